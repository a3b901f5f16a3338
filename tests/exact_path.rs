//! The exact equilibrium path: against an independent calculation, closed forms, and the stepped driver.
//!
//! Each test states its problem and where its expectation comes from. An assertion that something is zero or equal
//! stands beside one that the thing compared is there at all.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament_analysis::driver::{LoadPoint, StopRules};
use ligament_analysis::{Component, ControlKind, Termination, fields};
use tempfile::TempDir;
use verification::bench::{self, Bench, Run};
use verification::meshes;
use verification::numbers::{largest, relative_error, short};
use verification::problems::{DISK, SQUARE};
use verification::table::Table;
use verification::trusses::{Rod, Truss};

/// The disk of the reference: 324 points, 3717 bonds.
const COARSE: &str = "mesh.file=reference/disk.msh";

/// One bond at a time, in the order in which proportional loading reaches the limits.
const ONE_BY_RATIO: [&str; 2] = ["fracture.bonds_per_iteration=1", "fracture.order=ratio"];

/// A case without its load steps.
fn on_the_exact_path(text: &str) -> String {
    let start = text.find("fracture = ").unwrap();
    let end = start + text[start..].find('\n').unwrap();
    let fracture = "fracture = { control = \"event\" }";
    format!("{}{fracture}{}", &text[..start], &text[end..])
}

/// The first 200 breakages of the disk, bond for bond, with load factor, displacement and load (`reference/README.md`).
///
/// 1e-8: rounding times the condition number of the stiffness; the reference's own bonds are no closer than 1.9e-5.
#[test]
fn events_of_the_disk() {
    let expected = Table::reference("disk-event.csv");
    let text = on_the_exact_path(DISK);
    let bench = Bench::new(&text, &[COARSE, "fracture.stop.bonds=200"]);
    let run = bench.break_up();
    assert_eq!((expected.len(), run.breaks.len()), (200, 200));
    let mut worst = [0.0_f64; 3];
    for (row, record) in run.breaks.iter().enumerate() {
        let tags = ["a", "b"].map(|end| expected.count(row, end) as u64);
        let bond = bench.tags_of_bond(record.bond as usize);
        assert_eq!((record.order, record.step, bond), (row + 1, row + 1, tags));
        let step = &run.outcome.history[record.step];
        assert_eq!(step.load_factor, record.load_factor);
        assert_eq!((step.broken_bonds, step.broken_in_step), (row, 1));
        for (k, (column, of_bond, of_step)) in [
            ("factor", record.load_factor, step.load_factor),
            ("displacement", record.displacement, step.displacement),
            ("load", record.reaction, step.reaction),
        ]
        .into_iter()
        .enumerate()
        {
            assert_eq!(of_bond, of_step, "{column} of breakage {}", row + 1);
            let error = relative_error(of_bond, expected.number(row, column));
            worst[k] = worst[k].max(error);
            assert!(
                error < 1e-8,
                "{column} of breakage {} off by {error:.1e}",
                row + 1
            );
        }
    }
    println!(
        "200 events: factor, displacement, load off by {}",
        short(&worst)
    );
    let peak = run.outcome.peak().unwrap();
    let load = expected.column("load");
    assert!(relative_error(peak.reaction, largest(load)) < 1e-8);
    // The last record breaks nothing more.
    assert_eq!(
        run.outcome.termination,
        Termination::BondsBroken { bonds: 200 }
    );
    let last = run.last();
    assert_eq!(
        (last.step, last.broken_bonds, last.broken_in_step),
        (201, 200, 0)
    );
    assert!(last.at_rest);
}

/// Load on the line between two points of a rising curve.
fn on_curve(curve: &[LoadPoint], displacement: f64) -> f64 {
    let after = curve
        .iter()
        .position(|point| point.displacement >= displacement)
        .unwrap();
    let [a, b] = [curve[after - 1], curve[after]];
    let share = (displacement - a.displacement) / (b.displacement - a.displacement);
    a.reaction + share * (b.reaction - a.reaction)
}

