//! Update of the panel of one supernode by terms.
//!
//! Large panels are divided into tiles of columns. Rows below the square of a tile are independent: once the square is updated and its
//! rotations are known, they are tasks; the first task continues with the next square. Tiles and tasks begin at multiples of the widths of
//! vectors and of blocks of columns, so that a row undergoes the same instructions as in an undivided panel: the bits are the same.

use std::ops::Range;

use pulp::Arch;
use rayon::prelude::*;

use super::square::{AppliedRotations, DiagonalEntry, Rows, RowsBelow, Square};
use crate::panels::FactorKind;
use crate::substitution::BLOCK;

/// Columns in a tile.
const TILE: usize = 192;

/// Number of values to change, times the number of terms plus two, that makes a task worth while: some 50 microseconds.
const TASK: usize = 400_000;

/// A panel and the terms that update it.
pub(super) struct Panel<'a> {
    pub(super) kind: FactorKind,
    /// Diagonal entries of the matrix, shape (n_columns).
    pub(super) diagonal: &'a [DiagonalEntry],
    /// Remaining weights of the terms, shape (n_terms).
    pub(super) weights: &'a mut [f64],
    /// All rows of the panel.
    pub(super) rows: Rows<'a>,
}

/// Columns that are updated together.
struct Tile {
    columns: Range<usize>,
    /// Number of rows of each task below the square of the columns; `None` where all rows are updated with the pivots.
    rows_of_task: Option<usize>,
}

impl Panel<'_> {
    /// Updates the panel; returns the change of the number of negative pivots, or the column of a vanishing pivot as an error.
    pub(super) fn change(mut self) -> Result<isize, usize> {
        let n_columns = self.rows.columns.len();
        let mut tile = self.tile(0);
        // On one thread an undivided panel gives the same bits in less time.
        if tile.rows_of_task.is_none() || rayon::current_num_threads() == 1 {
            return self
                .update_undivided()
                .map(|rotations| rotations.more_negative);
        }
        let of_first = |column| tile.columns.start + column;
        let mut rotations = self.rotate(&tile).map_err(of_first)?;
        let mut more_negative = rotations.more_negative;
        while tile.columns.end < n_columns {
            let next = self.tile(tile.columns.end);
            let before = (tile, rotations);
            let of_next = match next.rows_of_task {
                Some(_) => self.update_below_and_next_square(&before, &next),
                None => {
                    self.update_rows_below(&before);
                    self.rotate(&next)
                }
            };
            rotations = of_next.map_err(|column| next.columns.start + column)?;
            more_negative += rotations.more_negative;
            tile = next;
        }
        self.update_rows_below(&(tile, rotations));
        Ok(more_negative)
    }

    /// The tile that begins at a column: all remaining columns where the rows below are not worth several tasks.
    fn tile(&self, first: usize) -> Tile {
        let n_columns = self.rows.columns.len();
        let height = self.rows.columns.first().map_or(0, |column| column.len());
        let width = TILE.min((n_columns - first) / BLOCK * BLOCK);
        let below = height - first - width;
        let n_tasks = width * below * (self.rows.terms.len() + 2) / TASK;
        let (end, rows_of_task) = if n_tasks < 2 {
            (n_columns, None)
        } else {
            let rows = below.div_ceil(n_tasks).next_multiple_of(BLOCK);
            (first + width, Some(rows))
        };
        Tile {
            columns: first..end,
            rows_of_task,
        }
    }

    /// Updates all rows of an undivided panel.
    fn update_undivided(self) -> Result<AppliedRotations, usize> {
        Arch::new().dispatch(Square {
            kind: self.kind,
            diagonal: self.diagonal,
            weights: self.weights,
            rows: self.rows,
        })
    }

    /// Updates the square of a tile, or all of its rows where they are not divided.
    fn rotate(&mut self, tile: &Tile) -> Result<AppliedRotations, usize> {
        let Range { start, end } = tile.columns;
        let n_rows = match tile.rows_of_task {
            Some(_) => end - start,
            None => self.rows.columns[start].len() - start,
        };
        let division = RowDivision {
            from: start,
            n_first: n_rows,
            n_each: usize::MAX,
        };
        let pieces = division.pieces(&mut self.rows, tile.columns.clone());
        Arch::new().dispatch(Square {
            kind: self.kind,
            diagonal: &self.diagonal[tile.columns.clone()],
            weights: self.weights,
            rows: pieces.into_iter().next().unwrap_or_default(),
        })
    }

    /// Updates the rows below the square of a tile.
    fn update_rows_below(&mut self, (tile, rotations): &(Tile, AppliedRotations)) {
        let Some(n_each) = tile.rows_of_task else {
            return;
        };
        let division = RowDivision {
            from: tile.columns.end,
            n_first: 0,
            n_each,
        };
        let pieces = division.pieces(&mut self.rows, tile.columns.clone());
        update_in_parallel(pieces.into_iter().skip(1).collect(), rotations);
    }

    /// Updates the rows below the square of a tile, and with them the square of the next tile.
    fn update_below_and_next_square(
        &mut self,
        (before, rotations): &(Tile, AppliedRotations),
        tile: &Tile,
    ) -> Result<AppliedRotations, usize> {
        let Range { start, end } = tile.columns;
        let division = RowDivision {
            from: start,
            n_first: end - start,
            n_each: before.rows_of_task.unwrap_or(usize::MAX),
        };
        let mut later = self.rows.columns.split_off(start);
        let of_square = later[..end - start].iter_mut();
        let columns = of_square.map(|column| &mut column[start..end]).collect();
        let pieces = division.pieces(&mut self.rows, before.columns.clone());
        let mut pieces = pieces.into_iter();
        let mut first = pieces.next().unwrap_or_default();
        let square = || {
            let rows = &mut first;
            Arch::new().dispatch(RowsBelow { rows, rotations });
            Arch::new().dispatch(Square {
                kind: self.kind,
                diagonal: &self.diagonal[start..end],
                weights: self.weights,
                rows: Rows { columns, ..first },
            })
        };
        let (rotations, ()) =
            rayon::join(square, || update_in_parallel(pieces.collect(), rotations));
        self.rows.columns.append(&mut later);
        rotations
    }
}

