//! Along every fracture run forces and energies balance and nothing heals.

use ligament::prelude::*;
use ligament_analysis::Layout;
use ligament_analysis::Termination;
use ligament_analysis::fields;
use ligament_analysis::history::{BreakRecord, ObserverError, StepRecord, View};
use ligament_model::failure::sliding::SLIDING;
use ligament_model::failure::softening;
use ligament_model::failure::softening::{exponential, linear, plastic};
use ligament_model::failure::stretch::TENSION;
use verification::numbers::{Random, damages, largest, relative_error};

use super::image::Image;
use super::invariance::{analysis, criteria};
use super::specimen::Specimen;

/// What only grows, as it was at the step before.
#[derive(Default)]
struct Past {
    broken_by: Vec<Option<u8>>,
    /// Energy that each bond took.
    dissipated: Vec<f64>,
    dissipated_energy: f64,
    /// Largest e/e_0 of each bond by each criterion.
    largest: Vec<Vec<f64>>,
    /// Damage of each point: of all kinds together, then of each.
    damage: Vec<Vec<f64>>,
}

/// Checks each step, and keeps the largest of what should be zero.
#[derive(Default)]
struct Check {
    positions: Vec<[f64; 2]>,
    /// Whether a rigid rotation costs no energy, so that moments balance: not where bonds resist shear between points that do not turn.
    moments_balance: bool,
    /// Largest forces and moments that met at a point, or loaded the body, so far.
    force_scale: f64,
    moment_scale: f64,
    past: Past,
    broken: Vec<u32>,
    /// Sum of supports, loads and holds over the forces that meet at a point.
    total: f64,
    /// What a hold carries over the forces that meet at a point.
    held: f64,
    /// Sum of the groups of the history over the forces that meet at a point.
    groups: f64,
    /// What the energies miss over the largest work so far.
    energy: f64,
    largest_work: f64,
    n_held: usize,
    steps: usize,
}

impl Check {
    fn new(setup: &Setup) -> Self {
        Self {
            positions: setup.body.geometry().positions().to_vec(),
            moments_balance: !setup.law.row.resists_rotations(),
            ..Self::default()
        }
    }

    fn forces(&mut self, record: &StepRecord, view: &View<'_>) {
        let internal = &view.balanced.internal;
        self.force_scale = internal.force_scale.max(self.force_scale);
        self.moment_scale = internal.moment_scale.max(self.moment_scale);
        if self.force_scale == 0.0 {
            return;
        }
        let layout: Layout = view.system.layout;
        let n = layout.n_degrees_of_freedom();
        let all: Vec<u32> = (0..n as u32).collect();
        let mut outer = view.loads.forces(record.load_factor, &all);
        let reactions = view.loads.reactions(record.load_factor, &internal.values);
        for (dof, outer) in outer.iter_mut().enumerate() {
            *outer += reactions[dof];
            if view.state.held[dof] && !view.loads.is_prescribed(dof) {
                let carried = internal.values[dof] - *outer;
                let scale = if layout.component(dof).is_rotation() {
                    self.moment_scale
                } else {
                    self.force_scale
                };
                if carried != 0.0 {
                    self.held = largest([self.held, carried / scale]);
                }
                self.n_held += 1;
                *outer += carried;
            }
        }
        let mut sum = [0.0; 3];
        let mut size = 0.0_f64;
        for (point, [x, y]) in (0..).zip(&self.positions) {
            let [along, across, moment] = Component::ALL.map(|it| layout.value(point, it, &outer));
            sum[0] += along;
            sum[1] += across;
            sum[2] += moment + x * across - y * along;
            size = size.max(x.abs()).max(y.abs());
        }
        sum[2] /= size;
        let sum = sum
            .into_iter()
            .take(if self.moments_balance { 3 } else { 2 });
        self.total = largest(sum.map(|it| it / self.force_scale).chain([self.total]));
        for component in [Component::X, Component::Y] {
            let groups = record.group_forces.iter();
            let sum: f64 = groups.map(|it| layout.value(0, component, it)).sum();
            self.groups = largest([self.groups, sum / self.force_scale]);
        }
    }

    fn growth(&mut self, record: &StepRecord, view: &View<'_>) {
        let state = view.state;
        let mut damage = vec![fields::damage(view.system, &state.intact)];
        let of_kinds = damages(view.system, view.criteria.criteria(), state);
        damage.extend(of_kinds.into_iter().map(|it| it.1));
        let past = std::mem::replace(
            &mut self.past,
            Past {
                broken_by: state.broken_by.clone(),
                dissipated: state.dissipated.clone(),
                dissipated_energy: record.dissipated_energy,
                largest: state.softening.largest.clone(),
                damage,
            },
        );
        let (now, step) = (&self.past, record.step);
        let broken = state.broken_bonds();
        assert!(broken == record.broken_bonds && broken <= self.broken.len());
        for (bond, by) in now.broken_by.iter().enumerate() {
            assert_eq!(by.is_none(), state.intact[bond], "step {step}, bond {bond}");
        }
        for (bond, by) in past.broken_by.iter().enumerate() {
            let is_same = by.is_none() || *by == now.broken_by[bond];
            assert!(is_same, "step {step}: bond {bond} healed");
        }
        let grows = |before: &[f64], now: &[f64]| before.iter().zip(now).all(|(a, b)| b >= a);
        assert!(grows(&past.dissipated, &now.dissipated), "step {step}");
        assert!(
            record.dissipated_energy >= past.dissipated_energy,
            "step {step}"
        );
        for (before, now) in past.largest.iter().zip(&now.largest) {
            assert!(grows(before, now), "step {step}");
        }
        for (before, now) in past.damage.iter().zip(&now.damage) {
            assert!(grows(before, now), "step {step}: damage falls");
            assert!(now.iter().all(|it| (0.0..=1.0).contains(it)), "step {step}");
        }
    }
}

