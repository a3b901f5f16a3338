//! Dense factorisation of the panel of a supernode: its columns, then the rows below.
//!
//! The arithmetic is faer's. Large panels are divided into the blocks that faer uses on one thread; independent rows and columns of these
//! blocks are tasks. The results have the same bits on any number of threads.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::{ldlt, llt};
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_unit_lower_triangular_in_place,
};
use faer::prelude::{Reborrow, ReborrowMut};
use faer::{Accum, MatMut, MatRef, Par};
use rayon::prelude::*;

use crate::panels::FactorKind;

/// Columns that faer eliminates together.
const BLOCK: usize = 128;

/// Rows below a block in one task.
const ROWS: usize = 128;

/// Factorises a panel (n_columns, height); the error is the first column without a valid pivot.
pub(crate) fn factorise(
    kind: FactorKind,
    panel: &mut [f64],
    n_columns: usize,
) -> Result<(), usize> {
    let height = panel.len() / n_columns;
    let panel = MatMut::from_column_major_slice_mut(panel, height, n_columns);
    let (mut columns, below) = panel.split_at_row_mut(n_columns);
    if n_columns <= 2 * BLOCK {
        factorise_at_once(kind, columns.rb_mut())?;
    } else {
        in_blocks(kind, columns.rb_mut())?;
    }
    if kind == FactorKind::Ldlt {
        for j in 1..n_columns {
            columns.rb_mut().col_mut(j).subrows_mut(0, j).fill(0.0);
        }
    }
    solve(kind, columns.rb(), below);
    Ok(())
}

/// Factorises a square matrix in one call to faer.
fn factorise_at_once(kind: FactorKind, square: MatMut<'_, f64>) -> Result<(), usize> {
    let n = square.nrows();
    let parameters = Default::default();
    match kind {
        FactorKind::Llt => {
            let room = llt::factor::cholesky_in_place_scratch::<f64>(n, Par::Seq, parameters);
            let mut room = MemBuffer::new(room);
            let stack = MemStack::new(&mut room);
            llt::factor::cholesky_in_place(square, Default::default(), Par::Seq, stack, parameters)
                .map_err(|llt::factor::LltError::NonPositivePivot { index }| index)?;
        }
        FactorKind::Ldlt => {
            let parameters = Default::default();
            let room = ldlt::factor::cholesky_in_place_scratch::<f64>(n, Par::Seq, parameters);
            let mut room = MemBuffer::new(room);
            let stack = MemStack::new(&mut room);
            ldlt::factor::cholesky_in_place(
                square,
                Default::default(),
                Par::Seq,
                stack,
                parameters,
            )
            .map_err(|ldlt::factor::LdltError::ZeroPivot { index }| index)?;
        }
    }
    Ok(())
}

/// Factorises a square matrix block by block, right-looking.
fn in_blocks(kind: FactorKind, mut square: MatMut<'_, f64>) -> Result<(), usize> {
    let n = square.nrows();
    for first in (0..n).step_by(BLOCK) {
        let width = BLOCK.min(n - first);
        let rest = square.rb_mut().get_mut(first.., first..);
        let (mut block, _, mut below, rest) = rest.split_at_mut(width, width);
        factorise_at_once(kind, block.rb_mut()).map_err(|column| first + column)?;
        solve(kind, block.rb(), below.rb_mut());
        subtract(kind, block.rb(), below.rb(), rest);
    }
    Ok(())
}

/// Solves for the rows below a factorised square, in tasks of some rows.
fn solve(kind: FactorKind, square: MatRef<'_, f64>, below: MatMut<'_, f64>) {
    let mut tasks = Vec::new();
    let mut rest = below;
    while rest.nrows() >= 2 * ROWS {
        let (rows, others) = rest.split_at_row_mut(ROWS);
        tasks.push(rows);
        rest = others;
    }
    tasks.push(rest);
    tasks.into_par_iter().with_max_len(1).for_each(|mut rows| {
        let right_hand_sides = rows.rb_mut().transpose_mut();
        match kind {
            FactorKind::Llt => solve_lower_triangular_in_place(square, right_hand_sides, Par::Seq),
            FactorKind::Ldlt => {
                solve_unit_lower_triangular_in_place(square, right_hand_sides, Par::Seq);
                for k in 0..square.ncols() {
                    let inverse = square[(k, k)].recip();
                    let column = rows.rb_mut().col_mut(k);
                    column.iter_mut().for_each(|value| *value *= inverse);
                }
            }
        }
    });
}

/// Subtracts L L^T or L D L^T of the rows below a block from the remaining square, in tasks of some columns.
fn subtract(
    kind: FactorKind,
    block: MatRef<'_, f64>,
    below: MatRef<'_, f64>,
    rest: MatMut<'_, f64>,
) {
    let mut scaled = below.to_owned();
    if kind == FactorKind::Ldlt {
        for k in 0..block.ncols() {
            let pivot = block[(k, k)];
            let column = scaled.col_mut(k);
            column.iter_mut().for_each(|value| *value *= pivot);
        }
    }
    let left = match kind {
        FactorKind::Llt => below,
        FactorKind::Ldlt => scaled.as_ref(),
    };
    let mut tasks = Vec::new();
    let (mut first, mut rest) = (0, rest);
    while rest.ncols() > 0 {
        let width = BLOCK.min(rest.ncols());
        let (columns, others) = rest.split_at_col_mut(width);
        tasks.push((first, columns.get_mut(first.., ..)));
        (first, rest) = (first + width, others);
    }
    tasks
        .into_par_iter()
        .with_max_len(1)
        .for_each(|(first, columns)| {
            let width = columns.ncols();
            let right = below.subrows(first, width).transpose();
            let (top_left, bottom_left) = left.get(first.., ..).split_at_row(width);
            let (top, bottom) = columns.split_at_row_mut(width);
            triangular::matmul(
                top,
                BlockStructure::TriangularLower,
                Accum::Add,
                top_left,
                BlockStructure::Rectangular,
                right,
                BlockStructure::Rectangular,
                -1.0,
                Par::Seq,
            );
            matmul(bottom, Accum::Add, bottom_left, right, -1.0, Par::Seq);
        });
}