/// The stepped driver with one bond at a time by ratio breaks the same bonds in the same order whatever its steps, each in
/// the first step that reaches the largest load factor of the path up to it; its curve is the envelope of the path.
///
/// Between breakages the state is proportional to the load, so that the largest s/s_0 is at the same bond at every load:
/// the order is a property of the body. 1e-9: rounding times the condition number. With nu = 0.38 the stiffness is
/// indefinite, and both runs end where the stored energy becomes negative or at the full load.
#[test]
fn a_stepped_test_follows_the_envelope() {
    for (name, material, step_settings) in [
        ("nu 0.21", "material.poisson=0.21", vec!["7", "50", "333"]),
        ("nu 0.38", "material.poisson=0.38", vec!["60"]),
    ] {
        let by_bonds = "model.poisson=bonds";
        let path = Bench::new(&on_the_exact_path(DISK), &[COARSE, material, by_bonds]).break_up();
        let events = &path.outcome.history;
        let envelope = path.outcome.envelope();
        println!("{name}: {}", path.outcome.termination);
        let snaps_back = (events.windows(2))
            .filter(|pair| pair[1].load_factor < pair[0].load_factor)
            .count();
        assert!(snaps_back > 50, "the path snaps back");
        for steps in step_settings {
            let steps = format!("fracture.steps={steps}");
            let settings = [&[COARSE, material, by_bonds, &steps], &ONE_BY_RATIO[..]].concat();
            let run = Bench::new(DISK, &settings).break_up();
            let bonds = |run: &Run| run.breaks.iter().map(|it| it.bond).collect::<Vec<u32>>();
            let (of_steps, of_path) = (bonds(&run), bonds(&path));
            let common = of_steps.len().min(of_path.len());
            assert_eq!(of_steps[..common], of_path[..common], "{steps}");
            assert!(common > 150);
            if name == "nu 0.21" {
                assert_eq!(path.outcome.termination, Termination::FullLoad);
                assert_eq!(of_steps.len(), of_path.len());
            }
            // The step in which each bond broke.
            let mut largest_factor = 0.0_f64;
            for (of_step, of_path) in run.breaks.iter().zip(&path.breaks) {
                largest_factor = largest_factor.max(of_path.load_factor);
                let history = &run.outcome.history;
                assert!(history[of_step.step].load_factor >= largest_factor);
                assert!(history[of_step.step - 1].load_factor < largest_factor);
            }
            let mut worst = [0.0_f64; 2];
            let at_rest = run.outcome.history.iter().filter(|step| step.at_rest);
            for step in at_rest.filter(|step| step.step > 0 && step.broken_bonds <= common) {
                // The event that the step waits for, on the line of the same bonds.
                let Some(event) =
                    (events.iter().skip(1)).find(|event| event.broken_bonds == step.broken_bonds)
                else {
                    continue;
                };
                assert!(event.load_factor >= step.load_factor * (1.0 - 1e-9));
                let scaled = event.reaction * step.load_factor / event.load_factor;
                worst[0] = worst[0].max(relative_error(step.reaction, scaled));
                let on_envelope = on_curve(&envelope, step.displacement);
                worst[1] = worst[1].max(relative_error(step.reaction, on_envelope));
            }
            println!(
                "{name}, {steps}: {common} bonds; line, envelope off by {}",
                short(&worst)
            );
            assert!(largest(worst) < 1e-9);
        }
    }
}

