//! Natural frequencies of a square lamina with PDS and the micropolar model (MPPD Tables 4 to 6).

use super::experiment::{Compute, Experiment, Findings};
use super::named_modes::{self, Frequencies};
use super::published::{Published, published};
use super::square_elements;
use super::table::{Extent, LabelError, Table};
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
            the axial one is the lowest for nu < 0. Finite elements: 60 x 60 squares with four nodes (bilinear, \
            2 x 2 Gauss points), a diagonal mass matrix, the nodes of the lowest 30 mm held.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

pub(super) static CASE: Template = template!("verification/square-modes.toml");

/// Density of the case, kg/m^3.
const DENSITY: f64 = 2500.0;

/// Axis of the lamina, which is supported at its base: y.
pub(super) const ALONG: usize = 1;

pub(super) const TABLES: [Published; 3] = [
    published!("mppd-table-4"),
    published!("mppd-table-5"),
    published!("mppd-table-6"),
];

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let tables = named_modes::tables(TABLES, extent, |labels| {
        let poisson = labels.number("nu")?;
        if labels.text("of")? == "finite elements" {
            let elements = format!("finite elements, nu = {poisson}");
            return memory.result(elements, || square_elements::frequencies(poisson, DENSITY));
        }
        let trial = (CASE.trial())
            .set("material.poisson", poisson)
            .set("model.law", labels.text("model")?.to_lowercase());
        memory.result(trial.command(), || Frequencies::from_trial(&trial, ALONG))
    })?;
    let plots = tables.iter().map(plot).collect::<Result<_, _>>()?;
    let errors = named_modes::errors(published!("mppd-errors"), extent, &tables, |labels| {
        let (nu, model) = (labels.text("nu")?, labels.text("model")?);
        Ok([
            format!("nu={nu}, model={model}, of=lattice"),
            format!("nu={nu}, model=MPPD, of=finite elements"),
        ])
    })?;
    let tables = tables.into_iter().chain([errors]).collect();
    Ok(Findings {
        tables,
        plots,
        ..Findings::default()
    })
}

fn plot(table: &Table) -> Result<Plot, LabelError> {
    let elements = "model=MPPD, of=finite elements";
    let (known, computed) = (
        table.known("nu", elements)?,
        table.computed("nu", elements)?,
    );
    let mut series = vec![
        Series::circles("finite elements, printed", Colour::Black, known),
        Series::line("finite elements, computed", Colour::Black, computed),
    ];
    for (model, colour) in [("PDS", Colour::Blue), ("MPPD", Colour::Vermilion)] {
        let of = format!("model={model}, of=lattice");
        let (known, computed) = (table.known("nu", &of)?, table.computed("nu", &of)?);
        series.push(Series::circles(format!("{model}, printed"), colour, known));
        series.push(Series::line(format!("{model}, computed"), colour, computed));
    }
    Ok(table.plot(["Poisson's ratio", "frequency, Hz"], series))
}
