//! Bodies in space: what a setup, its formulation and its model have there in the place of the plane's.

mod bending_test;
mod check;
mod dimension;
mod formulation;
mod model;
mod precrack;
mod soundness;

pub use precrack::{CrackSurface, SolidCrack};
