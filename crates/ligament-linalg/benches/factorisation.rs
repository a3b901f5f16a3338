//! Symbolic analysis, factorisation and solve, on square lattices with the pattern that bonds give.
//!
//! This crate knows no meshes: a point of the lattice has the 28 neighbours within three spacings and three unknowns.
#![allow(clippy::unwrap_used, missing_docs)]

use std::hint::black_box;
use std::sync::Arc;

use criterion::{Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use ligament_linalg::{Elimination, FactorKind, Pattern, Symbolic, SymmetricMatrix};

/// Horizon in spacings.
const REACH: i64 = 3;

/// Unknowns of a point.
const COMPONENTS: usize = 3;

/// Neighbours of a point far from the rim.
const NEIGHBOURS: f64 = 28.0;

/// Pattern of a lattice of `side` times `side` points, row after row.
fn pattern(side: i64) -> Pattern {
    let (mut column_starts, mut rows) = (vec![0], Vec::new());
    for (y, x) in (0..side).flat_map(|y| (0..side).map(move |x| (y, x))) {
        let mut lower: Vec<usize> = (-REACH..=REACH)
            .flat_map(|dy| (-REACH..=REACH).map(move |dx| (dy, dx)))
            .filter(|&(dy, dx)| dy * dy + dx * dx <= REACH * REACH && (dy, dx) < (0, 0))
            .map(|(dy, dx)| (y + dy, x + dx))
            .filter(|&(y, x)| (0..side).contains(&y) && (0..side).contains(&x))
            .map(|(y, x)| (y * side + x) as usize)
            .collect();
        lower.sort_unstable();
        let first = COMPONENTS * (y * side + x) as usize;
        for column in first..first + COMPONENTS {
            let coupled = lower.iter().flat_map(|point| {
                (0..COMPONENTS).map(move |component| COMPONENTS * point + component)
            });
            rows.extend(coupled.chain(first..=column));
            column_starts.push(rows.len());
        }
    }
    Pattern::new(column_starts, rows).unwrap()
}

/// A positive definite matrix: -1 beside the diagonal, and a diagonal that outweighs it.
fn matrix(pattern: Arc<Pattern>) -> SymmetricMatrix {
    let mut matrix = SymmetricMatrix::zero(pattern.clone());
    for column in 0..pattern.dimension() {
        let entries = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
        for entry in entries {
            let is_diagonal = pattern.rows()[entry] == column;
            matrix.values[entry] = if is_diagonal {
                COMPONENTS as f64 * (NEIGHBOURS + 1.0)
            } else {
                -1.0
            };
        }
    }
    matrix
}

fn factorisation(criterion: &mut Criterion) {
    for side in [50, 100] {
        let pattern = Arc::new(pattern(side));
        let matrix = matrix(pattern.clone());
        let analyse =
            || Symbolic::analyse(black_box(&pattern).clone(), Elimination::MinimumDegree).unwrap();
        let symbolic = Arc::new(analyse());

        let mut group = criterion.benchmark_group(format!("lattice of {} points", side * side));
        group.sampling_mode(SamplingMode::Flat).sample_size(10);
        group.bench_function("symbolic analysis", |bencher| bencher.iter(analyse));
        group.throughput(Throughput::Elements(symbolic.n_factor_values() as u64));
        for (name, kind) in [("L L^T", FactorKind::Llt), ("L D L^T", FactorKind::Ldlt)] {
            let mut factor = kind.factorise(&symbolic, &matrix).unwrap();
            group.bench_function(format!("{name}, factorisation"), |bencher| {
                bencher.iter(|| factor.refactorise(black_box(&matrix)).unwrap());
            });
            let loads = vec![1.0; pattern.dimension()];
            group.bench_function(format!("{name}, solve"), |bencher| {
                bencher.iter(|| {
                    let mut unknowns = black_box(&loads).clone();
                    factor.solve_in_place(&mut unknowns);
                    unknowns
                });
            });
        }
        group.finish();
    }
}

criterion_group!(benches, factorisation);
criterion_main!(benches);
