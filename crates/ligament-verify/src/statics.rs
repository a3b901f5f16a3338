//! Static tables of the micropolar model: a square plate in traction, shear and bending (MPPD Tables 1 to 3).

use super::experiment::{Compute, Experiment, Findings};
use super::published::{Published, published};
use super::square_elements::{SquareLoad, largest_displacements as elements};
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
            until they are equal; the last table is read at (270, 270) mm. Finite \
            elements: squares of 10 mm with four nodes (bilinear, 2 x 2 Gauss points), loaded by a force on the volume of the \
            outermost elements that comes to 10 MPa, in shear without the corners, in bending proportional to y of their \
            middles; 61 x 61 in traction and shear, 60 x 60 in bending, the largest displacements of all nodes. With this \
            reading 29 of the 30 printed values are met to the digits.",
    cases: &[&TRACTION, &SHEAR, &BENDING],
    compute: Compute::Code(compute),
};

pub(super) static TRACTION: Template = template!("verification/square-traction.toml");
pub(super) static SHEAR: Template = template!("verification/square-shear.toml");
pub(super) static BENDING: Template = template!("verification/square-bending.toml");

/// Half-width of the plate between its outermost points, m.
const HALF_WIDTH: f64 = 0.3;

/// Distance from the middle, a horizon inside the sides, at which Poisson's ratio is evaluated (MPPD eq. 59), m.
const INSIDE: f64 = 0.27;

/// Stress of the loads, Pa.
const STRESS: f64 = 10e6;

const MILLIMETRES: f64 = 1e3;

const MEGAPASCAL: f64 = 1e-6;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let mut read = |case: &'static Template, labels: Labels<'_>, model: &str| {
        let trial = (case.trial())
            .set("material.poisson", labels.number("nu")?)
            .set("model.law", model.to_lowercase());
        memory.reading(&trial, Reading::from_solution)
    };
    let poisson = published!("mppd-table-1-poisson").judge(extent, |labels| {
        Ok(read(&TRACTION, labels, labels.text("model")?)?.poisson)
    })?;
    let shear_modulus = published!("mppd-table-2-shear-modulus").judge(extent, |labels| {
        Ok(MEGAPASCAL * STRESS / read(&SHEAR, labels, labels.text("model")?)?.shear_angle)
    })?;
    let mut judge = |table: Published, load, displacement: fn(Reading) -> [f64; 2]| {
        table.judge(extent, |labels| {
            let [x, y] = match labels.text("model")? {
                "finite elements" => elements(load, labels.number("nu")?)?,
                model => displacement(read(case_of(load), labels, model)?),
            };
            let is_along_x = labels.text("component")? == "u_x";
            Ok(MILLIMETRES * if is_along_x { x } else { y })
        })
    };
    let tables = vec![
        judge(published!("mppd-table-1"), SquareLoad::Traction, |it| {
            it.largest
        })?,
        poisson,
        judge(published!("mppd-table-2"), SquareLoad::Shear, |it| {
            it.of_sides
        })?,
        shear_modulus,
        judge(published!("mppd-table-3"), SquareLoad::Bending, |it| {
            it.largest
        })?,
        judge(
            published!("bending-closed-form"),
            SquareLoad::Bending,
            |it| it.largest,
        )?,
        judge(published!("bending-inside"), SquareLoad::Bending, |it| {
            it.inside
        })?,
    ];
    let traction = "Simple traction: largest displacement across the load";
    let bending = "Simple bending: largest displacement along the load";
    let plots = vec![plot(&tables[0], traction)?, plot(&tables[5], bending)?];
    Ok(Findings {
        tables,
        plots,
        ..Findings::default()
    })
}

/// The case with a load.
pub(super) fn case_of(load: SquareLoad) -> &'static Template {
    match load {
        SquareLoad::Traction => &TRACTION,
        SquareLoad::Shear => &SHEAR,
        SquareLoad::Bending => &BENDING,
    }
}

/// Results of a run for the tables, m.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reading {
    /// Largest |u_x| and |u_y| of all points.
    pub(super) largest: [f64; 2],
    /// Values |u_x| and |u_y| in the middles of the right and the upper side.
    pub(super) middle: [f64; 2],
    /// Mean of u_x at the middle of the upper side and u_y at the middle of the right side, which does not depend on a rigid rotation;
    /// twice.
    pub(super) of_sides: [f64; 2],
    /// Values |u_x| and |u_y| on the diagonal at [`INSIDE`].
    inside: [f64; 2],
    /// Poisson's ratio at [`INSIDE`], for a plate in traction.
    poisson: f64,
    /// Shear angle at [`INSIDE`], for a plate in shear.
    shear_angle: f64,
}

impl Reading {
    pub(super) fn from_solution(solution: &Solution) -> anyhow::Result<Self> {
        let at = |x, y| displacement_at(solution, [x, y]);
        Ok(Self {
            largest: largest_displacements(solution)?,
            middle: [at(HALF_WIDTH, 0.0)[0].abs(), at(0.0, HALF_WIDTH)[1].abs()],
            of_sides: [0.5 * (at(0.0, HALF_WIDTH)[0] + at(HALF_WIDTH, 0.0)[1]); 2],
            inside: at(INSIDE, INSIDE).map(f64::abs),
            poisson: -at(INSIDE, 0.0)[0] / at(0.0, INSIDE)[1],
            shear_angle: (at(0.0, INSIDE)[0] + at(INSIDE, 0.0)[1]) / INSIDE,
        })
    }
}

/// Plot of u_x over Poisson's ratio, known and computed.
fn plot(table: &Table, title: &str) -> anyhow::Result<Plot> {
    let mut series = Vec::new();
    for (model, colour) in [("PDS", Colour::Blue), ("MPPD", Colour::Vermilion)] {
        let of = format!("model={model}, component=u_x");
        let label = format!("{model}, {}", table.heading.known);
        series.push(Series::circles(label, colour, table.known("nu", &of)?));
        let label = format!("{model}, computed");
        series.push(Series::line(label, colour, table.computed("nu", &of)?));
    }
    let axes = ["Poisson's ratio", "u_x, mm"];
    Ok(Plot::new(&table.heading.name, title, axes, series))
}