/// The mirrored square: pairs of tied bonds break in one event, in the order of their ends in the file, as they do in one round of
/// the stepped driver. Damage stays symmetric (1e-12: sums in another order).
#[test]
fn tied_bonds_break_in_one_event() {
    let (mesh, image) = meshes::mirrored(&meshes::read("tests/reference/square.msh"));
    let bench = Bench::on(&mesh, &on_the_exact_path(SQUARE), &[]);
    let run = bench.break_up();
    let damage = bench.in_file(&fields::damage(&**bench.model.plane(), &run.state().intact));
    let asymmetry = largest((0..damage.len()).map(|k| damage[k] - damage[image[k]]));
    assert!(largest(damage.iter().copied()) > 0.3 && asymmetry < 1e-12);
    let pairs = (run.outcome.history.iter()).filter(|step| step.broken_in_step == 2);
    assert!(pairs.count() > 20);
    let (numbering, ends) = (
        bench.model.body().numbering(),
        &bench.model.plane().topology().ends,
    );
    let in_file = |bond: u32| numbering.ends_in_file(ends[bond as usize]);
    let of_event = |pair: &[_]| -> bool {
        let [a, b]: [&ligament_analysis::history::BreakRecord; 2] = [&pair[0], &pair[1]];
        a.step != b.step || (in_file(a.bond) < in_file(b.bond) && a.order + 1 == b.order)
    };
    assert!(run.breaks.windows(2).all(of_event));
    let stepped = Bench::on(&mesh, SQUARE, &ONE_BY_RATIO).break_up();
    let bonds = |run: &Run| run.breaks.iter().map(|it| it.bond).collect::<Vec<u32>>();
    let common = stepped.breaks.len().min(run.breaks.len());
    assert!(common > 80);
    assert_eq!(bonds(&stepped)[..common], bonds(&run)[..common]);
}

/// Fibres between a wall and a point P, and a spring from P to the moved point D, which never breaks.
///
/// All fibres have the elongation u of P, so that they break in the order of their critical elongations e_i; with K_i
/// the stiffness of fibre i and those after it, at u = e_i: F_i = K_i e_i, D_i = e_i + F_i/k_0. A soft spring makes
/// the path snap back where D_(i+1) < D_i.
const FIBRES: [(f64, f64); 5] = [(4.0, 0.1), (3.0, 0.11), (5.0, 0.19), (1.0, 0.2), (2.0, 0.5)];
const SPRING: f64 = 2.0;

/// Displacement and force at each breakage.
fn closed_form() -> Vec<[f64; 2]> {
    let stiffness = |i: usize| FIBRES[i..].iter().map(|(k, _)| k).sum::<f64>();
    (0..FIBRES.len())
        .map(|i| {
            let (e, force) = (FIBRES[i].1, stiffness(i) * FIBRES[i].1);
            [e + force / SPRING, force]
        })
        .collect()
}

/// The truss; wall points 0 to 4 on the left, P is 5, D is 6. Numbers of the fibres are not in the order of breaking.
fn bundle(kind: ControlKind, size: f64) -> Truss {
    let order = [3, 0, 4, 2, 1];
    let mut rods: Vec<Rod> = (order.iter().enumerate())
        .map(|(wall, &fibre)| Rod {
            ends: [wall as u32, 5],
            stiffness: FIBRES[fibre].0,
            critical_elongation: FIBRES[fibre].1,
        })
        .collect();
    rods.push(Rod {
        ends: [5, 6],
        stiffness: SPRING,
        critical_elongation: f64::INFINITY,
    });
    let places = [-5.0, -4.0, -3.0, -2.0, -1.0, 0.0, 1.0];
    let mut truss = Truss::new(&places, &rods, kind, 6);
    truss.hold(&[0, 1, 2, 3, 4]);
    let boundary = &mut truss.boundary;
    for component in [Component::Y, Component::Rotation] {
        boundary.prescribe(&[6], component, 0.0).unwrap();
    }
    match kind {
        ControlKind::Displacement => boundary.prescribe(&[6], Component::X, size).unwrap(),
        ControlKind::Force => boundary.add_force(6, Component::X, size),
        ControlKind::Temperature | ControlKind::RigidBody(_) | ControlKind::FreeBody(_) => {
            panic!("not a load of the bundle")
        }
    }
    boundary.control.magnitude = size;
    truss
}

