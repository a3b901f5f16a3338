//! What an elastic solution, a breakage and one product with the matrix cost in space: cylinders with a crack over half of their section.
#![allow(clippy::unwrap_used, missing_docs)]

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use ligament_analysis::solver::Method;
use ligament_model::UnbrokenBonds;
use verification::cylinders::{Torn, cylinder, pulled};

/// Points a diameter: 4,580 points, about the size up to which the matrix is factorised, and 19,155.
const ACROSS: [usize; 2] = [18, 29];

fn solids(criterion: &mut Criterion) {
    for across in ACROSS {
        let system = cylinder(across);
        let mut group =
            criterion.benchmark_group(format!("{} points", system.topology().n_points()));
        group.sampling_mode(SamplingMode::Flat).sample_size(10);
        for method in [Method::Direct, Method::Iterative] {
            if method == Method::Direct && across != ACROSS[0] {
                continue;
            }
            let problem = pulled(&system, method);
            group.bench_function(format!("{method:?}, elastic with the crack"), |bencher| {
                bencher.iter(|| Torn::cracked(&problem, &system, 0.0).balance());
            });
            group.bench_function(format!("{method:?}, breakage of 1"), |bencher| {
                bencher.iter_custom(|iterations| {
                    let mut torn = Torn::cracked(&problem, &system, 0.0);
                    let mut balanced = torn.balance();
                    let mut whole = Duration::ZERO;
                    for _ in 0..iterations {
                        let start = Instant::now();
                        torn.break_longest(&balanced);
                        balanced = torn.balance();
                        whole += start.elapsed();
                    }
                    whole
                });
            });
        }
        let motions = vec![1.0; system.topology().layout.n_degrees_of_freedom()];
        let mut forces = motions.clone();
        let intact = vec![true; system.bonds.len()];
        group.throughput(Throughput::Elements(intact.len() as u64));
        group.bench_function("product with the matrix", |bencher| {
            bencher.iter(|| {
                system.multiply(
                    UnbrokenBonds::whole(&intact),
                    black_box(&motions),
                    &mut forces,
                );
            });
        });
        group.finish();
    }
}

criterion_group!(benches, solids);
criterion_main!(benches);
