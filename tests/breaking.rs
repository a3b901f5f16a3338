//! What the breaking of bonds must keep: energies, pre-cracks, protected parts, and how runs end.
//!
//! Each test states its problem and where its expectation comes from. An assertion that something is zero or equal
//! stands beside one that the thing compared is there at all.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament_analysis::Equilibrium;
use ligament_analysis::Observer;
use ligament_analysis::State;
use ligament_analysis::Termination;
use ligament_analysis::fields;
use ligament_analysis::history::ObserverError;
use ligament_analysis::history::StepRecord;
use ligament_analysis::history::View;
use std::collections::BTreeSet;
use tempfile::TempDir;
use verification::bench;
use verification::bench::Bench;
use verification::numbers::deviation;
use verification::numbers::largest;
use verification::numbers::relative_error;
use verification::problems::DISK;
use verification::problems::SQUARE;
use verification::table::Table;

/// A body that is loaded, unloaded to nothing and loaded the other way has given its work back at zero load, without a message that
/// energies do not balance, and ends with its last load step.
#[test]
fn unloading_to_nothing_keeps_the_balance() {
    let bench = Bench::new(
        DISK,
        &["fracture.steps=[0.01, 0.02, 0.0, -0.01, 0.0, 0.02]"],
    );
    let run = bench.break_up();
    assert!(run.breaks.is_empty());
    assert_eq!(run.outcome.history.len(), 7);
    assert_eq!(run.outcome.termination, Termination::StepsDone);
    assert!(!run.told("energy-unbalanced"), "{:?}", run.messages);
    // Equal load factors are equal states, 1e-9 of the work by the tolerance of the residual.
    let [loaded, again] = [2, 6].map(|step| run.outcome.history[step].external_work);
    assert!(loaded > 0.0 && relative_error(again, loaded) < 1e-9);
    for unloaded in [3, 5] {
        let work = run.outcome.history[unloaded].external_work;
        assert!(work.abs() < 1e-9 * loaded, "{work:e} of {loaded:e}");
    }
}

/// A body that its first load step tears has never carried a load at rest. What it carries then is rounding, 1e-22 to 1e-6 N of either sign
/// against 1e5 N and more of the whole body, and ends the run with the factor and with the iteration, whichever way it is moved.
#[test]
fn a_body_that_its_first_step_tears_fell_apart() {
    for method in ["direct", "iterative"] {
        for steps in ["[1.0]", "[-1.0, -1.2]"] {
            for motion in ["8e-4", "1.1e-3", "1.5e-3"] {
                let sign = if steps.starts_with("[-") { "-" } else { "" };
                let settings = [
                    format!("solver.method={method}"),
                    format!("fracture={{ steps = {steps} }}"),
                    format!("load.0.displacement.y={sign}{motion}"),
                ];
                let settings = settings.each_ref().map(String::as_str);
                let outcome = Bench::new(SQUARE, &settings).break_up().outcome;
                assert_eq!(outcome.termination, Termination::FellApart, "{settings:?}");
                let [unloaded, torn] = &outcome.history[..] else {
                    panic!("{settings:?}: {} states", outcome.history.len());
                };
                assert!(unloaded.reaction.abs() + torn.reaction.abs() < 1e-5);
            }
        }
    }
}

/// External work = stored + released energy in every load step. 1e-9 of the work: all three are exact between breakages.
#[test]
fn energies_balance_while_bonds_break() {
    let pulled = Bench::new(SQUARE, &["fracture.stop.load_fraction=0.1"]);
    let loaded = Bench::new(
        &SQUARE.replace("displacement = { y = 5e-5 }", "force = { y = 5e5 }"),
        &["fracture.steps=200"],
    );
    let pressed = Bench::new(
        DISK,
        &["fracture.order=ratio", "fracture.bonds_per_iteration=10"],
    );
    for (name, bench) in [("pulled", pulled), ("loaded", loaded), ("pressed", pressed)] {
        let run = bench.break_up();
        let at_rest: Vec<&StepRecord> = run
            .outcome
            .history
            .iter()
            .filter(|step| step.at_rest)
            .collect();
        let work = run.last().external_work;
        let error = largest(
            (at_rest.iter())
                .map(|step| step.external_work - step.stored_energy - step.released_energy),
        ) / work;
        let released = run.last().released_energy / work;
        println!(
            "{name}: {} bonds, balance off by {error:.1e}, released {released:.2}",
            run.breaks.len()
        );
        assert!(error < 1e-9, "{name}: {error:.1e}");
        assert!(
            released > 1e-3 && run.breaks.len() > 30,
            "{name}: bonds release energy"
        );
    }
}

