//! Stresses at the points by the laws of their materials, from the strains that their bonds show.
//!
//! With the strain eps of a point by least squares, less what the temperature gives it, and the stiffness C of its material in the space of
//! the body,
//!
//! sigma = C : eps.
//!
//! The strain at which sound bonds would carry the forces of the point ([`super::carried`]) gives the stress that the material carries, the
//! strain of the bonds that it has left ([`super::point_strain`]) the effective stress of damage mechanics; a sound point has one stress.
//!
//! That is the stress of an affine motion to rounding, inside a body, at its edges and beside cracks, whatever the corrections of the
//! bonds; the virial stress ([`super::virial`]) is so inside an uncorrected body alone. A point on the border of materials has the mean
//! of their stiffnesses by volume.

use rayon::prelude::*;

use crate::layout::Layout;
use crate::material::stress_component;
use crate::system::BondSystem;
use crate::tensor::SymTensor;

use super::carried::StrainReading;

impl<const D: usize> BondSystem<D> {
    /// Stress of each point in a motion, shape (n_points), Pa; None where the bonds of a point do not span the space.
    pub(crate) fn stresses_by_material(
        &self,
        layout: Layout,
        reading: StrainReading<'_>,
    ) -> Vec<Option<SymTensor<D>>> {
        let strains = self.strains_of_all(|point| self.strain_by(layout, reading, point));
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
                *sum += share * stress_component(stiffness, &strains, row);
            }
        }
        Some(SymTensor::from_components(&sums))
    }
}

#[cfg(test)]
mod tests;
