//! Contact between surfaces and with rigid bodies along the exact path, against statics, closed forms and load steps.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament_analysis::driver::Outcome;
use ligament_analysis::history::Termination;
use verification::bench::{Bench, Run, missing_energy, solved};

/// A column of 6 x 12 cells of 1 mm that its top presses down by 0.1 mm on a rigid floor.
const COLUMN: &str = r#"
lattice = { cells = [6, 12], spacing = 0.001, corner = [0.0, 0.0], thickness = 0.01, set = { top = { top = 1 } } }
material = { young = 15e9, poisson = 0.2, compressive_strength = 40e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "top", displacement = { x = 0.0 } }]
load = [{ group = "top", displacement = { y = -1e-4 } }]
fracture = { control = "event", stop = { bonds = 1 }, criterion = [{ kind = "compression" }] }
"#;

fn floor(y: f64) -> String {
    format!(
        r#"rigid=[{{ name = "floor", shape = "wall", centre = [0.0, {y:?}], normal = [0.0, 1.0] }}]"#
    )
}

/// A column that first falls through a gap breaks under the same force, and its load factor is larger by the gap over the way of the top, to
/// the rounding of the solution (1e-9). The floor is met at once along its whole width, without a force, at the load factor of the gap.
#[test]
fn a_gap_postpones_the_breakage_by_itself() {
    let gap = 2e-5;
    let [touching, apart] = [0.0, -gap].map(|y| solved(COLUMN, &[&floor(y)]).outcome);
    let broke = |outcome: &Outcome| {
        let mut rows = outcome.history.iter().filter(|it| it.broken_in_step > 0);
        let row = rows.next().unwrap();
        (row.load_factor, row.reaction)
    };
    let ((one, force), (other, later)) = (broke(&touching), broke(&apart));
    println!("breaks at {one:.6} and {other:.6} under {force:.6e} and {later:.6e} N");
    assert!(one > 0.01 && other < 1.0);
    assert!(((other - one) * 1e-4 / gap - 1.0).abs() < 1e-9);
    assert!((later / force - 1.0).abs() < 1e-9);
    let met = &apart.history[1];
    assert!(
        (met.load_factor * 1e-4 / gap - 1.0).abs() < 1e-9,
        "{}",
        met.load_factor
    );
    assert_eq!((apart.history.len(), met.broken_in_step), (4, 0));
    assert!(met.reaction.abs() < 1e-9 * force);
    assert!(missing_energy(&apart) < 1e-9);
}

/// A stiff block on a soft floor, under a force at 8 mm from its middle axis, 10 mm from the edges: a linear pressure that balances the force
/// reaches over three times the distance of the force from the edge, 6 mm, to half a facet at either end; elsewhere the block lifts off. The
/// largest pressure is 2 P/(c t), to the 1 % that the block bends (measured 0.03 %).
#[test]
fn a_block_under_an_eccentric_force_lifts_off() {
    const BLOCK: &str = r#"
lattice = { cells = [20, 10], spacing = 0.001, corner = [0.0, 0.0], thickness = 0.01, set = { bottom = { bottom = 1 }, edge = { right = 4 } } }
material = { young = 15e9, poisson = 0.0, tensile_strength = 1e9 }
model = { law = "nhpd", horizon_factor = 3.0 }
rigid = [{ name = "floor", shape = "wall", centre = [0.0, 0.0], normal = [0.0, 1.0], stiffness = 1e-4 }]
support = [{ group = "bottom", displacement = { x = 0.0 } }]
load = [{ group = "edge", force = { y = -1e3 } }]
fracture = { control = "event", criterion = [{ kind = "tension" }] }
"#;
    let outcome = solved(BLOCK, &[]).outcome;
    assert_eq!(outcome.termination, Termination::FullLoad);
    let floor = &outcome.history.last().unwrap().contacts[0];
    let all = outcome.state.surfaces.touching().touches();
    let pressures = all
        .filter(|it| it.depth() > 0.0)
        .map(|it| it.stiffness * it.depth() / it.area);
    let largest = pressures.fold(0.0, f64::max);
    let width = floor.area / 0.01;
    println!(
        "{width:.4e} m press, at most {largest:.4e} Pa, {:.9e} N",
        floor.normal_force[1]
    );
    // What holds the free block until the floor does may keep 1e-6 of the force, as in load steps; so soft a floor leaves 7e-8.
    assert!((floor.normal_force[1] / 1e3 - 1.0).abs() < 1e-6);
    assert!((width - 6e-3).abs() < 0.51e-3);
    // The outer integration point is 0.21 facets from the edge.
    let expected = 2.0 * 1e3 / (6e-3 * 0.01) * (1.0 - 0.21 / 6.0);
    assert!((largest / expected - 1.0).abs() < 0.01, "{expected}");
}

