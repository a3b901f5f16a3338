//! Forward and backward substitution on the panels of a factor.

use std::ops::Range;

use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use crate::branches::Branch;
use crate::panels::{FactorKind, Panels};

/// Columns of a panel that are read together: the number of streams from memory.
pub(crate) const BLOCK: usize = 8;

/// Solves L y = b in place for N vectors, from the leaves to the root; rows in the order of elimination.
///
/// The vectors pass through each block of columns one after another while it is in the cache: a second vector takes a small part of the
/// time of the first, and each has the bits of a pass of its own.
pub(crate) fn solve_forward<const N: usize>(
    panels: Panels<'_>,
    branch: &Branch,
    vectors: [&mut [f64]; N],
) {
    forward_branch(panels, branch, vectors);
}

/// Solves L^T x = y, or L^T x = D^-1 y, in place for N vectors, from the root to the leaves.
pub(crate) fn solve_backward<const N: usize>(
    panels: Panels<'_>,
    branch: &Branch,
    vectors: [&mut [f64]; N],
) {
    if rayon::current_num_threads() == 1 {
        // Same sums as by branches, from the last panel to the first, as they lie in memory.
        solve_backward_in(panels, branch.supernodes(), vectors);
    } else {
        backward_branch(panels, branch, vectors, None);
    }
}

/// Solves L^T x = y, or L^T x = D^-1 y, in place for the rows of consecutive supernodes, where the other rows that they need are solved.
pub(crate) fn solve_backward_in<const N: usize>(
    panels: Panels<'_>,
    supernodes: Range<usize>,
    vectors: [&mut [f64]; N],
) {
    let first_row = panels.rows(supernodes.clone()).start;
    Arch::new().dispatch(Backward {
        panels,
        first_row,
        vectors: vectors.map(|it| &mut it[first_row..]),
        stem: supernodes,
        above: None,
    });
}

/// Contribution of a supernode to a row of a vector: vector, row and value.
type RowContribution = (usize, usize, f64);

/// Forward substitution in the rows of a branch; returns the contributions to rows beyond it, in the order of its supernodes.
///
/// Sums are taken in the order of the supernodes for any number of threads: a part returns single contributions instead of sums.
fn forward_branch<const N: usize>(
    panels: Panels<'_>,
    branch: &Branch,
    mut vectors: [&mut [f64]; N],
) -> Vec<RowContribution> {
    let rows = panels.rows(branch.supernodes());
    let mut beyond = Vec::new();
    let of_parts: Vec<Vec<RowContribution>> = (branch.parts.par_iter())
        .zip(panels.split(&branch.parts, vectors.each_mut().map(|it| &mut **it)))
        .with_max_len(1)
        .map(|(part, vectors)| forward_branch(panels, part, vectors))
        .collect();
    for (vector, row, value) in of_parts.into_iter().flatten() {
        match vectors[vector].get_mut(row - rows.start) {
            Some(sum) => *sum += value,
            None => beyond.push((vector, row, value)),
        }
    }
    Arch::new().dispatch(Forward {
        panels,
        stem: branch.stem.clone(),
        first_row: rows.start,
        vectors,
        beyond: &mut beyond,
    });
    beyond
}

struct Forward<'a, const N: usize> {
    panels: Panels<'a>,
    stem: Range<usize>,
    /// First row of the vectors.
    first_row: usize,
    vectors: [&'a mut [f64]; N],
    beyond: &'a mut Vec<RowContribution>,
}

