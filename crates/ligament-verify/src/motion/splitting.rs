//! A beam that rigid blocks split: a double cantilever beam.

use anyhow::{Context, bail};

use super::fast_crack::breaks;
use super::record::Record;
use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::{Extent, Labels};
use crate::trial::{Memory, Template, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "motion_splitting",
    title: "Two rigid blocks that split a beam",
    source: "closed form: cantilevers that are clamped 0.64 of their depth behind the tip of the crack (Kanninen 1973)",
    setup: "Beam 100 x 20 x 10 mm on points of 1 mm, E = 10 GPa, rho = 1200 kg/m^3, G_c = 100 J/m^2, bbpd, `critical-stretch`. Two blocks in a slot at its left end \
            move apart at 0.12 m/s each. The half-opening d at the blocks and the length a of the crack from them on give the force E I 3 d/(a + 0.64 h)^3 and \
            the energy release rate 3/4 E h^3 d^2/(a + 0.64 h)^4 with the depth h of an arm. Force of a block at 1 ms, before the crack of 20 mm grows; the opening at the first \
            break; the length of the crack at 1.8 ms, up to the broken bond farthest from the blocks.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("verification/motion-splitting.toml");

/// Young's modulus, Pa; fracture energy, J/m^2; depth of an arm and thickness, m.
const YOUNG: f64 = 10e9;
const TOUGHNESS: f64 = 100.0;
const DEPTH: f64 = 0.01;
const THICKNESS: f64 = 0.01;

/// Place of the blocks and first length of the crack from them on, m; gap between a block and the beam, m.
const BLOCKS: f64 = 2.5e-3;
const CRACK: f64 = 20e-3;
const GAP: f64 = 2e-5;

/// Lengths by which an arm is longer than the crack, m.
const ROOT: f64 = 0.64 * DEPTH;

/// Time at which the force is read, s.
const BEFORE: f64 = 1e-3;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let table =
        published!("motion-splitting").judge(extent, |labels| entry(labels, &mut memory))?;
    Ok(Findings {
        tables: vec![table],
        ..Findings::default()
    })
}

fn entry(labels: Labels<'_>, memory: &mut Memory<[f64; 3]>) -> anyhow::Result<f64> {
    let [force, opening, length] =
        memory.reading_with_breakages(&CASE.trial(), |solution, records| {
            let opening =
                Record::of_rows(solution, |row| row.rigid_bodies[0].displacement[1] - GAP);
            let force = Record::of_rows(solution, |row| row.contacts[0].pressing);
            let first = records.first().context("no bond breaks")?;
            let all = breaks(&solution.model, records);
            let tip = all.iter().map(|it| it.at[0]).fold(0.0, f64::max);
            let end = opening.values.last().context("no rows")?;
            let inertia = THICKNESS * DEPTH.powi(3) / 12.0;
            let stiffness = 3.0 * YOUNG * inertia / (CRACK + ROOT).powi(3);
            let at_start = (4.0 * TOUGHNESS / (3.0 * YOUNG * DEPTH.powi(3))).sqrt();
            let arm = (end / at_start).sqrt();
            Ok([
                force.at(BEFORE)? / (stiffness * opening.at(BEFORE)?),
                opening.at(first.load_factor)? / (at_start * (CRACK + ROOT).powi(2)),
                (tip - BLOCKS + ROOT) / arm,
            ])
        })?;
    Ok(match labels.text("of")? {
        "force" => force,
        "opening at the first break" => opening,
        "length of the arms" => length,
        other => bail!("no quantity `{other}`"),
    })
}
