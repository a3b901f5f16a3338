//! Natural frequencies of a square lamina with PDS and the micropolar model (MPPD Tables 4 to 6).

use super::experiment::{Experiment, Findings};
use super::named_modes::Frequencies;
use super::published::{Published, published};
use super::table::{Extent, Table};
use super::trial::{Memory, Template, template};
use ligament_plot::plots::{Colour, Plot, Series};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "frequencies",
    title: "Natural frequencies of a square lamina",
    source: "Diana and Casolo (MPPD), Tables 4 to 6",
    setup: "60 x 60 points 10 mm apart, m = 3, E = 70 GPa, 2500 kg/m^3, plane stress, the three rows at the base \
            held in all unknowns. PDS, and MPPD with constant k_t and k_theta = k_t l (1 - l/delta)/2; partial \
            volumes and the surface correction by volumes. Modes are told by their shape, as in the paper: with PDS \
            the axial one is the lowest for nu < 0.",
    cases: &["cases/verification/square-modes.toml"],
    compute,
};

static CASE: Template = template!("verification/square-modes.toml");

/// The lamina stands on its base.
const ALONG: usize = 1;

/// A table and the mode it is of.
type OfMode = (Published, fn(Frequencies) -> f64);

const TABLES: [OfMode; 3] = [
    (published!("mppd-table-4"), |it| it.flexural),
    (published!("mppd-table-5"), |it| it.axial),
    (published!("mppd-table-6"), |it| it.second_flexural),
];

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let mut findings = Findings::default();
    for (table, frequency) in TABLES {
        let table = table.judge(extent, |labels| {
            let (nu, law) = (labels.number("nu")?, labels.text("model")?.to_lowercase());
            let trial = CASE
                .trial()
                .set("material.poisson", nu)
                .set("model.law", law);
            memory
                .result(trial.command(), || Frequencies::from_trial(&trial, ALONG))
                .map(frequency)
        })?;
        findings.plots.push(plot(&table)?);
        findings.tables.push(table);
    }
    Ok(findings)
}

fn plot(table: &Table) -> anyhow::Result<Plot> {
    let of = |model, from| [("model", model), ("of", from)];
    let elements = table.known("nu", &of("MPPD", "finite elements"))?;
    let mut series = vec![Series::dashes(
        "finite elements, printed",
        Colour::Black,
        elements,
    )];
    for (model, colour) in [("PDS", Colour::Blue), ("MPPD", Colour::Vermilion)] {
        let (known, computed) = (
            table.known("nu", &of(model, "lattice"))?,
            table.computed("nu", &of(model, "lattice"))?,
        );
        series.push(Series::circles(format!("{model}, printed"), colour, known));
        series.push(Series::line(format!("{model}, computed"), colour, computed));
    }
    Ok(Plot {
        name: table.heading.name.clone(),
        title: table.heading.title.clone(),
        x: "Poisson's ratio".to_owned(),
        y: "frequency, Hz".to_owned(),
        series,
    })
}