/// A circle of 0.1 m that is driven into a block.
pub(crate) const CIRCLE: &str = r#"
lattice = { cells = [40, 16], spacing = 0.001, corner = [-0.02, 0.0], thickness = 0.01, set = { bottom = { bottom = 1 } } }
material = { young = 70e9, poisson = 0.25 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
rigid = [{ name = "punch", shape = "circle", centre = [0.0003, 0.116], radius = 0.1, displacement = { y = -2e-4 } }]
fracture = { control = "event", criterion = [{ kind = "compression", limit = 7e-3 }] }
"#;

/// A sphere of 0.1 m that is driven into a solid block.
const SPHERE: &str = r#"
solid_lattice = { cells = [10, 10, 5], spacing = [0.001, 0.001, 0.001], corner = [-0.005, -0.005, 0.0], set = { bottom = { bottom = 1 } } }
material = { young = 70e9, poisson = 0.25 }
model = { law = "bbpd", horizon_factor = 2.5 }
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0, z = 0.0 } }]
rigid = [{ name = "punch", shape = "sphere", centre = [0.0003, 0.0001, 0.105], radius = 0.1, displacement = { z = -2e-4 } }]
fracture = { control = "event", criterion = [{ kind = "compression", limit = 1e-2 }] }
"#;

/// Two blocks, one of which leans on the other over a gap that closes from one side.
const BLOCKS: &str = r#"
lattice = { cells = [16, 17], spacing = 0.001, corner = [0.0, 0.0], thickness = 0.01, set = { bottom = { bottom = 1 }, top = { top = 1 } }, remove = [{ rectangle = [[-1.0, 0.008], [1.0, 0.009]] }] }
material = { young = 15e9, poisson = 0.2 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
contact = [{}]
load = [{ group = "top", displacement = { x = 2e-5, y = -1.02e-3 } }]
fracture = { control = "event", criterion = [{ kind = "compression", limit = 1e-3 }] }
"#;

/// The path up to its first breakages.
fn followed(text: &str, bonds: usize) -> Run {
    let stop = format!("fracture.stop.bonds={bonds}");
    Bench::new(text, &[&stop]).break_up()
}

/// Contacts close one after the other, each in a row of its own at a larger load factor; the first bond then breaks in load steps within
/// 0.2 % of its load factor on the path, between the blocks 0.01 %. Load steps have the contact in present positions, which here differs by strains of
/// some 1e-3. No row is beyond a limit, forces balance to 1e-9 and the ledger closes to 1e-9 with contacts that open and close.
#[test]
fn load_steps_break_the_same_bonds() {
    for (name, text, changes, within) in [
        ("circle", CIRCLE, 8, 2e-3),
        ("sphere", SPHERE, 3, 2e-3),
        ("blocks", BLOCKS, 1, 1e-4),
    ] {
        let run = followed(text, 12);
        let rows = &run.outcome.history;
        let first = rows.iter().position(|it| it.broken_in_step > 0).unwrap();
        let (at, bond) = (rows[first].load_factor, run.breaks[0].bond);
        println!(
            "{name}: {first} rows before the first breakage at {at:.6}, {} rows, {}, residual {:.1e}, energies miss {:.1e}",
            rows.len(),
            run.outcome.termination,
            run.largest_residual,
            missing_energy(&run.outcome)
        );
        assert!(first > changes, "{first}");
        let before = rows[..=first].windows(2);
        assert!(
            before
                .clone()
                .all(|it| it[0].load_factor <= it[1].load_factor)
        );
        assert!(rows.iter().all(|it| it.largest_ratio < 1.0 + 1e-8));
        // Without loads the curve is that of the rigid body, to the rounding of a sum over its axes.
        for row in rows {
            for body in &row.rigid_bodies {
                let way = body.displacement.iter().map(|it| it.abs()).sum::<f64>();
                assert!((row.displacement - way).abs() <= 1e-15 * way);
                let places = body.displacement.iter().zip(body.force);
                let against: f64 = places.filter(|it| *it.0 != 0.0).map(|it| it.1).sum();
                assert!((row.reaction - against).abs() <= 1e-12 * row.reaction);
            }
        }
        assert!(run.largest_residual < 1e-9);
        assert!(missing_energy(&run.outcome) < 1e-9);
        let steps = format!(
            "fracture={{ steps = [{:?}, {:?}], bonds_per_iteration = 1, stop = {{ bonds = 1 }}, criterion = [{{ kind = \"compression\", limit = {} }}] }}",
            at * (1.0 - within),
            at * (1.0 + within),
            text.split("limit = ")
                .nth(1)
                .unwrap()
                .split(' ')
                .next()
                .unwrap(),
        );
        let stepped = Bench::new(text, &[&steps]).break_up();
        assert_eq!(stepped.outcome.history[1].broken_bonds, 0, "{name}");
        let broken: Vec<u32> = stepped.breaks.iter().map(|it| it.bond).collect();
        // Between the blocks many bonds are near their limits together.
        let is_one = name == "blocks" || broken.contains(&bond);
        assert!(!broken.is_empty() && is_one, "{name}: {bond} {broken:?}");
    }
}

/// The way of a rigid body that moves ends the path where it is to end, between two events, to the rounding of an interpolation.
#[test]
fn the_path_ends_at_the_way_of_a_rigid_body() {
    let settings = ["fracture.stop.displacement=5e-5", "curve=punch"];
    let outcome = solved(CIRCLE, &settings).outcome;
    let reached = Termination::DisplacementReached { displacement: 5e-5 };
    assert_eq!(outcome.termination, reached);
    let last = outcome.history.last().unwrap();
    assert!((last.displacement / 5e-5 - 1.0).abs() < 1e-12);
    assert!(last.reaction > 0.0);
}
