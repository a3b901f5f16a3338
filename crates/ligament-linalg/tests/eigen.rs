//! Largest eigenvalues against spectra that are known.
#![allow(clippy::unwrap_used)]

use ligament_linalg::{Eigenpairs, Search, largest_eigenpairs, largest_eigenvalue};
use nalgebra::{DMatrix, DVector};

const SEARCH: Search = Search {
    count: 6,
    tolerance: 1e-10,
    limit: 5000,
    seed: 1,
};

/// The operator Q diag(values) Q^T with the reflection Q = 1 - 2 w w^T/(w^T w), w_i = 1 + sin i: the spectrum is known, and
/// no eigenvector lies along an axis.
fn reflected(values: &[f64]) -> impl FnMut(&[f64], &mut [f64]) + '_ {
    let w: Vec<f64> = (0..values.len()).map(|i| 1.0 + (i as f64).sin()).collect();
    let square: f64 = w.iter().map(|x| x * x).sum();
    let reflect = move |vector: &mut [f64]| {
        let along: f64 = vector.iter().zip(&w).map(|(a, b)| a * b).sum();
        for (value, w) in vector.iter_mut().zip(&w) {
            *value -= 2.0 * along / square * w;
        }
    };
    move |input, output| {
        output.copy_from_slice(input);
        reflect(output);
        for (value, factor) in output.iter_mut().zip(values) {
            *value *= factor;
        }
        reflect(output);
    }
}

/// Values against the largest of the known ones, vectors against the definition, orthonormality to rounding. An eigenvalue
/// is known to the square of its residual or to rounding (1e-15 of the largest); a residual is the tolerance asked for.
fn check(values: &[f64], found: &Eigenpairs, count: usize) {
    let n = values.len();
    let mut sorted = values.to_vec();
    sorted.sort_by(|a, b| b.total_cmp(a));
    assert!(found.converged, "{} products", found.products);
    assert_eq!(found.values.len(), count);
    let mut apply = reflected(values);
    for (pair, (value, vector)) in found.values.iter().zip(&found.vectors).enumerate() {
        let error = (value - sorted[pair]).abs();
        assert!(
            error < 1e-13 * sorted[0],
            "pair {pair}: {value} for {}",
            sorted[pair]
        );
        let mut image = vec![0.0; n];
        apply(vector, &mut image);
        let residual: f64 = (image.iter().zip(vector))
            .map(|(a, b)| (a - value * b).powi(2))
            .sum();
        assert!(
            residual.sqrt() < 1e-9 * value.abs(),
            "pair {pair}: {residual:e}"
        );
        for (other, second) in found.vectors.iter().enumerate() {
            let product: f64 = vector.iter().zip(second).map(|(a, b)| a * b).sum();
            let expected = f64::from(u8::from(other == pair));
            assert!(
                (product - expected).abs() < 1e-12,
                "{pair} {other}: {product}"
            );
        }
    }
}

/// 1/k^2, as the inverse eigenvalues of a string, over 2000 unknowns; then each of them twice.
#[test]
fn simple_and_double_eigenvalues() {
    let simple: Vec<f64> = (1..=2000).map(|k| 1.0 / f64::from(k * k)).collect();
    let found = largest_eigenpairs(2000, SEARCH, reflected(&simple));
    check(&simple, &found, 6);
    let double: Vec<f64> = (1..=2000)
        .map(|k: i32| 1.0 / f64::from(((k + 1) / 2).pow(2)))
        .collect();
    let search = Search { count: 7, ..SEARCH };
    check(
        &double,
        &largest_eigenpairs(2000, search, reflected(&double)),
        7,
    );
}

/// A basis of more than 128 vectors over eigenvalues of 1 to 1e-6, with restarts: the small ones must be as exact, relative
/// to themselves, as the large ones.
#[test]
fn many_eigenvalues_of_a_wide_range() {
    let values: Vec<f64> = (1..=3000)
        .map(|k| {
            let weak = if k > 5 { 1e-3 } else { 1.0 };
            weak / f64::from(k).powf(0.7)
        })
        .collect();
    let search = Search {
        count: 50,
        ..SEARCH
    };
    check(
        &values,
        &largest_eigenpairs(3000, search, reflected(&values)),
        50,
    );
}

