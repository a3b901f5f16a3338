//! What a state of bonds means: cracks as lines and surfaces, and how the directions of bonds distort yield.
//!
//! Nothing here is part of an equation: results of a run, or the criteria of a model, are read.
//!
//! | module | holds |
//! |---|---|
//! | [`crack`] | cracks of a body in the plane as lines |
//! | [`surfaces`] | in a solid, cracks as triangles, and where a field has a value |
//! | [`yielding`] | first yield of a family of bonds under a uniform strain |
//!
//! All quantities are in SI units. No files and no printing here.

pub mod crack;
pub mod surfaces;
pub mod yielding;
