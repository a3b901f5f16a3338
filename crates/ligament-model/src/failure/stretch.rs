//! Largest stretch in tension and in compression (MPPD eqs 44 to 46).

use super::basis::Basis;
use super::kind::{COMPRESSIVE_STRENGTH, Choice, Kind, Limits, PerSpace, TENSILE_STRENGTH};
use super::measure::Measure;
use super::unfit::NoLimit;
use crate::material::{Isotropic, Space};

/// Stretch, from the tensile strength.
pub static TENSION: Kind = Kind {
    source: "MPPD eq. 44",
    takes: &[TENSILE_STRENGTH],
    keys: &["limit"],
    ..Kind::new(
        "tension",
        "Stretch, from the `tensile_strength` or a `limit`.",
        &[Measure::Tension],
        LIMITS,
    )
};

/// Shortening, from the compressive strength.
pub static COMPRESSION: Kind = Kind {
    source: "MPPD eq. 44",
    takes: &[COMPRESSIVE_STRENGTH],
    keys: &["limit"],
    ..Kind::new(
        "compression",
        "Shortening, from the `compressive_strength` or a `limit`.",
        &[Measure::Compression],
        LIMITS,
    )
};

const LIMITS: PerSpace = PerSpace::new(limits, limits);

fn limits<const D: usize>(choice: &Choice, basis: &Basis<'_, D>) -> Result<Vec<Limits>, NoLimit> {
    let limit = limits_from_strength(choice, basis, limit);
    Ok(vec![Limits::without_coefficient(limit)])
}

/// Limits as they are given, or of the strength that the kind takes first (n_bonds).
pub(super) fn limits_from_strength<const D: usize>(
    choice: &Choice,
    basis: &Basis<'_, D>,
    of_material: fn(&Isotropic, f64, Space) -> f64,
) -> Vec<f64> {
    basis.given_or(choice.limit, || {
        basis.each(|constants, material| {
            let strength = (choice.kind.takes.first()?.value)(material)?;
            Some(of_material(&constants.material, strength, basis.space))
        })
    })
}

/// Limit stretch of a strength F (Pa): the strain of a bar under that stress,
///
/// s_0 = F/E (MPPD eq. 44), in plane strain F (1 - nu^2)/E.
///
/// The bond along the bar has this stretch, so that a bar yields at its strength wherever a bond lies along it.
pub fn limit(material: &Isotropic, strength: f64, space: impl Into<Space>) -> f64 {
    strength / material.bar_constants(space).young
}
