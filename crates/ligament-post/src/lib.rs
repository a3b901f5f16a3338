//! Evaluation of the state of bonds: cracks as lines and surfaces, and the anisotropy of yield from the directions of bonds.
//!
//! The crate is not part of any equation: it reads results of a run, or the criteria of a model.
//!
//! | module | content |
//! |---|---|
//! | [`crack`] | cracks of a body in the plane as lines |
//! | [`statistics`] | quantiles and Weibull moduli of many specimens |
//! | [`surfaces`] | cracks of a solid as triangles, and level sets of fields |
//! | [`yielding`] | first yield of a family of bonds under a uniform strain |
//!
//! All quantities are in SI units. The crate has no files and no printing.

pub mod crack;
mod opened;
pub mod statistics;
pub mod surfaces;
pub mod yielding;

pub use opened::OpenedCells;
