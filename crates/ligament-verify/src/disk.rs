//! The strength of the Brazilian disk grows with the horizon factor: NHPD eq. 22.

use std::f64::consts::PI;

use anyhow::Context;

use super::experiment::{Experiment, Findings};
use super::published::published;
use super::table::{Extent, Labels};
use super::trial::{StoredMesh, Template, stored_mesh, template};
use ligament_plot::plots::{Colour, Plot, Series};
use ligament_run::summary::DROP;

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "disk",
    title: "Brazilian disk: strength and horizon factor",
    source: "Zhang, Yang and Zhuang (NHPD), eq. 22",
    setup: "Disk of diameter 0.1 m, t = 1 m, E = 15 GPa, nu = 0.21, F_t = 3.81 MPa, plane stress, NHPD on triangle \
            meshes of 3 mm (1,440 points) and 2 mm (2,948 points). The platens are the nodes of the rim with |x| <= \
            1.5 mm, moved together in steps of 4 um, five bonds an iteration. The peak is the largest load before \
            the load first falls.",
    cases: &[&CASE],
    compute,
};

static CASE: Template = template!("brazilian-disk/case.toml");

static COARSE: StoredMesh = stored_mesh!("disk-3mm-platen-1.5mm.msh");
static FINE: StoredMesh = stored_mesh!("disk-2mm-platen-1.5mm.msh");

/// Load at which a disk of a material with this strength splits: pi D t F_t/2, N.
const CLOSED_FORM: f64 = 0.5 * PI * 0.1 * 1.0 * 3.81e6;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let table = published!("disk-peak").judge(extent, relative_peak)?;
    let eq_22 = (8..=16)
        .map(|quarters| 0.25 * f64::from(quarters))
        .map(|l| [l, (3.0 * l - 1.0) / 8.0]);
    let mut series = vec![Series::dashes(
        "NHPD eq. 22",
        Colour::Black,
        eq_22.collect(),
    )];
    for (mesh, colour) in [("3 mm", Colour::Blue), ("2 mm", Colour::Vermilion)] {
        let points = table.computed("lambda", &format!("mesh={mesh}"))?;
        series.push(Series::line(format!("computed, {mesh}"), colour, points));
    }
    let axes = ["horizon factor lambda", "peak load / (pi D t F_t/2)"];
    let plot = Plot::new("disk-peak", "Strength of the Brazilian disk", axes, series);
    Ok(Findings {
        tables: vec![table],
        plots: vec![plot],
        ..Findings::default()
    })
}

fn relative_peak(labels: Labels<'_>) -> anyhow::Result<f64> {
    let mesh = match labels.text("mesh")? {
        "3 mm" => &COARSE,
        _ => &FINE,
    };
    let trial = CASE
        .trial()
        .set("model.horizon_factor", labels.number("lambda")?);
    let solution = trial.on_mesh(mesh).solve()?;
    let peak = solution
        .outcome
        .first_peak(DROP)
        .context("the run has no state at rest")?;
    Ok(peak.reaction / CLOSED_FORM)
}
