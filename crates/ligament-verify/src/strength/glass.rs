//! The challenge problems of Kamarei and others for glass, as far as small strains and moderate bodies allow.

use std::f64::consts::PI;

use anyhow::{Context, bail};
use ligament::run::Solution;
use ligament_analysis::driver::LoadPoint;
use ligament_run::summary::DROP;

use super::cube::cube;
use super::uniform::{SQUARE, extremes, of_cube};
use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::{Extent, Labels};
use crate::trial::{Memory, StoredMesh, Template, Trial, stored_mesh, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "strength_glass",
    title: "Challenge problems for glass",
    source: "Kamarei, Zeng, Dolbow and Lopez-Pamies 2026, \"Nine circles of elastic brittle fracture: A series of challenge problems to assess \
             fracture models\"; linear elastic fracture mechanics (Tada, Paris and Irwin)",
    setup: "Soda-lime glass: E = 70 GPa, nu = 0.22, G_c = 10 N/m, strengths of 40 MPa under uniaxial, 27 under equibiaxial and 27.8 under hydrostatic \
            tension and 1000 under uniaxial compression; l_ch = E G_c/F_t^2 = 0.44 mm. NHPD, lambda = 3. Uniaxial tension, biaxial tension and torsion of a \
            thin tube are states of plane stress and run as the squares of `strength_squares`, hydrostatic tension as the cube of \
            `strength_cube`, by first failure. Single edge notch: strip 5 x 25 mm, horizon 0.15 mm at the tip; pure shear: strip 50 x 5 mm between \
            grips with a crack of 10 mm; double cantilever beam: arms of 10 x 2.5 mm, crack of 25 mm; these three in plane stress with `rankine` and \
            straight softening. Not run: indentation (contact with a ball, in space, on a horizon below 0.4 mm: some million points), and \
            what needs large strains of a nearly incompressible elastomer, which the laws here do not have (poker chip, trousers, and all \
            problems in polyurethane).",
    cases: &[&SQUARE, &NOTCH, &STRIP, &BEAM],
    compute: Compute::Code(compute),
};

static NOTCH: Template = template!("verification/strength-glass-edge-crack.toml");
static STRIP: Template = template!("verification/strength-glass-strip.toml");
static BEAM: Template = template!("verification/strength-glass-double-cantilever.toml");
static NOTCH_MESH: StoredMesh = stored_mesh!("glass-edge-crack.msh");
static STRIP_MESH: StoredMesh = stored_mesh!("glass-strip.msh");
static BEAM_MESH: StoredMesh = stored_mesh!("glass-double-cantilever.msh");

const YOUNG: f64 = 70e9;
const POISSON: f64 = 0.22;
const FRACTURE_ENERGY: f64 = 10.0;

/// Tensile and compressive strength, Pa.
const TENSILE: f64 = 40e6;
const COMPRESSIVE: f64 = 1000e6;

/// Width of the strip with the single edge notch, m.
const WIDTH: f64 = 5e-3;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let uniform =
        published!("strength-glass").judge(extent, |labels| strength(labels, &mut memory))?;
    let notch = published!("strength-glass-notch").judge(extent, notched)?;
    let mut memory = Memory::default();
    let cracks = published!("strength-glass-cracks").judge(extent, |labels| {
        match labels.text("problem")? {
            "pure shear" => memory.reading(&STRIP.trial().on_mesh(&STRIP_MESH), |it| {
                Ok(1e6 * peak(it)?.displacement)
            }),
            "double cantilever beam" => memory.reading(&BEAM.trial().on_mesh(&BEAM_MESH), |it| {
                Ok(peak(it)?.reaction)
            }),
            other => bail!("no problem `{other}`"),
        }
    })?;
    Ok(Findings {
        tables: vec![uniform, notch, cracks],
        ..Findings::default()
    })
}

/// Strength under a uniform stress, MPa: the smallest over meshes and angles.
fn strength(labels: Labels<'_>, memory: &mut Memory<[f64; 2]>) -> anyhow::Result<f64> {
    let criterion = labels.text("criterion")?;
    let square = || glass(SQUARE.trial(), criterion);
    let mut under = |principal: [f64; 2], unit: f64| {
        let [smallest, _] = extremes(memory, square, principal.map(|it| 2.0 * it * unit))?;
        Ok(2e-6 * smallest * unit)
    };
    match labels.text("stress")? {
        "uniaxial tension" => under([1.0, 0.0], TENSILE),
        "biaxial tension" => under([1.0, 1.0], TENSILE),
        "shear (torsion of a tube)" => under([1.0, -1.0], TENSILE),
        "uniaxial compression" => under([-1.0, 0.0], COMPRESSIVE),
        "hydrostatic tension" => {
            let factor = of_cube(glass(cube(), criterion), [2.0 * TENSILE; 3], 0.0)?;
            Ok(2e-6 * factor * TENSILE)
        }
        other => bail!("no stress `{other}`"),
    }
}

fn glass(trial: Trial, criterion: &str) -> Trial {
    trial
        .set("material.young", YOUNG)
        .set("material.poisson", POISSON)
        .set("material.tensile_strength", TENSILE)
        .set("material.compressive_strength", COMPRESSIVE)
        .set("fracture.criterion.0.kind", criterion)
}

/// Largest mean stress of the strip with a single edge notch over what the entry compares it with.
fn notched(labels: Labels<'_>) -> anyhow::Result<f64> {
    let length = 1e-3 * labels.number("a, mm")?;
    let trial = (NOTCH.trial())
        .on_mesh(&NOTCH_MESH)
        .set("precrack.0.points", [[-1e-3, 0.0], [length, 0.0]])
        // About twice the opening of the mouth at the peak.
        .set("stage.0.control.to", 6e-7 + 1.5e-3 * length);
    let stress = peak(&trial.solve()?)?.reaction / WIDTH;
    let griffith = griffith(length);
    let reference = match labels.text("against")? {
        "Griffith" => griffith,
        "both" => (TENSILE.powi(-2) + griffith.powi(-2)).powf(-0.5),
        other => bail!("no reference `{other}`"),
    };
    Ok(stress / reference)
}

/// Stress at which a crack from the side of a strip grows by linear elastic fracture mechanics, Pa (Tada, Paris and Irwin, single edge notch
/// under tension, within 0.5 % for a/W below 0.6).
fn griffith(length: f64) -> f64 {
    let share = length / WIDTH;
    let shape = 1.122 + share * (-0.231 + share * (10.55 + share * (-21.71 + share * 30.382)));
    (YOUNG * FRACTURE_ENERGY).sqrt() / (shape * (PI * length).sqrt())
}

/// The largest load before it first falls.
fn peak(solution: &Solution) -> anyhow::Result<LoadPoint> {
    solution
        .outcome
        .first_peak(DROP)
        .context("no state at rest")
}
