//! Dissipated energy that controls the load: through peaks and snap-backs, of bonds that soften and of brittle ones.

use ligament_model::failure::fracture_energy::BOND_ENERGY;
use ligament_model::failure::softening::{self, brittle};

use super::*;

/// Stiffness of the machine, N/m.
const MACHINE: f64 = 8e7;

/// Fracture energy of the material, J/m^2.
const FRACTURE_ENERGY: f64 = 100.0;

/// A bar of 30 by 8 cells of 1 mm, 1 m thick, that two notches leave 4 mm of, pulled by 0.2 mm at its right end.
fn bar(law: softening::Law, analysis: Analysis, stage: Stage) -> Setup {
    let sets = [("left", CellSet::left(2)), ("right", CellSet::right(2))];
    let sets = sets.map(|(name, set)| (name.to_owned(), set)).into();
    let body = LatticeBody::new([30, 8], [0.001; 2], [0.0; 2], &[], &sets).unwrap();
    let mut material = Material::isotropic(30e9, 0.2);
    material.fracture_energy = Some(FRACTURE_ENERGY);
    let bonds = Law::MPPD;
    let mut setup = Setup::new(body, material, bonds);
    let notch = |from: f64, to: f64| PreCrack::along(vec![[0.015, from], [0.015, to]]);
    setup.precracks = vec![notch(-0.01, 0.0021), notch(0.0061, 0.02)];
    setup.supports = vec![Support::new("left", &[Component::X, Component::Y])];
    let pull = Displacement {
        x: Some(2e-4),
        ..Displacement::default()
    };
    setup.loads = vec![Load::new("right", Action::Displacement(pull))];
    let mut choice: Choice = BOND_ENERGY.into();
    choice.limit = Some(1e-4);
    choice.after = law;
    setup.criteria = vec![choice];
    setup.analysis = analysis;
    setup.stages = vec![stage];
    setup
}

/// The load goes to 1, under a control or not.
fn pull(control: Option<f64>, steps: Option<usize>) -> Stage {
    Stage {
        name: "pull".to_owned(),
        loads: vec![("right".to_owned(), Course::to(1.0))],
        steps,
        control: control.map(dissipated),
    }
}

fn dissipated(to: f64) -> Control {
    Control {
        quantity: Quantity::DissipatedEnergy,
        to,
    }
}

fn steps() -> Analysis {
    let mut settings = stepped(Vec::new());
    settings.energy_tolerance = 1e-6;
    Analysis::Stepped(settings)
}

/// Force of a curve of displacements that grow, at one of them.
fn interpolated(curve: &[[f64; 2]], displacement: f64) -> f64 {
    let place = curve.partition_point(|it| it[0] < displacement);
    let [[from, low], [to, high]] = [curve[place - 1], curve[place]];
    low + (displacement - from) / (to - from) * (high - low)
}

/// A machine in series adds F/k to the displacement of the bar: with it the bar carries the same force as under the given displacement, and
/// its far end moves back where the bar softens faster than the machine. In each step the bonds dissipate the same energy. The area under
/// the curve, less the energy stored in bar and machine, is the energy released by the bonds, except for a platen that yields by 1e-6. 5e-3
/// of the peak: the given displacements lie between the displacements of the stiff machine.
#[test]
fn a_soft_machine_snaps_back_on_the_curve_of_a_stiff_one() {
    const END: f64 = 0.2;
    const STEPS: usize = 20;
    let mut setup = bar(linear::LAW, steps(), pull(None, Some(400)));
    setup.loads[0].tilts = true;
    let (stiff, _) = run(setup);
    let curve = stiff
        .history
        .iter()
        .map(|it| [it.displacement, it.reaction]);
    let curve: Vec<[f64; 2]> = curve.collect();
    let peak = curve.iter().fold(0.0_f64, |peak, it| peak.max(it[1]));
    let mut setup = bar(linear::LAW, steps(), pull(Some(END), Some(STEPS)));
    setup.loads[0].tilts = true;
    setup.loads[0].stiffness = Some(MACHINE);
    let (soft, _) = run(setup);
    assert_eq!(soft.termination, Termination::StepsDone);
    assert_eq!(soft.history.len(), STEPS + 1);
    let mut area = 0.0;
    for (step, record) in soft.history.iter().enumerate() {
        let wanted = END * step as f64 / STEPS as f64;
        let missed = (record.dissipated_energy - wanted).abs();
        assert!(missed <= 0.02 * END / STEPS as f64, "{step}: {missed:e}");
        let grip = record.displacement - record.reaction / MACHINE;
        if step > 0 {
            let given = interpolated(&curve, grip);
            let difference = (record.reaction - given).abs() / peak;
            assert!(difference < 5e-3, "{step}: {} {given}", record.reaction);
        }
        assert!(record.missing_energy().abs() <= 1e-6 * record.external_work);
        let machine = 0.5 * record.reaction.powi(2) / MACHINE;
        let stored = machine + record.stored_energy;
        if step < 2 {
            // The first step goes over the peak: no straight line.
            area = record.released_energy + stored;
            continue;
        }
        let before = &soft.history[step - 1];
        let force = 0.5 * (before.reaction + record.reaction);
        area += force * (record.displacement - before.displacement);
        let difference = (area - stored - record.released_energy).abs();
        assert!(difference < 1e-5 * area, "{step}: {difference:e}");
    }
    let both_fall = |pair: &[StepRecord]| {
        pair[1].reaction < pair[0].reaction && pair[1].displacement < pair[0].displacement
    };
    let back = soft.history.windows(2).filter(|it| both_fall(it)).count();
    assert!(back > STEPS / 2, "{back}");
}

