//! Discrete calibration in space: sums over the families of the points in place of the integrals over a full ball.

use rayon::prelude::*;

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::law::BondStiffness;
use crate::material::Isotropic;

/// Scales the densities of a law so that every point has the right energy, with the factors alpha (n_bonds).
///
/// A strain eps in all directions costs a point 1/4 sum alpha V_B l k_n eps^2, which should be 9/2 K eps^2. A strain e without change of
/// volume costs, in the mean over its directions, 1/4 sum alpha V_B l (2/15 k_n + 1/5 k_t) e : e, which should be G e : e. So
///
/// q_n = 18 K/sum(alpha V_B l k_n), q_t = (20 G - 12 K)/sum(alpha V_B l k_t)
///
/// are the factors of a point, and a bond takes the mean of its ends'. `materials` are those that the law makes of the given ones.
pub fn calibrated(
    stiffness: BondStiffness,
    length_factor: &[f64],
    bonds: &BondSet<3>,
    cloud: &PointCloud<3>,
    materials: &[Isotropic],
) -> BondStiffness {
    let bulk: Vec<f64> = materials.iter().map(|it| 18.0 * bulk_modulus(it)).collect();
    let shear: Vec<f64> = (materials.iter().zip(&bulk))
        .map(|(it, bulk)| 10.0 * it.young / (1.0 + it.poisson) - bulk * 12.0 / 18.0)
        .collect();
    let targets = [bulk, shear];
    let BondStiffness {
        mut axial,
        mut shear,
        mut rotational,
        ..
    } = stiffness;
    let factors = cloud.over_points(|point| {
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
            // Without a density there is nothing to scale: k_t = 0, or a point without bonds.
            if sums[k] == 0.0 {
                1.0
            } else {
                target / sums[k]
            }
        })
    });
    (&mut axial, &mut shear, &mut rotational, &bonds.ends)
        .into_par_iter()
        .for_each(|(axial, shear, rotational, ends)| {
            let [a, b] = ends.map(|end| factors[end as usize]);
            *axial *= 0.5 * (a[0] + b[0]);
            *shear *= 0.5 * (a[1] + b[1]);
            *rotational *= 0.5 * (a[1] + b[1]);
        });
    BondStiffness {
        axial,
        shear,
        rotational,
        ..stiffness
    }
}

/// Bulk modulus K = E/(3 (1 - 2 nu)), Pa.
pub fn bulk_modulus(material: &Isotropic) -> f64 {
    material.young / (3.0 * (1.0 - 2.0 * material.poisson))
}
