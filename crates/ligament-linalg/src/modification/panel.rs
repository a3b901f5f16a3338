//! The dense kernel of a change: terms through the panel of one supernode.

use std::ops::Range;

use pulp::Simd;

use super::diagonal::{DiagonalEntry, VANISHING_PIVOT};
use crate::panels::FactorKind;

/// Terms that go through the factor at once: their part of a panel stays in the cache.
pub(super) const TERMS_AT_ONCE: usize = 32;

/// Columns of a panel that are changed together.
const BLOCK: usize = 4;

/// The terms c w w^T on their way, with what of w lies in the panel at hand.
#[derive(Default)]
pub(super) struct Terms {
    /// What is left of the weight c of each term.
    weights: Vec<f64>,
    /// The terms that are not zero in the columns of the panel.
    active: Vec<usize>,
    /// Rows of the panel of the active terms, one term after another, shape (active, height).
    rows: Vec<f64>,
    height: usize,
    /// For each active term, its action on the columns of a block.
    rotations: Vec<[Rotation; BLOCK]>,
}

/// The action of a term on a column l of the factor, below the diagonal: w <- w - c l, then l <- p l + q w.
#[derive(Debug, Clone, Copy, Default)]
struct Rotation {
    c: f64,
    p: f64,
    q: f64,
}

impl Terms {
    /// Starts with the weights of new terms.
    pub(super) fn start(&mut self, weights: impl Iterator<Item = f64>) {
        self.weights.clear();
        self.weights.extend(weights);
    }

    /// Takes over what terms have in a panel; false if they are all zero in its columns.
    pub(super) fn gather(
        &mut self,
        columns: Range<usize>,
        below: &[usize],
        on_the_way: &mut [f64],
    ) -> bool {
        let n_terms = self.weights.len();
        self.active.clear();
        let in_columns = &on_the_way[TERMS_AT_ONCE * columns.start..TERMS_AT_ONCE * columns.end];
        self.active.extend((0..n_terms).filter(|&term| {
            in_columns
                .chunks_exact(TERMS_AT_ONCE)
                .any(|row| row[term] != 0.0)
        }));
        self.height = columns.len() + below.len();
        self.rows.clear();
        self.rows.resize(self.active.len() * self.height, 0.0);
        for (local, row) in columns.clone().chain(below.iter().copied()).enumerate() {
            let values = &on_the_way[TERMS_AT_ONCE * row..][..n_terms];
            for (place, &term) in self.active.iter().enumerate() {
                self.rows[place * self.height + local] = values[term];
            }
        }
        on_the_way[TERMS_AT_ONCE * columns.start..TERMS_AT_ONCE * columns.end].fill(0.0);
        !self.active.is_empty()
    }

    /// Hands the terms on to the rows below the panel.
    pub(super) fn scatter(&self, columns: Range<usize>, below: &[usize], on_the_way: &mut [f64]) {
        for (local, &row) in below.iter().enumerate() {
            let values = &mut on_the_way[TERMS_AT_ONCE * row..][..TERMS_AT_ONCE];
            for (place, &term) in self.active.iter().enumerate() {
                values[term] = self.rows[place * self.height + columns.len() + local];
            }
        }
    }

    /// Changes a panel; gives the change of the number of negative pivots, or the column whose pivot vanished.
    #[inline(always)]
    pub(super) fn change<S: Simd>(
        &mut self,
        simd: S,
        kind: FactorKind,
        panel: &mut [f64],
        diagonal: &[DiagonalEntry],
    ) -> Result<isize, usize> {
        let mut more_negative = 0;
        for (index, block) in panel.chunks_mut(BLOCK * self.height).enumerate() {
            let first = BLOCK * index;
            let width = block.len() / self.height;
            more_negative += self.change_pivots(kind, block, first, width, diagonal)?;
            match width {
                4 => self.change_below::<S, 4>(simd, block, first + 4),
                3 => self.change_below::<S, 3>(simd, block, first + 3),
                2 => self.change_below::<S, 2>(simd, block, first + 2),
                _ => self.change_below::<S, 1>(simd, block, first + 1),
            }
        }
        Ok(more_negative)
    }

    /// Changes the pivots of a block of columns and the triangle between them, and notes the rotations.
    #[inline(always)]
    fn change_pivots(
        &mut self,
        kind: FactorKind,
        block: &mut [f64],
        first: usize,
        width: usize,
        diagonal: &[DiagonalEntry],
    ) -> Result<isize, usize> {
        let height = self.height;
        self.rotations.clear();
        self.rotations
            .resize(self.active.len(), [Rotation::default(); BLOCK]);
        let mut more_negative = 0;
        for (k, column) in block.chunks_exact_mut(height).enumerate() {
            let row = first + k;
            let was_negative = column[row] < 0.0;
            let vanishing = VANISHING_PIVOT * diagonal[row].largest;
            for (place, &term) in self.active.iter().enumerate() {
                let w = &mut self.rows[place * height..][..height];
                let weight = &mut self.weights[term];
                let (rotation, pivot) = match kind {
                    FactorKind::Llt => rotate_root(&mut column[row], weight, w[row]),
                    FactorKind::Ldlt => rotate(&mut column[row], weight, w[row]),
                };
                let size = match kind {
                    FactorKind::Llt => pivot,
                    FactorKind::Ldlt => pivot.abs(),
                };
                // After each term: what is lost with one does not come back with the next.
                if size.is_nan() || size <= vanishing {
                    return Err(row);
                }
                for r in row + 1..first + width {
                    w[r] -= rotation.c * column[r];
                    column[r] = rotation.p * column[r] + rotation.q * w[r];
                }
                self.rotations[place][k] = rotation;
            }
            more_negative += isize::from(column[row] < 0.0) - isize::from(was_negative);
        }
        Ok(more_negative)
    }

