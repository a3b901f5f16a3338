//! The energy-based tensile strength of NHPD (eqs 14 to 16).

use rayon::prelude::*;

use crate::cloud::PointCloud;
use crate::material::{Isotropic, Material, Plane};
use crate::system::BondSystem;

/// Critical strain energy density e_0, J/m^3 (NHPD eq. 14):
///
/// F_t^2 / (2 E (1 - nu^2)) in plane stress, F_t^2 (1 - nu^2)(1 - nu)^2 / (2 E (1 - 2 nu)) in plane strain.
///
/// Both are eq. 11 at the axial strain of a uniaxial tension test, not the energy F_t^2/(2E) of that test: 17 % above it
/// at nu = 0.38 in plane stress. The paper's form is kept.
pub fn critical_energy(young: f64, poisson: f64, tensile_strength: f64, plane: Plane) -> f64 {
    let nu = poisson;
    let reduction = match plane {
        Plane::Stress => 1.0 / (1.0 - nu * nu),
        Plane::Strain => (1.0 - nu * nu) * (1.0 - nu).powi(2) / (1.0 - 2.0 * nu),
    };
    tensile_strength.powi(2) / (2.0 * young) * reduction
}

/// Critical stretches s_0 (n_bonds), NHPD eq. 16:
///
/// s_0 = sqrt(e_0 (V_A + V_B) / (Omega alpha V_A V_B c l))
///
/// A bond between materials takes the smaller e_0 of all that have a share in one of its ends. A bond of which an end is
/// marked in `no_fail` (n_points) never breaks: s_0 is infinite; so it is where a material has no tensile strength or
/// is orthotropic, for which eq. 14 says nothing.
pub fn critical_stretches(
    system: &BondSystem,
    materials: &[Material],
    plane: Plane,
    no_fail: &[bool],
) -> Vec<f64> {
    let energies: Vec<f64> = materials
        .iter()
        .map(|m| {
            let constants = m.elasticity.isotropic().zip(m.tensile_strength);
            constants.map_or(f64::INFINITY, |(Isotropic { young, poisson }, f_t)| {
                critical_energy(young, poisson, f_t, plane)
            })
        })
        .collect();
    let energy_at: Vec<f64> = (0..system.cloud.len())
        .into_par_iter()
        .map(|point| smallest_energy(&system.cloud, point, &energies))
        .collect();
    system
        .bonds
        .ends
        .par_iter()
        .zip(&system.axial_rigidity)
        .map(|(ends, &axial_rigidity)| {
            let [a, b] = ends.map(|end| end as usize);
            if no_fail[a] || no_fail[b] {
                return f64::INFINITY;
            }
            let volumes = system.cloud.volumes[a] + system.cloud.volumes[b];
            (energy_at[a].min(energy_at[b]) * volumes / axial_rigidity).sqrt()
        })
        .collect()
}

fn smallest_energy(cloud: &PointCloud, point: usize, energies: &[f64]) -> f64 {
    let present = cloud
        .shares(point)
        .iter()
        .zip(energies)
        .filter(|(share, _)| **share > 0.0);
    present
        .map(|(_, &energy)| energy)
        .fold(f64::INFINITY, f64::min)
}
