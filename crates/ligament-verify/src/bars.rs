//! A bar in tension between clamps, and a cantilever under a force at its end.

use anyhow::Context;
use ligament::run::Solution;

use super::experiment::{Compute, Experiment, Findings};
use super::published::{Published, published};
use super::table::{Extent, Labels, Table};
use super::trial::{Memory, StoredMesh, Template, stored_mesh, template};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "bars",
    title: "Bar in tension, cantilever in bending",
    source: "closed form: E A/L; Timoshenko's beam",
    setup: "A bar 0.2 x 0.1 m (1,543 points) between clamps that let it contract, pulled by 20 um: force over displacement against E A/L. A \
            cantilever 0.2 x 0.02 m (1,307 points, frontal), all displacements held at its root, a force spread over its end: mean \
            deflection of the end against P L^3/(3 E I) + 6 P L/(5 G A). E = 15 GPa, nu = 0.21, plane stress, NHPD. What the domain \
            correction gives is shown.",
    cases: &[&BAR, &CANTILEVER],
    compute: Compute::Code(compute),
};

static BAR: Template = template!("plate-tension/case.toml");
static CANTILEVER: Template = template!("verification/cantilever.toml");

static PLATE: StoredMesh = stored_mesh!("plate.msh");
static BEAM: StoredMesh = stored_mesh!("beam.msh");

const YOUNG: f64 = 15e9;
const POISSON: f64 = 0.21;
const THICKNESS: f64 = 0.01;
const LENGTH: f64 = 0.2;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let mut judge = |table: Published, case: &'static Template, mesh, ratio: fn(f64) -> f64| {
        table.judge(extent, |labels| {
            stiffness(labels, case, mesh, &mut memory).map(ratio)
        })
    };
    let tables: Vec<Table> = vec![
        judge(published!("bar-tension"), &BAR, &PLATE, |stiffness| {
            stiffness / (YOUNG * THICKNESS * 0.1 / LENGTH)
        })?,
        judge(published!("cantilever"), &CANTILEVER, &BEAM, |stiffness| {
            1.0 / (stiffness * cantilever())
        })?,
    ];
    Ok(Findings {
        tables,
        plots: Vec::new(),
        ..Findings::default()
    })
}

/// Deflection of the cantilever under a force of 1 N, m.
fn cantilever() -> f64 {
    let height: f64 = 0.02;
    let area = THICKNESS * height;
    let shear_modulus = YOUNG / (2.0 * (1.0 + POISSON));
    LENGTH.powi(3) / (3.0 * YOUNG * area * height * height / 12.0)
        + 1.2 * LENGTH / (shear_modulus * area)
}

/// Force over displacement of the load, N/m.
fn stiffness(
    labels: Labels<'_>,
    case: &'static Template,
    mesh: &'static StoredMesh,
    memory: &mut Memory<f64>,
) -> anyhow::Result<f64> {
    let trial = (case.trial())
        .on_mesh(mesh)
        .set("model.horizon_factor", labels.number("lambda")?)
        .set("correction.surface", labels.text("correction")?);
    memory.reading(&trial, |solution: &Solution| {
        let last = solution.outcome.history.last();
        let last = last.context("the run has no history")?;
        Ok((last.reaction / last.displacement).abs())
    })
}
