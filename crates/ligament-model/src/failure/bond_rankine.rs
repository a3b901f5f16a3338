//! Failure by the stress on the plane across a bond, after Rankine.
//!
//! A stretch says how far a bond is pulled, not how strongly: where the body is pressed across the bond, Poisson's effect stretches it
//! without any stress along it. Limits of stretch fail there at a part of the strength of the material (a Brazilian disk at half of it).

use super::basis::Basis;
use super::hooke::modulus;
use super::kind::{Choice, Kind, Limits, PerSpace, TENSILE_STRENGTH};
use super::measure::Measure;
use super::stress_limits::stress_limits;
use super::unfit::NoLimit;

/// Reason why bonds break at once where a stress lets them fail.
const BRITTLE: &str =
    "its measure is a stress, of which a bond does not tell how much energy it has taken";

/// Tensile stress across the bond.
pub static BOND_RANKINE: Kind = Kind {
    takes: &[TENSILE_STRENGTH],
    brittle_because: Some(BRITTLE),
    ..Kind::new(
        "bond-rankine",
        "Tensile stress on the plane across the bond, from the `tensile_strength`: the strength of the material under any stress.",
        &[Measure::NormalStress],
        PerSpace::new(limits, limits),
    )
};

fn limits<const D: usize>(_: &Choice, basis: &Basis<'_, D>) -> Result<Vec<Limits>, NoLimit> {
    Ok(vec![tensile(basis)])
}

/// Limits F_t/E' of the stress across the bonds.
pub(super) fn tensile<const D: usize>(basis: &Basis<'_, D>) -> Limits {
    let strains = basis.each(|constants, material| {
        Some(material.tensile_strength? / modulus(&constants.bonds, basis.space))
    });
    stress_limits(basis, &strains, |_, it| it.coefficients())
}
