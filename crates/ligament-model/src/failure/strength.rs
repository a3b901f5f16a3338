//! The energy-based tensile strength of NHPD (eqs 14 to 16).

use rayon::prelude::*;

use super::basis::weakest;
use super::kind::{Kind, Limits, TENSILE_STRENGTH};
use super::measure::Measure;
use crate::material::{Isotropic, Plane};
use crate::system::BondSystem;

/// Stretch, from the energy at the tensile strength.
pub const STRENGTH: Kind = Kind {
    takes: &[TENSILE_STRENGTH],
    ..Kind::new(
        "strength",
        "Stretch, from the energy at the `tensile_strength` (NHPD).",
        &[Measure::Tension],
        |_, basis| {
            let energies = basis.each(|constants, material| {
                let strength = material.tensile_strength?;
                Some(critical_energy(constants, strength, basis.plane))
            });
            let limit = critical_stretches(basis.system, &energies, basis.no_fail);
            Ok(vec![Limits::without_coefficient(limit)])
        },
    )
};

/// Critical strain energy density e_0, J/m^3 (NHPD eq. 14):
///
/// F_t^2 / (2 E (1 - nu^2)) in plane stress, F_t^2 (1 - nu^2)(1 - nu)^2 / (2 E (1 - 2 nu)) in plane strain.
///
/// Both are eq. 11 at the axial strain of a uniaxial tension test, not the energy F_t^2/(2E) of that test: 17 % above it
/// at nu = 0.38 in plane stress. The paper's form is kept.
pub fn critical_energy(material: &Isotropic, tensile_strength: f64, plane: Plane) -> f64 {
    let nu = material.poisson;
    let reduction = match plane {
        Plane::Stress => 1.0 / (1.0 - nu * nu),
        Plane::Strain => (1.0 - nu * nu) * (1.0 - nu).powi(2) / (1.0 - 2.0 * nu),
    };
    tensile_strength.powi(2) / (2.0 * material.young) * reduction
}

/// Critical stretches s_0 (n_bonds), NHPD eq. 16, for the critical energies e_0 of the materials (n_materials, J/m^3; infinite for
/// one that never fails):
///
/// s_0 = sqrt(e_0 (V_A + V_B) / (Omega alpha V_A V_B c l))
///
/// A bond between materials takes the smallest e_0 of all that have a share in one of its ends or that it crosses. A bond of which an end is
/// marked in `no_fail` (n_points) never breaks: s_0 is infinite.
pub fn critical_stretches(system: &BondSystem, energies: &[f64], no_fail: &[bool]) -> Vec<f64> {
    (
        weakest(&system.cloud, &system.bonds, no_fail, energies),
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
