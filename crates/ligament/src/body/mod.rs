//! The body: points with their groups, from a mesh, a lattice or arrays.

mod cells;
mod interface;
mod lattice;
mod mesh;
mod points;
mod solid_lattice;
mod solid_mesh;

pub use cells::{Cells, Hole, LatticeError};
pub use interface::{Body, OffOutline, Origin};
pub use lattice::{CellSet, LatticeBody};
pub use mesh::MeshBody;
pub use points::{Points, PointsError};
pub use solid_lattice::{SolidCellSet, SolidHole, SolidLatticeBody};
pub use solid_mesh::SolidMeshBody;
