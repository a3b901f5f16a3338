//! L U of matrices without symmetry: against dense elimination, and against the residual on a grid.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use ligament_linalg::{FactorError, GeneralMatrix, Lu};
use nalgebra::{DMatrix, DVector};

/// Numbers between -1 and 1 from a linear congruence, the same in every run.
fn numbers(mut seed: u32) -> impl FnMut() -> f64 {
    move || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed) / f64::from(u32::MAX) * 2.0 - 1.0
    }
}

/// A third of the entries of a matrix of order 40, with a diagonal that makes the first pivots zero, so that rows must change
/// places; nalgebra's dense elimination is the other calculation. The condition number of some hundreds leaves 1e-12 of 1e-16.
#[test]
fn solutions_are_those_of_dense_elimination() {
    const ORDER: usize = 40;
    let mut next = numbers(7);
    let mut entries = Vec::new();
    for row in 0..ORDER {
        for column in 0..ORDER {
            let value = next();
            if (row + 2 * column) % 3 == 0 && row != column {
                entries.push((row, column, value));
            }
        }
        entries.push((row, (row + 1) % ORDER, 4.0));
    }
    let dense = entries
        .iter()
        .fold(DMatrix::zeros(ORDER, ORDER), |mut sum, &(i, j, value)| {
            sum[(i, j)] += value;
            sum
        });
    let right: Vec<f64> = (0..ORDER).map(|_| next()).collect();
    let expected = dense.lu().solve(&DVector::from_vec(right.clone())).unwrap();
    let matrix = GeneralMatrix::of_entries(ORDER, entries);
    let mut found = right;
    Lu::factorise(&matrix).unwrap().solve_in_place(&mut found);
    for (found, expected) in found.iter().zip(expected.iter()) {
        assert!((found - expected).abs() < 1e-12 * expected.abs().max(1.0));
    }
}

/// Convection and diffusion on a grid of 60 x 60: 3600 unknowns, so that the factor has supernodes. The residual relative to the
/// right-hand side is rounding times the condition number, some thousands.
#[test]
fn a_grid_with_flow_is_solved() {
    const SIDE: usize = 60;
    let number = |x: usize, y: usize| y * SIDE + x;
    let mut entries = Vec::new();
    for y in 0..SIDE {
        for x in 0..SIDE {
            let here = number(x, y);
            entries.push((here, here, 4.0));
            if x + 1 < SIDE {
                entries.push((here, number(x + 1, y), -0.2));
                entries.push((number(x + 1, y), here, -1.8));
            }
            if y + 1 < SIDE {
                entries.push((here, number(x, y + 1), -1.3));
                entries.push((number(x, y + 1), here, -0.7));
            }
        }
    }
    let matrix = GeneralMatrix::of_entries(SIDE * SIDE, entries);
    let mut next = numbers(3);
    let right: Vec<f64> = (0..SIDE * SIDE).map(|_| next()).collect();
    let mut solution = right.clone();
    Lu::factorise(&matrix)
        .unwrap()
        .solve_in_place(&mut solution);
    let residual = matrix
        .product(&solution)
        .iter()
        .zip(&right)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max);
    assert!(residual < 1e-12, "{residual}");
    let mut again = right;
    Lu::factorise(&matrix).unwrap().solve_in_place(&mut again);
    assert_eq!(again, solution, "the same matrix gives the same bits");
}

#[test]
fn a_column_without_entries_has_no_pivot() {
    let matrix = GeneralMatrix::of_entries(3, vec![(0, 0, 1.0), (1, 2, 1.0), (2, 2, 2.0)]);
    let error = Lu::factorise(&matrix).err().unwrap();
    assert!(matches!(error, FactorError::ZeroPivot { .. }), "{error}");
}
