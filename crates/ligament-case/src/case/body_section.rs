//! The body: `[mesh]` or `[lattice]`.

use std::path::Path;

use serde::Serialize;

use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::lattice_section::{LatticeSection, RawLattice};
use super::mesh_section::{MeshSection, RawMesh};
use ligament_model::Plane;

/// The body, meshed or on a regular lattice.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum BodySection {
    /// A body meshed by Gmsh.
    Mesh(MeshSection),
    /// A rectangle of equal cells.
    Lattice(LatticeSection),
}

impl BodySection {
    /// Thickness, m.
    pub fn thickness(&self) -> f64 {
        match self {
            Self::Mesh(mesh) => mesh.thickness,
            Self::Lattice(lattice) => lattice.thickness,
        }
    }

    /// Plane stress or plane strain.
    pub fn plane(&self) -> Plane {
        match self {
            Self::Mesh(mesh) => mesh.plane.0,
            Self::Lattice(lattice) => lattice.plane.0,
        }
    }

    /// The one section of the two that is there; `folder` is that of the case file.
    pub(super) fn from_sections(
        mesh: Option<RawMesh>,
        lattice: Option<RawLattice>,
        folder: &Path,
    ) -> Result<Self, KeyFault> {
        let section = |name: &str| KeyPath::default().child(name);
        match (mesh, lattice) {
            (Some(mesh), None) => mesh.check(&section("mesh"), folder).map(Self::Mesh),
            (None, Some(lattice)) => lattice.check(&section("lattice")).map(Self::Lattice),
            (None, None) => Err(KeyFault::new(
                section("mesh"),
                Fault::MissingSection {
                    section: "[mesh] or [lattice]".to_owned(),
                    purpose: "one of them: [mesh] with `file`, the Gmsh file, or [lattice] with `cells` and `spacing`",
                },
            )),
            (Some(_), Some(_)) => Err(KeyFault::new(
                section("lattice"),
                "the case has a [mesh] as well, but its body is one of the two: remove [mesh] or [lattice]",
            )),
        }
    }
}
