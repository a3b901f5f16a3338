//! Contacts in load steps that begin with the rounding of a gap, and surfaces that a step moves through each other.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::collections::BTreeMap;

use ligament_analysis::Unbalanced;
use ligament_analysis::driver::Outcome;
use ligament_analysis::history::Termination;
use verification::bench::solved;

/// A plate of 8 x 4 cells, 1 m long times a size, held at one end, with the axis that leads to its other end (0 or 1) and the sign along it.
fn plate(size: f64, axis: usize, sign: f64) -> String {
    let mut cells = [4, 4];
    cells[axis] = 8;
    let mut corner = [0.0; 2];
    corner[axis] = size * (0.5 * sign - 0.5);
    let held = [["right", "left"], ["top", "bottom"]][axis][usize::from(sign > 0.0)];
    format!(
        r#"
lattice = {{ cells = {cells:?}, spacing = {:?}, corner = {corner:?}, thickness = {:?}, set = {{ held = {{ {held} = 1 }} }} }}
material = {{ young = 1e10, poisson = 0.2 }}
model = {{ law = "nhpd", horizon_factor = 3.0 }}
support = [{{ group = "held", displacement = {{ x = 0.0, y = 0.0 }} }}]
"#,
        size / 8.0,
        0.01 * size
    )
}

