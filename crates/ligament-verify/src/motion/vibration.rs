//! The free vibration of a cantilever.

use anyhow::Context;

use super::record::Record;
use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::{Extent, Labels};
use crate::trial::{Template, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "motion_vibration",
    title: "Free vibration of a cantilever",
    source: "natural frequency of the same body by the modal analysis",
    setup: "Cantilever of 100 x 10 points of 1 mm, E = 70 GPa, nu = 0.25, rho = 2700 kg/m^3, plane stress, NHPD, patch correction, inertias of rotation \
            times 4. A force on its end is a half sine of 0.5 ms, then the bar swings until 6 ms. The frequency is from the times at which the end falls \
            through zero, over the first frequency of the modal analysis.",
    cases: &[&CASE, &MODES],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("verification/motion-cantilever.toml");
static MODES: Template = template!("verification/motion-cantilever-modes.toml");

/// End of the force, s.
const FREE: f64 = 5e-4;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let table = published!("motion-vibration").judge(extent, frequency)?;
    Ok(Findings {
        tables: vec![table],
        ..Findings::default()
    })
}

/// Frequency of the motion over that of the first mode.
fn frequency(labels: Labels<'_>) -> anyhow::Result<f64> {
    let trial = CASE.trial();
    let trial = match labels.text("scheme")? {
        "explicit" => trial,
        scheme => trial
            .set("motion.scheme", scheme)
            .set("motion.step", 1e-6 * labels.number("step, us")?),
    };
    let falls = Record::of_probe(&trial.solve()?, "end")?.falls(FREE);
    let (first, last) = falls.first().zip(falls.last()).context("no vibration")?;
    let periods = falls.len().saturating_sub(1) as f64;
    Ok(periods / (last - first) / mode()?)
}

/// First natural frequency of the bar, Hz.
fn mode() -> anyhow::Result<f64> {
    let modes = MODES.trial().modes()?;
    let first = modes.first().context("no mode was found")?;
    Ok(first.frequency())
}
