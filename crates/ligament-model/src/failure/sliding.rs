//! Largest sliding (MPPD eqs 49 and 50).

use super::kind::{Kind, TENSILE_STRENGTH};
use super::measure::Measure;
use super::stretch;
use crate::material::{Isotropic, Plane};

/// Sliding, from the tensile strength.
pub const SLIDING: Kind = Kind {
    takes: &[TENSILE_STRENGTH],
    keys: &["limit"],
    ..Kind::new(
        "sliding",
        "Sliding, from the `tensile_strength` or a `limit`.",
        &[Measure::Sliding],
        |choice, basis| {
            Ok(vec![stretch::limits(
                choice,
                basis,
                &TENSILE_STRENGTH,
                limit,
            )])
        },
    )
};

/// Limit gamma_0 = s_0t (1 + nu)/2 (MPPD eq. 49), with nu/(1 - nu) in place of nu in plane strain: the sliding of the bonds at
/// 45 degrees to a bar that carries its tensile strength F_t (Pa).
pub fn limit(material: &Isotropic, tensile_strength: f64, plane: Plane) -> f64 {
    let poisson = material.in_plane(plane).poisson;
    0.5 * (1.0 + poisson) * stretch::limit(material, tensile_strength, plane)
}
