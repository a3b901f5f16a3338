//! Forward and backward substitution on the panels of a factor.

use pulp::{Arch, Simd, WithSimd};

use crate::panels::{FactorKind, Panels};

/// Columns of a panel that are read together: as many streams from memory.
const BLOCK: usize = 8;

/// Solves L y = b in place: all supernodes, from the leaves to the root; rows in the order of elimination.
pub(crate) fn solve_forward(panels: Panels<'_>, vector: &mut [f64]) {
    Arch::new().dispatch(Forward { panels, vector });
}

/// Solves L^T x = y, or L^T x = D^-1 y, in place: all supernodes, from the root to the leaves.
pub(crate) fn solve_backward(panels: Panels<'_>, vector: &mut [f64]) {
    Arch::new().dispatch(Backward { panels, vector });
}

struct Forward<'a> {
    panels: Panels<'a>,
    vector: &'a mut [f64],
}

struct Backward<'a> {
    panels: Panels<'a>,
    vector: &'a mut [f64],
}

impl WithSimd for Forward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let mut column = Vec::new();
        for supernode in 0..self.panels.supernodes.len() {
            forward(simd, self.panels, supernode, self.vector, &mut column);
        }
    }
}

impl WithSimd for Backward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let mut column = Vec::new();
        for supernode in (0..self.panels.supernodes.len()).rev() {
            backward(simd, self.panels, supernode, self.vector, &mut column);
        }
    }
}

/// Solves for the columns of one supernode and takes their part off the rows below.
#[inline(always)]
pub(crate) fn forward<S: Simd>(
    simd: S,
    panels: Panels<'_>,
    supernode: usize,
    vector: &mut [f64],
    column: &mut Vec<f64>,
) {
    let Panels {
        kind,
        supernodes,
        values,
    } = panels;
    let columns = supernodes.columns(supernode);
    let below = supernodes.rows_below(supernode);
    let height = columns.len() + below.len();
    column.clear();
    column.extend_from_slice(&vector[columns.clone()]);
    column.resize(height, 0.0);
    let panel = &values[supernodes.panel(supernode)];
    for (index, block) in panel.chunks(BLOCK * height).enumerate() {
        let first = BLOCK * index;
        let end = first + block.len() / height;
        for (k, l) in block.chunks_exact(height).enumerate() {
            let row = first + k;
            if kind == FactorKind::Llt {
                column[row] /= l[row];
            }
            for r in row + 1..end {
                column[r] -= l[r] * column[row];
            }
        }
        let (solved, rest) = column.split_at_mut(end);
        match end - first {
            8 => subtract::<S, 8>(simd, block, &solved[first..], rest),
            7 => subtract::<S, 7>(simd, block, &solved[first..], rest),
            6 => subtract::<S, 6>(simd, block, &solved[first..], rest),
            5 => subtract::<S, 5>(simd, block, &solved[first..], rest),
            4 => subtract::<S, 4>(simd, block, &solved[first..], rest),
            3 => subtract::<S, 3>(simd, block, &solved[first..], rest),
            2 => subtract::<S, 2>(simd, block, &solved[first..], rest),
            _ => subtract::<S, 1>(simd, block, &solved[first..], rest),
        }
    }
    let (solved, rest) = column.split_at(columns.len());
    vector[columns].copy_from_slice(solved);
    for (&row, value) in below.iter().zip(rest) {
        vector[row] += value;
    }
}

/// Solves for the columns of one supernode from the rows below, which are known.
#[inline(always)]
fn backward<S: Simd>(
    simd: S,
    panels: Panels<'_>,
    supernode: usize,
    vector: &mut [f64],
    column: &mut Vec<f64>,
) {
    let Panels {
        kind,
        supernodes,
        values,
    } = panels;
    let columns = supernodes.columns(supernode);
    let below = supernodes.rows_below(supernode);
    let height = columns.len() + below.len();
    column.clear();
    column.extend_from_slice(&vector[columns.clone()]);
    column.extend(below.iter().map(|&row| vector[row]));
    let panel = &values[supernodes.panel(supernode)];
    for (index, block) in panel.chunks(BLOCK * height).enumerate().rev() {
        let first = BLOCK * index;
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
    let n_columns = columns.len();
    vector[columns].copy_from_slice(&column[..n_columns]);
}

/// rest <- rest - sum over the columns of the block of l x, at the rows of `rest`.
#[inline(always)]
fn subtract<S: Simd, const WIDTH: usize>(simd: S, block: &[f64], x: &[f64], rest: &mut [f64]) {
    let height = block.len() / WIDTH;
    let first_row = height - rest.len();
    let columns: [_; WIDTH] =
        std::array::from_fn(|k| S::as_simd_f64s(&block[k * height + first_row..(k + 1) * height]));
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

/// Sums over the rows of `known` of l x for each column of the block.
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
