//! Meshes of solids.

mod cell;
mod mesh;

pub use cell::SolidCell;
pub use mesh::SolidMesh;
