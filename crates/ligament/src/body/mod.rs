//! The body: points with their groups, from a mesh, a lattice or arrays.

mod any;
mod cells;
mod interface;
mod lattice;
mod lattice_cells;
mod mesh;
mod mesh_cells;
mod mesh_messages;
mod points;

use ligament_model::shape::{Shape, SolidShape};

pub use any::AnyBody;
pub use cells::{Cells, Hole, LatticeError};
pub use interface::{Body, BodyOutline, Geometry, MeshedBody, OffOutline, Origin, Restricted};
pub use lattice::{BodyOnLattice, LatticeBody, SolidLatticeBody};
pub use lattice_cells::LatticeShape;
pub use mesh::{BodyOnMesh, MeshBody, SolidMeshBody};
pub use points::{Points, PointsError};

/// Rule that selects the cells of a set of a lattice in the plane.
pub type CellSet = Cells<2, Shape>;

/// Rule that selects the cells of a set of a lattice in space.
pub type SolidCellSet = Cells<3, SolidShape>;

/// A hole of a lattice in space.
pub type SolidHole = Hole<SolidShape>;
