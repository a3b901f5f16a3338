//! Strain and stress of the elements of a far field around a point.

use super::point_strain::Motion;
use crate::deformation::Deformations;
use crate::layout::Layout;
use crate::system::BondSystem;
use crate::tensor::SymTensor;
use crate::thermal::ThermalStrain;

/// Elements of a far field around a point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ElementsAtPoint<const D: usize> {
    /// Volume of the elements at the point, m^3.
    pub(crate) volume: f64,
    /// Strain at the point by least squares.
    strain: SymTensor<D>,
    /// Stress at this strain, Pa.
    pub(crate) stress: SymTensor<D>,
}

impl<const D: usize> ElementsAtPoint<D> {
    /// Energy 1/2 V sigma : eps, J.
    pub(crate) fn energy(&self) -> f64 {
        0.5 * self.volume * self.stress.contracted(&self.strain)
    }
}

impl<const D: usize> BondSystem<D> {
    /// Elements of the far field around a point; `None` for a point without elements.
    pub(crate) fn elements_at(
        &self,
        layout: Layout,
        deformations: &Deformations,
        point: u32,
    ) -> Option<ElementsAtPoint<D>> {
        let far = self.far.as_ref()?;
        let volume = far.volume(point);
        if volume == 0.0 {
            return None;
        }
        // Elements do not break, and their points have elements on all sides where they have no bonds.
        let motion = Motion {
            intact: &[],
            displacement: deformations.motions(),
            expansion: ThermalStrain::NONE,
        };
        let strain = self.fit_of_elements(layout, motion, point).strain()?;
        let of_cells = self.volumetric_stress_of(point, &strain);
        let stress = self.stress_of(point, &strain)?;
        let stress = stress.plus(&SymTensor::isotropic(of_cells));
        Some(ElementsAtPoint {
            volume,
            strain,
            stress,
        })
    }
}
