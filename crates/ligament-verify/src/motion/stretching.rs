//! A ring that expands so fast that it falls into many parts.

use anyhow::{Context, bail};

use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::{Extent, Labels};
use crate::trial::{Memory, Template, Trial, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "motion_stretching",
    title: "A ring that falls into parts",
    source: "ring of Levy and Molinari 2010; closed form: balance of energy (Glenn and Chudnovsky 1986), time of the first break",
    setup: "The circumference of a ring of 50 mm as a straight bar of 240 x 3 points: E = 275 GPa, nu = 0, rho = 2750 kg/m^3, G_c = 100 J/m^2, NHPD, patch \
            correction, `critical-stretch` with a strength of 300 MPa (horizon 0.625 mm), G_c scattered by a Weibull modulus of 20. All points \
            begin with the velocities of a strain rate, and both ends keep theirs. The parts are counted at ten times the time of the first break, \
            which is 300 MPa/(E rate); the mean over five seeds. A part of the length s has the \
            kinetic energy rho rate^2 s^3/24 about its middle and the strain energy s F_t^2/(2 E) for each area; where all of it makes cracks, \
            both are G_c together.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("verification/motion-stretching.toml");

/// Length of the bar, m, its number of columns, and the strain at its strength.
const LENGTH: f64 = 50e-3;
const COLUMNS: u32 = 240;
const STRAIN: f64 = 300e6 / 275e9;

/// Number of specimens.
const SEEDS: u64 = 5;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let table =
        published!("motion-stretching").judge(extent, |labels| entry(labels, &mut memory))?;
    Ok(Findings {
        tables: vec![table],
        ..Findings::default()
    })
}

/// Mean over the specimens of the number of parts, or of the time of the first break over that of the strength.
fn entry(labels: Labels<'_>, memory: &mut Memory<[f64; 2]>) -> anyhow::Result<f64> {
    let rate = labels.number("rate, 1/s")?;
    let mut sums = [0.0; 2];
    for seed in 0..SEEDS {
        let reading = memory.reading_with_breakages(&bar(rate, seed), |solution, records| {
            let last = solution.outcome.history.last().context("no rows")?;
            let first = records.first().context("no bond breaks")?;
            Ok([last.fragments as f64, first.load_factor * rate / STRAIN])
        })?;
        sums = [0, 1].map(|place| sums[place] + reading[place] / SEEDS as f64);
    }
    Ok(match labels.text("of")? {
        "parts" => sums[0],
        "time of the first break" => sums[1],
        other => bail!("no quantity `{other}`"),
    })
}

/// A bar that is stretched at a rate (1/s), with the seed of its strength.
fn bar(rate: f64, seed: u64) -> Trial {
    let side = LENGTH / f64::from(COLUMNS);
    let column = |number: u32| {
        let [from, to] = [0.01, 0.99].map(|share| side * (f64::from(number) + share));
        let velocity = rate * (side * (f64::from(number) + 0.5) - 0.5 * LENGTH);
        format!("{{box=[[{from:?},-1.0],[{to:?},1.0]],velocity={{x={velocity:?}}}}}")
    };
    let columns: Vec<String> = (0..COLUMNS).map(column).collect();
    let end = 0.5 * rate * (LENGTH - side);
    CASE.trial()
        .set("motion.duration", 10.0 * STRAIN / rate)
        .set("fracture.scatter.seed", seed)
        .set("load.0.velocity.x", -end)
        .set("load.1.velocity.x", end)
        .set_toml("initial_velocity", &format!("[{}]", columns.join(",")))
}
