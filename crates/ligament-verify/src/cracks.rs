//! Plates of imaginary elements with cracks and a hole in tension (MBB-PD section 4.3).

use std::collections::BTreeMap;

use anyhow::{Context, bail};
use ligament::run::Solution;
use ligament_analysis::fields::point_damage;

use super::experiment::{Compute, Experiment, Findings};
use super::published::published;
use super::table::{Extent, Labels};
use super::trial::{Memory, Template, Trial, template};
use ligament_plot::plots::{Colour, Plot, Series};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "cracks",
    title: "Cracks in plates of imaginary elements",
    source: "linear elastic fracture mechanics, independent calculation; Masoumi, Ravandi and Salehi (MBB-PD), section 4.3",
    setup: "Plate 100 x 100 x 1 mm, E = 65.8 GPa, nu = 0.3, G_c = 6137 J/m^2, plane stress, m = 3, pulled by u_y of the upper row, the \
            lower one held in y; no failure within three rows of either. A central crack of 10 mm across the load (central), cracks of 10 \
            mm from the middle of the left, right and upper side (three), a hole of 10 x 10 mm (hole). The exact path until the load \
            has fallen to 0.8 of its largest (0.5 with the printed criteria). Criteria: mixed-mode, the repaired one; printed-opening \
            (C.3, C.4) and printed-mixed (22 to 24, C.9, C.10), with the angle of C.10 by the differences of the ends (A.5), both \
            on the repaired elasticity. XFEM of the paper is in its figures alone: fracture mechanics stands in its place.",
    cases: &[&CENTRAL, &THREE, &HOLE, &STEPPED],
    compute: Compute::Code(compute),
};

static CENTRAL: Template = template!("mbb-central-crack/case.toml");
static THREE: Template = template!("three-cracks/case.toml");
static HOLE: Template = template!("square-hole/case.toml");

static STEPPED: Template = template!("mbb-central-crack/stepped.toml");

/// Side of the plate, m.
const SIDE: f64 = 0.1;

/// Section of the plate, m^2.
const SECTION: f64 = SIDE * 1e-3;

const MEGAPASCALS: f64 = 1e-6;

/// Results of a run for the tables.
#[derive(Debug, Clone)]
struct Failure {
    /// Stress on the whole section at the first breakage, MPa; unknown for true strains.
    first: f64,
    /// Largest stress, MPa.
    peak: f64,
    /// Displacement of the upper row at the largest stress, mm.
    at_peak: f64,
    /// Share of the broken bonds that do not cross the expected lines of the cracks.
    beside: f64,
    /// Largest difference of the damage between a point and its mirror images.
    asymmetry: f64,
    /// Strain (%) and stress (MPa) of a test with increasing displacement.
    curve: Vec<[f64; 2]>,
}

/// Curves with their names.
type Curves = Vec<(String, Vec<[f64; 2]>)>;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let (mut runs, mut curves) = (Memory::default(), Curves::new());
    let mut mixed = |labels: Labels<'_>| failure(&mut runs, &mut curves, labels, "mixed-mode");
    let peaks = published!("mbb-peaks").judge(extent, |labels| {
        let failure = mixed(labels)?;
        stress(&failure, labels)
    })?;
    let griffith = published!("mbb-griffith").judge(extent, |labels| Ok(mixed(labels)?.peak))?;
    let repaired = drawn("mbb-fracture", "Plates with cracks and a hole", curves);
    let mut curves = Curves::new();
    let mut by_criterion = |labels: Labels<'_>| {
        let criterion = labels.text("criterion")?;
        failure(&mut runs, &mut curves, labels, criterion)
    };
    let printed = published!("mbb-printed").judge(extent, |labels| {
        let failure = by_criterion(labels)?;
        stress(&failure, labels)
    })?;
    let printed_griffith = published!("mbb-printed-griffith")
        .judge(extent, |labels| Ok(by_criterion(labels)?.peak))?;
    let paths = published!("mbb-paths").judge(extent, |labels| {
        let failure = by_criterion(labels)?;
        match labels.text("of")? {
            "beside" => Ok(failure.beside),
            "asymmetry" => Ok(failure.asymmetry),
            other => bail!("of is `beside` or `asymmetry`, not `{other}`"),
        }
    })?;
    let compared = drawn(
        "mbb-printed",
        "Plates with cracks and a hole by criterion",
        curves,
    );
    let mut stepped = Memory::default();
    let true_strains = published!("mbb-true-strains").judge(extent, |labels| {
        let failure = in_steps(&mut stepped, labels.text("strains")?)?;
        match labels.text("of")? {
            "stress" => Ok(failure.peak),
            "displacement" => Ok(failure.at_peak),
            other => bail!("of is `stress` or `displacement`, not `{other}`"),
        }
    })?;
    Ok(Findings {
        tables: vec![
            peaks,
            griffith,
            printed,
            printed_griffith,
            paths,
            true_strains,
        ],
        plots: vec![repaired, compared],
        ..Findings::default()
    })
}

fn drawn(name: &str, title: &str, curves: Curves) -> Plot {
    let colours = [
        Colour::Blue,
        Colour::Sky,
        Colour::Vermilion,
        Colour::Green,
        Colour::Orange,
        Colour::Purple,
    ];
    let series = curves.into_iter().zip(colours);
    Plot::new(
        name,
        title,
        ["strain, %", "stress on the whole section, MPa"],
        series
            .map(|((label, curve), colour)| Series::curve(label, colour, curve))
            .collect(),
    )
}

