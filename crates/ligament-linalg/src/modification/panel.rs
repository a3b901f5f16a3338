//! Terms through the panel of one supernode, and a right-hand side after them while what they changed is in the cache.
//!
//! Large panels are taken in tiles of columns. The rows below the square of a tile do not wait for each other: once the square is changed
//! and its rotations are known, they are tasks. Tiles and tasks begin at multiples of what vectors and blocks of columns
//! hold, so that a row takes the instructions that it takes in a panel that is not divided: the bits are the same.

use std::ops::Range;

use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use super::diagonal::{DiagonalEntry, VANISHING_PIVOT};
use super::rotation::{BLOCK, Rotation, rotate, rotate_root, rotate_rows};
use crate::panels::FactorKind;
use crate::substitution::{self, forward_block, subtract_block};

/// Columns of a tile.
const TILE: usize = 128;

/// Values to change, times the terms and two more, that make a task worth while: some 50 microseconds.
const TASK: usize = 200_000;

/// A panel with terms that go through it.
pub(super) struct Panel<'a> {
    pub(super) kind: FactorKind,
    /// Diagonal entries of the matrix, shape (n_columns).
    pub(super) diagonal: &'a [DiagonalEntry],
    /// What is left of the weights of the terms, shape (n_terms).
    pub(super) weights: &'a mut [f64],
    pub(super) rows: Rows<'a>,
}

/// Some rows of a panel.
#[derive(Default)]
pub(super) struct Rows<'a> {
    /// Columns of the factor, shape (n_columns, n_rows).
    pub(super) columns: Vec<&'a mut [f64]>,
    /// Terms, shape (n_terms, n_rows).
    pub(super) terms: Vec<&'a mut [f64]>,
    /// A right-hand side that the forward substitution takes along, shape (n_rows).
    pub(super) right_hand_side: Option<&'a mut [f64]>,
}

impl Panel<'_> {
    /// Changes the panel; gives the change of the number of negative pivots, or the column whose pivot vanished.
    pub(super) fn change(self) -> Result<isize, usize> {
        let Self {
            kind,
            diagonal,
            weights,
            mut rows,
        } = self;
        let mut more_negative = 0;
        let mut first = 0;
        while first < diagonal.len() {
            let tile = rows.tile(first);
            let end = tile.columns.end;
            let mut pieces = rows.divided(&tile).into_iter();
            let mut square = Square {
                kind,
                diagonal: &diagonal[first..end],
                weights,
                rows: pieces.next().unwrap_or_default(),
                rotations: Vec::new(),
            };
            let changed = Arch::new().dispatch(&mut square);
            more_negative += changed.map_err(|column| first + column)?;
            square.change_below(pieces.collect());
            first = end;
        }
        Ok(more_negative)
    }
}

/// Columns that are changed before others, and how the rows from their first pivot on are divided.
struct Tile {
    columns: Range<usize>,
    /// Rows that are changed along with the pivots.
    n_rows: usize,
    /// Rows of each task after that.
    rows_of_task: usize,
}

impl Tile {
    /// Rows that are changed along with the pivots, and then those of each task, of something with all rows of the panel.
    fn divide<'a>(&self, rows: &'a mut [f64]) -> impl Iterator<Item = &'a mut [f64]> + use<'a> {
        let (top, below) = rows[self.columns.start..].split_at_mut(self.n_rows);
        std::iter::once(top).chain(below.chunks_mut(self.rows_of_task))
    }
}

