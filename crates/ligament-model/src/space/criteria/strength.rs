//! The energy-based tensile strength in space, by the argument of NHPD (eqs 14 to 16).

use rayon::prelude::*;

use super::basis::SolidBasis;
use crate::material::Isotropic;

/// Critical strain energy density e_0 = F_t^2 (1 - nu)/(2 E (1 + nu)(1 - 2 nu)), J/m^3: that of a uniaxial strain of the size of the axial
/// strain in a tension test, F_t/E, as in the plane.
pub fn critical_energy(material: &Isotropic, tensile_strength: f64) -> f64 {
    let Isotropic { young, poisson } = *material;
    tensile_strength.powi(2) * (1.0 - poisson)
        / (2.0 * young * (1.0 + poisson) * (1.0 - 2.0 * poisson))
}

/// Critical stretches s_0 = sqrt(e_0 (V_A + V_B)/(Omega alpha V_A V_B c l)) of the bonds (n_bonds); a bond between materials takes the
/// smaller e_0.
pub fn critical_stretches(basis: &SolidBasis<'_>) -> Vec<f64> {
    let energies = basis
        .each(|constants, material| Some(critical_energy(constants, material.tensile_strength?)));
    let system = basis.system;
    (
        basis.weakest(&energies),
        &system.bonds.ends,
        &system.rigidities.axial,
    )
        .into_par_iter()
        .map(|(energy, ends, &axial_rigidity)| {
            let [a, b] = ends.map(|end| system.cloud.volumes[end as usize]);
            (energy * (a + b) / axial_rigidity).sqrt()
        })
        .collect()
}