/// The bundle's path by displacement and by force is the closed form, bond for bond, and so are its energies: what a
/// breakage releases at held displacement. 1e-12: a few operations. It ends as it must: P loose from the wall carries
/// nothing, and a given force on it means collapse.
#[test]
fn a_bundle_of_fibres_snaps_back() {
    let expected = closed_form();
    let falls = (expected.windows(2)).filter(|pair| pair[1][0] < pair[0][0]);
    assert!(falls.count() >= 2, "the closed form snaps back");
    for (kind, size, end) in [
        (ControlKind::Displacement, 10.0, Termination::FellApart),
        (ControlKind::Force, 3.0, Termination::Collapsed),
    ] {
        let truss = bundle(kind, size);
        let (outcome, watch) = truss.follow(StopRules::NONE);
        assert_eq!(outcome.termination, end);
        let history = &outcome.history;
        assert_eq!(history.len(), 1 + expected.len() + 1);
        assert_eq!((history[0].displacement, history[0].reaction), (0.0, 0.0));
        let order = [1, 4, 3, 0, 2].map(|rod| truss.bond_of_rod[rod] as u32);
        let broken: Vec<u32> = watch.breaks.iter().map(|it| it.bond).collect();
        assert_eq!(broken, order);
        for (i, [displacement, force]) in expected.iter().enumerate() {
            let row = &history[i + 1];
            let error = [
                relative_error(row.displacement, *displacement),
                relative_error(row.reaction, *force),
                row.largest_ratio - 1.0,
            ];
            assert!(largest(error) < 1e-12, "{kind:?}, event {i}: {error:?}");
            let record = &watch.breaks[i];
            assert_eq!(record.displacement, row.displacement);
            assert_eq!(record.reaction, row.reaction);
            assert!((record.ratio - 1.0).abs() < 1e-12);
        }
        for row in history.iter().filter(|row| row.step > 0 && row.at_rest) {
            assert!(row.energy_error().abs() < 1e-12, "{row:?}");
        }
        // All that was put in is released or still stored.
        let last = history.last().unwrap();
        assert_eq!(last.broken_bonds, 5);
        assert!(last.released_energy > 0.1);
        if kind == ControlKind::Displacement {
            // At held D: spring and remaining fibres in series before and after, 1/2 D_i^2 (C_i - C_(i+1)).
            let in_series = |i: usize| {
                let fibres = FIBRES[i..].iter().map(|(k, _)| k).sum::<f64>();
                fibres * SPRING / (fibres + SPRING)
            };
            let released = (expected.iter().enumerate())
                .map(|(i, [d, _])| 0.5 * d * d * (in_series(i) - in_series(i + 1)))
                .sum::<f64>();
            assert!(relative_error(last.released_energy, released) < 1e-12);
            assert!(last.at_rest && last.reaction.abs() < 1e-12);
        } else {
            assert!(!last.at_rest);
        }
    }
}

/// What ends a run, on the bundle by displacement; positions on the path from the closed form.
#[test]
fn stop_rules_end_the_path_where_they_say() {
    let expected = closed_form();
    let run = |size: f64, stop: StopRules| bundle(ControlKind::Displacement, size).follow(stop).0;
    // The first line ends at D = 0.85, the second would at 0.715: it takes the third, up to 0.95, to reach 0.9.
    let wanted = 0.9;
    assert!(expected[0][0] < wanted && expected[1][0] < wanted && expected[2][0] > wanted);
    let stop = StopRules {
        displacement: Some(wanted),
        ..StopRules::NONE
    };
    let outcome = run(10.0, stop);
    let last = outcome.history.last().unwrap();
    assert_eq!(
        outcome.termination,
        Termination::DisplacementReached {
            displacement: wanted
        }
    );
    assert_eq!((last.broken_bonds, last.broken_in_step), (2, 0));
    assert!(last.at_rest && relative_error(last.displacement, wanted) < 1e-12);
    let [d, force] = expected[2];
    assert!(relative_error(last.reaction, wanted * force / d) < 1e-12);
    assert!(relative_error(last.largest_ratio, wanted / d) < 1e-12);
    // Full load at the same place.
    let outcome = run(wanted, StopRules::NONE);
    let at_full = outcome.history.last().unwrap();
    assert_eq!(outcome.termination, Termination::FullLoad);
    assert!(at_full.load_factor == 1.0 && relative_error(at_full.reaction, last.reaction) < 1e-12);
    // Before anything breaks.
    let outcome = run(0.4, StopRules::NONE);
    assert_eq!(outcome.termination, Termination::FullLoad);
    assert_eq!(
        (outcome.history.len(), outcome.state.broken_bonds()),
        (2, 0)
    );
    // A number of bonds: the state is that of the next event, which does not happen.
    let stop = StopRules {
        bonds: Some(2),
        ..StopRules::NONE
    };
    let outcome = run(10.0, stop);
    let last = outcome.history.last().unwrap();
    assert_eq!(outcome.termination, Termination::BondsBroken { bonds: 2 });
    assert_eq!((last.broken_bonds, last.broken_in_step), (2, 0));
    assert_eq!(outcome.state.broken_bonds(), 2);
    assert!(relative_error(last.reaction, expected[2][1]) < 1e-12);
    // The load: 1.5, 1.21, 1.52, 0.6, 1; below half of the peak with the fourth event.
    let stop = StopRules {
        load_fraction: Some(0.5),
        ..StopRules::NONE
    };
    let outcome = run(10.0, stop);
    let last = outcome.history.last().unwrap();
    assert_eq!(
        outcome.termination,
        Termination::LoadFraction { fraction: 0.5 }
    );
    assert_eq!(
        (last.step, last.broken_bonds, last.broken_in_step),
        (4, 3, 0)
    );
    // No time at all.
    let stop = StopRules {
        wall_time: Some(1e-9),
        ..StopRules::NONE
    };
    let outcome = run(10.0, stop);
    assert_eq!(outcome.termination, Termination::WallTime { seconds: 1e-9 });
    assert_eq!(
        (outcome.history.len(), outcome.state.broken_bonds()),
        (2, 0)
    );
    // Pushed together nothing is stretched.
    let outcome = run(-10.0, StopRules::NONE);
    assert_eq!(outcome.termination, Termination::NothingBreaks);
    assert_eq!(outcome.history.len(), 2);
    let last = outcome.history.last().unwrap();
    assert!(last.load_factor == 1.0 && last.stored_energy > 1.0);
}

