//! Squares under uniform stresses.

use super::uniform::{SQUARE, extremes};
use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::{Extent, Labels};
use crate::trial::{Memory, Trial};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "strength_squares",
    title: "First failure under a uniform stress",
    source: "definition: the surface of the criterion, max(sigma_1) = F_t (Rankine) or sigma_1/F_t - sigma_2/F_c = 1 (Mohr and Coulomb)",
    setup: "Square of 0.1 m, h = 5 mm, plane stress, NHPD, E = 15 GPa, nu = 0.21, F_t = 3.81 MPa, F_c = 10 F_t, under the tractions of a uniform \
            stress, on a Delaunay (568 points) and a frontal mesh (514), with principal axes at 0 and 23 degrees to the edges: stress at the first \
            breakage over that of the surface, the smallest and the largest of the four. `tension` stands beside them for contrast: it compares \
            stretches.",
    cases: &[&SQUARE],
    compute: Compute::Code(compute),
};

/// Tensile and compressive strength, Pa.
const TENSILE: f64 = 3.81e6;
const COMPRESSIVE: f64 = 38.1e6;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let table = published!("strength-squares").judge(extent, |labels| {
        let ratio = labels.number("ratio")?;
        let lambda = labels.number("lambda")?;
        let criterion = labels.text("criterion")?;
        let surface = surface(criterion, ratio);
        let stress = 2.0 * surface;
        let regularisation = labels.number("regularisation")?;
        let trial = || trial(criterion, lambda, regularisation);
        let [smallest, largest] = extremes(&mut memory, trial, [stress, ratio * stress])?;
        let factor = pick(labels, smallest, largest)?;
        Ok(factor * stress / surface)
    })?;
    Ok(Findings {
        tables: vec![table],
        ..Findings::default()
    })
}

fn trial(criterion: &str, lambda: f64, regularisation: f64) -> Trial {
    SQUARE
        .trial()
        .set("fracture.criterion.0.kind", criterion)
        .set("model.horizon_factor", lambda)
        .set("correction.regularisation", regularisation)
}

fn pick(labels: Labels<'_>, smallest: f64, largest: f64) -> anyhow::Result<f64> {
    let is_smallest = labels.text("of")? == "smallest";
    Ok(if is_smallest { smallest } else { largest })
}

/// Largest principal stress at failure, Pa, for a ratio of the principal stresses.
fn surface(criterion: &str, ratio: f64) -> f64 {
    match criterion {
        "mohr-coulomb" if ratio < 0.0 => TENSILE / (1.0 - ratio * TENSILE / COMPRESSIVE),
        _ => TENSILE,
    }
}
