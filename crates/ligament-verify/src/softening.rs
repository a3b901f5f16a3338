//! Softening bonds: the area under the curve of a bar, compared with its fracture energy.

use anyhow::{Context, bail};
use ligament_analysis::driver::LoadPoint;

use super::experiment::{Compute, Experiment, Findings};
use super::published::published;
use super::table::{Extent, Labels};
use super::trial::{Template, Trial, template};
use ligament_plot::plots::{Colour, Plot, Series};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "softening",
    title: "Softening bar: fracture energy and mesh",
    source: "definition: the work that separates the bar is G_c times its section",
    setup: "Bar 60 x 12 mm with two notches that leave 6 mm, on lattices of 12, 16 and 24 rows, m = 3, E = 30 GPa, G_c = 100 J/m^2, \
            plane stress; pulled by its ends in 150 steps. Bonds soften from the strain 1e-4 on (bond-energy, bilinear or \
            exponential), by a law that takes the fracture energy, or by one that ends at 20 times that strain whatever the \
            horizon. The area is that under force over displacement of the end.",
    cases: &[&BAR],
    compute: Compute::Code(compute),
};

static BAR: Template = template!("softening-bar/case.toml");

/// Section between the notches, m^2, and fracture energy, J/m^2.
const SECTION: f64 = 0.006;
const FRACTURE_ENERGY: f64 = 100.0;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let table = published!("softening-area").judge(extent, |labels| {
        let solution = bar(&labels)?.solve()?;
        Ok(area(&solution.outcome.envelope()) / (SECTION * FRACTURE_ENERGY))
    })?;
    let plots = match extent {
        Extent::Fast => Vec::new(),
        Extent::Full => vec![
            curves("energy", "end from G_c")?,
            curves("20", "end at 20 e_0")?,
        ],
    };
    Ok(Findings {
        tables: vec![table],
        plots,
        ..Findings::default()
    })
}

/// The bar of some labels.
fn bar(labels: &Labels<'_>) -> anyhow::Result<Trial> {
    let law = labels.text("law")?.to_owned();
    let trial = rows(BAR.trial(), labels.text("rows")?)?
        .set("model.law", law)
        .set("material.poisson", labels.number("nu")?)
        .set(
            "fracture.criterion.0.after",
            labels.text("after")?.to_owned(),
        );
    end(trial, labels.text("end")?)
}

/// The bar on a lattice of `rows` rows.
fn rows(trial: Trial, rows: &str) -> anyhow::Result<Trial> {
    let rows: u32 = rows.parse().context("rows must be a whole number")?;
    Ok(trial.on_lattice([5 * rows, rows], 0.012 / f64::from(rows)))
}

/// The bar with a given end of its softening law, or with the end by the fracture energy. An exponential law needs a larger displacement.
fn end(trial: Trial, end: &str) -> anyhow::Result<Trial> {
    match end {
        "energy" => Ok(trial
            .set("load.0.displacement.x", 3.6e-4)
            .set("fracture.steps", 300)),
        "20" => Ok(trial
            .set("fracture.criterion.0.end", 20.0)
            .set("load.0.displacement.x", 6e-5)),
        other => bail!("end is `energy` or `20`, not `{other}`"),
    }
}

/// Work under a curve, J.
fn area(curve: &[LoadPoint]) -> f64 {
    let pairs = curve.windows(2);
    let of_pair = |pair: &[LoadPoint]| {
        0.5 * (pair[0].reaction + pair[1].reaction) * (pair[1].displacement - pair[0].displacement)
    };
    pairs.map(of_pair).sum()
}

/// Plot of the curves of three lattices.
fn curves(wanted: &str, title: &str) -> anyhow::Result<Plot> {
    let lattices = [
        ("12", Colour::Orange),
        ("16", Colour::Blue),
        ("24", Colour::Vermilion),
    ];
    let mut series = Vec::new();
    for (count, colour) in lattices {
        let solution = end(rows(BAR.trial(), count)?, wanted)?.solve()?;
        let points = solution.outcome.envelope().into_iter();
        let points = points.map(|it| [it.displacement * 1e6, it.reaction / SECTION / 1e6]);
        let name = format!("{count} rows");
        series.push(Series::line(name, colour, points.collect()));
    }
    let axes = [
        "displacement of the end, um",
        "force / section between the notches, MPa",
    ];
    let (name, title) = (
        format!("softening-{wanted}"),
        format!("Notched bar, {title}"),
    );
    Ok(Plot::new(name, title, axes, series))
}
