//! What an equilibrium and a breakage are made of, besides factorisation and solve, on the disk of the Brazilian test.
#![allow(clippy::unwrap_used, missing_docs)]

use std::hint::black_box;
use std::sync::Arc;

use criterion::{Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use ligament_analysis::breaking::{BreakingOrder, BreakingRule, next_to_break};
use ligament_analysis::connectivity::Fragments;
use ligament_analysis::{Unknowns, assembly, internal};
use verification::bench::Bench;
use verification::problems;

const RULE: BreakingRule = BreakingRule {
    order: BreakingOrder::Excess,
    bonds_per_iteration: 1,
    tie_tolerance: 1e-8,
};

fn equilibrium(criterion: &mut Criterion) {
    for name in ["disk-2mm", "disk-1.5mm"] {
        let file = format!("mesh.file=../meshes/{name}.msh");
        let bench = Bench::new(problems::DISK, &[&file]);
        let system = &bench.model.system;
        let unknowns = Unknowns::of_problem(system, &bench.boundary);
        let pattern = Arc::new(assembly::pattern(system, &unknowns).unwrap());
        // At load factor 1 the elastic disk has many bonds beyond their limits.
        let elastic = bench.solve();
        let (displacement, intact) = (elastic.displacement(), &elastic.state().intact);
        let held = &elastic.state().held;
        let deformations = internal::deformations(system, displacement);

        let mut group = criterion.benchmark_group(name);
        group.sampling_mode(SamplingMode::Flat).sample_size(20);
        group.throughput(Throughput::Elements(system.bonds.len() as u64));
        group.bench_function("pattern", |bencher| {
            bencher.iter(|| assembly::pattern(black_box(system), &unknowns).unwrap());
        });
        group.bench_function("assembly", |bencher| {
            bencher
                .iter(|| assembly::assemble(black_box(system), &unknowns, &pattern, intact, held));
        });
        group.bench_function("sweep over the bonds", |bencher| {
            bencher.iter(|| {
                let deformations = internal::deformations(system, black_box(displacement));
                let forces = internal::internal_forces(system, intact, &deformations);
                let energy = internal::stored_energy(system, intact, &deformations);
                (deformations, forces, energy)
            });
        });
        group.bench_function("choice of the next bond", |bencher| {
            let limits = &bench.model.critical_stretch;
            bencher.iter(|| next_to_break(&RULE, black_box(&deformations), limits, intact));
        });
        group.bench_function("connectivity", |bencher| {
            bencher.iter(|| Fragments::find(black_box(system), intact));
        });
        group.finish();
    }
}

criterion_group!(benches, equilibrium);
criterion_main!(benches);
