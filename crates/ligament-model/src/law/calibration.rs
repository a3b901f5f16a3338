//! Discrete calibration: sums over the families of the points in place of the integrals over a full circle.
//!
//! The integrals over a full circle, in space a full ball, do not include the lattice or the surface. Here the discrete energies of uniform
//! strains at a point are matched: of equal strains along x and y, and of a shear averaged over its directions.
//!
//! The lattice itself remains anisotropic: the beam form with m = 3 and nu = 0 has E, nu and G/G_0 of 0.964, 0.036 and 1.07 along the axes
//! and 1.034, -0.034 and 0.93 between them (by integrals with the surface correction 0.925, 0.071 and 0.98, and 0.989, 0.006 and 0.86).

use super::BondStiffness;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::material::{Isotropic, Space};

/// Scales the densities of a law so that every point has the right energy, with the factors alpha (n_bonds).
///
/// In the plane, with (k_n, k_t) of the law a strain eps along x and y costs a point 1/4 sum alpha V_B l k_n eps^2 (MPPD eq. 33 in sums), which
/// should be (C_11 + C_12) eps^2; a shear gamma costs 1/32 sum alpha V_B l (k_n + k_t) gamma^2 in the mean over its directions,
/// which should be G/2 gamma^2. So
///
/// q_n = 4 (C_11 + C_12) / sum(alpha V_B l k_n), q_t = (16 G - 4 (C_11 + C_12)) / sum(alpha V_B l k_t)
///
/// are the factors of a point. In space a strain eps in all directions costs 1/4 sum alpha V_B l k_n eps^2, which should be 9/2 K eps^2, and a
/// strain e without change of volume, in the mean over its directions, 1/4 sum alpha V_B l (2/15 k_n + 1/5 k_t) e : e, which should be
/// G e : e. So there
///
/// q_n = 18 K/sum(alpha V_B l k_n), q_t = (20 G - 12 K)/sum(alpha V_B l k_t).
///
/// `materials` are the effective ones of the law.
pub fn calibrated<const D: usize>(
    stiffness: BondStiffness,
    length_factor: &[f64],
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    materials: &[Isotropic],
    space: Space,
) -> BondStiffness {
    let target = |it: &Isotropic| match space {
        Space::Plane(plane) => {
            let c = it.plane_stiffness(plane);
            let bulk = 4.0 * (c[(0, 0)] + c[(0, 1)]);
            [bulk, 16.0 * c[(2, 2)] - bulk]
        }
        Space::Solid => {
            let bulk = 18.0 * it.bulk_modulus();
            let shear = 10.0 * it.young / (1.0 + it.poisson);
            [bulk, shear - bulk * 12.0 / 18.0]
        }
    };
    scaled_to(
        materials.iter().map(target),
        stiffness,
        length_factor,
        bonds,
        cloud,
    )
}

/// Scales the densities of a law so that the sums of alpha V_B l k_n and of alpha V_B l k_t over the bonds of a point are the targets of its
/// materials, shape (n_materials), J/m^3.
///
/// A bond has the mean of the factors of its ends. Points near a surface have smaller sums and larger factors: a surface correction is not
/// needed.
fn scaled_to<const D: usize>(
    targets: impl Iterator<Item = [f64; 2]>,
    stiffness: BondStiffness,
    length_factor: &[f64],
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
) -> BondStiffness {
    let (of_stretch, of_shear): (Vec<f64>, Vec<f64>) = targets.map(<(f64, f64)>::from).unzip();
    let targets = [of_stretch, of_shear];
    let BondStiffness {
        mut axial,
        mut shear,
        mut rotational,
        ..
    } = stiffness;
    let factors = cloud.over_families(|point| {
        let mut sums = [0.0; 2];
        for &bond in bonds.incidence.at(point) {
            let volume = cloud.volumes[bonds.neighbour(bond, point) as usize];
            let bond = bond as usize;
            let weight = length_factor[bond] * volume * bonds.length[bond];
            sums[0] += weight * axial[bond];
            sums[1] += weight * shear[bond];
        }
        [0, 1].map(|k| {
            let target = cloud.mean_property(point as usize, &targets[k]);
            // A zero density cannot be scaled: k_t = 0, or a point without bonds.
            if sums[k] == 0.0 {
                1.0
            } else {
                target / sums[k]
            }
        })
    });
    let of_bonds = axial.iter_mut().zip(&mut shear).zip(&mut rotational);
    for (((axial, shear), rotational), ends) in of_bonds.zip(&*bonds.ends) {
        let [a, b] = ends.map(|end| factors[end as usize]);
        *axial *= 0.5 * (a[0] + b[0]);
        *shear *= 0.5 * (a[1] + b[1]);
        *rotational *= 0.5 * (a[1] + b[1]);
    }
    BondStiffness {
        axial,
        shear,
        rotational,
        ..stiffness
    }
}
