//! A criterion and a softening law of one's own: the tensile strength of a plate falls from its left edge to its right one, and beyond its
//! strength the force of a bond falls along half a wave of a cosine.

#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

#[path = "watched_plate.rs"]
#[allow(dead_code, reason = "its plate breaks here by another criterion")]
mod watched_plate;

use std::f64::consts::PI;

use ligament::Loading;
use ligament::analysis::driver::stepped;
use ligament::mechanics::failure::softening::{Fall, Law as SofteningLaw, linear};
use ligament::mechanics::failure::{AfterLimit, Criteria, Criterion, Measure, Softened};
use ligament::prelude::*;

/// mu = (1 + cos(pi (kappa - 1)/(r - 1)))/2 between the limit, kappa = 1, and the end, kappa = r.
fn cosine() -> SofteningLaw {
    SofteningLaw {
        word: "cosine",
        words: "Its force falls to zero along half a wave of a cosine.",
        fall: Fall::Formula {
            at: |end, kappa| {
                let phase = PI * (kappa - 1.0) / (end - 1.0);
                let force = 0.5 * (1.0 + phase.cos());
                // Work of the force since the limit, over twice the energy there.
                let work = 0.5 * (kappa - 1.0 + (end - 1.0) / PI * phase.sin());
                Softened {
                    force,
                    secant: force / kappa,
                    dissipated: 1.0 + 2.0 * work - force * kappa,
                }
            },
            end: |end| end,
            total: |end| end,
            for_energy: |energy| energy,
        },
        ..linear::LAW
    }
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut setup = watched_plate::plate()?;
    setup.analysis = Analysis::Stepped(stepped((1..=40).map(|it| f64::from(it) / 40.0).collect()));
    let model = Model::build(setup, &mut ())?;
    let mut problem = Loading::new(&model)?.problem(&model);
    // The critical stretch falls by a third over the width of 6 cm.
    let ends = problem.system.ends.iter();
    let middle = ends.map(|ends| ends.map(|end| model.body().position(end)[0]));
    let limits: Vec<f64> = middle
        .map(|[one, other]| 2.5e-4 * (1.0 - (one + other) / 2.0 / 0.18))
        .collect();
    let n_bonds = limits.len();
    let criterion = Criterion {
        after: AfterLimit::new(cosine(), vec![6.0; n_bonds]),
        ..Criterion::brittle("graded", Measure::Tension, limits)
    };
    problem.criteria = Criteria {
        list: vec![criterion],
    }
    .into();
    let Analysis::Stepped(settings) = &model.setup.analysis else {
        return Err("the plate is pulled in load steps".into());
    };
    let outcome = stepped::run(&problem, settings, &mut NoObserver)?;
    let peak = outcome.peak().ok_or("there is no equilibrium")?;
    println!(
        "{:.4e} N at {:.3e} m, {} bonds broken, {} soften",
        peak.reaction, peak.displacement, outcome.broken_bonds, outcome.softened_bonds
    );
    assert!(outcome.softened_bonds > 0);
    Ok(())
}
