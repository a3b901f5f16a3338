//! First failure at a round hole in a plate under tension.

use anyhow::Context;
use ligament::run::Solution;
use ligament_analysis::history::BreakRecord;

use crate::crack_path::middle;
use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::Extent;
use crate::trial::{Memory, StoredMesh, Template, stored_mesh, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "strength_hole",
    title: "First failure at a round hole",
    source: "closed form for a strip of finite width (Howland 1930; Peterson): K_t = 3.03 of the stress on the whole section at d/W = 0.1",
    setup: "Plate 100 x 200 mm with a hole of the radius R = 5 mm, pulled along its length by tractions on its ends, h = 1, 0.5 and 0.25 mm at the \
            hole and a tenth of the distance from it wider outside. Plane stress, NHPD, E = 15 GPa, nu = 0.21, criterion `bond-rankine`. K_t is \
            F_t over the stress on the ends at the first breakage; place is the distance of the broken bond from the nearer flank of the \
            hole, where the stress is largest, over R.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("verification/strength-hole.toml");

/// Meshes by h/R and mesher.
static MESHES: [(&str, &str, StoredMesh); 4] = [
    ("0.2", "Delaunay", stored_mesh!("plate-with-hole-1mm.msh")),
    ("0.1", "Delaunay", stored_mesh!("plate-with-hole-0.5mm.msh")),
    (
        "0.1",
        "frontal",
        stored_mesh!("plate-with-hole-0.5mm-frontal.msh"),
    ),
    (
        "0.05",
        "Delaunay",
        stored_mesh!("plate-with-hole-0.25mm.msh"),
    ),
];

const RADIUS: f64 = 0.005;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let table = published!("strength-hole").judge(extent, |labels| {
        let wanted = [labels.text("h/R")?, labels.text("mesher")?];
        let stored = MESHES.iter().find(|it| [it.0, it.1] == wanted);
        let (_, _, stored) = stored.context("no such mesh")?;
        let trial = (CASE.trial())
            .on_mesh(stored)
            .set("model.horizon_factor", labels.number("lambda")?);
        let [factor, place] = memory.reading_with_breakages(&trial, read)?;
        Ok(if labels.text("of")? == "place" {
            place
        } else {
            factor
        })
    })?;
    Ok(Findings {
        tables: vec![table],
        ..Findings::default()
    })
}

/// K_t at the first breakage, where the tractions are the tensile strength at load factor 1, and the place of the bond.
fn read(solution: &Solution, breaks: &[BreakRecord]) -> anyhow::Result<[f64; 2]> {
    let first = breaks.first().context("no bond fails")?;
    let [x, y] = middle(&solution.model, first.bond as usize).at;
    Ok([
        1.0 / first.load_factor,
        (x.abs() - RADIUS).hypot(y) / RADIUS,
    ])
}