impl Rows<'_> {
    /// The tile that begins with a column; the whole rest where its rows are not worth several tasks.
    fn tile(&self, first: usize) -> Tile {
        let n_columns = self.columns.len();
        let height = self.columns.first().map_or(0, |column| column.len());
        let width = TILE.min((n_columns - first) / substitution::BLOCK * substitution::BLOCK);
        let below = height - first - width;
        let n_tasks = width * below * (self.terms.len() + 2) / TASK;
        if n_tasks < 2 {
            return Tile {
                columns: first..n_columns,
                n_rows: height - first,
                rows_of_task: 1,
            };
        }
        Tile {
            columns: first..first + width,
            n_rows: width,
            rows_of_task: below
                .div_ceil(n_tasks)
                .next_multiple_of(substitution::BLOCK),
        }
    }

    /// The rows that are changed along with the pivots of a tile, and then those of each task.
    fn divided(&mut self, tile: &Tile) -> Vec<Rows<'_>> {
        let mut pieces = Vec::new();
        for column in &mut self.columns[tile.columns.clone()] {
            for (place, rows) in tile.divide(column).enumerate() {
                if place == pieces.len() {
                    pieces.push(Rows::default());
                }
                pieces[place].columns.push(rows);
            }
        }
        for term in &mut self.terms {
            let pieces = pieces.iter_mut().zip(tile.divide(term));
            pieces.for_each(|(piece, rows)| piece.terms.push(rows));
        }
        if let Some(right_hand_side) = &mut self.right_hand_side {
            let pieces = pieces.iter_mut().zip(tile.divide(right_hand_side));
            pieces.for_each(|(piece, rows)| piece.right_hand_side = Some(rows));
        }
        pieces
    }
}

/// Columns from the row of their first pivot on, down to that of their last one or further.
struct Square<'a, 'b> {
    kind: FactorKind,
    diagonal: &'a [DiagonalEntry],
    weights: &'a mut [f64],
    rows: Rows<'b>,
    /// For each block of columns and each term, its action on the columns, shape (n_blocks, n_terms).
    rotations: Vec<[Rotation; BLOCK]>,
}

impl WithSimd for &mut Square<'_, '_> {
    type Output = Result<isize, usize>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Square {
            kind,
            diagonal,
            weights,
            rows,
            rotations,
        } = self;
        let Rows {
            columns,
            terms,
            right_hand_side,
        } = rows;
        let mut more_negative = 0;
        let mut first = 0;
        for columns in columns.chunks_mut(substitution::BLOCK) {
            let start = first;
            for block in columns.chunks_mut(BLOCK) {
                let pivots = Pivots {
                    kind: *kind,
                    diagonal,
                    first,
                };
                let before = rotations.len();
                more_negative += pivots.change(block, weights, terms, rotations)?;
                first += block.len();
                rotate_rows(simd, block, first, terms, &rotations[before..]);
            }
            if let Some(right_hand_side) = right_hand_side {
                forward_block(simd, *kind, columns, start, right_hand_side);
            }
        }
        Ok(more_negative)
    }
}

impl Square<'_, '_> {
    /// Changes rows further below, which are tasks.
    fn change_below(&self, tasks: Vec<Rows<'_>>) {
        let solved = self.rows.right_hand_side.as_deref().unwrap_or_default();
        tasks.into_par_iter().with_max_len(1).for_each(|rows| {
            Arch::new().dispatch(Below {
                rows,
                rotations: &self.rotations,
                solved,
            });
        });
    }
}

/// Rows below the pivots of some columns.
struct Below<'a, 'b> {
    rows: Rows<'b>,
    rotations: &'a [[Rotation; BLOCK]],
    /// What the right-hand side became at the pivots, shape (n_columns).
    solved: &'a [f64],
}

impl WithSimd for Below<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Rows {
            mut columns,
            mut terms,
            mut right_hand_side,
        } = self.rows;
        let mut rotations = self.rotations.chunks_exact(terms.len());
        let mut solved = self.solved.chunks(substitution::BLOCK);
        for columns in columns.chunks_mut(substitution::BLOCK) {
            for block in columns.chunks_mut(BLOCK) {
                let rotations = rotations.next().unwrap_or_default();
                rotate_rows(simd, block, 0, &mut terms, rotations);
            }
            if let (Some(rest), Some(solved)) = (&mut right_hand_side, solved.next()) {
                subtract_block(simd, columns, solved, rest);
            }
        }
    }
}

/// The pivots of a block of columns, from the row of the first of them on.
struct Pivots<'a> {
    kind: FactorKind,
    /// Diagonal entries by row.
    diagonal: &'a [DiagonalEntry],
    first: usize,
}

impl Pivots<'_> {
    /// Changes the pivots and the triangle between them, and notes the rotations.
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
                // After each term: what is lost with one does not come back with the next.
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
