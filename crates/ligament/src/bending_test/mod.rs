//! The bending test of a model: the ratio by which the body is too stiff for strains that vary over its thickness.
//!
//! Uniform strains do not show this: a body may have E and Poisson's ratio of its material to many digits and bend far too little where it
//! has few points across. A free strip of one material, cut from the body at its thinnest section, is loaded on its outline by the
//! tractions of a stress that is linear in the position,
//!
//! bending: sigma = n (a x a), torsion (in space): sigma_ab = - v_b n, sigma_an = v_n b,
//!
//! with n, a and b the coordinates across, along and beside the strip from its middle and v their variances over it. Both stresses are
//! free of divergence, and linear strains are compatible, so that they are solutions of a classical continuum for any outline. In bars of
//! round or elliptic section the second stress is the torsion of Saint-Venant, in plates it is the twist. Under forces F, the tractions
//! distributed to the points by linear shape functions, the points should move by u_0 of the continuum, quadratic in the position, and a
//! rigid motion. The share c of u_0 in their motions u is fitted by least squares in the middle half of the strip: the strip is 1/c times
//! as stiff as the continuum.
//!
//! The search of the thinnest section also finds the smallest ligament, the section through which a crack has to run ([`smallest_ligament`]).

mod ahead_of_tips;
mod facets;
mod part;
mod solution;
mod stress;
mod strip;
mod thinnest;

pub use ahead_of_tips::{WIDE, smallest_ligament};
pub use solution::{BendingTest, THICK, TOO_STIFF, bending_test, most_points};
pub use thinnest::{MOST_SIDES, Section, thinnest_section};
