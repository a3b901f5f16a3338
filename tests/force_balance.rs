//! Nothing but bonds, supports and loads carries a force: what no bond resists is held, and a hold that would carry a load ends
//! the run.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament_analysis::driver::{self, Outcome, Rows};
use ligament_analysis::{Component, ControlKind, Termination};
use verification::bench::{Bench, Watch, solved};
use verification::numbers::relative_error;
use verification::trusses::{Rod, Truss};

/// A strip of 10 x 5 cells, held on its left side.
const STRIP: &str = r#"
lattice = { cells = [10, 5], spacing = 0.01, thickness = 0.01, set = { left = { left = 1 }, right = { right = 1 } } }
material = { young = 15e9, poisson = 0.3333, fracture_energy = 10.0 }
model = { law = "bbpd", horizon_factor = 2.0 }
support = [{ group = "left", displacement = { x = 0.0, y = 0.0 } }]
"#;

const CRITERION: &str = "[[fracture.criterion]]\nkind = \"critical-stretch\"\n";

/// The strip under a force along x, N, or a displacement, m, followed as the settings of `fracture` say.
fn pulled(load: &str, fracture: &str) -> Outcome {
    let load = format!("load = [{{ group = \"right\", {load} }}]\n");
    let text = format!("{STRIP}{load}[fracture]\n{fracture}\n{CRITERION}");
    Bench::new(&text, &[]).break_up().outcome
}

/// Points of the right side lose all bonds along x one after the other while the side is pulled with a given force: the first
/// that does takes its load with it, and the strip carries no more than what broke it. The exact path knows that load;
/// load steps find it to within a step.
#[test]
fn a_loaded_point_without_stiffness_ends_the_run() {
    let strength = {
        let exact = pulled("force = { x = 1e6 }", "control = \"event\"");
        let end = &exact.termination;
        assert!(matches!(end, Termination::LostStiffness { .. }), "{end}");
        assert_eq!(end.name(), "collapsed");
        assert_eq!(exact.rows, Rows::Events);
        exact.peak().unwrap().reaction
    };
    let by_displacement = pulled("displacement = { x = 1e-4 }", "steps = 400");
    let even = by_displacement.peak().unwrap().reaction;
    println!("{strength:.1} N by force, {even:.1} N where the side stays straight");
    // Points that may lag behind carry less than a side that is kept straight.
    assert!(strength < even && strength > 0.8 * even);
    for steps in [10, 20, 40, 50, 80, 100, 160, 200] {
        let stepped = pulled("force = { x = 4e3 }", &format!("steps = {steps}"));
        let peak = stepped.peak().unwrap().reaction;
        let step = 4e3 / f64::from(steps);
        let end = &stepped.termination;
        println!("{steps} steps: {peak:.1} N; {end}");
        assert_eq!(end.name(), "collapsed", "{steps} steps: {end}");
        assert!(peak <= strength && strength <= peak + step, "{steps} steps");
    }
}

/// Two points joined a quadrillion times more stiffly than all others, of which the wall holds one: two soft rods are in series
/// between them and the moved end, which a force of half a rod's moves. The rounding of the stiff rod says nothing about the
/// others, so that the state before any solution is no equilibrium.
#[test]
fn a_stiff_pair_of_points_does_not_hide_what_is_missing_elsewhere() {
    let rod = |ends: [u32; 2], stiffness: f64| Rod {
        ends,
        stiffness,
        critical_elongation: f64::INFINITY,
    };
    let rods = [rod([0, 1], 1e16), rod([1, 2], 1.0), rod([2, 3], 1.0)];
    let mut truss = Truss::new(&[0.0, 1.0, 2.0, 3.0], &rods, ControlKind::Displacement, 3);
    truss.hold(&[0]);
    let moved = &mut truss.boundary;
    moved.prescribe(&[3], Component::X, 1.0).unwrap();
    let mut watch = Watch::default();
    let outcome = driver::elastic::run(&truss.problem(), 1e-4, &mut watch).unwrap();
    let last = outcome.history.last().unwrap();
    println!("{} N, {} solves", last.reaction, last.solves);
    // 1e-9: forces are judged to 1e-10 of the largest at a point.
    assert!(relative_error(last.reaction, 0.5) < 1e-9, "{last:?}");
}

/// Supports that have corners in common, by the components they prescribe, by springs, or by both: the forces of all groups on the body are in
/// balance (to 1e-9 of the load), since no reaction counts twice, and a support that prescribes one component has no force along another.
#[test]
fn supports_with_common_points_count_each_reaction_once() {
    let plate = |supports: &str| {
        let text = format!(
            r#"
lattice = {{ cells = [10, 6], spacing = 0.01, corner = [0.0, 0.0], thickness = 0.01, set = {{ left = {{ left = 1 }}, bottom = {{ bottom = 1 }}, right = {{ right = 1 }} }} }}
material = {{ young = 15e9, poisson = 0.3 }}
model = {{ law = "bbpd", horizon_factor = 3.0 }}
support = [{supports}]
load = [{{ group = "right", force = {{ x = 1e3, y = -5e2 }} }}]
"#
        );
        let outcome = solved(&text, &[]).outcome;
        outcome.history.last().unwrap().group_forces.clone()
    };
    let rollers = plate(
        r#"{ group = "left", displacement = { x = 0.0 } }, { group = "bottom", displacement = { y = 0.0 } }"#,
    );
    assert!(rollers[0][1] == 0.0 && rollers[1][0] == 0.0);
    // The forces of points add up to the load by rounding.
    assert!((rollers[2][0] - 1e3).abs() < 1e-9 && (rollers[2][1] + 5e2).abs() < 1e-9);
    let fixed = plate(
        r#"{ group = "left", displacement = { x = 0.0, y = 0.0 } }, { group = "bottom", displacement = { x = 0.0, y = 0.0 } }"#,
    );
    let springs = plate(
        r#"{ group = "left", stiffness = { x = 1e8 } }, { group = "bottom", stiffness = { y = 1e8 } }"#,
    );
    for forces in [rollers, fixed, springs] {
        for axis in 0..2 {
            let sum: f64 = forces.iter().map(|it| it[axis]).sum();
            assert!(sum.abs() < 1e-6, "{forces:?}");
        }
    }
}
