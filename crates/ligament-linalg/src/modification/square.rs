//! Dense kernels of an update: terms are applied to some columns of a panel, and these to a right-hand side while they are in the cache.

use pulp::{Simd, WithSimd};

use super::rotation::{BLOCK, Rotation, rotate, rotate_root, rotate_rows};
use crate::panels::FactorKind;
use crate::substitution::{self, forward_block, subtract_block};

/// Ratio below which a pivot counts as zero, relative to the largest value of its diagonal entry of the matrix since the factorisation:
/// downdates leave rounding of some 1e-14 of that entry in place of a zero.
pub const VANISHING_PIVOT: f64 = 1e-10;

/// A diagonal entry of the matrix.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DiagonalEntry {
    value: f64,
    /// Largest absolute value of the entry since the matrix was factorised, which scales the rounding errors of the factor.
    pub(super) largest: f64,
}

impl DiagonalEntry {
    pub(crate) fn new(value: f64) -> Self {
        let largest = value.abs();
        Self { value, largest }
    }

    pub(super) fn add(&mut self, change: f64) {
        self.value += change;
        self.largest = self.largest.max(self.value.abs());
    }
}

/// Some rows of a panel.
#[derive(Default)]
pub(super) struct Rows<'a> {
    /// Columns of the factor, shape (n_columns, n_rows).
    pub(super) columns: Vec<&'a mut [f64]>,
    /// Terms, shape (n_terms, n_rows).
    pub(super) terms: Vec<&'a mut [f64]>,
    /// A right-hand side of the forward substitution, shape (n_rows).
    pub(super) right_hand_side: Option<&'a mut [f64]>,
}

/// Columns from the row of their first pivot down to the row of their last pivot or further.
pub(super) struct Square<'a, 'b> {
    pub(super) kind: FactorKind,
    /// Diagonal entries of the matrix by row.
    pub(super) diagonal: &'a [DiagonalEntry],
    /// Remaining weights of the terms, shape (n_terms).
    pub(super) weights: &'a mut [f64],
    pub(super) rows: Rows<'b>,
}

/// The action of terms on columns.
pub(super) struct AppliedRotations {
    /// Rotations of the columns by each term, for each block of columns, shape (n_blocks, n_terms).
    pub(super) rotations: Vec<[Rotation; BLOCK]>,
    /// Right-hand side at the pivots after the forward substitution; empty without one.
    pub(super) solved: Vec<f64>,
    /// Change of the number of negative pivots.
    pub(super) more_negative: isize,
}

/// Returns the action of the terms, or the column of a vanishing pivot.
impl WithSimd for Square<'_, '_> {
    type Output = Result<AppliedRotations, usize>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Square {
            kind,
            diagonal,
            weights,
            rows,
        } = self;
        let Rows {
            mut columns,
            mut terms,
            mut right_hand_side,
        } = rows;
        let n_blocks = columns.len().div_ceil(BLOCK);
        let mut rotations = Vec::with_capacity(n_blocks * terms.len());
        let mut more_negative = 0;
        let mut first = 0;
        for columns in columns.chunks_mut(substitution::BLOCK) {
            let start = first;
            for block in columns.chunks_mut(BLOCK) {
                let pivots = Pivots {
                    kind,
                    diagonal,
                    first,
                };
                let before = rotations.len();
                more_negative += pivots.change(block, weights, &mut terms, &mut rotations)?;
                first += block.len();
                rotate_rows(simd, block, first, &mut terms, &rotations[before..]);
            }
            if let Some(right_hand_side) = &mut right_hand_side {
                forward_block(simd, kind, columns, start, right_hand_side);
            }
        }
        let solved = right_hand_side.map_or_else(Vec::new, |it| it[..first].to_vec());
        Ok(AppliedRotations {
            rotations,
            solved,
            more_negative,
        })
    }
}

/// Rows below the pivots of columns.
pub(super) struct RowsBelow<'a, 'b> {
    pub(super) rows: &'a mut Rows<'b>,
    pub(super) rotations: &'a AppliedRotations,
}

impl WithSimd for RowsBelow<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Rows {
            columns,
            terms,
            right_hand_side,
        } = self.rows;
        let mut rotations = self.rotations.rotations.chunks_exact(terms.len());
        let mut solved = self.rotations.solved.chunks(substitution::BLOCK);
        for columns in columns.chunks_mut(substitution::BLOCK) {
            for block in columns.chunks_mut(BLOCK) {
                let rotations = rotations.next().unwrap_or_default();
                rotate_rows(simd, block, 0, terms, rotations);
            }
            if let (Some(rest), Some(solved)) = (&mut *right_hand_side, solved.next()) {
                subtract_block(simd, columns, solved, rest);
            }
        }
    }
}

/// Pivots of a block of columns, from the row of the first one.
struct Pivots<'a> {
    kind: FactorKind,
    /// Diagonal entries by row.
    diagonal: &'a [DiagonalEntry],
    first: usize,
}

impl Pivots<'_> {
    /// Updates the pivots and the triangle between them, and stores the rotations.
    #[inline(always)]
    fn change(
        self,
        block: &mut [&mut [f64]],
        weights: &mut [f64],
        terms: &mut [&mut [f64]],
        rotations: &mut Vec<[Rotation; BLOCK]>,
    ) -> Result<isize, usize> {
        let before = rotations.len();
        rotations.resize(before + terms.len(), [Rotation::default(); BLOCK]);
        let rotations = &mut rotations[before..];
        let end = self.first + block.len();
        let mut more_negative = 0;
        for (k, column) in block.iter_mut().enumerate() {
            let row = self.first + k;
            let was_negative = column[row] < 0.0;
            let vanishing = VANISHING_PIVOT * self.diagonal[row].largest;
            for ((w, weight), rotations) in
                (terms.iter_mut().zip(&mut *weights)).zip(&mut *rotations)
            {
                let (rotation, pivot) = match self.kind {
                    FactorKind::Llt => rotate_root(&mut column[row], weight, w[row]),
                    FactorKind::Ldlt => rotate(&mut column[row], weight, w[row]),
                };
                let size = match self.kind {
                    FactorKind::Llt => pivot,
                    FactorKind::Ldlt => pivot.abs(),
                };
                // Checked after each term: digits lost with one term do not come back with the next.
                if size.is_nan() || size <= vanishing {
                    return Err(row);
                }
                for r in row + 1..end {
                    w[r] -= rotation.c * column[r];
                    column[r] = rotation.p * column[r] + rotation.q * w[r];
                }
                rotations[k] = rotation;
            }
            more_negative += isize::from(column[row] < 0.0) - isize::from(was_negative);
        }
        Ok(more_negative)
    }
}
