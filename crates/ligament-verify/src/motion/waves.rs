//! Waves in bars and through lattices.

use std::f64::consts::TAU;

use anyhow::{Context, bail};
use ligament_plot::plots::{Colour, Series};

use super::record::Record;
use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::{Extent, Labels, Table};
use crate::trial::{Memory, Template, Trial, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "motion_waves",
    title: "Waves in bars, and their dispersion",
    source: "closed forms: d'Alembert's wave in a bar; plane waves through the bonds of a square lattice",
    setup: "Bars of steel 0.2 m long with the patch correction: in the plane 400 x 4 points of 0.5 mm, nu = 0.25 (bbpd 1/3), in space 200 x 8 x 8 of 1 mm, \
            lambda = 2.5, nu = 0.2 (bbpd 1/4). The left end moves by one period of a sine of 10 us; the speed is from the zero of the pulse at 50 and 100 mm. \
            Dispersion: E = 70 GPa, \
            nu = 0.25 (bbpd 1/3), rho = 2700 kg/m^3, plane stress, 160 x 201 points of 1 mm, lambda = 3, the correction of each law, held across the \
            wave; a Ricker wavelet of 400 kHz comes from the left. The phase speed is from the phases of the Fourier transforms at points of the middle \
            row, 10.5 and 50.5 mm from the left. Waves shorter than 6 spacings have not passed when the record ends.",
    cases: &[&PLANE, &SOLID, &WAVE],
    compute: Compute::Code(compute),
};

static PLANE: Template = template!("wave-bar/case.toml");
static SOLID: Template = template!("verification/motion-bar.toml");
static WAVE: Template = template!("verification/motion-wave.toml");

/// Time before which no wave comes back to the middle of the bar, s.
const ALONE: f64 = 30e-6;

/// Distance between the places at which a wave in a bar is read, m.
const QUARTER: f64 = 0.05;

/// Distance between the places at which a plane wave is read, m.
const GAUGE: f64 = 40e-3;

/// Spacing of the points of the lattice with the plane wave, m.
const SPACING: f64 = 1e-3;

/// Laws with one Poisson's ratio alone.
const OF_ONE_RATIO: [&str; 2] = ["bbpd", "bbpd-conical"];

/// The law whose energies are right without a correction of surfaces.
const WITHOUT_CORRECTION: &str = "mbb-pd";

/// Number of angular frequencies of a spectrum, and the least number of points per wavelength of the fastest wave in it.
const SPECTRUM: (usize, f64) = (400, 6.0);

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let bars = published!("motion-bar").judge(extent, bar)?;
    let mut memory = Memory::default();
    let dispersion = published!("motion-dispersion").judge(extent, |labels| {
        let law = labels.text("law")?;
        let trial = with_law(WAVE.trial(), law, "plane");
        let speed = plane_wave(law);
        let spectrum = memory.reading(&trial, |solution| {
            let [near, far] = ["near", "far"].map(|name| Record::of_probe(solution, name));
            let (count, shortest) = SPECTRUM;
            let step = TAU * speed / (shortest * SPACING) / count as f64;
            let delays = near?.delays(&far?, step, count);
            let of_delay = |[omega, delay]: [f64; 2]| {
                [
                    TAU * GAUGE / (delay * SPACING),
                    omega * GAUGE / delay / speed,
                ]
            };
            Ok(delays.into_iter().map(of_delay).collect::<Vec<_>>())
        })?;
        at(&spectrum, labels.number("points")?)
    })?;
    let plots = vec![dispersion.plot(
        ["points per wavelength", "phase speed over sqrt(E'/rho)"],
        series(&dispersion)?,
    )];
    Ok(Findings {
        tables: vec![bars, dispersion],
        plots,
        ..Findings::default()
    })
}

/// Speed of the pulse in a bar, m/s.
fn bar(labels: Labels<'_>) -> anyhow::Result<f64> {
    let (law, space) = (labels.text("law")?, labels.text("in")?);
    let trial = match space {
        "plane" => PLANE.trial(),
        "space" => SOLID.trial(),
        other => bail!("no bar in `{other}`"),
    };
    let trial = with_law(trial, law, space)
        .set("motion.duration", 40e-6)
        .set("motion.rows", 800);
    let trial = match WITHOUT_CORRECTION == law {
        true => trial.set("correction.surface", "none"),
        false => trial,
    };
    let solution = trial.solve()?;
    let turn = |name: &str| {
        let record = Record::of_probe(&solution, name)?;
        let [crest, _] = record.peak([0.0, ALONE])?;
        record.fall(crest)
    };
    Ok(QUARTER / (turn("middle")? - turn("quarter")?))
}

/// The trial with a law, and the Poisson's ratio of the law where it has only one.
pub(super) fn with_law(trial: Trial, law: &str, space: &str) -> Trial {
    let trial = trial.set("model.law", law);
    match (OF_ONE_RATIO.contains(&law), space) {
        (true, "plane") => trial.set("material.poisson", 1.0 / 3.0),
        (true, _) => trial.set("material.poisson", 0.25),
        (false, _) => trial,
    }
}

/// Speed sqrt(E/(1 - nu^2)/rho) of a long plane wave in plane stress with the constants of the case, m/s.
fn plane_wave(law: &str) -> f64 {
    let poisson: f64 = if law == "bbpd" { 1.0 / 3.0 } else { 0.25 };
    (70e9 / (1.0 - poisson.powi(2)) / 2700.0).sqrt()
}

/// Speed at a number of points per wavelength, between those of a spectrum by a straight line.
fn at(spectrum: &[[f64; 2]], points: f64) -> anyhow::Result<f64> {
    let around = spectrum
        .windows(2)
        .find(|pair| pair[0][0] >= points && points >= pair[1][0]);
    let [[long, fast], [short, slow]] = around
        .and_then(|pair| <[[f64; 2]; 2]>::try_from(pair).ok())
        .context("no wave of this length was found")?;
    Ok(fast + (slow - fast) * (points - long) / (short - long))
}

fn series(table: &Table) -> anyhow::Result<Vec<Series>> {
    let mut all = Vec::new();
    let colours = [
        Colour::Blue,
        Colour::Vermilion,
        Colour::Green,
        Colour::Black,
    ];
    for (law, colour) in ["nhpd", "bbpd", "pds", "mppd"].into_iter().zip(colours) {
        let of = format!("law={law}");
        all.push(Series::line(law, colour, table.computed("points", &of)?));
    }
    Ok(all)
}
