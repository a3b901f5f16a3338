//! Motion in time: against closed forms of the scheme, and against the conservation laws of every motion.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod faces;
mod statics;
mod vibration;

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::sync::Arc;

use ligament::body::{Cells, SolidLatticeBody};
use ligament::prelude::*;
use ligament::run::on_threads;
use ligament::setup::{self, InitialVelocity, PoissonForm};
use ligament::{Loading, Vibration};
use ligament_analysis::driver::{Outcome, Problem, motion};
use ligament_analysis::history::{Moment, ObserverError, Onward, StepRecord, Termination, View};
use ligament_analysis::modal::{ModalAnalysis, ModeKind, Rotations};
use ligament_analysis::motion::{
    Damping, Dashpot, MotionProblem, MotionSettings, Scheme, StepBreakages, critical_step,
};
use ligament_analysis::{Control, ControlKind, ProportionalLoading};
use ligament_model::law::LAWS;
use ligament_model::material::Space;

const YOUNG: f64 = 30e9;
const DENSITY: f64 = 2400.0;
const SPACING: f64 = 0.01;
/// Stretch at which bonds fail by the strength.
const STRETCH: f64 = 1e-4;

/// The first and the last layer of a bar of cells.
fn ends<const D: usize, S>() -> BTreeMap<String, Cells<D, S>> {
    let end = |name: &str, normal: i8| {
        let mut normals = [0; D];
        normals[0] = normal;
        (name.to_owned(), Cells::AtSide(normals, 1))
    };
    [end("first", -1), end("last", 1)].into()
}

fn setup_of(body: impl Into<AnyBody>, law: Law) -> Setup {
    let mut material = Material::isotropic(YOUNG, 0.2);
    material.tensile_strength = Some(STRETCH * YOUNG);
    material.fracture_energy = Some(STRETCH * STRETCH * YOUNG * SPACING);
    material.density = Some(DENSITY);
    let mut setup = Setup::new(body, material, law);
    setup.horizon = Horizon::Factor(2.5);
    setup.analysis = Analysis::Modal(ModalSettings::default());
    setup
}

fn plate(law: Law) -> Setup {
    setup_of(
        LatticeBody::new([12, 6], [SPACING; 2], [0.0; 2], &[], &ends()).unwrap(),
        law,
    )
}

fn block(law: Law) -> Setup {
    let body = SolidLatticeBody::new([6, 4, 3], [SPACING; 3], [0.0; 3], &[], &ends());
    setup_of(body.unwrap(), law)
}

/// Setups of every law in the dimensions in which it exists, whose rotations have a positive stiffness.
fn every_law() -> Vec<(String, Setup)> {
    let mut all = Vec::new();
    for law in LAWS.map(Law::usual) {
        all.push((format!("{} plane", law.name()), plate(law)));
        if law.row.exists_in(Space::Solid) {
            all.push((format!("{} space", law.name()), block(law)));
        }
    }
    all
}

/// The motion of a setup from first velocities with its supports and without loads; bonds break where the setup has criteria.
fn motion_of(setup: &Setup, velocity: impl FnOnce(&Model) -> Vec<f64>) -> MotionProblem {
    let mut of_statics = setup.clone();
    if !setup.criteria.is_empty() {
        of_statics.analysis = Analysis::Stepped(setup::stepped(vec![1.0]));
    }
    let model = Model::build(of_statics, &mut ()).unwrap();
    let Vibration { supports, mass, .. } = Vibration::new(&model).unwrap();
    let system = model.system.to_bonds();
    let nothing = Control {
        kind: ControlKind::Force,
        points: Vec::new(),
        shape: Vec::new(),
        magnitude: 0.0,
    };
    let mut loads = ProportionalLoading::new(system.layout, nothing);
    for (dof, held) in supports.held.iter().enumerate() {
        loads.prescribed[dof] = held.then_some(0.0);
    }
    MotionProblem {
        initial_velocity: velocity(&model).into(),
        dashpots: Arc::new([]),
        problem: Problem {
            face_friction: setup.closing_friction,
            contact: Default::default(),
            system,
            criteria: model.criteria.clone(),
            loads: Arc::new(loads),
            solver: model.setup.solver.clone(),
            probes: Arc::new([]),
            notches: Arc::default(),
        },
        mass,
    }
}

fn settings(duration: f64, rows: usize) -> MotionSettings {
    MotionSettings {
        rows,
        safety: 0.9,
        ..MotionSettings::new(duration)
    }
}

/// Implicit steps, a number of them between two rows.
fn implicit(duration: f64, rows: usize, steps: usize, dissipation: f64) -> MotionSettings {
    MotionSettings {
        scheme: Scheme::Implicit,
        step: Some(duration / (rows * steps) as f64),
        dissipation,
        breakages: StepBreakages {
            energy_tolerance: 1e-6,
            ..StepBreakages::default()
        },
        ..settings(duration, rows)
    }
}

/// States of a motion at its rows.
#[derive(Default)]
struct States {
    /// Time, displacements and velocities.
    rows: Vec<(f64, Vec<f64>, Vec<f64>)>,
    /// Records with the forces at all degrees of freedom.
    records: Vec<(StepRecord, Vec<f64>)>,
    /// Checkpoints at the rows.
    checkpoints: Vec<Vec<u8>>,
}

impl Observer for States {
    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        let displacement = view.state.displacement.clone();
        let velocity = view.motion.unwrap().velocity.to_vec();
        self.rows.push((record.load_factor, displacement, velocity));
        let forces = view.balanced.internal.values.clone();
        self.records.push((record.clone(), forces));
        Ok(())
    }

    fn moment(&mut self, moment: &Moment<'_>) -> Result<Onward, ObserverError> {
        self.checkpoints.push(moment.bytes());
        Ok(Onward::Go)
    }
}

