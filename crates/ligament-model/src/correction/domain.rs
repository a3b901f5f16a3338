//! The iterative domain correction: factors Omega that make the strain energy of a uniaxial strain along x and along y
//! right at every point (NHPD section 2.3, eqs 11 to 13).
//!
//! The correction is tied to the axes: quarter turns of the mesh leave the answer as it is, other turns do not.

use nalgebra::Vector3;

use super::Correction;
use super::families::Families;
use super::strain_mode::StrainMode;
use super::sweeps::Sweeps;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::element::imaginary::matrix;
use crate::law::BondStiffness;
use crate::material::{Material, Plane};

/// The continuum whose strain energies the bonds are to have.
#[derive(Debug, Clone, Copy)]
pub struct Continuum<'a> {
    /// Materials of the regions.
    pub materials: &'a [Material],
    /// State of the plane.
    pub plane: Plane,
}

/// Iterates Omega from 1 (NHPD eq. 13; the numerator printed as the strain is the energy density e):
///
/// Omega <- Omega / sqrt((a/p_x)^2 + (b/p_y)^2), p_x = (e_A/etil_A,x + e_B/etil_B,x)/2, p_y alike,
///
/// from given length factors alpha (n_bonds), with the trial energy density etil_A = (1/4) sum over B of
/// Omega alpha V_B (k_n s^2 + k_t gamma^2) l (eq. 12). At an interface e_A is the volume-weighted mean of the materials'.
pub fn iterate(
    bonds: &BondSet,
    cloud: &PointCloud,
    stiffness: &BondStiffness,
    length_factor: Vec<f64>,
    continuum: Continuum<'_>,
    sweeps: Sweeps,
) -> Correction {
    let density = |mode, bond| energy_density(mode, bond, bonds, stiffness, &length_factor);
    let targets = [StrainMode::UniaxialX, StrainMode::UniaxialY]
        .map(|mode| target_energies(mode, cloud, continuum));
    let families = Families::new(bonds, cloud, density, &targets);
    sweeps.correct(families, length_factor)
}

/// Strain energy density of every point over the continuum's, for each of [`StrainMode::ALL`], shape (4, n_points).
pub fn energy_ratios(
    bonds: &BondSet,
    cloud: &PointCloud,
    stiffness: &BondStiffness,
    correction: &Correction,
    continuum: Continuum<'_>,
) -> [Vec<f64>; 4] {
    let energies = cloud.over_families(|point| {
        let mut energies = [0.0; 4];
        for &bond in bonds.incidence.at(point) {
            let volume = cloud.volumes[bonds.neighbour(bond, point) as usize];
            let share = share(stiffness, bonds, bond, point);
            let bond = bond as usize;
            for (energy, mode) in energies.iter_mut().zip(StrainMode::ALL) {
                let density =
                    energy_density(mode, bond, bonds, stiffness, &correction.length_factor);
                *energy += share * correction.domain_factor[bond] * density * volume;
            }
        }
        energies.map(|sum| 0.5 * sum)
    });
    [0, 1, 2, 3].map(|mode| {
        let target = target_energies(StrainMode::ALL[mode], cloud, continuum);
        let ratios = energies.iter().zip(target);
        ratios.map(|(energies, e)| energies[mode] / e).collect()
    })
}

/// Share of the energy of a bond that belongs to one of its ends.
fn share(stiffness: &BondStiffness, bonds: &BondSet, bond: u32, point: u32) -> f64 {
    let of_first = stiffness.strain.get(bond as usize);
    let first_share = of_first.map_or(0.5, |stiffness| stiffness.first_share);
    if bonds.ends[bond as usize][0] == point {
        first_share
    } else {
        1.0 - first_share
    }
}

/// alpha (k_n s^2 + k_t gamma^2) l of a bond under a strain of size one.
fn energy_density(
    mode: StrainMode,
    bond: usize,
    bonds: &BondSet,
    stiffness: &BondStiffness,
    length_factor: &[f64],
) -> f64 {
    let density = match stiffness.strain.get(bond) {
        Some(density) => {
            let strain = Vector3::from(mode.strain());
            strain.dot(&(matrix(density.entries) * strain))
        }
        None => {
            let (stretch, shear) = mode.bond_deformation(bonds.direction[bond]);
            stiffness.axial[bond] * stretch * stretch + stiffness.shear[bond] * shear * shear
        }
    };
    length_factor[bond] * density * bonds.length[bond]
}

fn target_energies(mode: StrainMode, cloud: &PointCloud, continuum: Continuum<'_>) -> Vec<f64> {
    let energies: Vec<f64> = (continuum.materials.iter())
        .map(|material| mode.energy(&material.elasticity, continuum.plane))
        .collect();
    (0..cloud.len())
        .map(|point| cloud.mean_property(point, &energies))
        .collect()
}
