//! Reading of Gmsh files.
#![allow(clippy::unwrap_used, missing_docs)]

use std::hint::black_box;
use std::path::Path;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use ligament_mesh::gmsh;

fn parse(criterion: &mut Criterion) {
    let meshes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes");
    let mut group = criterion.benchmark_group("parse");
    for name in ["disk-2mm", "disk-1.5mm"] {
        let bytes = std::fs::read(meshes.join(format!("{name}.msh"))).unwrap();
        group.throughput(Throughput::Bytes(bytes.len() as u64));
        group.bench_function(name, |bencher| {
            bencher.iter(|| gmsh::parse(black_box(&bytes)).unwrap());
        });
    }
    group.finish();
}

criterion_group!(benches, parse);
criterion_main!(benches);