fn followed(problem: &MotionProblem, settings: &MotionSettings) -> (Outcome, States) {
    let mut states = States::default();
    let outcome = motion::run(problem, settings, &mut states).unwrap();
    (outcome, states)
}

/// Resumes a motion from some of its rows: its later records and its outcome have the same bits.
fn assert_resumes(
    problem: &MotionProblem,
    settings: &MotionSettings,
    (outcome, states): (&Outcome, &States),
    rows: &[usize],
) {
    for &row in rows {
        let mut checkpoint = states.checkpoints[row].as_slice();
        let restored = motion::restore(problem, settings, &mut checkpoint).unwrap();
        let mut rest = States::default();
        let again = restored.resume(&mut rest).unwrap();
        assert_eq!(again.history, outcome.history, "row {row}");
        assert_eq!(again.state, outcome.state, "row {row}");
        assert_eq!(again.termination, outcome.termination, "row {row}");
        assert!(rest.rows == states.rows[row..], "row {row}");
        assert!(rest.records == states.records[row..], "row {row}");
    }
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    let larger = |most: f64, it: f64| if it > most || it.is_nan() { it } else { most };
    values.into_iter().fold(0.0, larger)
}

/// Largest energy imbalance of a history, relative to work and first energy.
fn imbalance(outcome: &Outcome) -> f64 {
    largest(outcome.history.iter().map(|it| it.energy_error().abs()))
}

/// Velocities that excite all modes: a wavy field, the same on every machine.
fn wavy(n: usize) -> Vec<f64> {
    (0..n).map(|dof| (1.3 * dof as f64).sin() + 0.1).collect()
}

/// A free body keeps its momenta and its energy: 10,000 steps with all modes in motion.
///
/// 1e-12 of the sum of the sizes, over which rounding adds up; energies balance to 1e-10 because the energies of the scheme do, see the
/// driver. The energy computed from the velocities at the times themselves drifts below 1e-4.
#[test]
fn a_free_body_keeps_momentum_and_energy() {
    for (name, setup) in [("plane", plate(Law::NHPD)), ("space", block(Law::NHPD))] {
        let problem = motion_of(&setup, |model| {
            wavy(model.system.to_bonds().layout.n_degrees_of_freedom())
        });
        let critical = critical_step(&problem, &settings(1.0, 1)).unwrap().step;
        let (outcome, states) = followed(&problem, &settings(9000.0 * critical, 10));
        assert!(outcome.history[10].motion.unwrap().time_steps >= 10_000);
        let layout = problem.problem.system.layout;
        let masses = problem.masses(1.0);
        for axis in [Component::X, Component::Y] {
            let dofs: Vec<usize> = (0..layout.n_points as u32)
                .filter_map(|point| layout.degree_of_freedom(point, axis))
                .collect();
            let momentum = |row: usize| -> f64 {
                let velocity = &states.rows[row].2;
                dofs.iter().map(|&dof| masses[dof] * velocity[dof]).sum()
            };
            let size: f64 = dofs.iter().map(|&dof| masses[dof]).sum();
            assert!(
                (momentum(10) - momentum(0)).abs() < 1e-12 * size,
                "{name} {axis:?}"
            );
        }
        let energy = |row: usize| {
            let velocity = &states.rows[row].2;
            let both = velocity.iter().zip(&masses);
            let kinetic: f64 = both.map(|(v, mass)| 0.5 * mass * v * v).sum();
            kinetic + outcome.history[row].stored_energy
        };
        let drift = largest((5..10).map(|row| (energy(row + 1) / energy(row) - 1.0).abs()));
        println!(
            "{name}: imbalance {:.1e}, {drift:.1e} between rows",
            imbalance(&outcome)
        );
        assert!(imbalance(&outcome) < 1e-10, "{name}");
    }
}

/// A pulled bar that breaks: energies balance, bonds break once, and the same bits for one thread and two, and from any checkpoint.
///
/// 1e-9 of the work: the trapezoidal rule is exact for bonds that are linear until they break; measured 2e-14.
#[test]
fn a_breaking_bar_balances_and_repeats_its_bits() {
    for (name, mut setup) in [("plane", plate(Law::NHPD)), ("space", block(Law::NHPD))] {
        setup.criteria = vec![STRENGTH.into()];
        let problem = motion_of(&setup, |model| {
            // The halves fly apart.
            let layout = model.system.to_bonds().layout;
            let mut velocity = vec![0.0; layout.n_degrees_of_freedom()];
            for point in 0..layout.n_points as u32 {
                let dof = layout.degree_of_freedom(point, Component::X).unwrap();
                velocity[dof] = if (point as usize) < layout.n_points / 2 {
                    -3.0
                } else {
                    3.0
                };
            }
            velocity
        });
        for settings in [
            settings(4e-5, 8),
            implicit(4e-5, 8, 10, 0.0),
            implicit(4e-5, 8, 10, 0.1),
        ] {
            let (outcome, states) = followed(&problem, &settings);
            let last = outcome.history.last().unwrap();
            println!(
                "{name}: {} broken, imbalance {:.1e}",
                last.broken_bonds,
                imbalance(&outcome)
            );
            assert!(last.broken_bonds > 20);
            assert!(
                last.released_energy > 0.0
                    && last.released_energy < last.motion.unwrap().initial_energy
            );
            assert!(imbalance(&outcome) < 1e-9, "{name}");
            let two = on_threads(Some(2), || followed(&problem, &settings)).unwrap();
            assert_eq!(two.0.history, outcome.history);
            assert_resumes(&problem, &settings, (&outcome, &states), &[0, 3, 7, 8]);
        }
    }
}
