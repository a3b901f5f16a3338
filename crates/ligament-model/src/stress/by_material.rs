//! Stresses at the points by the laws of their materials, from the strains of their bonds.
//!
//! With the strain eps of a point by least squares, less its thermal strain, and the stiffness C of its material in the space of
//! the body,
//!
//! sigma = C : eps.
//!
//! The strain at which sound bonds would carry the forces of the point ([`super::carried`]) gives the stress that the material carries, the
//! strain of its unbroken bonds ([`super::point_strain`]) the effective stress of damage mechanics; both are equal at an undamaged point.
//!
//! That is the stress of an affine motion to rounding, inside a body, at its edges and beside cracks, whatever the corrections of the
//! bonds; the virial stress ([`super::virial`]) is so inside an uncorrected body alone. A point on the border of materials has the mean
//! of their stiffnesses by volume.

use crate::interface::Stresses;
use crate::layout::Layout;
use crate::material::stress_component;
use crate::parallel;
use crate::system::{BondSystem, StressAcrossPlane, UnbrokenBonds};
use crate::tensor::SymTensor;

use super::carried::StrainReading;

impl<const D: usize> BondSystem<D> {
    /// Stress of each point in a motion, Pa; not a number where the bonds of a point do not span the space.
    pub(crate) fn stresses_by_material(
        &self,
        layout: Layout,
        reading: StrainReading<'_>,
    ) -> Stresses {
        let strains = self.strains_of_all(|point| self.strain_by(layout, reading, point));
        let of_point =
            |point| self.stress_components(layout, reading, point as u32, strains[point]);
        Stresses {
            names: SymTensor::<D>::NAMES_WITH_NORMAL,
            values: parallel::flat_map(strains.len(), of_point),
        }
    }

    /// Stress of a point from a strain by a reading, Pa: the stress of its bonds plus the stress of its cells; None where the system does
    /// not have the stiffnesses of its materials.
    pub(crate) fn stress_in(
        &self,
        layout: Layout,
        reading: StrainReading<'_>,
        point: u32,
        strain: &SymTensor<D>,
    ) -> Option<SymTensor<D>> {
        let stress = self.stress_of(point, strain)?;
        let Some(terms) = &self.volumetric else {
            return Some(stress);
        };
        let motion = reading.motion();
        let remaining = match reading {
            StrainReading::Effective(_) => &[][..],
            StrainReading::Carried(carried) => carried.remaining,
        };
        let bonds = UnbrokenBonds {
            intact: motion.intact,
            remaining,
        };
        let motions = (motion.displacement, layout.components.len());
        let found = terms.stress_in_motions(bonds, motions, motion.expansion, point);
        let of_cells = match reading {
            StrainReading::Effective(_) => found.mean_over_living(),
            StrainReading::Carried(_) => found.mean_over_all(),
        };
        let of_cells = of_cells.unwrap_or_else(|| self.volumetric_stress_of(point, strain));
        Some(stress.plus(&SymTensor::isotropic(of_cells)))
    }

    /// Stress components of a point from a strain by a reading, Pa; for the plane with the component across it, NaN where that is unknown. All are
    /// NaN without a strain or without the stiffnesses of the materials.
    pub(crate) fn stress_components(
        &self,
        layout: Layout,
        reading: StrainReading<'_>,
        point: u32,
        strain: Option<SymTensor<D>>,
    ) -> Vec<f64> {
        let stress = strain.and_then(|it| self.stress_in(layout, reading, point, &it));
        let (Some(strain), Some(stress)) = (strain, stress) else {
            return vec![f64::NAN; SymTensor::<D>::NAMES_WITH_NORMAL.len()];
        };
        let mut components: Vec<f64> = stress.components().collect();
        if D == 2 {
            components.push(match self.stress_across_plane {
                StressAcrossPlane::Zero => 0.0,
                StressAcrossPlane::OfIsotropic => {
                    self.stress_across_plane(reading, point, &strain, &stress)
                }
                StressAcrossPlane::Unknown => f64::NAN,
            });
        }
        components
    }

    /// Stress across the plane of a point in plane strain, Pa, from its stress in the plane and its strain less the thermal strain. By Hooke's law
    /// with the whole strain eps,
    ///
    /// sigma_zz = lambda tr(eps) - (3 lambda + 2 mu) alpha T = (sigma_xx + sigma_yy)/2 - mu tr(eps).
    fn stress_across_plane(
        &self,
        reading: StrainReading<'_>,
        point: u32,
        strain: &SymTensor<D>,
        stress: &SymTensor<D>,
    ) -> f64 {
        let free = reading.motion().expansion.in_body::<D>(point);
        let of_shear = SymTensor::<D>::COMPONENTS.len() - 1;
        let shares = self.cloud.shares(point as usize).iter();
        let moduli = shares.zip(&self.materials);
        let mu: f64 = moduli
            .map(|(share, stiffness)| share * stiffness[(of_shear, of_shear)])
            .sum();
        0.5 * stress.trace() - mu * (strain.trace() + free.trace())
    }

    /// Stress of a point for a strain by the stiffness of its bonds, Pa; None where the system does not have the stiffnesses of its materials.
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

    /// Stress kappa tr(eps) of a point whose elements have the whole stiffness of its materials, Pa; 0 without elements.
    pub(crate) fn volumetric_stress_of(&self, point: u32, strain: &SymTensor<D>) -> f64 {
        let has_elements = self.far.as_ref().is_some_and(|far| far.volume(point) > 0.0);
        let Some(terms) = self.volumetric.as_ref().filter(|_| has_elements) else {
            return 0.0;
        };
        self.cloud.mean_property(point as usize, terms.moduli()) * strain.trace()
    }
}

#[cfg(test)]
mod tests;
