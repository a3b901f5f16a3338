//! Natural frequencies of a free disk in its plane.

use anyhow::Context;
use ligament_analysis::modal::ModeKind;

use super::experiment::{Compute, Experiment, Findings};
use super::published::published;
use super::table::Extent;
use super::trial::{Memory, StoredMesh, Template, stored_mesh, template};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "disk_modes",
    title: "Natural frequencies of a free disk",
    source: "closed form (Onoe 1956, contour vibrations of isotropic circular plates)",
    setup: "Disk of radius 50 mm on a mesh of 2 mm (2,998 points, Delaunay), E = 15 GPa, nu = 0.21, 2400 kg/m^3, plane stress, NHPD, held \
            nowhere. The three rigid motions are left out. Modes with n waves around the disk come in pairs, which the mesh parts a little: \
            both are judged.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("verification/free-disk.toml");
static MESH: StoredMesh = stored_mesh!("disk-2mm.msh");

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let table = published!("disk-modes").judge(extent, |labels| {
        let trial = CASE
            .trial()
            .on_mesh(&MESH)
            .set("model.horizon_factor", labels.number("lambda")?)
            .set("correction.surface", labels.text("correction")?);
        let frequencies: Vec<f64> = memory.result(trial.command(), || {
            let modes = trial.modes()?;
            let elastic = modes.iter().filter(|mode| mode.kind == ModeKind::Elastic);
            Ok(elastic.map(|mode| mode.frequency()).collect())
        })?;
        let place = labels.number("mode")? as usize;
        let found = frequencies.get(place.wrapping_sub(1)).copied();
        found.context("the disk has no such mode")
    })?;
    Ok(Findings {
        tables: vec![table],
        plots: Vec::new(),
        ..Findings::default()
    })
}