/// A wall or a box before the free end of a plate, at a gap of k of n parts of its way in n load steps.
fn before_it(size: f64, (axis, sign): (usize, f64), is_wall: bool, [k, n]: [u32; 2]) -> String {
    let way = 1e-3 * size;
    let face = sign * (size + way * f64::from(k) / f64::from(n));
    let mut centre = [0.25 * size; 2];
    centre[axis] = face + if is_wall { 0.0 } else { 0.2 * sign * size };
    let mut normal = [0.0; 2];
    normal[axis] = -sign;
    let shape = match is_wall {
        true => format!(r#"shape = "wall", normal = {normal:?}"#),
        false => format!(r#"shape = "box", size = [{0:?}, {0:?}]"#, 0.4 * size),
    };
    let along = ["x", "y"][axis];
    format!(
        r#"
rigid = [{{ name = "r", {shape}, centre = {centre:?}, displacement = {{ {along} = {:?} }} }}]
fracture = {{ steps = {n}, criterion = [{{ kind = "tension", limit = 1.0 }}] }}
"#,
        -sign * way
    )
}

/// Gaps as people write them: in one of the steps the gap is zero to the rounding of its coordinates.
const GAPS: [(u32, &[u32]); 4] = [
    (5, &[1, 2, 3, 4]),
    (7, &[1, 2, 3, 4, 5, 6]),
    (10, &[1, 3, 5, 7, 8, 9]),
    (20, &[3, 7, 9, 11, 13, 15, 17, 19]),
];

/// In plates of 1 mm, 1 cm, 1 m and 1 km, and of 1 m in four directions, all 48 combinations of shape, gap and steps go through, with a few solves a
/// step and balanced energies. The contact is linear beyond the gap (all integration points of the end meet at once), so that the stiffness, over that of the size, is
/// one number for each shape, to the rounding of a gap of 5 % of a way of 1e-3 of the size, 1e-15/5e-5 = 2e-11.
#[test]
fn a_contact_that_just_touches_is_in_equilibrium() {
    let mut stiffness: BTreeMap<bool, [f64; 2]> = BTreeMap::new();
    let twins = [(1.0, 0, 1.0), (1.0, 0, -1.0), (1.0, 1, 1.0), (1.0, 1, -1.0)];
    let scaled = [1e-3, 1e-2, 1e3].map(|size| (size, 0, 1.0));
    for (size, axis, sign) in twins.into_iter().chain(scaled) {
        for (is_wall, (n, gaps)) in [true, false]
            .iter()
            .flat_map(|it| GAPS.map(|gap| (*it, gap)))
        {
            for &k in gaps {
                let text =
                    plate(size, axis, sign) + &before_it(size, (axis, sign), is_wall, [k, n]);
                let outcome = solved(&text, &[]).outcome;
                let name =
                    format!("{k} of {n}, wall {is_wall}, {size} m, axis {axis}, sign {sign}");
                assert_eq!(outcome.termination, Termination::StepsDone, "{name}");
                for row in &outcome.history {
                    assert!(row.solves < 20, "{name}: {} solves", row.solves);
                    assert!(row.energy_error().abs() < 1e-6, "{name}: {row:?}");
                }
                let last = outcome.history.last().unwrap();
                let way = 1e-3 * size * f64::from(n - k) / f64::from(n);
                let found = last.reaction / way / size;
                let [low, high] = stiffness.entry(is_wall).or_insert([found; 2]);
                (*low, *high) = (low.min(found), high.max(found));
            }
        }
    }
    println!("{stiffness:?}");
    for [low, high] in stiffness.into_values() {
        assert!(low > 0.0 && high / low - 1.0 < 1e-10, "{low} {high}");
    }
}

/// What a run missed: the name of the contact, and the way over that in a step that is seen.
fn missed(outcome: &Outcome) -> (String, f64) {
    match &outcome.termination {
        Termination::NoEquilibrium {
            reason: Unbalanced::Missed { contact, missed },
            ..
        } => (contact.clone(), missed.way / missed.seen),
        other => panic!("{other}"),
    }
}

/// A plate of 1 m in space, 0.125 m thick.
const SOLID: &str = r#"
solid_lattice = { cells = [8, 4, 2], spacing = [0.125, 0.125, 0.125], corner = [0.0, 0.0, 0.0], set = { held = { left = 1 } } }
material = { young = 1e10, poisson = 0.25, density = 2500.0 }
model = { law = "bbpd", horizon_factor = 2.5 }
support = [{ group = "held", displacement = { x = 0.0, y = 0.0, z = 0.0 } }]
"#;

/// A rigid body that a step moves into a body, through it, or over its corner is named, with at least as many steps as take it a facet or the
/// half of its own half-width each. With a step that leads beside the body it goes by.
#[test]
fn a_rigid_body_that_jumps_is_named() {
    let circle = |y: f64, radius: f64, way: f64| {
        let centre = [1.3, y];
        format!(
            r#"rigid = [{{ name = "r", shape = "circle", centre = {centre:?}, radius = {radius:?}, displacement = {{ x = {way:?} }} }}]"#
        )
    };
    let block = r#"rigid = [{ name = "r", shape = "box", centre = [1.3, 0.25], size = [0.2, 0.2], displacement = { x = -0.8 } }]"#;
    let plate = plate(1.0, 0, 1.0);
    for (name, rigid) in [
        ("into", circle(0.25, 0.1, -0.8)),
        ("through", circle(0.25, 0.1, -2.6)),
        ("over a corner", circle(0.55, 0.2, -2.6)),
        ("smaller than a facet", circle(0.25, 0.02, -0.8)),
        ("box", block.to_owned()),
    ] {
        for steps in [
            "",
            "fracture = { steps = 1, criterion = [{ kind = \"tension\", limit = 10.0 }] }",
        ] {
            let outcome = solved(&format!("{plate}{rigid}\n{steps}"), &[]).outcome;
            let (contact, times) = missed(&outcome);
            println!("{name}: {times:.1} times as many steps");
            assert_eq!(
                (contact.as_str(), outcome.history.len()),
                ("r", 1),
                "{name}"
            );
            assert!(times > 5.0);
        }
    }
    let beside = solved(&format!("{plate}{}", circle(0.7, 0.1, -2.6)), &[]).outcome;
    assert_eq!(beside.termination, Termination::StepsDone);
    for (way, name) in [(-0.8, "into"), (-2.6, "through")] {
        let sphere = format!(
            r#"rigid = [{{ name = "r", shape = "sphere", centre = [1.3, 0.25, 0.125], radius = 0.1, displacement = {{ x = {way:?} }} }}]"#
        );
        assert_eq!(
            missed(&solved(&format!("{SOLID}{sphere}"), &[]).outcome).0,
            "r",
            "{name}"
        );
    }
}

/// In steps of less than a facet the circle meets the plate, also where the way in one step would end inside.
#[test]
fn a_rigid_body_in_small_steps_meets_the_body() {
    let rigid = r#"
rigid = [{ name = "r", shape = "circle", centre = [1.3, 0.25], radius = 0.1, displacement = { x = -0.25 } }]
fracture = { steps = 10, criterion = [{ kind = "tension", limit = 10.0 }] }
"#;
    let outcome = solved(&(plate(1.0, 0, 1.0) + rigid), &[]).outcome;
    assert_eq!(outcome.termination, Termination::StepsDone);
    let reactions: Vec<f64> = outcome.history.iter().map(|it| it.reaction).collect();
    // The gap of 0.2 m is 8 of the steps.
    assert!(reactions[7] == 0.0 && reactions[9] > 0.0, "{reactions:?}");
    assert!(reactions[9..].is_sorted(), "{reactions:?}");
}

/// Two blocks of 8 x 8 cells of 10 mm with a gap of one cell, the lower one held, the upper one moved as a whole.
const BLOCKS: &str = r#"
lattice = { cells = [8, 17], spacing = 0.01, corner = [0.0, 0.0], thickness = 0.01, set = { bottom = { bottom = 1 }, moved = { top = 8 } }, remove = [{ rectangle = [[-1.0, 0.08], [1.0, 0.09]] }] }
material = { young = 15e9, poisson = 0.2, density = 2500.0 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
contact = [{}]
"#;

/// A block that a step moves into another one by several facets, or through it, is named; one that moves as far beside it, or away, is not, and
/// one that ends half a facet deep is seen.
#[test]
fn a_part_that_jumps_through_another_is_named() {
    let moved = |x: f64, y: f64| {
        let load =
            format!(r#"load = [{{ group = "moved", displacement = {{ x = {x:?}, y = {y:?} }} }}]"#);
        solved(&format!("{BLOCKS}{load}"), &[]).outcome
    };
    for way in [-0.05, -0.2] {
        let (contact, times) = missed(&moved(0.0, way));
        assert_eq!(contact, "parts");
        assert!((times - way.abs() / 0.01).abs() < 0.1, "{times}");
    }
    for (x, y) in [(0.0, 0.2), (0.2, -0.005)] {
        let outcome = moved(x, y);
        assert_eq!(outcome.termination, Termination::StepsDone);
        assert_eq!(outcome.history.last().unwrap().contacts[0].pressing, 0.0);
    }
    let seen = moved(0.0, -0.015);
    assert_eq!(seen.termination, Termination::StepsDone);
    assert!(seen.history.last().unwrap().contacts[0].pressing > 0.0);
}

/// An explicit motion ends where a rigid body moves through the body in a time step.
#[test]
fn a_rigid_body_that_is_too_fast_for_the_time_step_is_named() {
    let plate = plate(1.0, 0, 1.0).replace("poisson = 0.2", "poisson = 0.2, density = 2500.0");
    // Rows are 1.5 us apart, less than the critical step, so that the circle moves by 0.15 m in each time step.
    let motion = r#"
rigid = [{ name = "r", shape = "circle", centre = [1.3, 0.25], radius = 0.1, velocity = { x = -1e5 } }]
motion = { duration = 6e-6, rows = 4 }
"#;
    let outcome = solved(&(plate + motion), &[]).outcome;
    println!("{}", outcome.termination);
    let (contact, times) = missed(&outcome);
    assert!(contact == "r" && times > 1.0, "{contact} {times}");
}

/// Without `between` the first part is that with the smallest number of a node or cell: the columns have the force on it. On a lattice the
/// lower block comes first, which the upper one presses down.
#[test]
fn the_first_part_has_the_smallest_number() {
    let press = r#"load = [{ group = "moved", displacement = { x = 0.0, y = -0.011 } }]"#;
    let outcome = solved(&format!("{BLOCKS}{press}"), &[]).outcome;
    let last = outcome.history.last().unwrap();
    let force = last.contacts[0].force(1);
    assert!(force < 0.0);
    // The bottom carries it.
    assert!((last.group_forces[0][1] / -force - 1.0).abs() < 1e-8);
}
