//! Planar and solid finite-element meshes and their groups, read from Gmsh files and input decks of Abaqus and CalculiX.
//!
//! [`gmsh::parse`] reads the bytes of a `.msh` file (formats 2.2 and 4.1, ASCII and binary) into a [`Mesh`]: nodes, triangles and
//! quadrangles with their corners counter-clockwise, and the physical groups as sets of nodes. Files without a valid planar mesh are refused
//! with the position of the fault. [`gmsh::parse_any`] reads solid meshes as well, of tetrahedra, hexahedra, prisms and pyramids. [`inp::parse`]
//! reads the mesh of an input deck of Abaqus or CalculiX, and keeps its other keywords.
//!
//! ```
//! let file = b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n\
//!     $Nodes\n3\n1 0 0 0\n2 2 0 0\n3 0 1 0\n$EndNodes\n\
//!     $Elements\n1\n1 2 2 7 1 1 2 3\n$EndElements\n";
//! let mesh = ligament_mesh::gmsh::parse(file)?;
//! assert_eq!(mesh.positions.len(), 3);
//! assert_eq!(mesh.area(), 1.0);
//! assert_eq!(mesh.group("7").map(|group| group.cells.len()), Some(1));
//! # Ok::<(), ligament_mesh::gmsh::GmshError>(())
//! ```
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

mod bisection;
mod cell;
mod coincidence;
mod coordinate_plane;
mod crack;
mod curve;
mod disjoint;
mod edges;
pub mod gmsh;
pub mod inp;
mod interpolation;
mod mesh;
mod numbering;
mod overlap;
pub mod parallel;
mod portion;
mod remark;
mod solid;
mod subdivision;

pub use bisection::{Bisectable, Bisection, MarkedCell, Unbisectable};
pub use cell::{Cell, MeshCell, cells_at_edges};
pub use curve::along_hilbert_curve;
pub use edges::outer_edges;
pub use mesh::{AnyMesh, Group, Mesh, NodeField, SolidMesh};
pub use numbering::Numbering;
pub use portion::Portion;
pub use remark::{DeckRemark, FileLine, Remark};
pub use solid::{Faces, NotOnOutline, Side, SolidCell};
