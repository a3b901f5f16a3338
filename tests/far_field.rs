//! A far field of linear finite elements beside bonds: against the closed forms of uniform and linear strains, and against the body whose cells
//! all have bonds.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use ligament::patch_test::patch_test;
use ligament_analysis::driver::Outcome;
use verification::bench::{Bench, Run, missing_energy};

/// Square of 100 mm and 568 points.
const SQUARE: &str = r#"
mesh = { file = "../meshes/square-delaunay.msh" }
material = { young = 30e9, poisson = 0.2, tensile_strength = 3e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
correction = { surface = "patch" }
support = [{ group = "left", displacement = { x = 0.0 } }, { group = "corner", displacement = { y = 0.0 } }]
load = [{ group = "right", displacement = { x = 1e-5 }, profile = { along = "y", zero = 0.05, one = 0.1 } }]
"#;

/// Cube of 60 mm and 357 points.
const CUBE: &str = r#"
mesh = { file = "../meshes/solids/cube.msh" }
material = { young = 30e9, poisson = 0.2 }
model = { law = "nhpd", horizon_factor = 3.0 }
correction = { surface = "patch" }
support = [{ group = "left", displacement = { x = 0.0 } }]
load = [{ group = "right", displacement = { x = 1e-6 } }]
"#;

/// Bonds in the lower left part of the square, and in half of the cube.
const PART_OF_SQUARE: &str = "far_field.near=[{ box = [[-1, -1], [0.06, 0.07]] }]";
const HALF_OF_CUBE: &str = "far_field.near=[{ box = [[-1, -1, -1], [0.04, 1, 1]] }]";

/// A body under uniform tractions has the constants of its material, and its bonds have one strain, as far as the patch correction goes: bonds
/// and elements bear the same forces at their border.
#[test]
fn a_uniform_strain_passes_from_bonds_to_elements() {
    for (text, near, law) in [
        (SQUARE, PART_OF_SQUARE, "model.law=nhpd"),
        (SQUARE, PART_OF_SQUARE, "model.law=pds"),
        (CUBE, HALF_OF_CUBE, "model.law=nhpd"),
    ] {
        let bench = Bench::new(text, &[near, law]);
        let far_points = bench.model.counts.far_points;
        assert!(far_points > bench.points() / 5, "{far_points}");
        let test = patch_test(&bench.model).unwrap();
        let constants = test.constants.unwrap();
        let young = constants.body.young.iter().zip(constants.material.young);
        for (body, material) in young.filter(|(_, material)| *material > 0.0) {
            // The whole square with bonds alone has 3e-4.
            assert!((body / material - 1.0).abs() < 3e-4, "{constants:?}");
        }
        // Of the patch correction, which leaves 3e-3 of a bar.
        let scatter = test.scatter.iter().copied().fold(0.0, f64::max);
        assert!(scatter < 3e-3, "{text}{law} {scatter:e}");
    }
}

/// In pure bending u_x = kappa x y the energy is E I kappa^2 L/2, of which linear elements and bonds have a little more.
#[test]
fn a_linear_strain_passes_to_one_per_cent() {
    let energy =
        |settings: &[&str]| Bench::new(SQUARE, settings).solve().outcome.history[0].stored_energy;
    let (young, side, curvature) = (30e9, 0.1_f64, 1e-5 / 0.05 / 0.1);
    let exact = 0.5 * young * side.powi(3) / 12.0 * curvature * curvature * side;
    let [bonds, part] = [&[][..], &[PART_OF_SQUARE]].map(energy);
    assert!((part / exact - 1.0).abs() < 0.02, "{part} {exact}");
    assert!((part / bonds - 1.0).abs() < 0.01, "{part} {bonds}");
}

/// The forces of elements and bonds at the border are inner forces: supports and loads balance, and the work is stored.
#[test]
fn forces_across_the_border_balance() {
    for (text, near) in [(SQUARE, PART_OF_SQUARE), (CUBE, HALF_OF_CUBE)] {
        for method in ["direct", "iterative"] {
            let bench = Bench::new(text, &[near, &format!("solver.method={method}")]);
            let run = bench.solve();
            let record = &run.outcome.history[0];
            // Residual of an elastic solution.
            assert!(run.largest_residual < 1e-9, "{:e}", run.largest_residual);
            let missing = record.external_work - record.stored_energy;
            assert!(missing.abs() < 1e-8 * record.stored_energy, "{missing:e}");
        }
    }
}

/// Notched beam in three-point bending, with bonds in the middle half of its length.
fn beam(settings: &[&str]) -> Run {
    let text =
        std::fs::read_to_string(verification::repository().join("cases/petersson-beam/case.toml"));
    let text = text.unwrap().replace("../../meshes", "../meshes");
    Bench::new(&text, settings).break_up()
}

const MIDDLE: &str = "far_field.near=[{ box = [[-0.4, -1.0], [0.4, 1.0]] }]";

fn peak(outcome: &Outcome) -> f64 {
    let reactions = outcome.history.iter().map(|it| it.reaction.abs());
    reactions.fold(0.0, f64::max)
}

/// The crack is that of the body with bonds everywhere, and the load within half a per cent.
#[test]
fn the_crack_is_that_of_the_whole_body() {
    let [whole, part] = [&[][..], &[MIDDLE]].map(beam);
    let difference = peak(&part.outcome) / peak(&whole.outcome) - 1.0;
    assert!(difference.abs() < 5e-3, "{difference:e}");
    let broken = [&whole, &part].map(|run| run.breaks.len());
    assert!(broken[0] > 50, "{broken:?}");
    assert_eq!(broken[0], broken[1]);
    assert!(missing_energy(&part.outcome) < 1e-2);
}
