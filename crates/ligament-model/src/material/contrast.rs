//! Materials with a reduced contrast of their stiffnesses.

use super::elasticity::{Elasticity, Isotropic, Orthotropic, OutOfPlane, Plane};
use super::{Anisotropic, Material};
use crate::law::bulk_stiffness;

/// The materials of a body with their stiffnesses k changed to k' = k_s (k/k_s)^p, so that the stiffest is `largest` times as stiff as the
/// softest, k_s; `None` where the contrast is not larger.
///
/// Corrections compute factors between such materials. The forces of a soft part on a stiff one may be below the residual of an iteration in
/// the stiff part; then the load of a soft layer between stiff parts would be undetermined.
pub fn with_reduced_contrast(
    materials: &[Material],
    plane: Plane,
    largest: f64,
) -> Option<Vec<Material>> {
    let stiffnesses = materials
        .iter()
        .map(|it| bulk_stiffness(&it.elasticity.plane_stiffness(plane)));
    let stiffnesses: Vec<f64> = stiffnesses.collect();
    let least = stiffnesses.iter().copied().fold(f64::INFINITY, f64::min);
    let most = stiffnesses.iter().copied().fold(0.0, f64::max);
    if most <= largest * least {
        return None;
    }
    let power = largest.ln() / (most / least).ln();
    let of_materials = materials
        .iter()
        .zip(stiffnesses)
        .map(|(material, stiffness)| Material {
            elasticity: scaled(material.elasticity, (stiffness / least).powf(power - 1.0)),
            ..material.clone()
        });
    Some(of_materials.collect())
}

/// Constants of a material with a stiffness multiplied by a factor in all directions.
fn scaled(elasticity: Elasticity, factor: f64) -> Elasticity {
    match elasticity {
        Elasticity::Isotropic(it) => Elasticity::Isotropic(Isotropic {
            young: factor * it.young,
            ..it
        }),
        Elasticity::Orthotropic(it) => Elasticity::Orthotropic(Orthotropic {
            young: it.young.map(|young| factor * young),
            shear_modulus: factor * it.shear_modulus,
            out_of_plane: it.out_of_plane.map(|across| OutOfPlane {
                young: factor * across.young,
                ..across
            }),
            ..it
        }),
        Elasticity::Anisotropic(it) => Elasticity::Anisotropic(Anisotropic {
            stiffness: factor * it.stiffness,
        }),
    }
}
