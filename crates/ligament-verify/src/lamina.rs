//! Natural frequencies of an orthotropic lamina with a hole, and their convergence (OMPPD Tables 3 to 5, Fig. 18).

use super::experiment::{Compute, Experiment, Findings};
use super::finite_elements::Mode;
use super::lamina_elements;
use super::named_modes::{self, Frequencies};
use super::published::{Published, published};
use super::table::{Extent, LabelError, Row, Table};
use super::trial::{Memory, Template, template};
use ligament_plot::plots::{Colour, Plot, Series};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "lamina",
    title: "Natural frequencies of an orthotropic lamina with a hole",
    source: "Diana and Casolo (OMPPD), Tables 3 to 5 and Fig. 18",
    setup: "400 x 200 mm with a central hole of radius 40 mm, 80 x 40 cells of 5 mm less those whose centre lies in \
            the hole (2,992 points), no bonds across the hole, m = 3.2. E_1 = 15 GPa, E_2 = 5 GPa, nu_12 = 0.25, G \
            = 4.8 GPa, 2500 kg/m^3, plane stress, axis 1 turned by the angle (degrees). The two columns at the left \
            end are held in both displacements, with their rotations free: so most printed values are met, and with held \
            rotations none. k_theta = k_t l (1 - l/delta)/2; partial volumes and the surface correction by volumes. The \
            coarse and the fine lattice have 748 and 11,988 points (cells of 10 and 2.5 mm). Finite elements: 1,824 \
            quadrilaterals with nine nodes around the round hole, a diagonal mass matrix, 10 mm at the left end held.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

pub(super) static CASE: Template = template!("verification/lamina-modes.toml");

/// Axis of the lamina, a cantilever along x.
const ALONG: usize = 0;

const TABLES: [Published; 3] = [
    published!("omppd-table-3"),
    published!("omppd-table-4"),
    published!("omppd-table-5"),
];

/// Number of cells along x; along y half as many.
const COARSE: u32 = 40;
const MIDDLE: u32 = 80;
const FINE: u32 = 160;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let middle = tables(extent, &mut memory, MIDDLE)?;
    let errors = named_modes::errors(published!("omppd-errors"), extent, &middle, |labels| {
        let angle = labels.text("angle")?;
        Ok(["lattice", "finite elements"].map(|of| format!("angle={angle}, of={of}")))
    })?;
    let mut findings = Findings {
        plots: middle.iter().map(of_angle).collect::<Result<_, _>>()?,
        tables: middle.iter().cloned().chain([errors]).collect(),
        ..Findings::default()
    };
    if extent == Extent::Full {
        let coarse = tables(extent, &mut memory, COARSE)?;
        let fine = tables(extent, &mut memory, FINE)?;
        findings.tables.push(convergence(&coarse, &middle, &fine)?);
        findings
            .plots
            .push(of_horizon([&coarse[0], &middle[0], &fine[0]])?);
    }
    Ok(findings)
}

/// Tables 3 to 5 on a lattice with `cells` cells along x.
fn tables(
    extent: Extent,
    memory: &mut Memory<Frequencies>,
    cells: u32,
) -> anyhow::Result<Vec<Table>> {
    named_modes::tables(TABLES, extent, |labels| {
        let angle = labels.number("angle")?.to_radians();
        if labels.text("of")? == "finite elements" {
            return memory.result(format!("finite elements, {angle}"), || {
                let (_, modes) = lamina_elements::modes(angle)?;
                let named = |mode: &Mode| (mode.frequency, mode.participation[ALONG]);
                Frequencies::from_modes(modes.iter().map(named))
            });
        }
        let trial = CASE.trial().set("material.angle", angle);
        let trial = trial.on_lattice([cells, cells / 2], 0.4 / f64::from(cells));
        let trial = trial.set("lattice.set.end.left", cells / COARSE);
        memory.result(trial.command(), || Frequencies::from_trial(&trial, ALONG))
    })
}

/// Table of the largest change of a frequency from the coarse lattice, and the largest difference of the fine lattice from finite elements.
fn convergence(coarse: &[Table], middle: &[Table], fine: &[Table]) -> anyhow::Result<Table> {
    let changes = differences(coarse.iter().zip(middle).flat_map(|(coarse, middle)| {
        let rows = rows_of(coarse, "lattice").zip(rows_of(middle, "lattice"));
        rows.map(|(coarse, middle)| (coarse.computed, middle.computed))
    }));
    let errors = differences(fine.iter().flat_map(|table| {
        let rows = rows_of(table, "lattice").zip(rows_of(table, "finite elements"));
        rows.map(|(row, elements)| (row.computed, elements.entry.known.value()))
    }));
    published!("omppd-convergence").judge(Extent::Full, |labels| {
        let all = match labels.text("points")? {
            "748" => &changes,
            _ => &errors,
        };
        Ok(all[all.len() - 1])
    })
}

/// The rows for the paper's lattice or for its finite elements.
fn rows_of<'a>(table: &'a Table, of: &'a str) -> impl Iterator<Item = &'a Row> {
    let belongs = move |row: &&Row| table.labels(row).text("of") == Ok(of);
    table.rows.iter().filter(belongs)
}

/// Relative differences |one/other - 1| of pairs, %, ascending.
fn differences(pairs: impl Iterator<Item = (f64, f64)>) -> Vec<f64> {
    let mut all: Vec<f64> = pairs
        .map(|(one, other)| 100.0 * (one / other - 1.0).abs())
        .collect();
    all.sort_by(f64::total_cmp);
    all
}

/// Plot of a frequency over the angle of the axes.
fn of_angle(table: &Table) -> Result<Plot, LabelError> {
    let elements = table.known("angle", "of=finite elements")?;
    let printed = table.known("angle", "of=lattice")?;
    let computed = table.computed("angle", "of=lattice")?;
    let series = vec![
        Series::dashes("finite elements, printed", Colour::Black, elements),
        Series::circles("lattice, printed", Colour::Vermilion, printed),
        Series::line("lattice, computed", Colour::Vermilion, computed),
    ];
    Ok(table.plot(["angle of axis 1, degrees", "frequency, Hz"], series))
}

/// Plot of the ratio of the first flexural frequency to that of finite elements, on three lattices.
fn of_horizon(tables: [&Table; 3]) -> Result<Plot, LabelError> {
    let angles = [
        ("0", Colour::Blue),
        ("30", Colour::Vermilion),
        ("45", Colour::Green),
        ("60", Colour::Orange),
        ("90", Colour::Purple),
    ];
    let mut series = Vec::new();
    for (angle, colour) in angles {
        let mut points = Vec::new();
        for (table, horizon) in tables.iter().zip([32.0, 16.0, 8.0]) {
            let known = table.known("angle", &format!("of=finite elements, angle={angle}"))?;
            let computed = table.computed("angle", &format!("of=lattice, angle={angle}"))?;
            let pairs = known.iter().zip(&computed);
            points.extend(
                pairs.map(|(known, computed)| [horizon, 100.0 * (computed[1] / known[1] - 1.0)]),
            );
        }
        series.push(Series::line(format!("{angle} degrees"), colour, points));
    }
    let title = "First flexural frequency: difference from finite elements";
    let axes = ["horizon, mm", "difference, %"];
    Ok(Plot::new("omppd-convergence", title, axes, series))
}