impl<const N: usize> WithSimd for Forward<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let supernodes = self.panels.supernodes;
        let mut columns = [const { Vec::new() }; N];
        for supernode in self.stem {
            let Range { start, end } = supernodes.columns(supernode);
            let below = supernodes.rows_below(supernode);
            for (column, vector) in columns.iter_mut().zip(&self.vectors) {
                column.clear();
                column.extend_from_slice(&vector[start - self.first_row..end - self.first_row]);
                column.resize(end - start + below.len(), 0.0);
            }
            let all = columns.each_mut().map(Vec::as_mut_slice);
            forward(simd, self.panels, supernode, all);
            for (number, (column, vector)) in columns.iter().zip(&mut self.vectors).enumerate() {
                let (solved, additions) = column.split_at(end - start);
                vector[start - self.first_row..end - self.first_row].copy_from_slice(solved);
                let is_own = |row: &usize| row - self.first_row < vector.len();
                let own = match below.last() {
                    Some(last) if !is_own(last) => below.partition_point(is_own),
                    _ => below.len(),
                };
                for (&row, value) in below[..own].iter().zip(additions) {
                    vector[row - self.first_row] += value;
                }
                let others = below[own..].iter().zip(&additions[own..]);
                self.beyond
                    .extend(others.map(|(&row, &value)| (number, row, value)));
            }
        }
    }
}

/// Solved rows of the stems above a branch.
#[derive(Clone, Copy)]
struct SolvedRows<'a, const N: usize> {
    first_row: usize,
    solutions: [&'a [f64]; N],
    above: Option<&'a SolvedRows<'a, N>>,
}

impl<const N: usize> SolvedRows<'_, N> {
    /// Appends the values of a vector at some rows, ascending, from this stem or those above.
    #[inline(always)]
    fn gather(mut self, vector: usize, mut rows: &[usize], values: &mut Vec<f64>) {
        while let Some(above) = self.above {
            let solution = self.solutions[vector];
            let own = rows.partition_point(|row| row - self.first_row < solution.len());
            let (of_stem, beyond) = rows.split_at(own);
            values.extend(of_stem.iter().map(|row| solution[row - self.first_row]));
            (self, rows) = (*above, beyond);
        }
        let solution = self.solutions[vector];
        values.extend(rows.iter().map(|row| solution[row - self.first_row]));
    }
}

/// Backward substitution in the rows of a branch, from the solved rows above it.
fn backward_branch<const N: usize>(
    panels: Panels<'_>,
    branch: &Branch,
    vectors: [&mut [f64]; N],
    above: Option<&SolvedRows<'_, N>>,
) {
    let first_row = panels.rows(branch.stem.clone()).start;
    let n_rows_of_parts = first_row - panels.rows(branch.supernodes()).start;
    let mut of_parts = vectors;
    let mut of_stem =
        (of_parts.each_mut()).map(|it| it.split_off_mut(n_rows_of_parts..).unwrap_or_default());
    Arch::new().dispatch(Backward {
        panels,
        stem: branch.stem.clone(),
        first_row,
        vectors: of_stem.each_mut().map(|it| &mut **it),
        above,
    });
    let known = SolvedRows {
        first_row,
        solutions: of_stem.each_ref().map(|it| &**it),
        above,
    };
    (branch.parts.par_iter())
        .zip(panels.split(&branch.parts, of_parts))
        .with_max_len(1)
        .for_each(|(part, vectors)| backward_branch(panels, part, vectors, Some(&known)));
}

struct Backward<'a, const N: usize> {
    panels: Panels<'a>,
    stem: Range<usize>,
    /// First row of the vectors.
    first_row: usize,
    vectors: [&'a mut [f64]; N],
    above: Option<&'a SolvedRows<'a, N>>,
}

impl<const N: usize> WithSimd for Backward<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let supernodes = self.panels.supernodes;
        let mut columns = [const { Vec::new() }; N];
        for supernode in self.stem.rev() {
            let Range { start, end } = supernodes.columns(supernode);
            let rest = SolvedRows {
                first_row: end,
                solutions: self
                    .vectors
                    .each_ref()
                    .map(|it| &it[end - self.first_row..]),
                above: self.above,
            };
            for (number, column) in columns.iter_mut().enumerate() {
                column.clear();
                let own = start - self.first_row..end - self.first_row;
                column.extend_from_slice(&self.vectors[number][own]);
                rest.gather(number, supernodes.rows_below(supernode), column);
            }
            let all = columns.each_mut().map(Vec::as_mut_slice);
            backward(simd, self.panels, supernode, all);
            for (column, vector) in columns.iter().zip(&mut self.vectors) {
                vector[start - self.first_row..end - self.first_row]
                    .copy_from_slice(&column[..end - start]);
            }
        }
    }
}

