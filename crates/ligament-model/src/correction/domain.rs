//! The iterative domain correction: factors Omega that make the strain energies of uniaxial strains along the axes right at every point
//! (NHPD section 2.3, eqs 11 to 13). The third axis of bodies in space is our own, see `docs/space.md`.
//!
//! The correction is tied to the axes: quarter turns of the mesh leave the result unchanged, other turns do not.

use nalgebra::Vector3;

use super::Correction;
use super::families::Families;
use super::strain_mode::StrainMode;
use super::sweeps::Sweeps;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::element::imaginary::matrix;
use crate::fixed::EnergyRatio;
use crate::law::BondStiffness;
use crate::material::Stiffness;

/// Largest number of strains in which energies are compared.
pub(super) const MOST_MODES: usize = 7;

/// Iterates Omega from 1 (NHPD eq. 13; the numerator printed as the strain is the energy density e):
///
/// Omega <- Omega / sqrt((a/p_x)^2 + (b/p_y)^2 + (c/p_z)^2), p_x = (e_A/etil_A,x + e_B/etil_B,x)/2, p_y and p_z alike,
///
/// with the direction cosines (a, b, c) of the bond, from given length factors alpha (n_bonds), with the trial energy density
/// etil_A = (1/4) sum over B of Omega alpha V_B (k_n s^2 + k_t |gamma|^2) l (eq. 12) and the energy density e_A of the `continuum`: the
/// stiffness of each material. At an interface e_A is the volume-weighted mean of the materials'.
///
/// In space, with d_min as spacing, a horizon factor of 2 takes about 200 sweeps, of 2.5 or more about 130; at 1.5 there is no fixed point.
pub fn iterate<const D: usize>(
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    stiffness: &BondStiffness,
    length_factor: Vec<f64>,
    continuum: &[Stiffness],
    sweeps: Sweeps,
) -> Correction {
    let modes = StrainMode::<D>::uniaxial();
    let density =
        |axis: usize, bond| energy_density(&modes[axis], bond, bonds, stiffness, &length_factor);
    let targets = std::array::from_fn(|axis| target_energies(&modes[axis], cloud, continuum));
    let families = Families::new(bonds, cloud, density, &targets);
    sweeps.correct(families, length_factor)
}

/// Ratio of the strain energy density of every point to the density of the continuum, for each of [`StrainMode::all`], with half the energy of a
/// bond at either end.
pub fn energy_ratios<const D: usize>(
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    stiffness: &BondStiffness,
    correction: &Correction,
    continuum: &[Stiffness],
) -> Vec<EnergyRatio> {
    let modes = StrainMode::<D>::all();
    let energies = cloud.over_families(|point| {
        let mut energies = [0.0; MOST_MODES];
        for &bond in bonds.incidence.at(point) {
            let volume = cloud.volumes[bonds.neighbour(bond, point) as usize];
            let share = share(stiffness, bonds, bond, point);
            let bond = bond as usize;
            for (energy, mode) in energies.iter_mut().zip(&modes) {
                let density =
                    energy_density(mode, bond, bonds, stiffness, &correction.length_factor);
                *energy += share * correction.domain_factor[bond] * density * volume;
            }
        }
        energies.map(|sum| 0.5 * sum)
    });
    ratios(&modes, cloud, continuum, |place| {
        energies.iter().map(|it| it[place]).collect()
    })
}

/// Energy densities of the points under some uniform strains over the energy density of the continuum; the function `energies` gives the
/// densities (n_points, J/m^3) under the strain of a number.
pub(super) fn ratios<const D: usize>(
    modes: &[StrainMode<D>],
    cloud: &PointCloud<D>,
    continuum: &[Stiffness],
    energies: impl Fn(usize) -> Vec<f64>,
) -> Vec<EnergyRatio> {
    let ratios = modes.iter().enumerate().map(|(place, mode)| {
        let target = target_energies(mode, cloud, continuum);
        let ratios = energies(place).into_iter().zip(target);
        mode.named(ratios.map(|(energy, e)| energy / e).collect())
    });
    ratios.collect()
}

/// Fraction of the energy of a bond that belongs to one of its ends.
fn share<const D: usize>(
    stiffness: &BondStiffness,
    bonds: &BondSet<D>,
    bond: u32,
    point: u32,
) -> f64 {
    let of_first = stiffness.strain.get(bond as usize);
    let first_share = of_first.map_or(0.5, |stiffness| stiffness.first_share);
    if bonds.ends[bond as usize][0] == point {
        first_share
    } else {
        1.0 - first_share
    }
}

/// Product alpha (k_n s^2 + k_t |gamma|^2) l of a bond under a strain of size one.
pub(super) fn energy_density<const D: usize>(
    mode: &StrainMode<D>,
    bond: usize,
    bonds: &BondSet<D>,
    stiffness: &BondStiffness,
    length_factor: &[f64],
) -> f64 {
    let density = match stiffness.strain.get(bond) {
        Some(density) => {
            let strain = Vector3::from_iterator(mode.strain.engineering().take(3));
            strain.dot(&(matrix(density.entries) * strain))
        }
        None => {
            let (axial, shear) = (stiffness.axial[bond], stiffness.shear[bond]);
            mode.density(bonds.direction[bond], axial, shear)
        }
    };
    length_factor[bond] * density * bonds.length[bond]
}

fn target_energies<const D: usize>(
    mode: &StrainMode<D>,
    cloud: &PointCloud<D>,
    continuum: &[Stiffness],
) -> Vec<f64> {
    let energies: Vec<f64> = continuum.iter().map(|it| mode.energy(it)).collect();
    (0..cloud.len())
        .map(|point| cloud.mean_property(point, &energies))
        .collect()
}
