//! Stresses at the points: two readings of the forces of the bonds, and the law of the material for the strains that the bonds show.
//!
//! | reading | from | symmetric |
//! |---|---|---|
//! | [`virial`] | the bonds of the point, each with the whole of its length | made so |
//! | [`traction`] | the bonds that cross a small plane through the point | no: couples on the points are in balance with the difference |
//! | [`by_material`] | Hooke's law for the strain at which sound bonds carry the forces of the point ([`carried`]), or for that of the bonds left
//! ([`point_strain`]) | yes |
//!
//! In a uniform strain the first two are the stress of the continuum whose energy the bonds have, inside a body whose bonds nothing
//! corrects; the third one is the stress of the material everywhere. Tension is positive.

mod across;
pub mod by_material;
pub mod carried;
pub mod crack_front;
pub mod domain_integral;
mod elements;
pub mod growing_tip;
pub mod point_strain;
pub mod principal;
pub mod stored;
pub mod tip_field;
pub mod traction;
pub mod virial;
