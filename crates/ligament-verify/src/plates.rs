//! Plates of imaginary elements in tension, in shear and heated (MBB-PD section 4.1).

use anyhow::{Context, bail};

use super::experiment::{Compute, Experiment, Findings};
use super::published::published;
use super::table::{Extent, Labels, Table};
use super::trial::{Memory, Template, Trial, displacement_at, probe, template};
use ligament::run::Solution;
use ligament_output::csv::read::Sheet;
use ligament_plot::plots::{Colour, Plot, Series};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "plates",
    title: "Plates of imaginary elements",
    source: "closed form, finite elements, independent calculation; Masoumi, Ravandi and Salehi (MBB-PD), section 4.1",
    setup: "Plate 100 x 100 x 1 mm, E = 65.8 GPa, plane stress, m = 3. Tension: 200 MPa on the outer rows of points along y, or \
            columns along x. Shear: u_x = 1 mm and u_y = 0 on the upper row, the lower one held, nu = 0.3 and the five ratios of the paper, \
            which does not name them for shear. A is taken as the middle of the right side, at the row above it. Heated by 50 K: nu = 0.4, \
            23e-6 1/K, upper and lower row held (thermal), and the left column too (thermal-left). The elements end at the rows \
            that are prescribed.",
    cases: &[&TENSION_Y, &TENSION_X, &SHEAR, &THERMAL, &THERMAL_LEFT],
    compute: Compute::Code(compute),
};

pub(super) static TENSION_Y: Template = template!("mbb-plate/tension.toml");
pub(super) static TENSION_X: Template = template!("mbb-plate/tension-x.toml");
pub(super) static SHEAR: Template = template!("mbb-plate/shear.toml");
pub(super) static THERMAL: Template = template!("thermal-plates/case.toml");
pub(super) static THERMAL_LEFT: Template = template!("thermal-plates/three-edges.toml");

/// Table of problem, d, x, y (mm), u_x, u_y (um) by finite elements.
const ELEMENTS: &str = include_str!("../../../tests/reference/mbb-pd-elements.csv");

/// Side of the plate, m.
const SIDE: f64 = 0.1;

const MICROMETRES: f64 = 1e6;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut narrowing = Memory::default();
    let mut across = |labels: Labels<'_>| -> anyhow::Result<f64> {
        let (case, nu) = (tension(labels)?, labels.number("nu")?);
        let trial = on_lattice(case.trial(), spacing(labels)?).set("material.poisson", nu);
        let half = narrowing.reading(&trial, |it| Ok(0.5 * probe(it, "narrowing")?))?;
        Ok(MICROMETRES * half)
    };
    let mut tables = vec![
        published!("mbb-tension").judge(extent, &mut across)?,
        published!("mbb-tension-lattice").judge(extent, |labels| {
            Ok(across(labels)? - MICROMETRES * narrowing_by_hooke(labels)?)
        })?,
    ];
    let elements = elements()?;
    let mut states = Memory::default();
    let mut plate = |labels: Labels<'_>| -> anyhow::Result<Compared> {
        let trial = on_lattice(problem(labels)?, spacing(labels)?);
        let wanted = (labels.text("problem")?, labels.number("d")?);
        states.reading(&trial, |it| {
            Compared::with_elements(it, spacing(labels)?, &elements, wanted)
        })
    };
    tables.push(published!("mbb-plates").judge(extent, |labels| {
        let component = usize::from(labels.text("component")? == "u_y");
        Ok(100.0 * plate(labels)?.difference[component])
    })?);
    tables.push(published!("mbb-plates-elements").judge(extent, |labels| {
        let compared = plate(labels)?;
        Ok(match labels.text("of")? {
            "force" => compared.force,
            _ => MICROMETRES * compared.middle,
        })
    })?);
    let mut sheared = Memory::default();
    let mut shear = |labels: Labels<'_>| -> anyhow::Result<f64> {
        let trial = on_lattice(SHEAR.trial(), spacing(labels)?);
        let trial = trial.set("material.poisson", labels.number("nu")?);
        let d = spacing(labels)?;
        let [force, across] = sheared.reading(&trial, |it| {
            let last = it.outcome.history.last().context("the run has no state")?;
            let at_side = displacement_at(it, [0.5 * (SIDE - d), 0.5 * d]);
            Ok([last.reaction, MICROMETRES * at_side[1]])
        })?;
        match labels.text("of")? {
            "force" => Ok(force),
            "u_y" => Ok(across),
            other => bail!("of is `force` or `u_y`, not `{other}`"),
        }
    };
    tables.push(published!("mbb-shear").judge(extent, &mut shear)?);
    tables.push(published!("mbb-shear-lattice").judge(extent, &mut shear)?);
    let plots = vec![plot(&tables[0])?];
    Ok(Findings {
        tables,
        plots,
        ..Findings::default()
    })
}