/// The peaks that the summary gives. Of the bundle: loads 1.5, 1.21, 1.52, 0.6, 1 at D = 0.85, 0.715, 0.95, 0.5, 1. A test
/// whose displacement only rises follows 1.5 at 0.85, falls there to 0.85 1.52/0.95 = 1.36, rises to 1.52 at 0.95, falls
/// to 0.95 and rises to 1.
#[test]
fn a_first_peak_is_one_of_the_envelope() {
    let (outcome, _) = bundle(ControlKind::Displacement, 10.0).follow(StopRules::NONE);
    let curve: Vec<[f64; 2]> = (outcome.envelope().iter())
        .map(|point| [point.displacement, point.reaction])
        .collect();
    let expected = [
        [0.0, 0.0],
        [0.85, 1.5],
        [0.85, 1.36],
        [0.95, 1.52],
        [0.95, 0.95],
        [1.0, 1.0],
    ];
    // The stiffness in series of the closed form gives these numbers; the first point is where the body is unloaded.
    let close = |a: &[f64; 2], b: &[f64; 2]| (0..2).all(|k| (a[k] - b[k]).abs() < 1e-12);
    assert_eq!(curve.len(), expected.len(), "{curve:?}");
    assert!(
        curve.iter().zip(&expected).all(|(a, b)| close(a, b)),
        "{curve:?}"
    );
    assert!(relative_error(outcome.peak().unwrap().reaction, 1.52) < 1e-12);
    assert!(relative_error(outcome.first_peak(0.05).unwrap().reaction, 1.5) < 1e-12);
    assert!(relative_error(outcome.first_peak(0.2).unwrap().reaction, 1.52) < 1e-12);
}

