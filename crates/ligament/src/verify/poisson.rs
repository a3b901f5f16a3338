//! Poisson's ratio from uniaxial tension: what a test would read off the model.

use super::plots::{Colour, Mark, Plot, Series};
use super::table::{Extent, Known, Labels};
use super::trial::{StoredMesh, Template, probe};
use super::{Experiment, Findings};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "poisson",
    title: "Poisson's ratio from uniaxial tension",
    source: "closed form",
    setup: "Plate 0.2 x 0.1 m on an irregular mesh of 4 mm (1,543 points), E = 15 GPa, plane stress, NHPD; pulled along x, \
            free to contract. Two strain gauges in the middle, 100 mm along and 55.4 mm across, give nu.",
    compute,
};

const ON_MESH: &str = include_str!("published/poisson-mesh.csv");

static PLATE: Template = Template {
    path: "cases/plate-tension/case.toml",
    text: include_str!("../../../../cases/plate-tension/case.toml"),
};

static MESH: StoredMesh = StoredMesh {
    path: "../../meshes/plate.msh",
    bytes: include_bytes!("../../../../meshes/plate.msh"),
};

/// Lengths of the gauges of the plate along and across, m.
const GAUGES: [f64; 2] = [0.1, 0.079_215 - 0.023_790];

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let table = Known::parse("poisson-mesh", ON_MESH)?.judge(extent, on_mesh)?;
    let curve = |lambda: &str, colour| {
        let points = table.computed("nu", &[("lambda", lambda)])?;
        anyhow::Ok(Series::new(
            &format!("lambda = {lambda}"),
            Mark::Line,
            colour,
            points,
        ))
    };
    let plot = Plot {
        name: "poisson-mesh".to_owned(),
        title: "Poisson's ratio on an irregular mesh".to_owned(),
        x: "Poisson's ratio, input".to_owned(),
        y: "Poisson's ratio, from strain gauges".to_owned(),
        series: vec![
            Series::new(
                "closed form",
                Mark::Dashes,
                Colour::Black,
                vec![[-0.5, -0.5], [0.38, 0.38]],
            ),
            curve("2", Colour::Orange)?,
            curve("3", Colour::Blue)?,
            curve("4", Colour::Vermilion)?,
        ],
    };
    Ok(Findings {
        tables: vec![table],
        plots: vec![plot],
    })
}

fn on_mesh(labels: Labels<'_>) -> anyhow::Result<f64> {
    let trial = PLATE.trial();
    let trial = trial.set("material.poisson", labels.number("nu")?);
    let trial = trial.set("model.horizon_factor", labels.number("lambda")?);
    let solution = trial.solve_on(&MESH)?;
    let along = probe(&solution, "gauge-x")? / GAUGES[0];
    let across = probe(&solution, "gauge-y")? / GAUGES[1];
    Ok(-across / along)
}
