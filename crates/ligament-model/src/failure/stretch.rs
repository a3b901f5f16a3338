//! Largest stretch in tension and in compression (MPPD eqs 44 to 46).

use super::basis::Basis;
use super::kind::{COMPRESSIVE_STRENGTH, Choice, Kind, Limits, Property, TENSILE_STRENGTH};
use super::measure::Measure;
use crate::material::{Isotropic, Plane};

/// Stretch, from the tensile strength.
pub const TENSION: Kind = Kind {
    takes: &[TENSILE_STRENGTH],
    keys: &["limit"],
    ..Kind::new(
        "tension",
        "Stretch, from the `tensile_strength` or a `limit`.",
        &[Measure::Tension],
        |choice, basis| Ok(vec![limits(choice, basis, &TENSILE_STRENGTH, limit)]),
    )
};

/// Shortening, from the compressive strength.
pub const COMPRESSION: Kind = Kind {
    takes: &[COMPRESSIVE_STRENGTH],
    keys: &["limit"],
    ..Kind::new(
        "compression",
        "Shortening, from the `compressive_strength` or a `limit`.",
        &[Measure::Compression],
        |choice, basis| Ok(vec![limits(choice, basis, &COMPRESSIVE_STRENGTH, limit)]),
    )
};

/// Limits as they are given, or of a strength (Pa); a bond between materials takes the smaller one.
pub(super) fn limits(
    choice: &Choice,
    basis: &Basis<'_>,
    strength: &Property,
    of_material: fn(&Isotropic, f64, Plane) -> f64,
) -> Limits {
    let of_materials = match choice.limit {
        Some(limit) => vec![limit; basis.materials.len()],
        None => basis.each(|constants, material| {
            let strength = (strength.value)(material)?;
            Some(of_material(constants, strength, basis.plane))
        }),
    };
    Limits::without_coefficient(basis.weakest(&of_materials))
}

/// Limit stretch of a strength F (Pa): the strain of a bar under that stress,
///
/// s_0 = F/E (MPPD eq. 44), in plane strain F (1 - nu^2)/E.
///
/// The bond along the bar has this stretch, so that a bar yields at its strength wherever a bond lies along it.
pub fn limit(material: &Isotropic, strength: f64, plane: Plane) -> f64 {
    strength / material.in_plane(plane).young
}
