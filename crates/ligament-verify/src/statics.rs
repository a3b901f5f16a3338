//! Static tables of the micropolar model: a square plate in traction, shear and bending (MPPD Tables 1 to 3).

use super::experiment::{Experiment, Findings};
use super::published::{Published, published};
use super::table::{Extent, Labels, Table};
use super::trial::{Memory, Template, displacement_at, largest_displacements, template};
use ligament::run::Solution;
use ligament_plot::plots::{Colour, Plot, Series};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "statics",
    title: "Square plate in traction, shear and bending",
    source: "Diana and Casolo (MPPD), Tables 1 to 3",
    setup: "61 x 61 points 10 mm apart, half-width 300 mm, m = 3, E = 70 GPa, plane stress, 10 MPa on the outermost \
            row of points: along y on top and bottom (traction), along the four sides without their corners \
            (shear), along x on left and right and proportional to y (bending). PDS, and MPPD with constant k_t and \
            k_theta = k_t l (1 - l/delta)/2; partial volumes and the surface correction by volumes. Displacements \
            are the largest of all points; those of shear are u_x at (0, 300) mm and u_y at (300, 0) mm, turned \
            until they are equal; the last table is read at (270, 270) mm.",
    cases: &[
        "cases/verification/square-traction.toml",
        "cases/verification/square-shear.toml",
        "cases/verification/square-bending.toml",
    ],
    compute,
};

static TRACTION: Template = template!("verification/square-traction.toml");

static SHEAR: Template = template!("verification/square-shear.toml");

static BENDING: Template = template!("verification/square-bending.toml");

/// Half-width of the plate between its outermost points, m.
const HALF_WIDTH: f64 = 0.3;

/// Distance from the middle, a horizon inside the sides, at which Poisson's ratio is read (MPPD eq. 59), m.
const INSIDE: f64 = 0.27;

const MILLIMETRES: f64 = 1e3;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut bent = Memory::default();
    let tables = vec![
        judge(
            published!("mppd-table-1"),
            extent,
            &mut Memory::default(),
            &TRACTION,
            largest_displacements,
        )?,
        published!("mppd-table-1-poisson").judge(extent, poisson_inside)?,
        judge(
            published!("mppd-table-2"),
            extent,
            &mut Memory::default(),
            &SHEAR,
            |it| Ok([shear_displacement(it)?; 2]),
        )?,
        judge(
            published!("mppd-table-3"),
            extent,
            &mut bent,
            &BENDING,
            largest_displacements,
        )?,
        judge(
            published!("bending-closed-form"),
            extent,
            &mut bent,
            &BENDING,
            largest_displacements,
        )?,
        judge(
            published!("bending-inside"),
            extent,
            &mut Memory::default(),
            &BENDING,
            |it| Ok(displacement_at(it, [INSIDE; 2]).map(f64::abs)),
        )?,
    ];
    let plots = vec![
        plot(
            &tables[0],
            "Simple traction: largest displacement across the load",
            "u_x",
        )?,
        plot(
            &tables[4],
            "Simple bending: largest displacement along the load",
            "u_x",
        )?,
    ];
    Ok(Findings { tables, plots })
}

/// Judges a table of displacements [u_x, u_y] in mm; runs that several entries share are done once.
fn judge(
    table: Published,
    extent: Extent,
    memory: &mut Memory<[f64; 2]>,
    case: &'static Template,
    read: impl Fn(&Solution) -> anyhow::Result<[f64; 2]>,
) -> anyhow::Result<Table> {
    table.judge(extent, |labels| {
        let (nu, law) = (labels.number("nu")?, labels.text("model")?.to_lowercase());
        let trial = case
            .trial()
            .set("material.poisson", nu)
            .set("model.law", law);
        let [x, y] = memory.result(trial.command(), || read(&trial.solve()?))?;
        Ok(MILLIMETRES
            * if labels.text("component")? == "u_x" {
                x
            } else {
                y
            })
    })
}

/// Mean of u_x at the middle of the upper side and u_y at the middle of the right side: what a rigid rotation leaves of
/// them, m.
fn shear_displacement(solution: &Solution) -> anyhow::Result<f64> {
    let [along_x, _] = displacement_at(solution, [0.0, HALF_WIDTH]);
    let [_, along_y] = displacement_at(solution, [HALF_WIDTH, 0.0]);
    Ok(0.5 * (along_x + along_y))
}

fn poisson_inside(labels: Labels<'_>) -> anyhow::Result<f64> {
    let trial = TRACTION
        .trial()
        .set("material.poisson", labels.number("nu")?);
    let solution = trial.set("model.law", "pds").solve()?;
    let [across, _] = displacement_at(&solution, [INSIDE, 0.0]);
    let [_, along] = displacement_at(&solution, [0.0, INSIDE]);
    Ok(-across / along)
}

/// One component over Poisson's ratio, known and computed.
fn plot(table: &Table, title: &str, component: &str) -> anyhow::Result<Plot> {
    let mut series = Vec::new();
    for (model, colour) in [("PDS", Colour::Blue), ("MPPD", Colour::Vermilion)] {
        let of = [("model", model), ("component", component)];
        let label = format!("{model}, {}", table.heading.known);
        series.push(Series::circles(label, colour, table.known("nu", &of)?));
        let label = format!("{model}, computed");
        series.push(Series::line(label, colour, table.computed("nu", &of)?));
    }
    Ok(Plot {
        name: table.heading.name.clone(),
        title: title.to_owned(),
        x: "Poisson's ratio".to_owned(),
        y: format!("{component}, mm"),
        series,
    })
}
