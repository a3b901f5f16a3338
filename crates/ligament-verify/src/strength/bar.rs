//! A bar whose bonds soften from the strength on: strength apart from toughness.

use anyhow::Context;

use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::Extent;
use crate::trial::{Memory, StoredMesh, Template, stored_mesh, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "strength_bar",
    title: "Strength of a bar over its fracture energy",
    source: "definition: a bar carries F_t, whatever its fracture energy",
    setup: "Bar 0.05 x 0.1 m, h = 5 mm (272 points), pulled by its ends, F_t = 3.81 MPa, E = 15 GPa, nu = 0.21, plane stress, NHPD, criterion `rankine`, \
            after which bonds soften along a straight line; G_c = 10, 40 and 160 J/m^2, so that l_ch = 10 to 165 mm. Largest mean stress over F_t.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("verification/strength-bar.toml");
static MESH: StoredMesh = stored_mesh!("bar-5mm.msh");

/// F_t times the section, N.
const STRENGTH: f64 = 3.81e6 * 0.05;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let table = published!("strength-bar").judge(extent, |labels| {
        let trial = (CASE.trial())
            .on_mesh(&MESH)
            .set("model.horizon_factor", labels.number("lambda")?)
            .set("material.fracture_energy", labels.number("G_c, J/m^2")?);
        memory.reading(&trial, |solution| {
            let peak = solution.outcome.peak().context("no state at rest")?;
            Ok(peak.reaction / STRENGTH)
        })
    })?;
    Ok(Findings {
        tables: vec![table],
        ..Findings::default()
    })
}
