//! `ligament inspect`.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;

use ligament_case::mesh_file::read_in_own_plane;
use ligament_mesh::gmsh::CoordinatePlane;

use crate::inspect::write_summary;
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament inspect meshes/disk.msh
  ligament inspect meshes/solids/bar.msh       a solid, with the quality of its tetrahedra

Reads Gmsh files of the formats 2.2 and 4.1, ASCII or binary. Lengths are taken to be in m.";

/// `ligament inspect`.
#[derive(Debug, Args)]
pub struct InspectArgs {
    /// The mesh (Gmsh .msh)
    #[arg(value_name = "MESH")]
    pub mesh: PathBuf,
}

impl InspectArgs {
    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        let (mesh, plane) = read_in_own_plane(&self.mesh)?;
        let mut out = terminal::stdout();
        write_summary(&mut out, &self.mesh, &mesh)?;
        if plane != CoordinatePlane::Xy {
            let word = plane.word();
            writeln!(
                out,
                "  note: a case reads it by `coordinates = \"{word}\"` in [mesh]"
            )?;
        }
        Ok(())
    }
}
