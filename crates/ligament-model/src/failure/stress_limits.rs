//! Limits of stresses across the bonds.

use super::basis::Basis;
use super::criterion::Surroundings;
use super::hooke::Moduli;
use super::kind::Limits;
use crate::material::VolumetricSplit;

/// Limits of a stress across the bonds over E', from the limits of the materials (n_materials), with coefficients of the measure as a function of the index of a material and its moduli. A bond of several materials has the coefficients of the softest one.
pub(super) fn stress_limits<const D: usize, const N: usize>(
    basis: &Basis<'_, D>,
    of_materials: &[f64],
    coefficients: impl Fn(usize, &Moduli) -> [f64; N],
) -> Limits {
    let of_material = |(material, constants): (usize, &Option<VolumetricSplit>)| {
        let moduli = constants.map_or(Moduli::BAR, |it| Moduli::new(&it.bonds, basis.space));
        coefficients(material, &moduli)
    };
    let constants = basis.constants.iter().enumerate();
    let of_material: Vec<[f64; N]> = constants.map(of_material).collect();
    let materials = basis.weakest_materials(of_materials).into_iter();
    Limits {
        limit: basis.weakest(of_materials),
        coefficient: materials.flat_map(|it| of_material[it]).collect(),
        surroundings: Some(Surroundings::Stress.into()),
        is_brittle: false,
        name: None,
    }
}
