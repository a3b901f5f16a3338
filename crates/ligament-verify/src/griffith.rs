//! Cracks controlled by the fracture energy: failure stress of a plate with a central crack, energy and straightness of a crack.

use std::f64::consts::PI;

use anyhow::{Context, ensure};

use super::crack_path::ends;
use super::experiment::{Compute, Experiment, Findings};
use super::published::published;
use super::table::{Extent, LabelError, Labels, Table};
use super::trial::{Memory, StoredMesh, Template, Trial, stored_mesh, template};
use ligament::run::Solution;
use ligament_plot::plots::{Colour, Mark, Plot, Series};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "griffith",
    title: "Cracks driven by the fracture energy",
    source: "linear elastic fracture mechanics (Griffith; Tada, Paris and Irwin)",
    setup: "Plate 100 mm wide and 200 mm high, t = 10 mm, E = 15 GPa, G_c = 20 J/m^2, plane stress; on a lattice, or on \
            irregular meshes of 2,231 to 4,038 points that are finer along the crack. A central crack of half-length a = \
            15.2 mm, a line that bonds do not cross, under equal forces on the ends: the largest force of the exact path \
            over that at which K = sqrt(E G_c). And an edge crack of 30 mm, opened until the plate is in two.",
    cases: &[&ON_MESH, &ON_LATTICE, &MODE_ONE],
    compute: Compute::Code(compute),
};

static ON_MESH: Template = template!("central-crack/case.toml");
static ON_LATTICE: Template = template!("central-crack/lattice.toml");
static MODE_ONE: Template = template!("central-crack/mode-one.toml");

/// Meshes by their size along the crack, mm.
static MESHES: [(f64, StoredMesh); 3] = [
    (2.0, stored_mesh!("central-crack-2mm.msh")),
    (1.4, stored_mesh!("central-crack-1.4mm.msh")),
    (1.0, stored_mesh!("central-crack-1mm.msh")),
];

/// Half of the plate's width, W, m.
const HALF_WIDTH: f64 = 0.05;

/// Half of the plate's height, m.
const HALF_HEIGHT: f64 = 0.1;

/// Thickness t of the plate, m.
const THICKNESS: f64 = 0.01;

/// Half-length a of the central crack, m.
const HALF_LENGTH: f64 = 0.0152;

/// Position of the tip of the edge crack, m.
const EDGE_TIP: f64 = -0.02;

/// Shift of the part of the line whose crossings are counted, m. Bonds of a lattice cross at the points of the lattice, and the ends of
/// that part should be between them.
const ASIDE: f64 = 1.1e-4;

/// Young's modulus E, Pa.
const YOUNG: f64 = 15e9;

/// Fracture energy G_c, J/m^2.
const FRACTURE_ENERGY: f64 = 20.0;

/// Distance from the crack within which the horizon is averaged: half the height of the fine strip of the meshes, m.
const STRIP: f64 = 0.005;

/// Largest relative error of delta/a in the label of an entry.
const LABEL_TOLERANCE: f64 = 5e-3;

/// Results of a run of the edge crack for the tables.
#[derive(Debug, Clone, Copy)]
struct Separation {
    /// Energy released by the breakages per new surface, over G_c.
    work: f64,
    /// Energy of the broken bonds at their limits per new surface, over G_c.
    energy: f64,
    /// Largest distance of a broken bond's midpoint from the line of the crack, over its horizon.
    deviation: f64,
}

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let strength = published!("griffith").judge(extent, relative_strength)?;
    let crossing = published!("fracture-energy-crossing").judge(extent, crossing_energy)?;
    let mut memory = Memory::default();
    let mut separated = |labels: Labels<'_>| -> anyhow::Result<Separation> {
        let trial = with_labels(MODE_ONE.trial(), labels)?.on_mesh(mesh(labels)?);
        memory.reading(&trial, Separation::from_solution)
    };
    let work = published!("fracture-energy-released")
        .judge(extent, |labels| Ok(separated(labels)?.work))?;
    let energy = published!("fracture-energy-separation")
        .judge(extent, |labels| Ok(separated(labels)?.energy))?;
    let deviation =
        published!("mode-one").judge(extent, |labels| Ok(separated(labels)?.deviation))?;
    let plots = vec![plot(&strength)?];
    let tables = vec![strength, crossing, work, energy, deviation];
    Ok(Findings {
        tables,
        plots,
        ..Findings::default()
    })
}