/// Brittle bonds dissipate their energy all at once: the exact path goes from breakage to breakage as it does under a displacement, here
/// far beyond factor 1 of a small one, until the energy is used up.
#[test]
fn the_exact_path_goes_on_until_the_energy_is_gone() {
    const END: f64 = 1.2e-3;
    let path = || Analysis::Event(event());
    let (given, whole) = run(bar(brittle::LAW, path(), pull(None, None)));
    assert_eq!(given.termination, Termination::FellApart);

    let mut setup = bar(brittle::LAW, path(), pull(Some(END), None));
    let short = Displacement {
        x: Some(2e-8),
        ..Displacement::default()
    };
    setup.loads[0].action = Action::Displacement(short);
    let (followed, part) = run(setup);
    assert_eq!(
        followed.termination,
        Termination::EnergyDissipated { energy: END }
    );
    let order = |records: &[BreakRecord]| records.iter().map(|it| it.bond).collect::<Vec<u32>>();
    let broken = order(&part.breaks);
    assert!(broken.len() > 10, "{}", broken.len());
    assert_eq!(broken, order(&whole.breaks[..broken.len()]));
    let energies = followed.history.iter().map(|it| it.dissipated_energy);
    let energies: Vec<f64> = energies.collect();
    let (last, before) = energies.split_last().unwrap();
    assert!(*last >= END && before.iter().all(|it| *it < END));
    assert!(followed.history.iter().all(|it| it.at_rest));
    let largest = followed.history.iter().map(|it| it.load_factor);
    assert!(largest.fold(0.0, f64::max) > 10.0);
}

/// Runs continue with the same bits from every restart point, also from points between two rounds of breaking.
#[test]
fn runs_go_on_to_the_same_bits() {
    for (law, analysis, end, count) in [
        (linear::LAW, steps(), 0.38, Some(8)),
        (brittle::LAW, Analysis::Event(event()), 8e-4, None),
    ] {
        let mut setup = bar(law, analysis.clone(), pull(Some(end), count));
        setup.loads[0].stiffness = Some(MACHINE);
        let back = Stage {
            name: "back".to_owned(),
            loads: vec![("right".to_owned(), Course::to(0.0))],
            steps: count,
            control: None,
        };
        setup.stages.push(back);
        assert!(goes_on_from_every_moment(setup, &analysis) > 12);
    }
}

#[test]
fn what_dissipates_nothing_controls_nothing() {
    let error = |law, analysis, stage| {
        let setup = bar(law, analysis, stage);
        setup.solve(&mut NoObserver).unwrap_err().to_string()
    };
    let brittle = error(brittle::LAW, steps(), pull(Some(0.1), Some(4)));
    assert!(
        brittle.starts_with("stages[0].control: brittle bonds take their energy all at once"),
        "{brittle}"
    );
    let elastic = error(linear::LAW, Analysis::default(), pull(Some(0.1), None));
    assert!(
        elastic.starts_with("stages[0].control: nothing is dissipated"),
        "{elastic}"
    );
    let none = error(linear::LAW, steps(), pull(Some(0.0), Some(4)));
    assert!(none.contains("an energy above 0 at the end"), "{none}");
    let mut sound = bar(linear::LAW, steps(), pull(Some(0.1), Some(4)));
    sound.no_fail = vec![Place::Everywhere];
    let (outcome, _) = run(sound);
    assert!(
        outcome.termination.to_string().contains("no bond softens"),
        "{}",
        outcome.termination
    );
}