/// Largest means largest with its sign: large negative eigenvalues are passed over.
#[test]
fn negative_eigenvalues_come_last() {
    let values: Vec<f64> = (1..=300)
        .map(|k| if k % 3 == 0 { -5.0 } else { 1.0 / f64::from(k) })
        .collect();
    check(
        &values,
        &largest_eigenpairs(300, SEARCH, reflected(&values)),
        6,
    );
}

/// All eigenvalues of a small operator, different ones or all alike (where the blocks run dry): n = 1 to 9.
#[test]
fn small_operators() {
    for n in 1..=9_usize {
        let distinct: Vec<f64> = (1..=n).map(|k| k as f64).collect();
        for values in [distinct, vec![3.0; n]] {
            let search = Search {
                count: 20,
                ..SEARCH
            };
            check(
                &values,
                &largest_eigenpairs(n, search, reflected(&values)),
                n,
            );
        }
    }
}

/// A dense matrix against nalgebra's decomposition, which shares nothing with this one.
#[test]
fn agrees_with_a_dense_decomposition() {
    let n = 120;
    let entry = |i: usize, j: usize| ((i * j + i + j) as f64 * 0.37).sin();
    let matrix = DMatrix::from_fn(n, n, |i, j| entry(i.min(j), i.max(j)));
    let mut expected: Vec<f64> = matrix.symmetric_eigenvalues().iter().copied().collect();
    expected.sort_by(|a, b| b.total_cmp(a));
    let found = largest_eigenpairs(n, SEARCH, |input, output| {
        let image = &matrix * DVector::from_column_slice(input);
        output.copy_from_slice(image.as_slice());
    });
    assert!(found.converged);
    for (value, expected) in found.values.iter().zip(&expected) {
        assert!((value - expected).abs() < 1e-12 * n as f64);
    }
}

/// An operator that gives no numbers ends the search instead of hanging it.
#[test]
fn an_operator_without_numbers_does_not_converge() {
    let search = Search {
        limit: 200,
        ..SEARCH
    };
    let found = largest_eigenpairs(100, search, |_, output| output.fill(f64::NAN));
    assert!(!found.converged);
}

/// The largest eigenvalue lies between the estimate and the estimate with its residual, within 30 products: far from the others, as where few
/// springs are stiffest, it is found to the tolerance; at the end of a band, as of a regular chain (4 sin^2), to 2 %; also if it occurs twice.
#[test]
fn largest_eigenvalue_is_enclosed() {
    let band = |k: u32| 4.0 * (f64::from(k) * std::f64::consts::PI / 6000.0).sin().powi(2);
    let chain: Vec<f64> = (1..=3000).map(band).collect();
    let twice: Vec<f64> = chain.iter().flat_map(|it| [*it, *it]).collect();
    let mut stiffest = chain.clone();
    stiffest[700] = 6.0;
    for (spectrum, accuracy) in [(chain, 0.02), (twice, 0.02), (stiffest, 1e-3)] {
        let largest = spectrum.iter().copied().fold(0.0, f64::max);
        let found = largest_eigenvalue(spectrum.len(), 1e-3, 30, reflected(&spectrum)).unwrap();
        let above = found.value + found.residual;
        assert!(
            found.value <= largest * (1.0 + 1e-14) && largest <= above,
            "{largest}: {found:?}"
        );
        assert!(above - largest < accuracy * largest, "{largest}: {above}");
        assert!(found.products <= 30);
        let norm: f64 = found.vector.iter().map(|it| f64::from(it * it)).sum();
        // Single precision, and vectors that are orthogonal to it.
        assert!((norm - 1.0).abs() < 1e-4, "{norm}");
    }
}

/// Operators whose Krylov spaces end early: a number, nothing, and a multiple of the identity.
#[test]
fn largest_eigenvalue_of_a_small_space() {
    for spectrum in [vec![3.0], vec![0.0; 5], vec![2.0; 5]] {
        let found = largest_eigenvalue(spectrum.len(), 1e-3, 30, reflected(&spectrum)).unwrap();
        // Rounding of the reflections.
        assert!((found.value - spectrum[0]).abs() < 1e-14 && found.residual < 1e-14);
    }
    assert_eq!(
        largest_eigenvalue(3, 1e-3, 30, |_, image| image.fill(f64::NAN)),
        None
    );
}
