//! The virial stress of points in space, sigma_i = 1/(2 V_i) sum_j f_ij (x) xi_ij over the intact bonds of a point, its symmetric part: as in
//! [`stress::virial`](crate::stress::virial). The sum of V_i sigma_i is the mean stress of any body in equilibrium, exactly, and sigma_i the
//! derivative of the point's energy density for a uniform strain.
//!
//! The other reading of the plane, forces through planes at the points, is not made in space: it shares bonds out by areas of the plane.

use rayon::prelude::*;

use super::element::SolidKinematics;
use super::system::Typed;
use crate::deformation::SpaceDeformation;
use crate::system::BondsLeft;

/// Names of the components of a stress in space, in their order.
pub const COMPONENTS: &[&str] = &["xx", "yy", "xy", "zz", "xz", "yz"];

/// Stresses xx, yy, xy, zz, xz and yz, Pa: those of the plane first.
pub type SolidStress = [f64; 6];

impl<const M: usize, B: SolidKinematics<M>> Typed<'_, B, M> {
    /// Virial stress of every point, shape (n_points).
    pub(super) fn virial_stresses(
        self,
        bonds: BondsLeft<'_>,
        deformations: &[SpaceDeformation],
    ) -> Vec<SolidStress> {
        (0..self.system.cloud.len() as u32)
            .into_par_iter()
            .map(|point| self.virial_stress(bonds, deformations, point))
            .collect()
    }

    /// Virial stress of one point.
    pub(super) fn virial_stress(
        self,
        bonds: BondsLeft<'_>,
        deformations: &[SpaceDeformation],
        point: u32,
    ) -> SolidStress {
        let mut sum = [0.0; 6];
        for &bond in self.system.bonds.incidence.at(point) {
            let Some(element) = self.left(bonds, bond as usize) else {
                continue;
            };
            let dyad = element.dyad(&deformations[bond as usize]);
            for (sum, part) in sum.iter_mut().zip(dyad) {
                *sum += 0.5 * part;
            }
        }
        sum.map(|value| value / self.system.cloud.volumes[point as usize])
    }
}
