//! Time steps of explicit motion of lattices, in the plane and in space: millions of bonds a second, all of a step included.
#![allow(clippy::unwrap_used, clippy::print_stdout, missing_docs)]

use std::time::Instant;

use ligament::Loading;
use ligament::body::SolidLatticeBody;
use ligament::prelude::*;
use ligament::run::on_threads;
use ligament::setup::InitialVelocity;
use ligament_analysis::driver;
use ligament_analysis::motion::{MotionProblem, MotionSettings, critical_step};

/// Bonds times steps of a measurement.
const WORK: usize = 400_000_000;

/// A free lattice of beams whose bonds may break, set in motion at one end.
fn setup(body: impl Into<AnyBody>, law: Law) -> Setup {
    let mut material = Material::isotropic(30e9, 0.2);
    material.tensile_strength = Some(3e6);
    material.density = Some(2400.0);
    let mut setup = Setup::new(body, material, law);
    setup.criteria = vec![STRENGTH.into()];
    setup.initial_velocities = vec![InitialVelocity {
        place: Place::Everywhere,
        velocity: [1e-3, 0.0, 0.0],
    }];
    setup.analysis = Analysis::Motion(MotionSettings::new(1.0));
    setup
}

fn problem(setup: &Setup) -> MotionProblem {
    let model = Model::build(setup.clone(), &mut ()).unwrap();
    let loading = Loading::new(&model).unwrap();
    loading.motion(&loading.problem(&model)).unwrap()
}

/// Seconds for a number of steps with the critical step already known.
fn seconds(problem: &MotionProblem, steps: usize, step: f64) -> f64 {
    let mut settings = MotionSettings::new(steps as f64 * step);
    settings.rows = 1;
    let start = Instant::now();
    driver::motion::run(problem, &settings, &mut NoObserver).unwrap();
    start.elapsed().as_secs_f64()
}

fn measure(name: &str, setup: &Setup) {
    let problem = problem(setup);
    let n_bonds = problem.problem.system.ends.len();
    let step = 0.8
        * critical_step(&problem, &MotionSettings::new(1.0))
            .unwrap()
            .step;
    let steps = WORK / n_bonds;
    for threads in [1, 2] {
        let rate = on_threads(Some(threads), || {
            let begun = seconds(&problem, 10, step);
            let whole = seconds(&problem, steps + 10, step);
            (n_bonds * steps) as f64 / (whole - begun) / 1e6
        });
        println!(
            "{name}: {n_bonds} bonds, {threads} threads, {:.1} million bonds a second",
            rate.unwrap()
        );
    }
}

fn main() {
    let (sets, solid_sets) = (Default::default(), Default::default());
    for n in [100, 300] {
        let body = LatticeBody::new([n, n], [1e-3; 2], [0.0; 2], &[], &sets).unwrap();
        measure(
            &format!("beams, plane, {n}^2 points"),
            &setup(body, Law::NHPD),
        );
    }
    for n in [15, 31] {
        let body = || SolidLatticeBody::new([n; 3], [1e-3; 3], [0.0; 3], &[], &solid_sets).unwrap();
        measure(
            &format!("beams, space, {n}^3 points"),
            &setup(body(), Law::NHPD),
        );
        measure(
            &format!("springs, space, {n}^3 points"),
            &setup(body(), Law::BBPD),
        );
    }
}
