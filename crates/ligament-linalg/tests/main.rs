//! Factorisations and eigenvalues on matrices whose answers are known.

mod eigen;
mod factor;
mod general;
