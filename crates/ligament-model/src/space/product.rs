//! The product of the stiffness in space with a vector, without a matrix: one sweep over the bonds.

use super::element::SolidKinematics;
use super::system::Typed;
use crate::product::over_parts;
use crate::system::BondsLeft;

impl<const M: usize, B: SolidKinematics<M>> Typed<'_, B, M> {
    /// The product of the stiffness of the bonds that are left with motions, shape (M n_points) both.
    pub(super) fn multiply(self, bonds: BondsLeft<'_>, motions: &[f64], forces: &mut [f64]) {
        let ends = &self.system.bonds.ends;
        over_parts::<M>(ends.len(), forces, |of_part, sums| {
            for bond in of_part {
                if let Some(element) = self.left(bonds, bond) {
                    let [a, b] = ends[bond].map(|end| end as usize);
                    let (at_a, at_b) = (&motions[M * a..][..M], &motions[M * b..][..M]);
                    let forces = element.end_forces(&element.deformation(at_a, at_b));
                    for (point, force) in [a, b].into_iter().zip(forces) {
                        for (sum, value) in sums[point].iter_mut().zip(force) {
                            *sum += value;
                        }
                    }
                }
            }
        });
    }
}
