//! Cracks that branch.

use anyhow::bail;
use ligament::Model;
use ligament_analysis::history::BreakRecord;

use super::fast_crack::{Break, breaks, largest_speed, rayleigh};
use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::{Extent, Labels};
use crate::trial::{Memory, Template, Trial, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "motion_branching",
    title: "Cracks that branch",
    source: "benchmarks of Bobaru and Zhang 2015, of Ha and Bobaru 2010 and of Borden 2012; speed of Rayleigh waves",
    setup: "Plate 100 x 40 mm with a notch of 50 mm in the middle of its left side, plane stress, a stress on its upper and lower edge from the start on, \
            `critical-stretch`. Borden: E = 32 GPa, rho = 2450 kg/m^3, G_c = 3 J/m^2, 1 MPa, 70 us. Bobaru: E = 72 GPa, rho = 2440 kg/m^3, G_c = 3.8 J/m^2, \
            2 MPa, 43 us. Ha: the same with 135 J/m^2 and 12 MPa. Poisson's ratio is 1/3 with bbpd and 0.2 with the other laws. A crack branches where \
            bonds break more than 2.5 mm above and below the line of the notch; place and time are those of the first one. Speeds are those of the broken bond \
            farthest from the notch, over 5 us.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("branching/case.toml");

/// Tip of the notch, m.
const TIP: [f64; 2] = [0.05, 0.02];

/// Distance from the line of the notch beyond which a broken bond belongs to a branch, m.
const BESIDE: f64 = 2.5e-3;

/// Duration over which a speed is read, s.
const WINDOW: f64 = 5e-6;

/// What a plate is made of and loaded by: E (Pa), density (kg/m^3), fracture energy (J/m^2), stress (MPa), duration (s).
type Set = [f64; 5];

/// Result of a run.
#[derive(Debug, Clone, Copy)]
struct Reading {
    /// Numbers of cracks: 2 with branches on both sides of the line, otherwise 1.
    cracks: f64,
    /// First broken bond of a branch; without a branch not a number.
    branch: Break,
    /// Largest speed over that of Rayleigh waves.
    speed: f64,
}

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let sets = published!("motion-branching").judge(extent, |labels| entry(labels, &mut memory))?;
    let spread = published!("motion-branching-spread")
        .judge(extent, |labels| spread(labels, &mut memory))?;
    let laws =
        published!("motion-branching-laws").judge(extent, |labels| entry(labels, &mut memory))?;
    Ok(Findings {
        tables: vec![sets, spread, laws],
        ..Findings::default()
    })
}

fn entry(labels: Labels<'_>, memory: &mut Memory<Reading>) -> anyhow::Result<f64> {
    let mut set = set(labels.text("set")?)?;
    if let Ok(stress) = labels.number("stress, MPa") {
        set[3] = stress;
    }
    let law = labels.text("law").unwrap_or("bbpd");
    let size = ["h, mm", "H, mm"].map(|key| labels.number(key));
    let [spacing, horizon] = size;
    let reading = read(memory, set, law, [spacing?, horizon?])?;
    Ok(match labels.text("of")? {
        "cracks" => reading.cracks,
        "time, us" => 1e6 * reading.branch.time,
        "speed over c_R" => reading.speed,
        other => bail!("no quantity `{other}`"),
    })
}

/// Largest less smallest place of branching over meshes and horizons, mm.
fn spread(labels: Labels<'_>, memory: &mut Memory<Reading>) -> anyhow::Result<f64> {
    let set = set(labels.text("set")?)?;
    let [mut least, mut most] = [f64::INFINITY, f64::NEG_INFINITY];
    for size in [[0.5, 1.5], [0.5, 1.0], [0.25, 1.0], [0.25, 0.75]] {
        let place = 1e3 * read(memory, set, "bbpd", size)?.branch.at[0];
        (least, most) = (least.min(place), most.max(place));
    }
    Ok(most - least)
}

fn set(name: &str) -> anyhow::Result<Set> {
    Ok(match name {
        "Borden" => [32e9, 2450.0, 3.0, 1.0, 70e-6],
        "Bobaru" => [72e9, 2440.0, 3.8, 2.0, 43e-6],
        "Ha" => [72e9, 2440.0, 135.0, 12.0, 43e-6],
        other => bail!("no plate of `{other}`"),
    })
}

/// Reading of a plate for a law and the spacing and the horizon of the points, mm.
fn read(
    memory: &mut Memory<Reading>,
    set: Set,
    law: &str,
    [spacing, horizon]: [f64; 2],
) -> anyhow::Result<Reading> {
    let poisson = if law == "bbpd" { 1.0 / 3.0 } else { 0.2 };
    let trial = plate(set, [spacing, horizon])
        .set("model.law", law)
        .set("material.poisson", poisson);
    let [young, density, ..] = set;
    let shear = (young / (2.0 * (1.0 + poisson)) / density).sqrt();
    // Plane stress is plane strain with another ratio.
    let limit = shear * rayleigh(poisson / (1.0 + poisson));
    memory.reading_with_breakages(&trial, |solution, records| {
        Ok(reading(&solution.model, records, limit))
    })
}

fn plate(set: Set, [spacing, horizon]: [f64; 2]) -> Trial {
    let [young, density, toughness, stress, duration] = set;
    let across = |length: f64| (length / spacing).round() as u32;
    let force = 1e3 * stress;
    CASE.trial()
        .on_lattice([across(100.0), across(40.0)], 1e-3 * spacing)
        .set("model.horizon_factor", horizon / spacing)
        .set("material.young", young)
        .set("material.density", density)
        .set("material.fracture_energy", toughness)
        .set("load.0.force_per_length.y", force)
        .set("load.1.force_per_length.y", -force)
        .set("motion.duration", duration)
}

fn reading(model: &Model, records: &[BreakRecord], limit: f64) -> Reading {
    let all = breaks(model, records);
    let side = |sign: f64| {
        let mut beside = all.iter();
        beside.find(|it| sign * (it.at[1] - TIP[1]) > BESIDE)
    };
    let none = Break {
        time: f64::NAN,
        at: [f64::NAN; 2],
    };
    let branches = side(1.0).zip(side(-1.0));
    let speed = largest_speed(all.iter(), TIP, WINDOW) / limit;
    Reading {
        cracks: if branches.is_some() { 2.0 } else { 1.0 },
        branch: branches.map_or(none, |(upper, _)| *upper),
        speed,
    }
}
