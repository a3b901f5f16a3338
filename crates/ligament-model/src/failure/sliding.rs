//! Largest sliding (MPPD eqs 49 and 50).

use super::basis::Basis;
use super::kind::{Choice, Kind, Limits, PerSpace, TENSILE_STRENGTH};
use super::measure::Measure;
use super::stretch;
use super::unfit::NoLimit;
use crate::material::{Isotropic, Space};

/// Sliding, from the tensile strength.
pub static SLIDING: Kind = Kind {
    source: "MPPD eqs 49, 50",
    takes: &[TENSILE_STRENGTH],
    keys: &["limit"],
    ..Kind::new(
        "sliding",
        "Sliding, from the `tensile_strength` or a `limit`.",
        &[Measure::Sliding],
        PerSpace::new(limits, limits),
    )
};

fn limits<const D: usize>(choice: &Choice, basis: &Basis<'_, D>) -> Result<Vec<Limits>, NoLimit> {
    let limit = stretch::limits_from_strength(choice, basis, limit);
    Ok(vec![Limits::without_coefficient(limit)])
}

/// Limit gamma_0 = s_0t (1 + nu)/2 (MPPD eq. 49), with nu/(1 - nu) in place of nu in plane strain: the sliding of the bonds at
/// 45 degrees to a bar that carries its tensile strength F_t (Pa). In space it is F_t (1 + nu)/(2 E), as in plane stress.
pub fn limit(material: &Isotropic, tensile_strength: f64, space: impl Into<Space>) -> f64 {
    let space = space.into();
    let poisson = material.bar_constants(space).poisson;
    0.5 * (1.0 + poisson) * stretch::limit(material, tensile_strength, space)
}
