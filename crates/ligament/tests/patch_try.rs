//! Try.
use ligament::prelude::*;
use ligament::setup::{Alpha, CorrectionDomain, Surface};
use ligament_model::correction::patch::Settings;
use std::sync::Arc;
fn env(name: &str, or: f64) -> f64 {
    std::env::var(name)
        .ok()
        .map_or(or, |it| it.parse().unwrap())
}
#[test]
fn try_it() {
    let nu = env("NU", 0.21);
    let lambda = env("LAMBDA", 3.0);
    let calibration = Calibration::Integral;
    let law = match std::env::var("LAW").unwrap_or("nhpd".into()).as_str() {
        "nhpd" => Law::Nhpd,
        "bbpd" => Law::Bbpd { calibration },
        "pds" => Law::Pds { calibration },
        "mppd" => Law::Mppd {
            calibration,
            rotational_stiffness: RotationalStiffness::Decaying,
        },
        _ => panic!(),
    };
    let body: Arc<dyn Body> = match std::env::var("MESH") {
        Ok(file) => Arc::new(MeshBody::from(
            gmsh::parse(&std::fs::read(file).unwrap()).unwrap(),
        )),
        Err(_) => {
            let n = env("N", 20.0) as u32;
            let sets = [
                ("bottom".to_owned(), CellSet::Bottom(1)),
                ("top".to_owned(), CellSet::Top(1)),
            ];
            Arc::new(
                LatticeBody::new(
                    [n, 2 * n],
                    [0.1 / f64::from(n); 2],
                    [0.0, 0.0],
                    &[],
                    &sets.into(),
                )
                .unwrap(),
            )
        }
    };
    let gauge = match body.origin() {
        ligament::body::Origin::Lattice(it) => 0.2 - it.spacing[1],
        _ => 0.2,
    };
    let strain = 1e-3;
    let nu_true = if law.fixes_poisson() { 1.0 / 3.0 } else { nu };
    for patched in [false, true] {
        let mut setup = Setup::new(
            Points::new(vec![[0.0; 2]], vec![1.0]).unwrap(),
            Material::isotropic(1.0, nu),
            law,
        );
        setup.body = body.clone();
        setup.horizon = Horizon::Factor(lambda);
        if patched {
            let d = Settings::default();
            setup.correction.surface = Surface::Patch(Settings {
                moment_weight: env("MW", d.moment_weight),
                regularisation: env("R", d.regularisation),
                ..d
            });
            let _ = (Alpha::None, CorrectionDomain::Whole);
        }
        setup.supports = vec![Support::new("bottom", &[Component::Y])];
        let up = Displacement {
            y: Some(strain * gauge),
            ..Displacement::default()
        };
        setup.loads = vec![Load::new("top", Action::Displacement(up))];
        let clock = std::time::Instant::now();
        let solution = setup.solve(&mut Unobserved).unwrap();
        let took = clock.elapsed();
        let model = &solution.model;
        let outcome = &solution.outcome;
        let row = outcome.history.last().unwrap();
        let modulus = row.reaction.abs() / 0.1 / strain;
        let u = &outcome.state.displacement;
        let system = &model.system;
        let deformations = ligament_model::Bonds::deformations(
            &**system,
            &vec![true; system.bonds.len()],
            u,
            ligament_model::thermal::ThermalStrain::NONE,
        );
        let mut square = 0.0;
        for (d, [a, b]) in deformations.iter().zip(&system.bonds.direction) {
            square += (d.stretch - strain * (b * b - nu_true * a * a)).powi(2);
        }
        println!(
            "patched {patched}: points {} E {modulus:.5} rms {:.5} range {:?} voids {} {took:?} {}",
            system.cloud.len(),
            (square / deformations.len() as f64).sqrt() / strain,
            model.correction_range,
            model.across_holes,
            model
                .warnings
                .iter()
                .map(|it| it.to_string())
                .collect::<Vec<_>>()
                .join("; ")
        );
    }
}
