//! Meshes of solids.

mod cell;
mod faces;
mod quality;
mod surface;

pub use cell::SolidCell;
pub use faces::{Faces, Side};
pub use surface::NotOnOutline;
