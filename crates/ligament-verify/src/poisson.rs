//! Poisson's ratio from uniaxial tension, as measured in a test.

use super::experiment::{Compute, Experiment, Findings};
use super::published::published;
use super::table::{Extent, LabelError, Labels, Table};
use super::trial::{StoredMesh, Template, probe, stored_mesh, template};
use ligament::run::Solution;
use ligament_plot::plots::{Colour, Plot, Series};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "poisson",
    title: "Poisson's ratio from uniaxial tension",
    source: "closed form",
    setup: "On a lattice: plate 0.2 x 0.1 m of 80 x 40 points, m = 3, E = 15 GPa, plane stress, PDS and MPPD \
            (constant k_t); gauges in the middle, 97.5 mm along and 47.5 mm across. On a mesh: plate 0.2 x 0.1 m on \
            an irregular mesh of 4 mm (1,543 points), E = 15 GPa, plane stress, NHPD; pulled along x, free to \
            contract. Two strain gauges in the middle, 100 mm along and 55.4 mm across, give nu.",
    cases: &[&LATTICE, &PLATE],
    compute: Compute::Code(compute),
};

static LATTICE: Template = template!("verification/lattice-tension.toml");
static PLATE: Template = template!("plate-tension/case.toml");

static MESH: StoredMesh = stored_mesh!("plate.msh");

/// Lengths of the gauges along and across, m.
const ON_LATTICE: [f64; 2] = [2.0 * 0.048_75, 2.0 * 0.023_75];
const ON_MESH: [f64; 2] = [0.1, 0.079_215 - 0.023_790];

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let lattice = published!("poisson-lattice").judge(extent, on_lattice)?;
    let mesh = published!("poisson-mesh").judge(extent, on_mesh)?;
    let by_law = [("PDS", Colour::Blue), ("MPPD", Colour::Vermilion)];
    let by_lambda = [
        ("2", Colour::Orange),
        ("3", Colour::Blue),
        ("4", Colour::Vermilion),
    ];
    let plots = vec![
        plot(&lattice, "law", &by_law)?,
        plot(&mesh, "lambda", &by_lambda)?,
    ];
    Ok(Findings {
        tables: vec![lattice, mesh],
        plots,
        ..Findings::default()
    })
}

fn on_lattice(labels: Labels<'_>) -> anyhow::Result<f64> {
    let trial = LATTICE
        .trial()
        .set("material.poisson", labels.number("nu")?);
    let trial = trial.set("model.law", labels.text("law")?.to_lowercase());
    ratio(&trial.solve()?, ON_LATTICE)
}

fn on_mesh(labels: Labels<'_>) -> anyhow::Result<f64> {
    let trial = PLATE.trial().set("material.poisson", labels.number("nu")?);
    let trial = trial.set("model.horizon_factor", labels.number("lambda")?);
    ratio(&trial.on_mesh(&MESH).solve()?, ON_MESH)
}

/// Poisson's ratio from two gauges of these lengths along and across.
fn ratio(solution: &Solution, [along, across]: [f64; 2]) -> anyhow::Result<f64> {
    let strain = probe(solution, "gauge-x")? / along;
    let contraction = -probe(solution, "gauge-y")? / across;
    Ok(contraction / strain)
}

/// Plot of the differences from the input, for each label of a key.
fn plot(table: &Table, key: &str, curves: &[(&str, Colour)]) -> Result<Plot, LabelError> {
    let mut series = vec![Series::dashes(
        "closed form",
        Colour::Black,
        vec![[-0.5, 0.0], [0.38, 0.0]],
    )];
    for (label, colour) in curves {
        let computed = table.computed("nu", &format!("{key}={label}"))?;
        let missed = computed
            .into_iter()
            .map(|[input, found]| [input, found - input])
            .collect();
        series.push(Series::line(format!("{key} {label}"), *colour, missed));
    }
    let axes = ["Poisson's ratio, input", "from strain gauges, less input"];
    Ok(table.plot(axes, series))
}