    /// Applies the rotations to the rows below a block of columns, for two terms at a time: the columns are then read and
    /// written half as often.
    #[inline(always)]
    fn change_below<S: Simd, const WIDTH: usize>(
        &mut self,
        simd: S,
        block: &mut [f64],
        first_row: usize,
    ) {
        let height = self.height;
        let mut pairs = self.rows.chunks_exact_mut(2 * height);
        let mut rotations = self.rotations.chunks_exact(2);
        for (w, rotations) in (&mut pairs).zip(&mut rotations) {
            let (one, other) = w.split_at_mut(height);
            let w = [&mut one[first_row..], &mut other[first_row..]];
            let rotations = [rotations[0], rotations[1]];
            apply::<S, WIDTH, 2>(simd, block, w, &rotations);
        }
        if let ([rotations], w) = (rotations.remainder(), pairs.into_remainder()) {
            apply::<S, WIDTH, 1>(simd, block, [&mut w[first_row..]], &[*rotations]);
        }
    }
}

/// Applies the rotations of some terms, one after the other, to the last rows of a block of columns.
#[inline(always)]
fn apply<S: Simd, const WIDTH: usize, const TERMS: usize>(
    simd: S,
    block: &mut [f64],
    terms: [&mut [f64]; TERMS],
    rotations: &[[Rotation; BLOCK]; TERMS],
) {
    let height = block.len() / WIDTH;
    let n_rows = terms[0].len();
    let mut terms = terms.map(|w| S::as_mut_simd_f64s(w));
    let mut columns = block.chunks_exact_mut(height);
    let mut columns: [_; WIDTH] = std::array::from_fn(|_| {
        let column = columns.next().unwrap_or_default();
        S::as_mut_simd_f64s(&mut column[height - n_rows..])
    });
    let splat = |part: fn(&Rotation) -> f64| -> [[_; WIDTH]; TERMS] {
        std::array::from_fn(|t| std::array::from_fn(|k| simd.splat_f64s(part(&rotations[t][k]))))
    };
    let (c, p, q) = (splat(|r| r.c), splat(|r| r.p), splat(|r| r.q));
    let n_vectors = terms[0].0.len();
    for w in &terms {
        assert_eq!(w.0.len(), n_vectors);
    }
    for column in &columns {
        assert_eq!(column.0.len(), n_vectors);
    }
    for r in 0..n_vectors {
        let mut values: [_; TERMS] = std::array::from_fn(|t| terms[t].0[r]);
        for k in 0..WIDTH {
            let mut l = columns[k].0[r];
            for t in 0..TERMS {
                values[t] = simd.negate_mul_add_e_f64s(c[t][k], l, values[t]);
                l = simd.mul_add_e_f64s(q[t][k], values[t], simd.mul_f64s(p[t][k], l));
            }
            columns[k].0[r] = l;
        }
        for t in 0..TERMS {
            terms[t].0[r] = values[t];
        }
    }
    for (w, rotations) in terms.iter_mut().zip(rotations) {
        for (r, w) in w.1.iter_mut().enumerate() {
            for (column, rotation) in columns.iter_mut().zip(rotations) {
                let l = &mut column.1[r];
                *w -= rotation.c * *l;
                *l = rotation.p * *l + rotation.q * *w;
            }
        }
    }
}

/// One step of L D L^T + c w w^T at a pivot d: d' = d + c w^2, c' = c d/d' (Gill 1974, method C1). Gives the action on the
/// column, and d'; the result is worthless where d' vanishes.
#[inline(always)]
fn rotate(pivot: &mut f64, weight: &mut f64, w: f64) -> (Rotation, f64) {
    let old = *pivot;
    let new = old + *weight * w * w;
    let q = *weight * w / new;
    *weight *= old / new;
    *pivot = new;
    (Rotation { c: w, p: 1.0, q }, new)
}

/// One step as [`rotate`] does it where the diagonal holds the square root of the pivot, and each column is that root times
/// the column of a unit L. The result is worthless where the new pivot is not positive.
#[inline(always)]
fn rotate_root(root: &mut f64, weight: &mut f64, w: f64) -> (Rotation, f64) {
    let old = *root;
    let new = old * old + *weight * w * w;
    let new_root = new.sqrt();
    let q = *weight * w / new_root;
    *weight *= old * old / new;
    *root = new_root;
    let rotation = Rotation {
        c: w / old,
        p: new_root / old,
        q,
    };
    (rotation, new)
}