/// Curves of computed strengths, each with the labels of its entries.
const CURVES: [(&str, Colour, &str); 6] = [
    (
        "lattice, bbpd",
        Colour::Sky,
        "body=lattice, law=bbpd, lambda=4",
    ),
    (
        "lattice, nhpd",
        Colour::Blue,
        "body=lattice, law=nhpd, lambda=4, nu=0.2",
    ),
    ("mesh, bbpd", Colour::Orange, "body=mesh, law=bbpd"),
    (
        "mesh, nhpd, energy",
        Colour::Vermilion,
        "body=mesh, nu=0.2, criterion=bond-energy",
    ),
    (
        "mesh, nhpd, stretch",
        Colour::Purple,
        "body=mesh, nu=0.2, criterion=critical-stretch",
    ),
    (
        "5/3 mm, m = 2 to 6",
        Colour::Green,
        "size=5/3, law=nhpd, nu=1/3",
    ),
];

/// Plot of strength over the horizon; one lattice has a mark of its own, because its horizon factor varies.
fn plot(strength: &Table) -> Result<Plot, LabelError> {
    let lefm = vec![[0.1, 1.0], [0.7, 1.0]];
    let mut series = vec![Series::dashes("LEFM", Colour::Black, lefm)];
    for (label, colour, of) in CURVES {
        let mark = match of.starts_with("size=") {
            true => Mark::Circles,
            false => Mark::Line,
        };
        let points = strength.computed("delta/a", of)?;
        series.push(Series::new(label, mark, colour, points));
    }
    let title = "Failure stress of a plate with a central crack";
    let axes = [
        "horizon / half-length of the crack",
        "failure stress over LEFM",
    ];
    Ok(Plot::new("griffith", title, axes, series))
}

/// Failure stress of a plate of width 2W with a central crack of length 2a:
///
/// sigma = sqrt(E G_c/(pi a))/F, F = (1 - 0.025 (a/W)^2 + 0.06 (a/W)^4) sqrt(sec(pi a/(2W)))
///
/// (Tada 2000, section 2.1: error of 0.1 % for a long plate).
fn failure_stress() -> f64 {
    let ratio = HALF_LENGTH / HALF_WIDTH;
    let width = 1.0 - 0.025 * ratio.powi(2) + 0.06 * ratio.powi(4);
    let secant = 1.0 / (0.5 * PI * ratio).cos();
    (YOUNG * FRACTURE_ENERGY / (PI * HALF_LENGTH)).sqrt() / (width * secant.sqrt())
}

/// The trial with law, Poisson's ratio, criterion and horizon factor of an entry; the law is unchanged where its table has none.
fn with_labels(trial: Trial, labels: Labels<'_>) -> anyhow::Result<Trial> {
    let trial = trial
        .set("material.poisson", labels.number("nu")?)
        .set("model.horizon_factor", labels.number("lambda")?)
        .set("fracture.criterion.0.kind", labels.text("criterion")?);
    Ok(match labels.text("law") {
        Ok(law) => trial.set("model.law", law),
        Err(_) => trial,
    })
}

