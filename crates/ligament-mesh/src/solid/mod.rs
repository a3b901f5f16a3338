//! Meshes of solids.

mod cell;
mod faces;
mod mesh;

pub use cell::SolidCell;
pub use faces::{Faces, Side};
pub use mesh::SolidMesh;
