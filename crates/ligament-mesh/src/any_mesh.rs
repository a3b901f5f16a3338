//! A mesh of either kind.

use crate::mesh::{Mesh, SolidMesh};

/// A mesh that is planar or solid.
#[derive(Debug, Clone, PartialEq)]
pub enum AnyMesh {
    /// Triangles and quadrangles in a plane.
    Plane(Mesh),
    /// Tetrahedra, hexahedra, prisms and pyramids.
    Solid(SolidMesh),
}

impl AnyMesh {
    /// Number of nodes.
    pub fn n_nodes(&self) -> usize {
        match self {
            AnyMesh::Plane(mesh) => mesh.positions.len(),
            AnyMesh::Solid(mesh) => mesh.positions.len(),
        }
    }
}
