//! Stresses at the points, from the forces of the bonds: two readings of the same forces.
//!
//! | reading | from | symmetric |
//! |---|---|---|
//! | [`virial`] | the bonds of the point, each with the whole of its length | made so |
//! | [`traction`] | the bonds that cross a small plane through the point | no: couples on the points are in balance with the difference |
//!
//! In a uniform strain both are the stress of the continuum whose energy the bonds have. Tension is positive.

pub mod point_strain;
pub mod traction;
pub mod virial;