/// A fibre of two equal bonds in a row: they are tied, break together, and leave the point between them loose. It keeps
/// its place to the last bit while the rest of the path goes down and up.
#[test]
fn a_loose_point_stays_where_it_is() {
    // Wall points 0, 1, 2, the point 3 in the middle of the weakest fibre, P is 4, D is 5.
    let rod = |ends: [u32; 2], stiffness: f64, critical_elongation: f64| Rod {
        ends,
        stiffness,
        critical_elongation,
    };
    let rods = [
        rod([0, 3], 8.0, 0.05),
        rod([3, 4], 8.0, 0.05),
        rod([1, 4], 2.0, 0.11),
        rod([2, 4], 3.0, 0.4),
        rod([4, 5], 2.0, f64::INFINITY),
    ];
    let mut truss = Truss::new(
        &[-4.0, -3.0, -2.0, -1.0, 0.0, 1.0],
        &rods,
        ControlKind::Displacement,
        5,
    );
    truss.hold(&[0, 1, 2]);
    for (component, value) in [
        (Component::X, 2.0),
        (Component::Y, 0.0),
        (Component::Rotation, 0.0),
    ] {
        truss.boundary.prescribe(&[5], component, value).unwrap();
    }
    truss.boundary.control.magnitude = 2.0;
    let (outcome, watch) = truss.follow(StopRules::NONE);
    // u of P at the events: 0.1 (tied pair), 0.11, 0.4; D = u + F/2.
    let expected = [[0.1 + 0.45, 0.9], [0.11 + 0.275, 0.55], [0.4 + 0.6, 1.2]];
    let history = &outcome.history;
    for (row, [d, force]) in history[1..].iter().zip(expected) {
        assert!(relative_error(row.displacement, d) < 1e-12);
        assert!(relative_error(row.reaction, force) < 1e-12);
    }
    assert_eq!((history[1].broken_in_step, history[2].broken_bonds), (2, 2));
    let place = |row: usize| watch.displacements.as_ref().unwrap()[row][9];
    assert!(relative_error(place(1), 0.05) < 1e-12);
    for row in 2..=4 {
        assert_eq!(place(row), place(1), "row {row}");
    }
    assert!(watch.largest_residual < 1e-12);
    assert_eq!(outcome.termination, Termination::FellApart);
}

/// A part that loses its hold across the load, but is loaded along x by prescribed motions at both ends: its strains stay
/// in proportion to the load, and no more than one solution a breakage is needed. A guide S, moved up as D moves right,
/// tears off first (at D = 0.2); then the fibres follow their closed form.
#[test]
fn a_part_that_may_slide_is_followed_without_solving_again() {
    // The guide 0, wall points 1 and 2 held along x only, P is 3, D is 4.
    let rod = |ends: [u32; 2], stiffness: f64, critical_elongation: f64| Rod {
        ends,
        stiffness,
        critical_elongation,
    };
    let rods = [
        rod([0, 1], 1.0, 0.2),
        rod([1, 3], 4.0, 0.1),
        rod([2, 3], 2.0, 0.15),
        rod([3, 4], 2.0, f64::INFINITY),
    ];
    let mut truss = Truss::new(
        &[-4.0, -3.0, -2.0, -1.0, 0.0],
        &rods,
        ControlKind::Displacement,
        4,
    );
    let boundary = &mut truss.boundary;
    boundary.prescribe(&[0], Component::X, -1.0).unwrap();
    boundary.prescribe(&[0], Component::Y, 0.1).unwrap();
    boundary.prescribe(&[0], Component::Rotation, 0.0).unwrap();
    boundary.prescribe(&[1, 2], Component::X, 0.0).unwrap();
    boundary.prescribe(&[4], Component::X, 1.0).unwrap();
    let (outcome, watch) = truss.follow(StopRules::NONE);
    let history = &outcome.history;
    // S tears at a factor of 0.2; u = 0.1: D = 0.1 + 6 0.1/2 = 0.4; u = 0.15: D = 0.15 + 2 0.15/2 = 0.3.
    let expected = [0.2, 0.4, 0.3];
    for (row, d) in history[1..].iter().zip(expected) {
        assert!(relative_error(row.displacement, d) < 1e-12, "{row:?}");
        assert!(row.solves <= 1, "{row:?}");
    }
    // There are no moments, so that theirs is a ratio of rounding: 1e-10 is still below what is solved for again.
    assert!(watch.largest_residual < 1e-10);
    assert!(watch.held[2] == 2, "{:?}: across, and turning", watch.held);
    // The free motion across is scaled with the rest.
    let across = |row: usize| watch.displacements.as_ref().unwrap()[row][10];
    assert!(relative_error(across(1), 0.02) < 1e-12);
    assert!(relative_error(across(2), 0.04) < 1e-12);
    assert_eq!(outcome.termination, Termination::FellApart);
}

