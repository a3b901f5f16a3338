//! The energy-based tensile strength of NHPD (eqs 14 to 16).

use super::basis::Basis;
use super::kind::{Choice, Kind, Limits, PerSpace, TENSILE_STRENGTH};
use super::measure::Measure;
use super::unfit::NoLimit;
use crate::material::{Isotropic, Plane, Space};

/// Stretch, from the energy at the tensile strength.
pub static STRENGTH: Kind = Kind {
    source: "NHPD eqs 14 to 16",
    takes: &[TENSILE_STRENGTH],
    ..Kind::new(
        "strength",
        "Stretch, from the energy at the `tensile_strength` (NHPD).",
        &[Measure::Tension],
        PerSpace::new(limits, limits),
    )
};

fn limits<const D: usize>(_: &Choice, basis: &Basis<'_, D>) -> Result<Vec<Limits>, NoLimit> {
    let energies = basis.each(|constants, material| {
        let [bar, of_bonds] =
            [constants.material, constants.bonds].map(|it| it.bar_constants(basis.space));
        // The stress of the bonds alone at the strain of a bar that carries its strength.
        let strength = material.tensile_strength? * (of_bonds.young / bar.young);
        Some(critical_energy(&constants.bonds, strength, basis.space))
    });
    let limit = critical_stretches(basis, &energies);
    Ok(vec![Limits::without_coefficient(limit)])
}

/// Critical strain energy density e_0, J/m^3 (NHPD eq. 14):
///
/// | | e_0 |
/// |---|---|
/// | plane stress | F_t^2 / (2 E (1 - nu^2)) |
/// | plane strain | F_t^2 (1 - nu^2)(1 - nu)^2 / (2 E (1 - 2 nu)) |
/// | space, by the same argument | F_t^2 (1 - nu) / (2 E (1 + nu)(1 - 2 nu)) |
///
/// All are the energy of a uniaxial strain (eq. 11) of the size of the axial strain in a uniaxial tension test, not the energy
/// F_t^2/(2E) of that test: 17 % above it at nu = 0.38 in plane stress. The paper's form is kept.
pub fn critical_energy(
    material: &Isotropic,
    tensile_strength: f64,
    space: impl Into<Space>,
) -> f64 {
    let Isotropic { young, poisson: nu } = *material;
    let square = tensile_strength.powi(2);
    let reduction = match space.into() {
        Space::Plane(Plane::Stress) => 1.0 / (1.0 - nu * nu),
        Space::Plane(Plane::Strain) => (1.0 - nu * nu) * (1.0 - nu).powi(2) / (1.0 - 2.0 * nu),
        Space::Solid => {
            return square * (1.0 - nu) / (2.0 * young * (1.0 + nu) * (1.0 - 2.0 * nu));
        }
    };
    square / (2.0 * young) * reduction
}

/// Critical stretches s_0 (n_bonds), NHPD eq. 16, for the critical energies e_0 of the materials (J/m^3; infinite for
/// one that never fails):
///
/// s_0 = sqrt(e_0 (V_A + V_B) / (Omega alpha V_A V_B c l))
///
/// A bond of several materials takes the mean e_0 over its length ([`Basis::weakest`]). A bond with an end that never fails never breaks: s_0 is
/// infinite.
pub fn critical_stretches<const D: usize>(basis: &Basis<'_, D>, energies: &[f64]) -> Vec<f64> {
    let system = basis.system;
    let volumes = &system.cloud.volumes;
    let mut limits = basis.weakest(energies);
    let of_bonds = system.bonds.ends.iter().zip(&system.rigidities.axial);
    for (limit, (&[a, b], axial_rigidity)) in limits.iter_mut().zip(of_bonds) {
        let both = volumes[a as usize] + volumes[b as usize];
        *limit = (*limit * both / axial_rigidity).sqrt();
    }
    limits
}
