//! Stresses at the points by the laws of their materials, from the strains that their bonds show.
//!
//! With the strain eps of a point by least squares over the bonds that it has left ([`super::point_strain`]), less what the temperature
//! gives it, and the stiffness C of its material in the space of the body,
//!
//! sigma = C : eps.
//!
//! That is the stress of an affine motion to rounding, inside a body, at its edges and beside cracks, whatever the corrections of the
//! bonds; the virial stress ([`super::virial`]) is so inside an uncorrected body alone. A point on the border of materials has the mean
//! of their stiffnesses by volume.

use rayon::prelude::*;

use crate::layout::Layout;
use crate::material::Stiffness;
use crate::system::BondSystem;
use crate::tensor::SymTensor;

use super::point_strain::Motion;

impl<const D: usize> BondSystem<D> {
    /// Stress of each point in a motion, shape (n_points), Pa; None where the bonds of a point do not span the space.
    pub(crate) fn stresses_by_material(
        &self,
        layout: Layout,
        motion: Motion<'_>,
    ) -> Vec<Option<SymTensor<D>>> {
        let strains = self.point_strains(layout, motion);
        let numbered = strains.into_par_iter().enumerate();
        numbered
            .map(|(point, strain)| self.stress_of(point as u32, &strain?))
            .collect()
    }

    /// Stress of a point with a strain, Pa; None where the system does not have the stiffnesses of its materials.
    pub(crate) fn stress_of(&self, point: u32, strain: &SymTensor<D>) -> Option<SymTensor<D>> {
        if self.materials.is_empty() {
            return None;
        }
        let strains: Vec<f64> = strain.engineering().collect();
        let mut sums = vec![0.0; strains.len()];
        let shares = self.cloud.shares(point as usize).iter();
        let shares = shares.zip(&self.materials);
        for (share, stiffness) in shares.filter(|(share, _)| **share > 0.0) {
            for (row, sum) in sums.iter_mut().enumerate() {
                *sum += share * component(stiffness, &strains, row);
            }
        }
        Some(SymTensor::from_components(&sums))
    }
}

/// Stress C : eps of a strain.
pub(crate) fn stress<const D: usize>(
    stiffness: &Stiffness,
    strain: &SymTensor<D>,
) -> SymTensor<D> {
    let strains: Vec<f64> = strain.engineering().collect();
    let rows = 0..strains.len();
    let components: Vec<f64> = rows.map(|it| component(stiffness, &strains, it)).collect();
    SymTensor::from_components(&components)
}

/// A component of the stress of engineering strains.
fn component(stiffness: &Stiffness, strains: &[f64], row: usize) -> f64 {
    let terms = strains.iter().enumerate();
    terms
        .map(|(column, strain)| stiffness[(row, column)] * strain)
        .sum()
}

#[cfg(test)]
mod tests;
