//! Meshes of solids.

mod cell;
mod faces;
mod mesh;
mod quality;
mod surface;

pub use cell::SolidCell;
pub use faces::{Faces, Side};
pub use mesh::SolidMesh;
pub use surface::OffSurface;
