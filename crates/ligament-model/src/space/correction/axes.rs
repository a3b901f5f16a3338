//! The iterative correction in space: factors Omega that make the strain energies of uniaxial strains along x, y and z right at every
//! point. NHPD's [domain correction](crate::correction::domain) with a third axis (our own, see `docs/space.md`).
//!
//! The correction is tied to the axes: quarter turns of the mesh leave the answer as it is, other turns do not.

use super::families::Families;
use super::strain_mode::SolidStrainMode;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::correction::{Correction, Sweeps};
use crate::law::BondStiffness;
use crate::material::Isotropic;

/// Iterates Omega from 1:
///
/// Omega <- Omega/sqrt((a/p_x)^2 + (b/p_y)^2 + (c/p_z)^2), p_x = (e/etil_A,x + e/etil_B,x)/2, p_y and p_z alike,
///
/// with the direction cosines (a, b, c) of the bond, the continuum's e = E (1 - nu)/(2 (1 + nu)(1 - 2 nu)) for a strain of size one and
/// etil_A = 1/4 sum over B of Omega alpha V_B (k_n s^2 + k_t |gamma|^2) l, from given length factors alpha (n_bonds). At an interface e is
/// the volume-weighted mean of the `materials`', which are those that the law makes of the given ones.
///
/// With d_min as spacing a horizon factor of 2 takes about 200 sweeps, of 2.5 or more about 130; at 1.5 there is no fixed point.
pub fn iterate(
    bonds: &BondSet<3>,
    cloud: &PointCloud<3>,
    stiffness: &BondStiffness,
    length_factor: Vec<f64>,
    materials: &[Isotropic],
    sweeps: Sweeps,
) -> Correction {
    let densities = |bond: usize| {
        let factor = length_factor[bond] * bonds.length[bond];
        [
            factor * stiffness.axial[bond],
            factor * stiffness.shear[bond],
        ]
    };
    let targets = target_energies(SolidStrainMode::UniaxialX, cloud, materials);
    let families = Families::new(bonds, cloud, densities, &targets);
    sweeps.correct(families, length_factor)
}

/// Strain energy density of every point over the continuum's, for each of [`SolidStrainMode::ALL`], shape (7, n_points).
pub fn energy_ratios(
    bonds: &BondSet<3>,
    cloud: &PointCloud<3>,
    stiffness: &BondStiffness,
    correction: &Correction,
    materials: &[Isotropic],
) -> [Vec<f64>; 7] {
    let energies = cloud.over_families(|point| {
        let mut energies = [0.0; 7];
        for &bond in bonds.incidence.at(point) {
            let volume = cloud.volumes[bonds.neighbour(bond, point) as usize];
            let bond = bond as usize;
            let weight = correction.length_factor[bond]
                * correction.domain_factor[bond]
                * bonds.length[bond]
                * volume;
            let shear_ratio = correction.shear_ratio.get(bond).copied().unwrap_or(1.0);
            for (energy, mode) in energies.iter_mut().zip(SolidStrainMode::ALL) {
                let [stretch, shear] = mode.bond_deformation(bonds.direction[bond]);
                *energy += weight
                    * (stiffness.axial[bond] * stretch
                        + shear_ratio * stiffness.shear[bond] * shear);
            }
        }
        energies.map(|sum| 0.25 * sum)
    });
    std::array::from_fn(|mode| {
        let target = target_energies(SolidStrainMode::ALL[mode], cloud, materials);
        let ratios = energies.iter().zip(target);
        ratios.map(|(energies, e)| energies[mode] / e).collect()
    })
}

fn target_energies(
    mode: SolidStrainMode,
    cloud: &PointCloud<3>,
    materials: &[Isotropic],
) -> Vec<f64> {
    let energies: Vec<f64> = materials.iter().map(|it| mode.energy(it)).collect();
    (0..cloud.len())
        .map(|point| cloud.mean_property(point, &energies))
        .collect()
}

#[cfg(test)]
mod tests;