impl Observer for Check {
    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        for record in records {
            assert!(!self.broken.contains(&record.bond), "{record:?}");
            self.broken.push(record.bond);
            self.force_scale = self.force_scale.max(record.reaction);
        }
        Ok(())
    }

    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        self.steps += 1;
        self.forces(record, view);
        self.growth(record, view);
        self.largest_work = largest([self.largest_work, record.external_work]);
        if self.largest_work > 0.0 {
            let missing = record.missing_energy() / self.largest_work;
            self.energy = largest([self.energy, missing]);
        }
        Ok(())
    }
}

/// Follows a specimen to the end and says what did not balance.
fn followed(name: &str, setup: Setup) -> Check {
    let mut check = Check::new(&setup);
    let end = setup.solve(&mut check).unwrap().outcome.termination;
    println!(
        "{name}: {} steps, {} bonds, {} held: total {:.1e}, held {:.1e}, groups {:.1e}, energy {:.1e}; {end}",
        check.steps,
        check.broken.len(),
        check.n_held,
        check.total,
        check.held,
        check.groups,
        check.energy
    );
    assert!(!check.broken.is_empty(), "{name}");
    // Also an unloaded body is in equilibrium.
    assert_ne!(end.name(), "no-equilibrium", "{name}");
    check
}

/// Forwards, back, and further, to the other side as well.
const BACK_AND_FORTH: [f64; 10] = [0.2, 0.4, 0.3, 0.45, 0.1, -0.2, 0.5, 0.7, 0.0, 1.0];

/// Brittle bonds. Equilibria are known to 1e-10 of the forces at a point, of which some ten are added up, and between them work
/// and energies are exact: 1e-8 of the work are several times what the forces leave.
#[test]
fn forces_and_energies_of_brittle_runs_balance() {
    let mut n_held = 0;
    for (seed, law) in (701..).zip(Law::ALL.repeat(9)) {
        let mut random = Random(seed);
        let specimen = Specimen::new(law, &mut random);
        let number = seed as usize;
        let mut analysis = analysis(number, None);
        if let Analysis::Stepped(settings) = &mut analysis
            && number.is_multiple_of(2)
        {
            settings.load_factors = BACK_AND_FORTH.to_vec();
        }
        let criteria = criteria(&specimen, number / 3);
        let name = format!("{}, seed {seed}", law.name());
        let check = followed(&name, specimen.torn(&Image::SAME, criteria, analysis));
        assert!(check.total < 1e-9 && check.groups < 1e-9, "{name}");
        assert!(check.held < 1e-9, "{name}: a hold carries {:e}", check.held);
        assert!(check.energy < 1e-8, "{name}: {:e}", check.energy);
        n_held += check.n_held;
    }
    assert!(n_held > 0, "nothing came loose");
}

/// A load that goes through zero to the other side is carried the other way: the body is as whole as before.
#[test]
fn a_load_the_other_way_is_no_end() {
    let mut specimen = Specimen::new(Law::NHPD, &mut Random(1));
    for by_force in [false, true] {
        specimen.by_force = by_force;
        let criterion = Choice {
            limit: Some(1e3 * specimen.strain),
            ..Choice::from(TENSION).with_softening(linear::LAW, Some(2.0))
        };
        let analysis = Analysis::Stepped(stepped(vec![0.2, 0.1, -0.15, -0.3, 0.2]));
        let setup = specimen.torn(&Image::SAME, vec![criterion], analysis);
        let outcome = setup.solve(&mut NoObserver).unwrap().outcome;
        assert_eq!(outcome.termination, Termination::StepsDone);
        let [there, .., back] = &outcome.history[1..] else {
            panic!("steps are missing");
        };
        assert!(relative_error(back.reaction, there.reaction) < 1e-9);
    }
}

/// Bonds that soften. Their equilibria are known to 1e-6 of the forces at a point, and the program calls energies balanced to 1e-4 of
/// the work.
#[test]
fn forces_and_energies_of_softening_runs_balance() {
    let laws: Vec<Law> = Law::ALL
        .into_iter()
        .filter(|law| !law.row.needs_lattice)
        .collect();
    for (seed, law) in (801..).zip(laws.repeat(3)) {
        let mut specimen = Specimen::new(law, &mut Random(seed));
        // A body under a given force collapses with the first bonds that soften.
        specimen.by_force = false;
        let choice = |kind, times: f64, law: softening::Law, parameter| Choice {
            limit: Some(times * specimen.strain),
            ..Choice::from(kind).with_softening(law, parameter)
        };
        let criteria = match seed % 3 {
            0 => vec![choice(TENSION, 1.0, linear::LAW, Some(6.0))],
            1 => vec![choice(TENSION, 1.0, exponential::LAW, Some(1.0))],
            _ => vec![
                choice(TENSION, 1.0, linear::LAW, Some(3.0)),
                choice(SLIDING, 1.5, plastic::LAW, None),
            ],
        };
        let mut settings = stepped(BACK_AND_FORTH.map(|it| 0.7 * it).to_vec());
        settings.energy_tolerance = 1e-9;
        let name = format!("{}, seed {seed}", law.name());
        let analysis = Analysis::Stepped(settings);
        let check = followed(&name, specimen.torn(&Image::SAME, criteria, analysis));
        assert!(check.total < 1e-5 && check.groups < 1e-5, "{name}");
        assert!(check.held < 1e-5, "{name}: a hold carries {:e}", check.held);
        assert!(check.energy < 1e-4, "{name}: {:e}", check.energy);
    }
}
