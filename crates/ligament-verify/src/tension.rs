//! An orthotropic lamina with a hole in tension, compared with finite elements (OMPPD Figs 16, 17).

use super::case_run::{CaseRun, ResultCache, displacement_at, displacements};
use super::experiment::{Compute, Experiment, Findings};
use super::published::known_table;
use super::table::Extent;
use ligament::run::Solution;
use ligament_output::csv::read::CsvTable;
use ligament_plot::plots::{Colour, Plot, Series};

/// Experiment of the plate in tension.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "tension",
    title: "Orthotropic lamina with a hole in tension",
    source: "finite elements, as in Diana and Casolo (OMPPD), Figs 16 and 17",
    setup: "The lamina of the natural frequencies (2,992 points, m = 3.2), u_x = -0.5 and 0.5 mm in the three \
            columns at its ends, free along y (u_y is given less its mean over all points). Displacements of the \
            upper row of cells against an independent solution by finite elements at the same points.",
    cases: &[CASE],
    compute: Compute::Code(compute),
};

pub(super) const CASE: &str = "cases/verification/lamina-tension.toml";

/// Table of angle (degrees), x, y (m), u_x, u_y (m) by finite elements along the upper edge.
const ELEMENTS: &str = include_str!("../../../tests/reference/fem-hole-edge.csv");

const MILLIMETRES: f64 = 1e3;

/// Displacements along the upper edge at one angle of the axes.
#[derive(Debug, Clone)]
struct Edge {
    angle: f64,
    /// Coordinates x of the points, m.
    along: Vec<f64>,
    /// Displacements by finite elements, m.
    elements: Vec<[f64; 2]>,
    /// Displacements by the lattice, m.
    lattice: Vec<[f64; 2]>,
}

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let elements = CsvTable::parse("fem-hole-edge.csv", ELEMENTS)?;
    let elements = elements.numbers(["zeta", "x", "y", "ux", "uy"])?;
    let mut cache = ResultCache::default();
    let mut edges: Vec<Edge> = Vec::new();
    let table = known_table("omppd-tension")?.judge(extent, |labels| {
        let angle = labels.number("angle")?;
        let case_run = CaseRun::from_file(CASE)?.set("material.angle", angle.to_radians());
        let edge = cache.reading(&case_run, |it| {
            let edge = Edge::from_solution(it, &elements, angle);
            edges.push(edge.clone());
            Ok(edge)
        })?;
        Ok(edge.difference(usize::from(labels.text("component")? == "u_y")))
    })?;
    Ok(Findings {
        tables: vec![table],
        plots: vec![plot(&edges, 0), plot(&edges, 1)],
        ..Findings::default()
    })
}

impl Edge {
    fn from_solution(solution: &Solution, elements: &[[f64; 5]], angle: f64) -> Self {
        let across = displacements(solution).map(|[_, v]| v);
        let mean = across.sum::<f64>() / solution.model.plane().cloud.len() as f64;
        let mut edge = Self {
            angle,
            along: Vec::new(),
            elements: Vec::new(),
            lattice: Vec::new(),
        };
        for [_, x, y, along, across] in elements.iter().filter(|row| row[0] == angle) {
            let [u_x, u_y] = displacement_at(solution, [*x, *y]);
            edge.along.push(*x);
            edge.elements.push([*along, *across]);
            edge.lattice.push([u_x, u_y - mean]);
        }
        edge
    }

    /// Largest difference of a component over its largest value by finite elements; NaN without points.
    fn difference(&self, component: usize) -> f64 {
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::NAN, f64::max);
        let pairs = || self.elements.iter().zip(&self.lattice);
        largest(&mut pairs().map(|(one, other)| (one[component] - other[component]).abs()))
            / largest(&mut pairs().map(|(one, _)| one[component].abs()))
    }

    fn curve(&self, of: &[[f64; 2]], component: usize) -> Vec<[f64; 2]> {
        let points = self.along.iter().zip(of);
        points
            .map(|(x, u)| [MILLIMETRES * x, MILLIMETRES * u[component]])
            .collect()
    }
}

fn plot(edges: &[Edge], component: usize) -> Plot {
    let colours = [
        Colour::Blue,
        Colour::Vermilion,
        Colour::Green,
        Colour::Orange,
        Colour::Purple,
    ];
    let mut series = Vec::new();
    for (edge, colour) in edges.iter().zip(colours) {
        let label = format!("{} degrees", edge.angle);
        let known = if series.is_empty() {
            "finite elements"
        } else {
            ""
        };
        let lattice = edge.curve(&edge.lattice, component);
        let elements = edge.curve(&edge.elements, component);
        series.push(Series::curve(label, colour, lattice));
        series.push(Series::dashes(known, Colour::Black, elements));
    }
    let name = ["u_x", "u_y"][component];
    Plot::new(
        format!("omppd-tension-{name}"),
        format!("Upper edge of the lamina in tension: {name}"),
        ["x, mm", &format!("{name}, mm")],
        series,
    )
}
