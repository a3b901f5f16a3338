//! Bodies in space.

pub mod cloud;
pub mod hole;
pub mod lattice;
pub mod shape;