/// Centre slot of 40 mm in the disk: a fresh specimen has bonds cut, a share of them at some points, and no damage.
#[test]
fn a_pre_crack_is_no_damage() {
    let text =
        format!("{DISK}precrack = [{{ points = [[-0.0141, -0.0141], [0.0142, 0.0143]] }}]\n");
    let bench = Bench::new(&text, &[]);
    let model = &bench.model;
    let run = bench.break_up();
    assert!(model.cut_bonds() > 100);
    let whole = Bench::new(DISK, &[]).model.plane().bonds.len();
    assert_eq!(model.plane().bonds.len() + model.cut_bonds(), whole);
    let intact = vec![true; model.plane().bonds.len()];
    assert_eq!(largest(fields::damage(&**model.plane(), &intact)), 0.0);
    let share = &model.fixed.precrack_share;
    assert!(largest(share.iter().copied()) > 0.3 && share.contains(&0.0));
    // What broke later is damage (NHPD eq. 17), of the bonds that the crack had left.
    let system = &**model.plane();
    let (mut broken, mut all) = (vec![0.0; bench.points()], vec![0.0; bench.points()]);
    for (bond, ends) in system.bonds.ends.iter().enumerate() {
        let is_broken = run.breaks.iter().any(|record| record.bond as usize == bond);
        for &end in ends {
            all[end as usize] += system.weight[bond];
            broken[end as usize] += if is_broken { system.weight[bond] } else { 0.0 };
        }
    }
    let damage = fields::damage(system, &run.state().intact);
    for point in 0..bench.points() {
        assert!((damage[point] - broken[point] / all[point]).abs() < 1e-12);
    }
    let damaged = |point: usize| share[point] > 0.0 && damage[point] > 0.3;
    assert!(
        (0..bench.points()).any(damaged),
        "points at the slot are damaged"
    );
}

/// A broken bond is a bond that is not there: the disk with its slot's bonds marked as broken, and the disk built without
/// them, have the same solution (1e-9: other sums, another factorisation).
#[test]
fn a_broken_bond_is_an_absent_bond() {
    let text =
        format!("{DISK}precrack = [{{ points = [[-0.0141, -0.0141], [0.0142, 0.0143]] }}]\n");
    let without = Bench::new(&text, &[]);
    let with = Bench::new(DISK, &[]);
    let (system, kept) = (&**with.model.plane(), &without.model.plane().bonds.ends);
    let present: BTreeSet<&[u32; 2]> = kept.iter().collect();
    let mut state = State {
        load_factor: 1.0,
        ..State::fresh(system)
    };
    let absent: Vec<u32> = (0..system.bonds.len() as u32)
        .filter(|&bond| !present.contains(&system.bonds.ends[bond as usize]))
        .collect();
    let mut equilibrium = Equilibrium::new(&with.problem(), 1e-4).unwrap();
    let breakage = equilibrium.break_bonds(&mut state, &absent);
    let balanced = equilibrium
        .balance(&mut state, &breakage, &mut NoObserver)
        .unwrap()
        .balanced()
        .unwrap();
    let run = without.solve();
    let (u, whole) = (run.displacement(), with.solve());
    let error = deviation(&state.displacement, u);
    let energy = relative_error(balanced.stored_energy, run.last().stored_energy);
    let effect = deviation(whole.displacement(), u);
    println!(
        "marked against absent: {error:.1e}, energy {energy:.1e}; the slot itself {effect:.1e}"
    );
    assert!(error < 1e-9 && energy < 1e-9);
    assert!(effect > 1e-2, "the slot matters");
}

struct NoObserver;

impl Observer for NoObserver {
    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        Ok(())
    }
}

/// A force that grows beyond what the body bears: the run ends because the loaded part comes loose or the body carries
/// nothing any more, not with an error, and its history is on disk up to there.
#[test]
fn a_force_beyond_the_strength_ends_in_collapse() {
    let text = SQUARE.replace("displacement = { y = 5e-5 }", "force = { y = 1e6 }");
    let folder = TempDir::new().unwrap();
    let out = folder.path().join("out");
    let case = bench::case(&text, &["fracture.steps=40"]);
    let summary = bench::run_program(&case, &out);
    println!(
        "{}: {} bonds",
        summary.termination_message, summary.broken_bonds
    );
    assert!(["collapsed", "fell-apart"].contains(&&*summary.termination));
    assert!(summary.steps < 40 && summary.broken_bonds > 50);
    let history = Table::read(&out.join("history.csv"));
    assert_eq!(
        history.len(),
        summary.steps + 1,
        "all load steps are in the file"
    );
    let broken = history.count(history.len() - 1, "broken_bonds");
    assert_eq!(broken, summary.broken_bonds);
    assert_eq!(Table::read(&out.join("breaks.csv")).len(), broken);
    let peak = summary.peak.unwrap().reaction;
    assert!(
        (2e5..1e6).contains(&peak),
        "F_t times the width of 0.1 m is 3.8e5 N: {peak:e}"
    );
}

/// No bond with an end in a protected part breaks, where others would have broken without the protection.
#[test]
fn protected_bonds_never_break() {
    let protected =
        r#"no_fail = [{ box = [[-0.004, 0.02], [0.004, 0.06]] }, { group = "platen-bottom" }]"#;
    let free = Bench::new(DISK, &[]);
    let bench = Bench::new(&format!("{DISK}{protected}\n"), &[]);
    let inside = |point: u32| {
        let [x, y] = bench.positions()[point as usize];
        x.abs() <= 0.004 && y >= 0.02 || bench.group("platen-bottom").contains(&point)
    };
    let marked = (0..bench.points() as u32)
        .filter(|&point| inside(point))
        .count();
    assert_eq!(marked, bench.model.no_fail_points());
    let broken_inside = |bench: &Bench| {
        let run = bench.break_up();
        assert!(run.breaks.len() > 50);
        let ends = |bond: u32| bench.model.plane().bonds.ends[bond as usize];
        let touches = |bond: u32| ends(bond).iter().any(|&end| inside(end));
        run.breaks
            .iter()
            .filter(|record| touches(record.bond))
            .count()
    };
    assert!(
        broken_inside(&free) > 10,
        "without protection bonds break there"
    );
    assert_eq!(broken_inside(&bench), 0);
}
