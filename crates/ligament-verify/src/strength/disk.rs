//! The Brazilian disk, failing by stress.

use anyhow::Context;
use ligament::run::Solution;
use ligament_analysis::history::BreakRecord;

use crate::crack_path::middle;
use crate::disk_test::CLOSED_FORM;
use crate::experiment::{Compute, Experiment, Findings};
use crate::published::{Published, published};
use crate::spread::spread;
use crate::table::{Extent, Labels, Table};
use crate::trial::{Memory, StoredMesh, Template, Trial, stored_mesh, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "strength_disk",
    title: "Brazilian disk: first failure and peak",
    source: "closed form (Hertz): the disk splits from its middle at pi D t F_t/2 = 598.5 kN",
    setup: "Disk of the diameter D = 0.1 m, t = 1 m, F_t = 3.81 MPa, E = 15 GPa, nu = 0.21, plane stress, NHPD, between platens 3, 6 and 10 mm wide \
            that move together; Delaunay and frontal meshes of 4, 3 and 2 mm; exact path over 150 breakages. Largest load over the closed form, \
            and distance of the first broken bond from the middle over the radius. `tension` stands beside `bond-rankine` for contrast: it breaks \
            bonds beside the platens, which pressure across them stretches. No platens of 1.5 mm: they would be narrower than the \
            distance of two points.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("verification/strength-disk.toml");

/// Meshes by size (mm), mesher and width of the platens (mm).
static MESHES: [([&str; 3], StoredMesh); 10] = [
    (["4", "Delaunay", "6"], stored_mesh!("disk-4mm.msh")),
    (["4", "frontal", "6"], stored_mesh!("disk-4mm-frontal.msh")),
    (["3", "Delaunay", "6"], stored_mesh!("disk-3mm.msh")),
    (["3", "frontal", "6"], stored_mesh!("disk-3mm-frontal.msh")),
    (["2", "Delaunay", "6"], stored_mesh!("disk-2mm.msh")),
    (["2", "frontal", "6"], stored_mesh!("disk-2mm-frontal.msh")),
    (
        ["4", "Delaunay", "3"],
        stored_mesh!("disk-4mm-platen-1.5mm.msh"),
    ),
    (
        ["3", "Delaunay", "3"],
        stored_mesh!("disk-3mm-platen-1.5mm.msh"),
    ),
    (
        ["2", "Delaunay", "3"],
        stored_mesh!("disk-2mm-platen-1.5mm.msh"),
    ),
    (
        ["2", "Delaunay", "10"],
        stored_mesh!("disk-2mm-platen-5mm.msh"),
    ),
];

const RADIUS: f64 = 0.05;

/// Horizon factors between which the peak should not vary.
const LAMBDAS: [f64; 3] = [2.5, 3.0, 4.0];

/// Peak over the closed form, and place of the first breakage over the radius.
type Reading = [f64; 2];

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let mut judge = |table: Published, criterion: &str| -> anyhow::Result<Table> {
        table.judge(extent, |labels| {
            let mesh = [
                labels.text("h, mm")?,
                labels.text("mesher")?,
                labels.text("platen, mm")?,
            ];
            let trial = trial(mesh, labels.number("lambda")?, criterion)?;
            let [peak, place] = memory.reading_with_breakages(&trial, read)?;
            Ok(if labels.text("of")? == "place" {
                place
            } else {
                peak
            })
        })
    };
    let mut tables = vec![
        judge(published!("strength-disk"), "bond-rankine")?,
        judge(published!("strength-disk-stretch"), "tension")?,
    ];
    tables.push(
        published!("strength-disk-spread")
            .judge(extent, |labels| Ok(spread(&peaks(labels, &mut memory)?)))?,
    );
    Ok(Findings {
        tables,
        ..Findings::default()
    })
}

/// The peaks of `bond-rankine` over all meshes with platens of 6 mm, or over the horizon factors on one of them.
fn peaks(labels: Labels<'_>, memory: &mut Memory<Reading>) -> anyhow::Result<Vec<f64>> {
    let (size, mesher) = (labels.text("h, mm")?, labels.text("mesher")?);
    let lambdas = match labels.text("lambda")? {
        "2.5 to 4" => LAMBDAS.to_vec(),
        _ => vec![labels.number("lambda")?],
    };
    let mut peaks = Vec::new();
    for (mesh, _) in &MESHES {
        let is_of = |label: &str, of: &str| label == "all" || label == of;
        if mesh[2] == "6" && is_of(size, mesh[0]) && is_of(mesher, mesh[1]) {
            for lambda in &lambdas {
                let trial = trial(*mesh, *lambda, "bond-rankine")?;
                peaks.push(memory.reading_with_breakages(&trial, read)?[0]);
            }
        }
    }
    Ok(peaks)
}

fn trial(mesh: [&str; 3], lambda: f64, criterion: &str) -> anyhow::Result<Trial> {
    let stored = MESHES.iter().find(|(name, _)| *name == mesh);
    let (_, stored) = stored.context("no such mesh")?;
    Ok((CASE.trial())
        .on_mesh(stored)
        .set("model.horizon_factor", lambda)
        .set("fracture.criterion.0.kind", criterion))
}

fn read(solution: &Solution, breaks: &[BreakRecord]) -> anyhow::Result<Reading> {
    let peak = solution.outcome.peak().context("no state at rest")?;
    let first = breaks.first().context("no bond fails")?;
    let [x, y] = middle(&solution.model, first.bond as usize).at;
    Ok([peak.reaction / CLOSED_FORM, x.hypot(y) / RADIUS])
}
