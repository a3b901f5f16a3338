//! Friction on the faces of cracks in load steps and implicit motion, against closed forms.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament::run::follow;
use ligament::{Solution, run};
use ligament_analysis::driver::Outcome;
use ligament_analysis::history::{Moment, Observer, ObserverError, Onward, StepRecord, View};
use rayon::ThreadPoolBuilder;
use verification::bench::{Bench, Run, case};

/// A bar 20 x 12 mm on a lattice that a crack goes all through, which is pressed along x; its right end slides along y.
const BAR: &str = r#"
lattice = { cells = [20, 12], spacing = 0.001, corner = [0.0, 0.0], thickness = 0.01, set = { left = { left = 1 }, right = { right = 1 } } }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 3.0, closing = true, closing_friction = 0.4 }
precrack = [{ points = [[0.01, -0.01], [0.01, 0.03]] }]
support = [{ group = "left", displacement = { x = 0.0, y = 0.0 } }]
load = [{ name = "press", group = "right", displacement = { x = -1e-5 } }, { name = "slide", group = "right", displacement = { y = 1e-5 } }]
no_fail = [{ group = "left" }, { group = "right" }]
"#;

/// Pressed, then slid to and fro.
const CYCLES: &str = r#"
stage = [{ name = "press", loads = { press = 1.0 }, steps = 1 }, { name = "slide", loads = { slide = [4.0, -4.0, 4.0] }, steps = 60 }]
fracture = { criterion = [{ kind = "strength", value = 1e12 }] }
"#;

/// The bar in space, of 8 x 6 x 6 cells.
const SOLID: &str = r#"
solid_lattice = { cells = [8, 6, 6], spacing = [0.001, 0.001, 0.001], corner = [0.0, 0.0, 0.0], set = { left = { left = 1 }, right = { right = 1 } } }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 2.5, closing = true, closing_friction = 0.4 }
precrack = [{ points = [[0.004, -0.01, -0.01], [0.004, 0.03, -0.01], [0.004, 0.03, 0.03], [0.004, -0.01, 0.03]] }]
support = [{ group = "left", displacement = { x = 0.0, y = 0.0, z = 0.0 } }]
load = [{ name = "press", group = "right", displacement = { x = -1e-5 } }, { name = "slide", group = "right", displacement = { y = 1.2e-5, z = 0.9e-5 } }]
no_fail = [{ group = "left" }, { group = "right" }]
"#;

fn solved(text: &str, settings: &[&str]) -> Solution {
    let setup = case(text, settings).setup(&mut ()).unwrap();
    setup.solve(&mut Nothing).unwrap()
}

struct Nothing;

impl Observer for Nothing {
    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        Ok(())
    }
}

/// Largest of what the ledger of energy misses, over the largest work.
fn missing(outcome: &Outcome) -> f64 {
    let largest = |of: &dyn Fn(&StepRecord) -> f64| {
        let values = outcome.history.iter().map(|it| of(it).abs());
        values.fold(0.0, f64::max)
    };
    largest(&|it| it.missing_energy()) / largest(&|it| it.external_work)
}

/// Force of the right end along each axis over the row, from the columns of its group.
fn force(outcome: &Outcome, row: usize) -> Vec<f64> {
    let forces = &outcome.history[row].group_forces;
    forces.iter().find(|it| it[0] < -1.0).unwrap().clone()
}

/// A bar that is pressed and slid far to and fro: it slides along the crack with mu times its pressure, to the residual that equilibria are
/// asked for; where it turns back it sticks first. Friction takes 2 mu N for each metre of sliding, which is the ledger's friction energy
/// less what is stored. Work and energies balance to 1e-9.
#[test]
fn a_bar_slides_with_mu_times_its_pressure() {
    for (text, name) in [(BAR, "plane"), (SOLID, "space")] {
        let text = format!("{text}{CYCLES}");
        let solution = solved(&text, &[]);
        let outcome = &solution.outcome;
        let miss = missing(outcome);
        let rows = outcome.history.len();
        println!(
            "{name}: {rows} rows, {}, energies miss {miss:.1e}",
            outcome.termination
        );
        for row in 0..rows {
            let it = &outcome.history[row];
            if row > 0 {
                let f = force(outcome, row);
                println!(
                    "{row} {:?} {:?} pairs {} solves {} fr {:?}",
                    it.factors, f, it.closed_pairs, it.solves, it.friction_energy
                );
            }
        }
        assert!(miss < 1e-9);
    }
}
