//! Plates of imaginary elements with cracks and a hole in tension (MBB-PD section 4.3).

use anyhow::{Context, bail};
use ligament_analysis::driver::Outcome;

use super::experiment::{Experiment, Findings};
use super::published::published;
use super::table::{Extent, Labels};
use super::trial::{Memory, Template, template};
use ligament_plot::plots::{Colour, Plot, Series};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "cracks",
    title: "Cracks in plates of imaginary elements",
    source: "linear elastic fracture mechanics, independent calculation; Masoumi, Ravandi and Salehi (MBB-PD), section 4.3",
    setup: "Plate 100 x 100 x 1 mm, E = 65.8 GPa, nu = 0.3, G_c = 6137 J/m^2, plane stress, m = 3, pulled by u_y of the upper row, the \
            lower one held in y; no failure within three rows of either. A central crack of 10 mm across the load (central), cracks of 10 \
            mm from the middle of the left, right and upper side (three), a hole of 10 x 10 mm (hole). The exact path until the load \
            has fallen to 0.8 of its largest.",
    cases: &[&CENTRAL, &THREE, &HOLE],
    compute,
};

static CENTRAL: Template = template!("mbb-central-crack/case.toml");
static THREE: Template = template!("three-cracks/case.toml");
static HOLE: Template = template!("square-hole/case.toml");

/// Side of the plate, m.
const SIDE: f64 = 0.1;

/// Section of the plate, m^2.
const SECTION: f64 = SIDE * 1e-3;

const MEGAPASCALS: f64 = 1e-6;

/// What the tables read in a run, MPa.
#[derive(Debug, Clone)]
struct Failure {
    first: f64,
    peak: f64,
    /// Strain (%) and stress that a test with a rising displacement shows.
    curve: Vec<[f64; 2]>,
}

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut runs = Memory::default();
    let mut curves = Vec::new();
    let mut failure = |labels: Labels<'_>| -> anyhow::Result<Failure> {
        let (case, d) = (labels.text("case")?, labels.number("d")?);
        let cells = (1e3 * SIDE / d).round() as u32;
        let trial = (template(case)?.trial())
            .on_lattice([cells, cells], 1e-3 * d)
            .set("fracture.stop.load_fraction", 0.8);
        runs.reading(&trial, |it| {
            let failure = Failure::from_outcome(&it.outcome)?;
            curves.push((format!("{case}, {d} mm"), failure.curve.clone()));
            Ok(failure)
        })
    };
    let peaks = published!("mbb-peaks");
    let peaks = peaks.judge(extent, |labels| {
        let failure = failure(labels)?;
        match labels.text("of")? {
            "first" => Ok(failure.first),
            "peak" => Ok(failure.peak),
            other => bail!("of is `first` or `peak`, not `{other}`"),
        }
    })?;
    let griffith = published!("mbb-griffith").judge(extent, |labels| Ok(failure(labels)?.peak))?;
    let colours = [
        Colour::Blue,
        Colour::Sky,
        Colour::Vermilion,
        Colour::Green,
        Colour::Orange,
        Colour::Purple,
    ];
    let series = curves.into_iter().zip(colours);
    let plot = Plot::new(
        "mbb-fracture",
        "Plates with cracks and a hole",
        ["strain, %", "stress on the whole section, MPa"],
        series
            .map(|((label, curve), colour)| Series::curve(label, colour, curve))
            .collect(),
    );
    Ok(Findings {
        tables: vec![peaks, griffith],
        plots: vec![plot],
        ..Findings::default()
    })
}

fn template(case: &str) -> anyhow::Result<&'static Template> {
    match case {
        "central" => Ok(&CENTRAL),
        "three" => Ok(&THREE),
        "hole" => Ok(&HOLE),
        other => bail!("no plate `{other}`"),
    }
}

impl Failure {
    fn from_outcome(outcome: &Outcome) -> anyhow::Result<Self> {
        let stress = |force: f64| MEGAPASCALS * force / SECTION;
        let first = outcome.first_break.context("no bond breaks")?;
        let peak = outcome.peak().context("the run has no state at rest")?;
        let curve = outcome.envelope();
        Ok(Self {
            first: stress(first.reaction),
            peak: stress(peak.reaction),
            curve: (curve.iter())
                .map(|point| [100.0 * point.displacement / SIDE, stress(point.reaction)])
                .collect(),
        })
    }
}
