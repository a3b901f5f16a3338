//! Terms through the panel of one supernode.
//!
//! Large panels are taken in tiles of columns. The rows below the square of a tile do not wait for each other: once the square is changed
//! and its rotations are known, they are tasks, and the first of these goes on to the next square. Tiles and tasks begin at
//! multiples of what vectors and blocks of columns hold, so that a row takes the instructions that it takes in a panel that
//! is not divided: the bits are the same.

use std::ops::Range;

use pulp::Arch;
use rayon::prelude::*;

use super::diagonal::DiagonalEntry;
use super::square::{Below, Rows, Square, Turned};
use crate::panels::FactorKind;
use crate::substitution::BLOCK;

/// Columns of a tile.
const TILE: usize = 192;

/// Values to change, times the terms and two more, that make a task worth while: some 25 microseconds.
const TASK: usize = 200_000;

/// A panel with terms that go through it.
pub(super) struct Panel<'a> {
    pub(super) kind: FactorKind,
    /// Diagonal entries of the matrix, shape (n_columns).
    pub(super) diagonal: &'a [DiagonalEntry],
    /// What is left of the weights of the terms, shape (n_terms).
    pub(super) weights: &'a mut [f64],
    /// All of its rows.
    pub(super) rows: Rows<'a>,
}

/// Columns that are changed before others.
struct Tile {
    columns: Range<usize>,
    /// Rows of each task below the square of the columns; None where all rows are changed along with the pivots.
    rows_of_task: Option<usize>,
}

impl Panel<'_> {
    /// Changes the panel; gives the change of the number of negative pivots, or the column whose pivot vanished.
    pub(super) fn change(mut self) -> Result<isize, usize> {
        let mut more_negative = 0;
        let mut before: Option<(Tile, Turned)> = None;
        for tile in self.tiles() {
            let turned = match (&before, tile.rows_of_task) {
                (Some(before), Some(_)) => self.turn_along(before, &tile),
                (Some(before), None) => {
                    self.turn_below(before);
                    self.turn(&tile)
                }
                (None, _) => self.turn(&tile),
            };
            let turned = turned.map_err(|column| tile.columns.start + column)?;
            more_negative += turned.more_negative;
            before = Some((tile, turned));
        }
        if let Some(last) = &before {
            self.turn_below(last);
        }
        Ok(more_negative)
    }

    /// The tiles: the last one takes all columns that are left where the rows below are not worth several tasks.
    fn tiles(&self) -> Vec<Tile> {
        let n_columns = self.rows.columns.len();
        let height = self.rows.columns.first().map_or(0, |column| column.len());
        let mut tiles = Vec::new();
        let mut first = 0;
        while first < n_columns {
            let width = TILE.min((n_columns - first) / BLOCK * BLOCK);
            let below = height - first - width;
            let n_tasks = width * below * (self.rows.terms.len() + 2) / TASK;
            let (end, rows_of_task) = if n_tasks < 2 {
                (n_columns, None)
            } else {
                let rows = below.div_ceil(n_tasks).next_multiple_of(BLOCK);
                (first + width, Some(rows))
            };
            tiles.push(Tile {
                columns: first..end,
                rows_of_task,
            });
            first = end;
        }
        tiles
    }

    /// Changes the square of a tile, or all of its rows where they are not divided.
    fn turn(&mut self, tile: &Tile) -> Result<Turned, usize> {
        let Range { start, end } = tile.columns;
        let n_rows = match tile.rows_of_task {
            Some(_) => end - start,
            None => self.rows.columns[start].len() - start,
        };
        let cut = Cut {
            from: start,
            n_first: n_rows,
            n_each: usize::MAX,
        };
        let pieces = cut.pieces(&mut self.rows, tile.columns.clone());
        Arch::new().dispatch(Square {
            kind: self.kind,
            diagonal: &self.diagonal[tile.columns.clone()],
            weights: self.weights,
            rows: pieces.into_iter().next().unwrap_or_default(),
        })
    }

    /// Changes the rows below the square of a tile.
    fn turn_below(&mut self, (tile, turned): &(Tile, Turned)) {
        let Some(n_each) = tile.rows_of_task else {
            return;
        };
        let cut = Cut {
            from: tile.columns.end,
            n_first: 0,
            n_each,
        };
        let pieces = cut.pieces(&mut self.rows, tile.columns.clone());
        side_by_side(pieces.into_iter().skip(1).collect(), turned);
    }

    /// Changes the rows below the square of a tile, and along with them the square of the next one.
    fn turn_along(
        &mut self,
        (before, turned): &(Tile, Turned),
        tile: &Tile,
    ) -> Result<Turned, usize> {
        let Range { start, end } = tile.columns;
        let cut = Cut {
            from: start,
            n_first: end - start,
            n_each: before.rows_of_task.unwrap_or(usize::MAX),
        };
        let mut later = self.rows.columns.split_off(start);
        let of_square = later[..end - start].iter_mut();
        let columns = of_square.map(|column| &mut column[start..end]).collect();
        let pieces = cut.pieces(&mut self.rows, before.columns.clone());
        let mut pieces = pieces.into_iter();
        let mut first = pieces.next().unwrap_or_default();
        let square = || {
            let rows = &mut first;
            Arch::new().dispatch(Below { rows, turned });
            Arch::new().dispatch(Square {
                kind: self.kind,
                diagonal: &self.diagonal[start..end],
                weights: self.weights,
                rows: Rows { columns, ..first },
            })
        };
        let (turned, ()) = rayon::join(square, || side_by_side(pieces.collect(), turned));
        self.rows.columns.append(&mut later);
        turned
    }
}

/// Changes rows below the pivots of columns, which are tasks.
fn side_by_side(pieces: Vec<Rows<'_>>, turned: &Turned) {
    let tasks = pieces.into_par_iter().with_max_len(1);
    tasks.for_each(|mut rows| {
        let rows = &mut rows;
        Arch::new().dispatch(Below { rows, turned });
    });
}

/// Where the rows of a panel are cut: so many from one on, and then each so many.
#[derive(Clone, Copy)]
struct Cut {
    from: usize,
    n_first: usize,
    n_each: usize,
}

impl Cut {
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
