//! A long edge crack whose bonds soften from the strength on.

use std::f64::consts::PI;

use anyhow::Context;

use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::Extent;
use crate::trial::{Memory, StoredMesh, Template, Trial, stored_mesh, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "strength_crack",
    title: "Long edge crack with strength and fracture energy",
    source: "linear elastic fracture mechanics (Tada, Paris and Irwin): sigma = sqrt(E G_c)/(2.104 sqrt(pi a)) at a/W = 0.4",
    setup: "Plate 0.4 x 0.8 m with an edge crack of a = 0.16 m, tractions on its ends, opened in steps at the mouth; E = 15 GPa, nu = 0.21, \
            G_c = 20 J/m^2, plane stress, NHPD, criterion `rankine`, after which bonds soften along a straight line. h = 5 and 2.5 mm at the tip (884 and \
            1,859 points). F_t = 3.81 and 7.62 MPa: l_ch = E G_c/F_t^2 = 20.7 and 5.2 mm, and H/l_ch is the horizon at the tip, lambda h, over that. \
            Largest load over that of linear fracture mechanics. The process zone lowers it: an estimate is a crack longer by 0.44 l_ch, \
            0.915 and 0.978.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("verification/strength-crack.toml");

/// Meshes by their size at the tip, mm.
static MESHES: [(&str, StoredMesh); 2] = [
    ("5", stored_mesh!("edge-crack-5mm.msh")),
    ("2.5", stored_mesh!("edge-crack-2.5mm.msh")),
];

const YOUNG: f64 = 15e9;
const FRACTURE_ENERGY: f64 = 20.0;
const LENGTH: f64 = 0.16;
const WIDTH: f64 = 0.4;

/// F in K = F sigma sqrt(pi a) at a/W = 0.4.
const SHAPE: f64 = 2.104;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let table = published!("strength-crack").judge(extent, |labels| {
        let trial = trial(
            labels.text("h, mm")?,
            labels.number("lambda")?,
            labels.number("F_t, MPa")?,
        )?;
        peak(&mut memory, &trial)
    })?;
    let change = published!("strength-crack-change").judge(extent, |labels| {
        let (lambda, strength) = (labels.number("lambda")?, labels.number("F_t, MPa")?);
        let coarse = peak(&mut memory, &trial("5", lambda, strength)?)?;
        let fine = peak(&mut memory, &trial("2.5", lambda, strength)?)?;
        Ok(100.0 * (fine - coarse) / coarse)
    })?;
    Ok(Findings {
        tables: vec![table, change],
        ..Findings::default()
    })
}

fn trial(size: &str, lambda: f64, strength: f64) -> anyhow::Result<Trial> {
    let (_, mesh) = (MESHES.iter().find(|(name, _)| *name == size)).context("no such mesh")?;
    Ok((CASE.trial())
        .on_mesh(mesh)
        .set("model.horizon_factor", lambda)
        .set("material.tensile_strength", 1e6 * strength))
}

/// Largest load over that of linear elastic fracture mechanics.
fn peak(memory: &mut Memory<f64>, trial: &Trial) -> anyhow::Result<f64> {
    memory.reading(trial, |solution| {
        let peak = solution.outcome.peak().context("no state at rest")?;
        let stress = (YOUNG * FRACTURE_ENERGY).sqrt() / (SHAPE * (PI * LENGTH).sqrt());
        Ok(peak.reaction / (WIDTH * stress))
    })
}