/// Along the whole path of two specimens, which snaps back hundreds of times, and by force: external work = stored +
/// released energy (1e-9 of the work: all three are exact), every state is an equilibrium, and each event takes one
/// solution.
#[test]
fn energies_balance_along_the_path() {
    let by_force = SQUARE.replace("displacement = { y = 5e-5 }", "force = { y = 1e6 }");
    for (name, text, settings) in [
        ("pressed", DISK, vec![COARSE]),
        ("pulled", SQUARE, vec![]),
        ("loaded", by_force.as_str(), vec![]),
        (
            "indefinite",
            DISK,
            vec![
                COARSE,
                "material.poisson=0.38",
                "model.poisson=bonds",
                "fracture.stop.bonds=200",
            ],
        ),
    ] {
        let run = Bench::new(&on_the_exact_path(text), &settings).break_up();
        let history = &run.outcome.history;
        let at_rest = || history.iter().filter(|step| step.at_rest);
        let work = largest(at_rest().map(|step| step.external_work));
        let error = largest(
            at_rest().map(|step| step.external_work - step.stored_energy - step.released_energy),
        ) / work;
        let backwards = (history.windows(2))
            .filter(|pair| pair[1].load_factor < pair[0].load_factor)
            .count();
        println!(
            "{name}: {} bonds, {backwards} of {} events backwards, balance off by {error:.1e}, {}",
            run.breaks.len(),
            history.len(),
            run.outcome.termination
        );
        assert!(error < 1e-9 && run.largest_residual < 1e-9);
        assert!(run.breaks.len() > 50 && backwards > 20);
        let released = largest(at_rest().map(|step| step.released_energy));
        assert!(released > 1e-3 * work, "{released:e} of {work:e}");
        // The way to the next event needs no solution, a breakage needs one; a body that barely hangs together, or an
        // indefinite one, may need a refinement.
        let refinements = at_rest().filter(|step| step.solves > 1).count();
        assert!(at_rest().all(|step| step.solves <= 2));
        assert!(refinements == 0 || !matches!(name, "pressed" | "pulled"));
        for pair in run.breaks.windows(2) {
            assert_eq!(pair[0].order + 1, pair[1].order);
        }
    }
}

/// `breaks.csv` has the load and displacement of each breakage in both drivers; the fields of the exact path, on which the
/// load goes back, are numbered by the event.
#[test]
fn files_of_both_drivers() {
    let folder = TempDir::new().unwrap();
    for (name, text) in [
        ("exact", on_the_exact_path(SQUARE)),
        ("stepped", SQUARE.to_owned()),
    ] {
        let out = folder.path().join(name);
        let case = bench::case(&text, &["output.fields_every=30"]);
        let summary = bench::run_program(&case, &out);
        let breaks = Table::read(&out.join("breaks.csv"));
        let history = Table::read(&out.join("history.csv"));
        assert_eq!(breaks.len(), summary.broken_bonds);
        assert!(breaks.len() > 80);
        for row in 0..breaks.len() {
            let factor = breaks.number(row, "load_factor");
            let displacement = breaks.number(row, "displacement");
            assert!(relative_error(displacement, 5e-5 * factor) < 1e-12);
            let step = breaks.count(row, "step");
            let of_step = history.number(step, "reaction");
            let reaction = breaks.number(row, "reaction");
            if name == "exact" {
                assert_eq!(reaction, of_step);
            } else {
                // Before the breakage the body was stiffer than at the end of the step.
                assert!(reaction > of_step);
            }
        }
        let files = std::fs::read_dir(&out).unwrap();
        let fields = files.filter(|entry| {
            let name = entry.as_ref().unwrap().file_name().into_string().unwrap();
            name.starts_with("fields_") && name.ends_with(".vtu")
        });
        if name == "exact" {
            let last = history.len() - 1;
            assert_eq!(
                fields.count(),
                last / 30 + 1 + usize::from(!last.is_multiple_of(30))
            );
            let collection = std::fs::read_to_string(out.join("fields.pvd")).unwrap();
            assert!(collection.contains("timestep=\"60.0\""), "{collection}");
        }
    }
}
