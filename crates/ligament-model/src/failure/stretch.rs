//! Largest stretch in tension and in compression (MPPD eqs 44 to 46).

use crate::material::{Isotropic, Plane};

/// Limit stretch of a strength F (Pa): the strain of a bar under that stress,
///
/// s_0 = F/E (MPPD eq. 44), in plane strain F (1 - nu^2)/E.
///
/// The bond along the bar has this stretch, so that a bar yields at its strength wherever a bond lies along it.
pub fn limit(material: &Isotropic, strength: f64, plane: Plane) -> f64 {
    strength / material.in_plane(plane).young
}
