//! A disk between two walls that move: the Brazilian test in time.

use std::f64::consts::PI;

use anyhow::{Context, bail};
use ligament_analysis::history::StepRecord;

use super::fast_crack::distance;
use super::record::Record;
use crate::crack_path::middle;
use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::{Extent, Labels};
use crate::trial::{Memory, Template, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "motion_disk",
    title: "A disk between two walls that move",
    source: "closed form: Hondros 1959 for the stress in the middle; symmetry",
    setup: "Disk of 60 mm on points of 1 mm, E = 30 GPa, nu = 0.25, rho = 2500 kg/m^3, plane stress, NHPD, tensile strength 10 MPa, `bond-rankine`. Rigid walls \
            press it from both sides along 10 cells; their velocity grows in 50 us, and waves cross the disk in 17 us. Force of the walls at the first \
            break, over P = pi D t F_t/2 alpha/(sin 2 alpha - alpha) for the half-width alpha of the contacts; distance of this break from the middle over D; \
            difference of the forces of both walls over P.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("verification/motion-disk.toml");

/// Diameter, thickness, half of the width of the contacts, m; strength, Pa.
const DIAMETER: f64 = 0.06;
const THICKNESS: f64 = 0.01;
const HALF_WIDTH: f64 = 5e-3;
const STRENGTH: f64 = 10e6;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let table = published!("motion-disk").judge(extent, |labels| entry(labels, &mut memory))?;
    Ok(Findings {
        tables: vec![table],
        ..Findings::default()
    })
}

/// Force at which the middle of the disk reaches the strength, N.
fn force_in_statics() -> f64 {
    let alpha = (2.0 * HALF_WIDTH / DIAMETER).asin();
    let share = (2.0 * alpha).sin() / alpha - 1.0;
    0.5 * PI * DIAMETER * THICKNESS * STRENGTH / share
}

fn entry(labels: Labels<'_>, memory: &mut Memory<[f64; 3]>) -> anyhow::Result<f64> {
    let velocity = labels.number("velocity, m/s")?;
    let trial = (CASE.trial())
        .set("rigid.0.velocity.x", velocity)
        .set("rigid.1.velocity.x", -velocity);
    let [force, place, difference] =
        memory.reading_with_breakages(&trial, |solution, records| {
            let first = records.first().context("no bond breaks")?;
            let at = middle(&solution.model, first.bond as usize).at;
            let pressing = |wall: usize| move |row: &StepRecord| row.contacts[wall].pressing;
            let walls = [0, 1].map(|wall| Record::of_rows(solution, pressing(wall)));
            let [left, right] = &walls;
            let apart = left
                .values
                .iter()
                .zip(&right.values)
                .map(|(a, b)| (a - b).abs());
            let apart = apart.fold(0.0, f64::max);
            // The row after the first break is the last one.
            let force = left.at(first.load_factor)?;
            Ok([force, distance(at, [0.03; 2]), apart])
        })?;
    Ok(match labels.text("of")? {
        "force over that in statics" => force / force_in_statics(),
        "distance from the middle over D" => place / DIAMETER,
        "difference of the walls" => difference / force,
        other => bail!("no quantity `{other}`"),
    })
}
