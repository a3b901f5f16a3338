//! What an equilibrium and a breakage are made of, and a breakage as a whole, on the disk of the Brazilian test.
#![allow(clippy::unwrap_used, missing_docs)]

use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};

use criterion::measurement::WallTime;
use criterion::{
    BatchSize, BenchmarkGroup, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};
use ligament_analysis::Balanced;
use ligament_analysis::bond_numbers::BondNumbers;
use ligament_analysis::breaking::{BreakingOrder, BreakingRule, next_to_break};
use ligament_analysis::connectivity::Fragments;
use ligament_analysis::connectivity::decremental::Connectivity;
use ligament_analysis::driver::Problem;
use ligament_analysis::solver::{SolverSettings, Update};
use ligament_analysis::{Equilibrium, State, Unknowns, assembly, internal};
use ligament_model::thermal::ThermalStrain;
use verification::bench::{Bench, Watch};
use verification::problems;

/// Bonds after which the intact body takes the place of the broken one, so that all samples break the same ones.
const BROKEN: usize = 200;

/// Everything is linear between breakages, so the largest s/s_0 at load factor 1 leads along the exact path.
fn rule(bonds_per_iteration: usize) -> BreakingRule {
    BreakingRule {
        order: BreakingOrder::Ratio,
        bonds_per_iteration,
        tie_tolerance: 1e-8,
    }
}

fn equilibrium(criterion: &mut Criterion) {
    for name in ["disk-2mm", "disk-1.5mm"] {
        let file = format!("mesh.file=../meshes/{name}.msh");
        let bench = Bench::new(problems::DISK, &[&file]);
        let mut group = criterion.benchmark_group(name);
        group.sampling_mode(SamplingMode::Flat).sample_size(20);
        breakages(&mut group, &bench);
        group.throughput(Throughput::Elements(bench.model.plane().bonds.len() as u64));
        parts(&mut group, &bench);
        group.finish();
    }
}

fn parts(group: &mut BenchmarkGroup<'_, WallTime>, bench: &Bench) {
    let system = &**bench.model.plane();
    let unknowns = Unknowns::all_but(system, |dof| bench.boundary.prescribed[dof].is_some());
    let pattern = Arc::new(assembly::pattern(system, &unknowns).unwrap());
    let elastic = bench.solve();
    let (displacement, intact) = (elastic.displacement(), &elastic.state().intact);
    let held = &elastic.state().held;
    let left = elastic.state().bonds();
    group.bench_function("pattern", |bencher| {
        bencher.iter(|| assembly::pattern(black_box(system), &unknowns).unwrap());
    });
    group.bench_function("assembly", |bencher| {
        bencher.iter(|| assembly::assemble(black_box(system), &unknowns, &pattern, left, held));
    });
    group.bench_function("sweep over the bonds", |bencher| {
        bencher
            .iter(|| internal::sweep(system, left, black_box(displacement), ThermalStrain::NONE));
    });
    let deformations =
        internal::sweep(system, left, displacement, ThermalStrain::NONE).deformations;
    let next = |count: usize| {
        let limits = bench.model.criteria.without_state();
        next_to_break(
            &BondNumbers::whole(0),
            &rule(count),
            black_box(&deformations),
            &limits,
            intact,
            |bond| [bond, 0],
        )
    };
    group.bench_function("choice of the next bond", |bencher| {
        bencher.iter(|| next(1));
    });
    group.bench_function("connectivity, whole body", |bencher| {
        bencher.iter(|| Fragments::find(black_box(system), intact));
    });
    let whole = Connectivity::new(system);
    let broken = next(10);
    group.bench_function("connectivity, 10 bonds", |bencher| {
        bencher.iter_batched(
            || (whole.clone(), intact.clone()),
            |(mut connectivity, mut left)| {
                connectivity.bonds_broke(system, &mut left, black_box(&broken));
                connectivity
            },
            BatchSize::LargeInput,
        );
    });
}

/// Breakages from the choice of the bonds to the new equilibrium, the choice not timed.
fn breakages(group: &mut BenchmarkGroup<'_, WallTime>, bench: &Bench) {
    for (update, counts) in [
        (Update::Incremental, [1, 5, 10].as_slice()),
        (Update::Refactor, &[5]),
    ] {
        let problem = Problem {
            solver: SolverSettings {
                update: Some(update),
                ..SolverSettings::default()
            },
            ..bench.problem()
        };
        for &count in counts {
            let mut body = Body::intact(&problem);
            group.bench_function(format!("{update:?}, breakage of {count}"), |bencher| {
                bencher.iter_custom(|iterations| {
                    (0..iterations)
                        .map(|_| {
                            if body.state.broken_bonds() + count > BROKEN {
                                body = Body::intact(&problem);
                            }
                            body.break_next(&rule(count), &bench.model.criteria)
                        })
                        .sum()
                });
            });
        }
    }
}

/// A body in equilibrium whose bonds break.
struct Body {
    equilibrium: Equilibrium,
    state: State,
    balanced: Balanced,
    watch: Watch,
}

impl Body {
    fn intact(problem: &Problem) -> Self {
        let mut equilibrium = Equilibrium::new(problem, 1e-4).unwrap();
        let mut state = State::fresh(&*problem.system);
        state.load_factor = 1.0;
        let breakage = equilibrium.break_bonds(&mut state, &[]);
        let mut watch = Watch::default();
        let balanced = equilibrium.balance(&mut state, &breakage, &mut watch);
        Self {
            balanced: balanced.unwrap().balanced().unwrap(),
            equilibrium,
            state,
            watch,
        }
    }

    /// Breaks the bonds whose turn it is, and tells how long that and the new equilibrium took.
    fn break_next(
        &mut self,
        rule: &BreakingRule,
        criteria: &ligament_model::failure::Criteria,
    ) -> Duration {
        let (deformations, intact) = (&self.balanced.deformations, &self.state.intact);
        let (numbers, criteria) = (BondNumbers::whole(0), criteria.without_state());
        let bonds = next_to_break(&numbers, rule, deformations, &criteria, intact, |bond| {
            [bond, 0]
        });
        let start = Instant::now();
        let breakage = self.equilibrium.break_bonds(&mut self.state, &bonds);
        let (state, watch) = (&mut self.state, &mut self.watch);
        let balanced = self.equilibrium.balance(state, &breakage, watch);
        let duration = start.elapsed();
        self.balanced = balanced.unwrap().balanced().unwrap();
        duration
    }
}

criterion_group!(benches, equilibrium);
criterion_main!(benches);