fn stress(failure: &Failure, labels: Labels<'_>) -> anyhow::Result<f64> {
    match labels.text("of")? {
        "first" => Ok(failure.first),
        "peak" => Ok(failure.peak),
        other => bail!("of is `first` or `peak`, not `{other}`"),
    }
}

/// The plate with a criterion and a spacing `d`, mm.
pub(super) fn trial(case: &str, d: f64, criterion: &str) -> anyhow::Result<Trial> {
    let cells = (1e3 * SIDE / d).round() as u32;
    // The load along the path of the printed criteria falls and rises again.
    let fraction = if criterion == "mixed-mode" { 0.8 } else { 0.5 };
    Ok((template(case)?.trial())
        .on_lattice([cells, cells], 1e-3 * d)
        .set("fracture.stop.load_fraction", fraction)
        .set("fracture.criterion.0.kind", criterion))
}

/// Results of the exact path of a plate with a criterion; curves of new runs are appended.
fn failure(
    runs: &mut Memory<Failure>,
    curves: &mut Curves,
    labels: Labels<'_>,
    criterion: &str,
) -> anyhow::Result<Failure> {
    let (case, d) = (labels.text("case")?, labels.number("d")?);
    let trial = trial(case, d, criterion)?;
    runs.reading(&trial, |it| {
        let failure = Failure::from_solution(it, lines(case))?;
        curves.push((
            format!("{case}, {criterion}, {d} mm"),
            failure.curve.clone(),
        ));
        Ok(failure)
    })
}

/// The central crack at d = 2 mm in load steps of 0.5 um, with strains over distances before or after the deformation.
fn in_steps(runs: &mut Memory<Failure>, strains: &str) -> anyhow::Result<Failure> {
    let steps: Vec<f64> = (0..70).map(|step| 0.175 + 5e-4 * f64::from(step)).collect();
    let trial = (STEPPED.trial())
        .on_lattice([50, 50], 2e-3)
        .set("fracture.steps", steps)
        .set("fracture.stop.load_fraction", 0.5)
        .set("model.strains", strains);
    runs.reading(&trial, |it| Failure::from_solution(it, lines("central")))
}

/// Heights of the expected lines of a plate's cracks, m.
fn lines(case: &str) -> &'static [f64] {
    match case {
        "hole" => &[-0.005, 0.005],
        _ => &[0.0],
    }
}

fn template(case: &str) -> anyhow::Result<&'static Template> {
    match case {
        "central" => Ok(&CENTRAL),
        "three" => Ok(&THREE),
        "hole" => Ok(&HOLE),
        other => bail!("no plate `{other}`"),
    }
}

impl Failure {
    fn from_solution(solution: &Solution, lines: &[f64]) -> anyhow::Result<Self> {
        let outcome = &solution.outcome;
        let stress = |force: f64| MEGAPASCALS * force / SECTION;
        let peak = outcome.peak().context("the run has no state at rest")?;
        let curve = outcome.envelope();
        Ok(Self {
            first: (outcome.first_break).map_or(f64::NAN, |it| stress(it.reaction)),
            peak: stress(peak.reaction),
            at_peak: 1e3 * peak.displacement,
            beside: beside(solution, lines),
            asymmetry: asymmetry(solution),
            curve: (curve.iter())
                .map(|point| [100.0 * point.displacement / SIDE, stress(point.reaction)])
                .collect(),
        })
    }
}

/// Share of the broken bonds that cross none of the horizontal lines at some heights, m.
fn beside(solution: &Solution, lines: &[f64]) -> f64 {
    let (system, intact) = (solution.model.plane(), &solution.outcome.state.intact);
    let height = |point: u32| system.cloud.positions[point as usize][1];
    let crosses = |ends: &[u32; 2]| {
        let [a, b] = ends.map(height);
        lines.iter().any(|line| (a - line) * (b - line) < 0.0)
    };
    let bonds = system.bonds.ends.iter().zip(intact);
    let broken: Vec<bool> = bonds
        .filter(|(_, is_intact)| !**is_intact)
        .map(|(ends, _)| crosses(ends))
        .collect();
    let off = broken.iter().filter(|crosses| !**crosses).count();
    off as f64 / broken.len() as f64
}

/// Largest difference of the damage between a point and its mirror images about both axes.
fn asymmetry(solution: &Solution) -> f64 {
    let (system, intact) = (solution.model.plane(), &solution.outcome.state.intact);
    let half = 0.5 * system.cloud.cell_size(0)[0];
    let places = system.cloud.positions.iter();
    let damages: BTreeMap<[i64; 2], f64> = (0..)
        .zip(places)
        .map(|(point, at)| {
            let place = at.map(|coordinate| (coordinate / half).round() as i64);
            (place, point_damage(&**system, intact, point))
        })
        .collect();
    let differences = damages.iter().flat_map(|(&[x, y], damage)| {
        let images = [[-x, y], [x, -y]].map(|image| damages.get(&image));
        images.map(|image| image.map_or(f64::NAN, |image| (damage - image).abs()))
    });
    differences.fold(0.0, f64::max)
}