/// Updates rows below the pivots of columns, as parallel tasks.
fn update_in_parallel(pieces: Vec<Rows<'_>>, rotations: &AppliedRotations) {
    let tasks = pieces.into_par_iter().with_max_len(1);
    tasks.for_each(|mut rows| {
        let rows = &mut rows;
        Arch::new().dispatch(RowsBelow { rows, rotations });
    });
}

/// Division of the rows of a panel: a first piece, then pieces of equal size.
#[derive(Clone, Copy)]
struct RowDivision {
    from: usize,
    n_first: usize,
    n_each: usize,
}

impl RowDivision {
    fn divide(self, rows: &mut [f64]) -> impl Iterator<Item = &mut [f64]> {
        let (first, rest) = rows[self.from..].split_at_mut(self.n_first);
        std::iter::once(first).chain(rest.chunks_mut(self.n_each))
    }

    /// The pieces of some columns, with the terms and the right-hand side.
    fn pieces<'a>(self, rows: &'a mut Rows<'_>, columns: Range<usize>) -> Vec<Rows<'a>> {
        let mut pieces: Vec<Rows<'a>> = Vec::new();
        for column in &mut rows.columns[columns] {
            for (place, rows) in self.divide(column).enumerate() {
                if place == pieces.len() {
                    pieces.push(Rows::default());
                }
                pieces[place].columns.push(rows);
            }
        }
        for term in &mut rows.terms {
            let pieces = pieces.iter_mut().zip(self.divide(term));
            pieces.for_each(|(piece, rows)| piece.terms.push(rows));
        }
        if let Some(right_hand_side) = &mut rows.right_hand_side {
            let pieces = pieces.iter_mut().zip(self.divide(right_hand_side));
            pieces.for_each(|(piece, rows)| piece.right_hand_side = Some(rows));
        }
        pieces
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modification::square::VANISHING_PIVOT;

    /// Columns that fill no last block, and rows that fill no last vector.
    const N_COLUMNS: usize = 437;
    const HEIGHT: usize = 1_603;

    /// A panel with terms and a right-hand side.
    #[derive(Clone, PartialEq, Debug)]
    struct UpdateTest {
        values: Vec<f64>,
        weights: Vec<f64>,
        terms: Vec<f64>,
        right_hand_side: Vec<f64>,
    }

    impl UpdateTest {
        /// A factor whose small entries below the diagonal leave the size of the terms unchanged. Every fifth pivot of L D L^T is negative.
        fn new(kind: FactorKind, n_terms: usize) -> Self {
            let number = |k: usize| ((k * 7_919 % 10_007) as f64 / 5_003.5 - 1.0) / 30.0;
            let mut values: Vec<f64> = (0..N_COLUMNS * HEIGHT).map(number).collect();
            for column in 0..N_COLUMNS {
                let is_negative = kind == FactorKind::Ldlt && column % 5 == 0;
                values[column * HEIGHT + column] = if is_negative { -1.5 } else { 1.5 };
            }
            Self {
                values,
                weights: (0..n_terms).map(|k| [0.3, -0.2, 0.1][k % 3]).collect(),
                terms: (0..n_terms * HEIGHT).map(|k| number(k + 31)).collect(),
                right_hand_side: (0..HEIGHT).map(|k| number(k + 77)).collect(),
            }
        }

        fn panel<'a>(&'a mut self, kind: FactorKind, diagonal: &'a [DiagonalEntry]) -> Panel<'a> {
            Panel {
                kind,
                diagonal,
                weights: &mut self.weights,
                rows: Rows {
                    columns: self.values.chunks_exact_mut(HEIGHT).collect(),
                    terms: self.terms.chunks_exact_mut(HEIGHT).collect(),
                    right_hand_side: Some(&mut self.right_hand_side),
                },
            }
        }
    }

    /// Changes a panel in tiles, and a copy of it as a whole.
    fn both(kind: FactorKind, start: &UpdateTest) -> [(UpdateTest, Result<isize, usize>); 2] {
        let diagonal = [DiagonalEntry::new(1.0); N_COLUMNS];
        let (mut divided, mut whole) = (start.clone(), start.clone());
        let panel = divided.panel(kind, &diagonal);
        let n_tasks = |tile: &Tile| (HEIGHT - tile.columns.end).checked_div(tile.rows_of_task?);
        let mut tiles = vec![panel.tile(0)];
        while let Some(last) = tiles.last().filter(|it| it.columns.end < N_COLUMNS) {
            tiles.push(panel.tile(last.columns.end));
        }
        let n_tasks: Vec<_> = tiles.iter().map(n_tasks).collect();
        assert!(
            matches!(n_tasks[..], [Some(2..), Some(1..), None]),
            "{n_tasks:?}"
        );
        // A pool of one thread would not divide the panel.
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build();
        let of_divided = pool.expect("two threads").install(|| panel.change());
        let of_whole = whole.panel(kind, &diagonal).update_undivided();
        let of_whole = of_whole.map(|rotations| rotations.more_negative);
        [(divided, of_divided), (whole, of_whole)]
    }

    #[test]
    fn tiles_have_the_bits_of_a_panel_that_is_not_divided() {
        for kind in [FactorKind::Llt, FactorKind::Ldlt] {
            for n_terms in [3, 8] {
                let start = UpdateTest::new(kind, n_terms);
                let [divided, whole] = both(kind, &start);
                assert!(whole.1.is_ok() && whole.0 != start, "{kind:?}");
                assert!(divided == whole, "{kind:?}, {n_terms} terms");
            }
        }
    }

    /// A single term makes a pivot vanish: in the first tile, in the next ones, and in the last column.
    #[test]
    fn a_pivot_that_vanishes_has_the_same_column() {
        for kind in [FactorKind::Llt, FactorKind::Ldlt] {
            for column in [100, 251, 390, 436] {
                let mut start = UpdateTest::new(kind, 4);
                let pivot = start.values[column * HEIGHT + column];
                start.terms.fill(0.0);
                start.terms[3 * HEIGHT + column] = pivot;
                start.weights[3] = match kind {
                    FactorKind::Llt => -1.0,
                    FactorKind::Ldlt => -(1.0 - VANISHING_PIVOT / 10.0) / pivot,
                };
                let [divided, whole] = both(kind, &start);
                assert_eq!([divided.1, whole.1], [Err(column); 2], "{kind:?}");
            }
        }
    }
}
