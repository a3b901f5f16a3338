//! The stages from a mesh to a bond system, each with the results of those before it.
#![allow(clippy::unwrap_used, missing_docs)]

use std::hint::black_box;
use std::path::Path;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use ligament_mesh::{Mesh, gmsh};
use ligament_model::correction::length::length_factors;
use ligament_model::correction::patch::Settings;
use ligament_model::correction::{StopRule, Sweeps, domain, patch};
use ligament_model::failure::Basis;
use ligament_model::failure::strength::{critical_energy, critical_stretches};
use ligament_model::law::Law;
use ligament_model::{
    BondSet, BondSystem, Elasticity, ElementKind, Horizons, Isotropic, Plane, PointCloud,
};

const HORIZON_FACTOR: f64 = 3.0;

/// Sweeps measured at a time; the disks take about 80.
const SWEEPS: Sweeps = Sweeps {
    stop: StopRule::Sum(0.0),
    limit: 10,
};

fn mesh(name: &str) -> Mesh {
    let meshes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes");
    let bytes = std::fs::read(meshes.join(format!("{name}.msh"))).unwrap();
    gmsh::parse(&bytes).unwrap()
}

fn preparation(criterion: &mut Criterion) {
    let rock = Isotropic {
        young: 15e9,
        poisson: 0.21,
    };
    let plane = Plane::Stress;
    let energies = [critical_energy(&rock, 3.81e6, plane)];
    for name in ["disk-2mm", "disk-1.5mm"] {
        let mesh = mesh(name);
        let material_of_cell = vec![0; mesh.cells.len()];
        let points = || PointCloud::from_mesh(black_box(&mesh), 1.0, &material_of_cell, 1);
        let cloud = points();
        let horizons = Horizons::from_spacing(&cloud.spacing, HORIZON_FACTOR);
        let bonds = BondSet::search(&cloud, &horizons);
        let stiffness = Law::MPPD_BEAM.densities(&bonds, &cloud, &[rock.into()], plane.into());
        let continuum = Elasticity::Isotropic(rock).stiffness::<2>(plane);
        let continuum = [continuum.unwrap()];
        let correct = || {
            let alpha = length_factors(&bonds, &cloud);
            domain::iterate(&bonds, &cloud, &stiffness, alpha, &continuum, SWEEPS)
        };
        let patch = || {
            let points = patch::Points {
                cloud: &cloud,
                forces: patch::forces_of_mesh(
                    &mesh.cells,
                    &cloud,
                    &material_of_cell,
                    continuum.to_vec(),
                ),
                turn: true,
            };
            let alpha = length_factors(&bonds, &cloud);
            let settings = Settings::DEFAULT;
            let axial = || stiffness.axial.clone();
            let nearest_to =
                patch::reference(settings.reference, &bonds, &cloud, &horizons, &alpha, axial);
            patch::correct(&bonds, &points, &stiffness, (alpha, &nearest_to), &settings)
        };
        let correction = correct();
        let stages = || {
            let alpha = correction.length_factor.clone();
            (cloud.clone(), bonds.clone(), stiffness.clone(), alpha)
        };
        let put_together = |(cloud, bonds, stiffness, alpha)| {
            let omega = &correction.domain_factor;
            BondSystem::new(cloud, bonds, ElementKind::Beam, stiffness, alpha, omega)
        };
        let system = put_together(stages());
        let basis = Basis {
            system: &system,
            no_fail: &vec![false; cloud.len()],
            space: plane.into(),
            materials: &[],
            joints: &[],
            constants: Vec::new(),
            lattice: None,
            scatter: &[],
        };

        let mut group = criterion.benchmark_group(name);
        group.throughput(Throughput::Elements(cloud.len() as u64));
        group.bench_function("points", |bencher| bencher.iter(points));
        group.bench_function("search", |bencher| {
            bencher.iter(|| BondSet::search(black_box(&cloud), &horizons));
        });
        group.throughput(Throughput::Elements(bonds.len() as u64));
        group.bench_function("law", |bencher| {
            bencher.iter(|| {
                Law::MPPD_BEAM.densities(black_box(&bonds), &cloud, &[rock.into()], plane.into())
            });
        });
        group.bench_function("correction, 10 sweeps", |bencher| bencher.iter(correct));
        group.bench_function("patch correction", |bencher| bencher.iter(patch));
        group.bench_function("bond system", |bencher| {
            bencher.iter_batched(stages, put_together, BatchSize::LargeInput);
        });
        group.bench_function("critical stretches", |bencher| {
            bencher.iter(|| critical_stretches(black_box(&basis), &energies));
        });
        group.finish();
    }
}

criterion_group!(benches, preparation);
criterion_main!(benches);
