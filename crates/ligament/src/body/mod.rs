//! The body: points with their groups, from a mesh, a lattice or arrays.

mod interface;
mod lattice;
mod mesh;
mod points;
mod solid_mesh;

pub use interface::{Body, OffOutline, Origin};
pub use lattice::{CellSet, Hole, LatticeBody, LatticeError};
pub use mesh::MeshBody;
pub use points::{Points, PointsError};
pub use solid_mesh::SolidMeshBody;