fn tension(labels: Labels<'_>) -> anyhow::Result<&'static Template> {
    match labels.text("along")? {
        "x" => Ok(&TENSION_X),
        "y" => Ok(&TENSION_Y),
        other => bail!("along is `x` or `y`, not `{other}`"),
    }
}

fn problem(labels: Labels<'_>) -> anyhow::Result<Trial> {
    match labels.text("problem")? {
        "shear" => Ok(SHEAR.trial()),
        "thermal" => Ok(THERMAL.trial()),
        "thermal-left" => Ok(THERMAL_LEFT.trial()),
        other => bail!("no problem `{other}`"),
    }
}

/// Spacing of an entry, m; its label is in mm.
fn spacing(labels: Labels<'_>) -> anyhow::Result<f64> {
    Ok(1e-3 * labels.number("d")?)
}

/// The plate on a lattice with a spacing (m).
fn on_lattice(trial: Trial, spacing: f64) -> Trial {
    let cells = (SIDE / spacing).round() as u32;
    trial.on_lattice([cells, cells], spacing)
}

/// Displacement at the middle of a free side, -nu s/E (L - d)/2, m.
fn narrowing_by_hooke(labels: Labels<'_>) -> anyhow::Result<f64> {
    Ok(-labels.number("nu")? * 200e6 / 65.8e9 * 0.5 * (SIDE - spacing(labels)?))
}

/// Displacement by finite elements at a point.
#[derive(Debug, Clone, PartialEq)]
struct Elements {
    problem: String,
    /// Spacing of the lattice, mm.
    spacing: f64,
    /// Position x, y, m.
    place: [f64; 2],
    /// Displacement u_x, u_y, m.
    displacement: [f64; 2],
}

fn elements() -> Result<Vec<Elements>, ligament_output::Error> {
    let sheet = Sheet::parse("mbb-pd-elements.csv", ELEMENTS)?;
    let problems = sheet.values::<String>("problem")?.into_iter();
    let numbers = sheet.numbers(["d_mm", "x_mm", "y_mm", "ux_um", "uy_um"])?;
    Ok(problems
        .zip(numbers)
        .map(|(problem, [spacing, x, y, u_x, u_y])| Elements {
            problem,
            spacing,
            place: [1e-3 * x, 1e-3 * y],
            displacement: [u_x / MICROMETRES, u_y / MICROMETRES],
        })
        .collect())
}

/// Comparison of a plate with finite elements.
#[derive(Debug, Clone, Copy)]
struct Compared {
    /// L2 norm of the differences of u_x and u_y over the norm by finite elements.
    difference: [f64; 2],
    /// Displacement u_x at the right end of the row above the middle, m.
    middle: f64,
    /// Force of the first load, N.
    force: f64,
}

impl Compared {
    fn with_elements(
        solution: &Solution,
        spacing: f64,
        elements: &[Elements],
        (problem, label): (&str, f64),
    ) -> anyhow::Result<Self> {
        let (mut apart, mut size) = ([0.0; 2], [0.0; 2]);
        let of = |it: &&Elements| it.problem == problem && it.spacing == label;
        for element in elements.iter().filter(of) {
            let found = displacement_at(solution, element.place);
            for axis in 0..2 {
                apart[axis] += (found[axis] - element.displacement[axis]).powi(2);
                size[axis] += element.displacement[axis].powi(2);
            }
        }
        let end = [0.5 * (SIDE - spacing), 0.5 * spacing];
        let last = solution.outcome.history.last();
        Ok(Self {
            difference: [0, 1].map(|axis| (apart[axis] / size[axis]).sqrt()),
            middle: displacement_at(solution, end)[0],
            force: last.context("the run has no state")?.reaction,
        })
    }
}

/// Plot of u_A over Poisson's ratio.
fn plot(table: &Table) -> anyhow::Result<Plot> {
    let (along_x, along_y) = ("d=2, along=x", "d=2, along=y");
    let series = vec![
        Series::dashes("closed form", Colour::Black, table.known("nu", along_y)?),
        Series::line("along y", Colour::Blue, table.computed("nu", along_y)?),
        Series::circles("along x", Colour::Vermilion, table.computed("nu", along_x)?),
    ];
    let title = "Plate in tension: displacement across the load";
    let axes = ["Poisson's ratio", "u_A, um"];
    Ok(Plot::new(&table.heading.name, title, axes, series))
}