fn mesh(labels: Labels<'_>) -> anyhow::Result<&'static StoredMesh> {
    let size = labels.number("size")?;
    let found = MESHES.iter().find(|(of_mesh, _)| *of_mesh == size);
    let (_, mesh) = found.with_context(|| format!("no mesh of {size} mm"))?;
    Ok(mesh)
}

/// Runs the plate with a central crack, on a lattice or a mesh; without the crack if `intact`, only for its model.
fn central_crack(labels: Labels<'_>, intact: bool) -> anyhow::Result<Solution> {
    let is_lattice = labels.text("body")? == "lattice";
    let template = if is_lattice { &ON_LATTICE } else { &ON_MESH };
    let mut trial = with_labels(template.trial(), labels)?;
    if intact {
        // A line beside the plate cuts no bond, and a load that breaks no bond ends the run at once.
        trial = trial
            .set("precrack.0.points", [[1.0, 0.0], [2.0, 0.0]])
            .set("load.0.force_per_length.y", 1.0)
            .set("load.1.force_per_length.y", -1.0);
    }
    if !is_lattice {
        return trial.on_mesh(mesh(labels)?).solve();
    }
    let columns = (2e3 * HALF_WIDTH / labels.number("size")?).round();
    let rows = columns * HALF_HEIGHT / HALF_WIDTH;
    let spacing = 2.0 * HALF_WIDTH / columns;
    trial
        .on_lattice([columns as u32, rows as u32], spacing)
        .solve()
}

fn relative_strength(labels: Labels<'_>) -> anyhow::Result<f64> {
    let solution = central_crack(labels, false)?;
    let (labelled, found) = (labels.number("delta/a")?, horizon(&solution) / HALF_LENGTH);
    ensure!(
        (found - labelled).abs() < LABEL_TOLERANCE,
        "delta/a is {found:.3}, its label says {labelled}"
    );
    let peak = solution
        .outcome
        .peak()
        .context("the run has no state at rest")?;
    Ok(peak.reaction / (2.0 * HALF_WIDTH * THICKNESS) / failure_stress())
}

/// Mean horizon of the points along the crack, m.
fn horizon(solution: &Solution) -> f64 {
    let model = &solution.model;
    let cloud = &model.plane().cloud;
    let near = cloud.positions.iter().zip(&model.fixed.horizon);
    let near = near.filter(|([_, y], _)| (y + cloud.origin[1]).abs() <= STRIP);
    let (sum, count) = near.fold((0.0, 0.0), |(sum, count), (_, h)| (sum + h, count + 1.0));
    sum / count
}

/// Energy at the limits of the bonds across the middle part of the line y = 0 of a plate without crack, over G_c times the surface t dx of
/// that part.
fn crossing_energy(labels: Labels<'_>) -> anyhow::Result<f64> {
    let solution = central_crack(labels, true)?;
    let half = 0.5 * HALF_WIDTH;
    let crosses = |bond: usize| {
        let [[x, y], [other_x, other_y]] = ends(&solution.model, bond);
        let at = x + (other_x - x) * y / (y - other_y);
        y * other_y < 0.0 && (at - ASIDE).abs() < half
    };
    let bonds = (0..solution.model.plane().bonds.len()).filter(|&bond| crosses(bond));
    let surface = 2.0 * half * THICKNESS;
    Ok(energy_at_limits(&solution, bonds) / (FRACTURE_ENERGY * surface))
}

/// Sum of 1/2 R s_0^2, R = Omega alpha V_A V_B k_n l, J.
fn energy_at_limits(solution: &Solution, bonds: impl Iterator<Item = usize>) -> f64 {
    let model = &solution.model;
    let limits = &model.criteria.list[0].limit;
    bonds
        .map(|bond| 0.5 * model.plane().rigidities.axial[bond] * limits[bond].powi(2))
        .sum()
}

impl Separation {
    fn from_solution(solution: &Solution) -> anyhow::Result<Self> {
        let intact = &solution.outcome.state.intact;
        let broken: Vec<usize> = (0..intact.len()).filter(|&bond| !intact[bond]).collect();
        let reached = broken.iter().map(|&bond| {
            let [[x, _], [other_x, _]] = ends(&solution.model, bond);
            0.5 * (x + other_x)
        });
        let far = reached.fold(EDGE_TIP, f64::max);
        ensure!(
            HALF_WIDTH - far < horizon(solution),
            "the crack ends at x = {far:.4} m, inside the plate"
        );
        let separating = FRACTURE_ENERGY * (HALF_WIDTH - EDGE_TIP) * THICKNESS;
        let last = solution.outcome.history.last();
        let horizons = &solution.model.plane().bonds.horizon;
        let deviations = broken.iter().map(|&bond| {
            let [[_, y], [_, other_y]] = ends(&solution.model, bond);
            0.5 * (y + other_y).abs() / horizons[bond]
        });
        Ok(Self {
            work: last.context("the run has no state")?.released_energy / separating,
            energy: energy_at_limits(solution, broken.iter().copied()) / separating,
            deviation: deviations.fold(0.0, f64::max),
        })
    }
}
