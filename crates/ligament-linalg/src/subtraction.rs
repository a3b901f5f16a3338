//! The update of a panel by another: L L^T, or L D L^T, subtracted at their common rows and columns.

use std::ops::Range;

use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, MatMut, MatRef, Par};

use crate::panels::FactorKind;

/// Columns of a panel whose products are summed before the subtraction.
const DEPTH: usize = 512;

/// Number of columns from which on the part above the diagonal is not computed.
const TRIANGULAR: usize = 32;

/// Working memory of a subtraction.
#[derive(Default)]
pub(crate) struct Buffers {
    products: Vec<f64>,
    scaled: Vec<f64>,
    places: Vec<u32>,
}

/// A panel that updates panels after it.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    /// Values, shape (n_columns, height).
    pub(crate) values: &'a [f64],
    pub(crate) n_columns: usize,
    /// Rows below the columns, ascending.
    pub(crate) below: &'a [usize],
}

/// Some columns of a panel.
pub(crate) struct Target<'a> {
    /// Range of the columns, in the order of elimination.
    pub(crate) columns: Range<usize>,
    /// Index in the panel of each of its rows, shape (n); undefined for other rows.
    pub(crate) place_of_row: &'a [u32],
    /// Values, shape (n_columns, height).
    pub(crate) values: &'a mut [f64],
    pub(crate) height: usize,
}

impl Target<'_> {
    /// Subtracts the update of these columns by another panel.
    pub(crate) fn subtract(&mut self, kind: FactorKind, source: Source<'_>, buffers: &mut Buffers) {
        let Source {
            values: panel,
            n_columns: width,
            below,
        } = source;
        let from = below.partition_point(|&row| row < self.columns.start);
        let n_columns = below[from..].partition_point(|&row| row < self.columns.end);
        if n_columns == 0 {
            return;
        }
        let rows = &below[from..];
        let Buffers {
            products,
            scaled,
            places,
        } = buffers;
        places.clear();
        places.extend(rows.iter().map(|&row| self.place_of_row[row]));
        products.resize(products.len().max(rows.len() * n_columns), 0.0);
        let products = &mut products[..rows.len() * n_columns];
        let height = width + below.len();
        for first in (0..width).step_by(DEPTH) {
            let depth = DEPTH.min(width - first);
            let block = &panel[first * height..(first + depth) * height];
            let right = MatRef::from_column_major_slice(block, height, depth);
            let right = right.subrows(width + from, rows.len());
            let left = match kind {
                FactorKind::Llt => right,
                FactorKind::Ldlt => {
                    scaled.clear();
                    for (k, column) in block.chunks_exact(height).enumerate() {
                        let pivot = column[first + k];
                        let rows = &column[width + from..];
                        scaled.extend(rows.iter().map(|value| value * pivot));
                    }
                    MatRef::from_column_major_slice(scaled, rows.len(), depth)
                }
            };
            multiply(products, left, right.subrows(0, n_columns));
            self.add(rows, n_columns, products, places);
        }
    }

    /// Adds products (n_columns, n_rows) on and below the diagonal.
    fn add(&mut self, rows: &[usize], n_columns: usize, products: &[f64], places: &[u32]) {
        for (k, &column) in rows[..n_columns].iter().enumerate() {
            let products = &products[k * rows.len()..(k + 1) * rows.len()];
            let values = &mut self.values[(column - self.columns.start) * self.height..];
            let values = &mut values[..self.height];
            for (&place, product) in places[k..].iter().zip(&products[k..]) {
                values[place as usize] += product;
            }
        }
    }
}

/// Computes - left right^T, at least on and below the diagonal, column-major.
fn multiply(products: &mut [f64], left: MatRef<'_, f64>, right: MatRef<'_, f64>) {
    let n_columns = right.nrows();
    let products = MatMut::from_column_major_slice_mut(products, left.nrows(), n_columns);
    if n_columns < TRIANGULAR {
        matmul(
            products,
            Accum::Replace,
            left,
            right.transpose(),
            -1.0,
            Par::Seq,
        );
        return;
    }
    let (top, bottom) = products.split_at_row_mut(n_columns);
    let (top_left, bottom_left) = left.split_at_row(n_columns);
    triangular::matmul(
        top,
        BlockStructure::TriangularLower,
        Accum::Replace,
        top_left,
        BlockStructure::Rectangular,
        right.transpose(),
        BlockStructure::Rectangular,
        -1.0,
        Par::Seq,
    );
    matmul(
        bottom,
        Accum::Replace,
        bottom_left,
        right.transpose(),
        -1.0,
        Par::Seq,
    );
}