/// Forward substitution in the columns of one supernode, the first entries of `column`, in place; the other entries become the contributions
/// to the rows below.
pub(crate) fn forward_in(panels: Panels<'_>, supernode: usize, column: &mut [f64]) {
    Arch::new().dispatch(ForwardIn {
        panels,
        supernode,
        column,
    });
}

struct ForwardIn<'a> {
    panels: Panels<'a>,
    supernode: usize,
    column: &'a mut [f64],
}

impl WithSimd for ForwardIn<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        forward(simd, self.panels, self.supernode, [self.column]);
    }
}

/// Implementation of [`forward_in`] for N columns.
#[inline(always)]
fn forward<S: Simd, const N: usize>(
    simd: S,
    panels: Panels<'_>,
    supernode: usize,
    mut of_vectors: [&mut [f64]; N],
) {
    let Panels {
        kind,
        supernodes,
        values,
    } = panels;
    let height = of_vectors[0].len();
    let panel = &values[supernodes.panel(supernode)];
    for (index, block) in panel.chunks(BLOCK * height).enumerate() {
        let mut columns: [&[f64]; BLOCK] = Default::default();
        for (place, l) in columns.iter_mut().zip(block.chunks_exact(height)) {
            *place = l;
        }
        let columns = &columns[..block.len() / height];
        for column in &mut of_vectors {
            forward_block(simd, kind, columns, BLOCK * index, column);
        }
    }
}

/// Forward substitution in a block of columns; the pivot of its first column is in the row `first` of the columns and of `column`.
#[inline(always)]
pub(crate) fn forward_block<S: Simd>(
    simd: S,
    kind: FactorKind,
    block: &[impl AsRef<[f64]>],
    first: usize,
    column: &mut [f64],
) {
    let end = first + block.len();
    for (k, l) in block.iter().enumerate() {
        let (row, l) = (first + k, l.as_ref());
        if kind == FactorKind::Llt {
            column[row] /= l[row];
        }
        for r in row + 1..end {
            column[r] -= l[r] * column[row];
        }
    }
    let (solved, rest) = column.split_at_mut(end);
    subtract_block(simd, block, &solved[first..], rest);
}

/// Computes rest <- rest - sum of l x over the columns of a block, at the last rows of the columns, as many as `rest` has.
#[inline(always)]
pub(crate) fn subtract_block<S: Simd>(
    simd: S,
    block: &[impl AsRef<[f64]>],
    x: &[f64],
    rest: &mut [f64],
) {
    match block.len() {
        8 => subtract::<S, 8>(simd, block, x, rest),
        7 => subtract::<S, 7>(simd, block, x, rest),
        6 => subtract::<S, 6>(simd, block, x, rest),
        5 => subtract::<S, 5>(simd, block, x, rest),
        4 => subtract::<S, 4>(simd, block, x, rest),
        3 => subtract::<S, 3>(simd, block, x, rest),
        2 => subtract::<S, 2>(simd, block, x, rest),
        _ => subtract::<S, 1>(simd, block, x, rest),
    }
}

/// Backward substitution of N vectors in the columns of one supernode, the first entries of each, from the solved rows below.
#[inline(always)]
fn backward<S: Simd, const N: usize>(
    simd: S,
    panels: Panels<'_>,
    supernode: usize,
    mut of_vectors: [&mut [f64]; N],
) {
    let Panels {
        kind,
        supernodes,
        values,
    } = panels;
    let height = of_vectors[0].len();
    let panel = &values[supernodes.panel(supernode)];
    for (index, block) in panel.chunks(BLOCK * height).enumerate().rev() {
        for column in &mut of_vectors {
            backward_block(simd, kind, block, BLOCK * index, column);
        }
    }
}

