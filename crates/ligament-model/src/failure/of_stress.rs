//! Limits of stresses across the bonds, and measures that follow the stress.

use rayon::prelude::*;

use super::basis::{Basis, weakest_materials};
use super::hooke::Moduli;
use super::kind::Limits;
use super::measure::Measure;
use super::surroundings::Surroundings;
use crate::element::BondDeformation;
use crate::material::Isotropic;
use crate::stress::point_strain::StrainAround;

/// Limits of a stress across the bonds over E', from those of the materials (n_materials), with the coefficients of its measure that a
/// function makes of the index of a material and its moduli. A bond between materials takes those of the one with the smallest limit.
pub(super) fn of_stress<const D: usize, const N: usize>(
    basis: &Basis<'_, D>,
    of_materials: &[f64],
    coefficients: impl Fn(usize, &Moduli) -> [f64; N],
) -> Limits {
    let of_material = |(material, constants): (usize, &Option<Isotropic>)| {
        let moduli = constants.map_or(Moduli::BAR, |it| Moduli::new(&it, basis.space));
        coefficients(material, &moduli)
    };
    let constants = basis.constants.iter().enumerate();
    let of_material: Vec<[f64; N]> = constants.map(of_material).collect();
    let materials = weakest_materials(basis.system, of_materials).into_iter();
    Limits {
        limit: basis.weakest(of_materials),
        coefficient: materials.flat_map(|it| of_material[it]).collect(),
        surroundings: Some(Surroundings::Stress.into()),
        is_brittle: false,
    }
}

/// Puts the stress around each bond into the coefficients of a measure, shape (n_bonds, n).
pub(super) fn follow_stress(
    measure: Measure,
    coefficients: &mut [f64],
    around: &[Option<StrainAround>],
    deformations: &[BondDeformation],
) {
    let count = measure.coefficient_names().len();
    let of_bonds = coefficients.par_chunks_exact_mut(count);
    let both = around.par_iter().zip(deformations);
    of_bonds.zip(both).for_each(|(own, (around, it))| {
        measure.follow_stress(own, around.as_ref(), it);
    });
}

impl Measure {
    /// Puts the stress around a bond into its coefficients of a measure that [takes it](Self::takes_stress).
    pub fn follow_stress(
        self,
        coefficients: &mut [f64],
        around: Option<&StrainAround>,
        deformation: &BondDeformation,
    ) {
        let lateral = |lateral: f64, bar: f64| match around {
            Some(around) => lateral * around.lateral,
            None => (bar - 1.0) * deformation.stretch(),
        };
        match coefficients {
            [q, ratio, bar, _] => *q = lateral(*ratio, *bar),
            [q, x, y, z, ratio, modulus, bar, ..] => {
                *q = lateral(*ratio, *bar);
                let shear = around.map_or([0.0; 3], |it| it.shear);
                [*x, *y, *z] = shear.map(|it| *modulus * it);
            }
            _ => {}
        }
    }
}
