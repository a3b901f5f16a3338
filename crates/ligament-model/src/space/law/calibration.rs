//! Discrete calibration in space: sums over the families of the points in place of the integrals over a full ball.

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::law::BondStiffness;
use crate::law::calibration::scaled_to;
use crate::material::Isotropic;

/// Scales the densities of a law so that every point has the right energy, with the factors alpha (n_bonds).
///
/// A strain eps in all directions costs a point 1/4 sum alpha V_B l k_n eps^2, which should be 9/2 K eps^2. A strain e without change of
/// volume costs, in the mean over its directions, 1/4 sum alpha V_B l (2/15 k_n + 1/5 k_t) e : e, which should be G e : e. So
///
/// q_n = 18 K/sum(alpha V_B l k_n), q_t = (20 G - 12 K)/sum(alpha V_B l k_t)
///
/// are the factors of a point. `materials` are those that the law makes of the given ones.
pub fn calibrated(
    stiffness: BondStiffness,
    length_factor: &[f64],
    bonds: &BondSet<3>,
    cloud: &PointCloud<3>,
    materials: &[Isotropic],
) -> BondStiffness {
    let targets = materials.iter().map(|it| {
        let bulk = 18.0 * bulk_modulus(it);
        [
            bulk,
            10.0 * it.young / (1.0 + it.poisson) - bulk * 12.0 / 18.0,
        ]
    });
    scaled_to(targets, stiffness, length_factor, bonds, cloud)
}

/// Bulk modulus K = E/(3 (1 - 2 nu)), Pa.
pub fn bulk_modulus(material: &Isotropic) -> f64 {
    material.young / (3.0 * (1.0 - 2.0 * material.poisson))
}
