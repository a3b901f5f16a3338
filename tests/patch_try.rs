use ligament::prelude::*;
use ligament_model::correction::{length, patch};
use ligament_model::{BondSet, BondSystem, ElementKind, Horizons, Plane, PointCloud};
#[test]
fn try_it() {
    let file = std::env::var("MESH").unwrap();
    let lambda: f64 = std::env::var("LAMBDA").unwrap_or("3".into()).parse().unwrap();
    let nu: f64 = std::env::var("NU").unwrap_or("0.21".into()).parse().unwrap();
    let e = |name: &str, or: f64| std::env::var(name).ok().map_or(or, |it| it.parse().unwrap());
    let mesh = gmsh::parse(&std::fs::read(file).unwrap()).unwrap();
    let cloud = PointCloud::from_mesh(&mesh, 1.0, &vec![0; mesh.cells.len()], 1);
    let horizons = Horizons::from_spacing(&cloud.spacing, lambda);
    let bonds = BondSet::search(&cloud, &horizons);
    let material = Isotropic { young: 1.0, poisson: nu };
    let stiffness = ligament_model::law::beam::stiffness(&bonds, &cloud, &[material], Plane::Stress);
    let alpha = length::length_factors(&bonds, &cloud);
    let forces = patch::of_mesh(&mesh.cells, &cloud, &vec![0; mesh.cells.len()], &[material.plane_stiffness(Plane::Stress)]);
    let settings = patch::Settings {
        moment_weight: e("MW", 0.1), regularisation: std::env::var("R").unwrap_or("1e-2,1e-3,1e-4,1e-4".into()).split(',').map(|it| it.parse().unwrap()).collect(), reduction: e("RED", 0.1), tolerance: e("TOL", 1e-5), ..Default::default()
    };
    let clock = std::time::Instant::now();
    let found = patch::factors(&bonds, &cloud, &stiffness, &alpha, &forces, true, &settings);
    let took = clock.elapsed();
    let q: Vec<f64> = found.axial.iter().zip(&alpha).map(|(q, a)| q / a / found.body_factor).collect();
    let range = q.iter().fold((9e9f64, 0.0f64), |(l, h), &q| (l.min(q), h.max(q)));
    println!("points {} bonds {} c0 {:.4} report {:?} factors {range:?} time {took:?}", cloud.len(), bonds.len(), found.body_factor, found.report);
    let mut stiffness = stiffness;
    for (bond, (n, t)) in found.axial.iter().zip(&found.shear).enumerate() {
        stiffness.axial[bond] *= n; stiffness.shear[bond] *= t; stiffness.rotational[bond] *= t;
    }
    let one = vec![1.0; bonds.len()];
    let system = BondSystem::new(cloud, bonds, ElementKind::Beam, stiffness, one.clone(), &one);
    let strain = 1e-3;
    let mut setup = Setup::new(MeshBody::from(mesh), Material::isotropic(1.0, nu), Law::Nhpd);
    setup.horizon = Horizon::Factor(lambda);
    setup.supports = vec![Support::new("bottom", &[Component::Y])];
    let up = Displacement { y: Some(strain * 0.2), ..Displacement::default() };
    setup.loads = vec![Load::new("top", Action::Displacement(up))];
    let mut model = Model::build(setup, &mut ()).unwrap();
    for patched in [false, true] {
        if patched { model.system = std::sync::Arc::new(system.clone()); }
        let loading = ligament::loading::Loading::new(&model.setup, &model.system).unwrap();
        let problem = loading.problem(&model.system, &model.criteria);
        let outcome = ligament::run::follow(&problem, &model.setup.analysis, &mut Unobserved).unwrap();
        let row = outcome.history.last().unwrap();
        let modulus = row.reaction.abs() / 0.1 / strain;
        let u = &outcome.state.displacement;
        let at = |x: f64| {
            let side: Vec<f64> = (model.system.cloud.positions.iter().enumerate()).filter(|(_, p)| (p[0] - x).abs() < 1e-9 && p[1].abs() < 0.05).map(|(k, _)| u[3 * k]).collect();
            side.iter().sum::<f64>() / side.len() as f64
        };
        let contraction = (at(-0.05) - at(0.05)) / 0.1 / strain;
        // Bond strains against the uniform strain of uniaxial tension.
        let deformations = ligament_model::Bonds::deformations(&*model.system, &vec![true; model.system.bonds.len()], u, ligament_model::thermal::ThermalStrain::NONE);
        let mut square = 0.0;
        for (d, [a, b]) in deformations.iter().zip(&model.system.bonds.direction) {
            square += (d.stretch - strain * (b * b - nu * a * a)).powi(2);
        }
        println!("patched {patched}: E {modulus:.5} nu {contraction:.4} rms {:.5}", (square / deformations.len() as f64).sqrt() / strain);
    }
}