/// Backward substitution in a block of columns; the pivot of its first column is in the row `first` of the columns and of `column`.
#[inline(always)]
fn backward_block<S: Simd>(
    simd: S,
    kind: FactorKind,
    block: &[f64],
    first: usize,
    column: &mut [f64],
) {
    let height = column.len();
    let end = first + block.len() / height;
    let known = &column[end..];
    let mut sums = [0.0; BLOCK];
    match end - first {
        8 => products::<S, 8>(simd, block, known, &mut sums),
        7 => products::<S, 7>(simd, block, known, &mut sums),
        6 => products::<S, 6>(simd, block, known, &mut sums),
        5 => products::<S, 5>(simd, block, known, &mut sums),
        4 => products::<S, 4>(simd, block, known, &mut sums),
        3 => products::<S, 3>(simd, block, known, &mut sums),
        2 => products::<S, 2>(simd, block, known, &mut sums),
        _ => products::<S, 1>(simd, block, known, &mut sums),
    }
    for (k, l) in block.chunks_exact(height).enumerate().rev() {
        let row = first + k;
        let in_block: f64 = (row + 1..end).map(|r| l[r] * column[r]).sum();
        let known = sums[k] + in_block;
        column[row] = match kind {
            FactorKind::Llt => (column[row] - known) / l[row],
            FactorKind::Ldlt => column[row] / l[row] - known,
        };
    }
}

/// Implementation of [`subtract_block`] for blocks of `WIDTH` columns.
#[inline(always)]
fn subtract<S: Simd, const WIDTH: usize>(
    simd: S,
    block: &[impl AsRef<[f64]>],
    x: &[f64],
    rest: &mut [f64],
) {
    let columns: [_; WIDTH] = std::array::from_fn(|k| {
        let l = block[k].as_ref();
        S::as_simd_f64s(&l[l.len() - rest.len()..])
    });
    let (rest, tail) = S::as_mut_simd_f64s(rest);
    let factors: [_; WIDTH] = std::array::from_fn(|k| simd.splat_f64s(x[k]));
    for column in &columns {
        assert_eq!(column.0.len(), rest.len());
    }
    for (r, value) in rest.iter_mut().enumerate() {
        for k in 0..WIDTH {
            *value = simd.negate_mul_add_e_f64s(factors[k], columns[k].0[r], *value);
        }
    }
    for (r, value) in tail.iter_mut().enumerate() {
        for k in 0..WIDTH {
            *value -= x[k] * columns[k].1[r];
        }
    }
}

/// Sums of l x over the rows of `known`, for each column of the block.
#[inline(always)]
fn products<S: Simd, const WIDTH: usize>(
    simd: S,
    block: &[f64],
    known: &[f64],
    sums: &mut [f64; BLOCK],
) {
    let height = block.len() / WIDTH;
    let first_row = height - known.len();
    let columns: [_; WIDTH] =
        std::array::from_fn(|k| S::as_simd_f64s(&block[k * height + first_row..(k + 1) * height]));
    let (known, tail) = S::as_simd_f64s(known);
    for column in &columns {
        assert_eq!(column.0.len(), known.len());
    }
    let mut totals = [simd.splat_f64s(0.0); WIDTH];
    for (r, value) in known.iter().enumerate() {
        for k in 0..WIDTH {
            totals[k] = simd.mul_add_e_f64s(columns[k].0[r], *value, totals[k]);
        }
    }
    for k in 0..WIDTH {
        let rest: f64 = columns[k].1.iter().zip(tail).map(|(l, x)| l * x).sum();
        sums[k] = simd.reduce_sum_f64s(totals[k]) + rest;
    }
}
