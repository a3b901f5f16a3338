//! Symbolic analysis, factorisation, solve and change in place, on square lattices with the pattern that bonds give.
//!
//! This crate knows no meshes: a point of the lattice has the 28 neighbours within three spacings and three unknowns.
#![allow(clippy::unwrap_used, missing_docs)]

use std::hint::black_box;
use std::sync::Arc;

use criterion::measurement::WallTime;
use criterion::{
    BenchmarkGroup, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};
use ligament_linalg::{
    Elimination, FactorKind, Factorisation, ForwardSubstituted, Pattern, RankOne, Symbolic,
    SymmetricMatrix,
};
use rayon::ThreadPoolBuilder;

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

/// Points of a rectangle in the order of nested dissection: both halves, then the columns or rows between them.
fn dissect(side: i64, [x, y]: [std::ops::Range<i64>; 2], order: &mut Vec<usize>) {
    let (width, height) = (x.end - x.start, y.end - y.start);
    if width.max(height) <= 2 * REACH {
        order.extend(y.flat_map(|y| x.clone().map(move |x| (y * side + x) as usize)));
    } else if width >= height {
        let cut = x.start + (width - REACH) / 2;
        dissect(side, [x.start..cut, y.clone()], order);
        dissect(side, [cut + REACH..x.end, y.clone()], order);
        order.extend(y.flat_map(|y| (cut..cut + REACH).map(move |x| (y * side + x) as usize)));
    } else {
        let cut = y.start + (height - REACH) / 2;
        dissect(side, [x.clone(), y.start..cut], order);
        dissect(side, [x.clone(), cut + REACH..y.end], order);
        order.extend(
            (cut..cut + REACH).flat_map(|y| x.clone().map(move |x| (y * side + x) as usize)),
        );
    }
}

/// The unknowns by nested dissection of their points.
fn elimination(side: i64) -> Elimination {
    let mut points = Vec::new();
    dissect(side, [0..side, 0..side], &mut points);
    let unknowns = points
        .iter()
        .flat_map(|point| COMPONENTS * point..COMPONENTS * (point + 1));
    Elimination::Given(unknowns.collect())
}

/// Three terms for each of some bonds between neighbours in a row, spread over the lattice.
fn bonds(side: i64, count: usize) -> Vec<RankOne> {
    let n_points = (side * side) as usize;
    let first_points = (0..count).map(|k| n_points * (2 * k + 1) / (2 * count) + 7 * k % 31);
    first_points
        .flat_map(|point| {
            (0..COMPONENTS).map(move |mode| {
                let unknowns = COMPONENTS * point..COMPONENTS * (point + 2);
                let sign = |k: usize| if k / COMPONENTS == 0 { 1.0 } else { -1.0 };
                RankOne {
                    weight: 1.0,
                    entries: (unknowns.enumerate())
                        .map(|(k, unknown)| {
                            (unknown, sign(k) / (1 + (k + mode) % COMPONENTS) as f64)
                        })
                        .collect(),
                }
            })
        })
        .collect()
}

/// Puts stiffness in and takes it out again, in turns.
struct ThereAndBack {
    terms: Vec<RankOne>,
    right_hand_side: Vec<(usize, f64)>,
}

impl ThereAndBack {
    fn new(side: i64, n_bonds: usize) -> Self {
        let terms = bonds(side, n_bonds);
        let right_hand_side = terms.iter().flat_map(|term| term.entries.clone()).collect();
        Self {
            terms,
            right_hand_side,
        }
    }

    fn change(&mut self, factor: &mut dyn Factorisation) -> ForwardSubstituted {
        let half_solved = factor.change(&self.terms, &self.right_hand_side).unwrap();
        for term in &mut self.terms {
            term.weight = -term.weight;
        }
        half_solved
    }
}

/// Factorisation and solution on some threads.
fn on_threads(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    threads: usize,
    factor: &mut dyn Factorisation,
    matrix: &SymmetricMatrix,
) {
    let pool = ThreadPoolBuilder::new().num_threads(threads);
    let pool = pool.build().unwrap();
    group.bench_function(format!("{name}, factorisation"), |bencher| {
        bencher.iter(|| pool.install(|| factor.refactorise(black_box(matrix)).unwrap()));
    });
    let loads = vec![1.0; matrix.pattern().dimension()];
    group.bench_function(format!("{name}, solve"), |bencher| {
        bencher.iter(|| {
            let mut unknowns = black_box(&loads).clone();
            pool.install(|| factor.solve_in_place(&mut unknowns));
            unknowns
        });
    });
}

fn factorisation(criterion: &mut Criterion) {
    for side in [50, 100] {
        let pattern = Arc::new(pattern(side));
        let matrix = matrix(pattern.clone());
        let analyse = || Symbolic::analyse(black_box(&pattern).clone(), elimination(side)).unwrap();
        let symbolic = Arc::new(analyse());

        let mut group = criterion.benchmark_group(format!("lattice of {} points", side * side));
        group.sampling_mode(SamplingMode::Flat).sample_size(10);
        group.bench_function("symbolic analysis", |bencher| bencher.iter(analyse));
        group.throughput(Throughput::Elements(symbolic.n_factor_values() as u64));
        for (name, kind) in [("L L^T", FactorKind::Llt), ("L D L^T", FactorKind::Ldlt)] {
            let mut factor = kind.factorise(&symbolic, &matrix).unwrap();
            for threads in [1, 2] {
                let name = format!("{name}, {threads} threads");
                on_threads(&mut group, &name, threads, factor.as_mut(), &matrix);
            }
            for n_bonds in [1, 5, 10] {
                let mut there_and_back = ThereAndBack::new(side, n_bonds);
                let half_solved = there_and_back.change(factor.as_mut());
                group.bench_function(format!("{name}, change of {n_bonds} bonds"), |bencher| {
                    bencher.iter(|| there_and_back.change(factor.as_mut()));
                });
                if n_bonds == 1 {
                    group.bench_function(format!("{name}, backward pass"), |bencher| {
                        bencher.iter(|| factor.finish(black_box(&half_solved).clone()));
                    });
                }
                factor.refactorise(&matrix).unwrap();
            }
        }
        group.finish();
    }
}

criterion_group!(benches, factorisation);
criterion_main!(benches);
