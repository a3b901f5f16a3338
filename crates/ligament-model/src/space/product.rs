//! The product of the stiffness in space with a vector, without a matrix: one sweep over the bonds.

use super::element::SolidKinematics;
use super::system::Typed;
use crate::product::{add_to, over_parts};
use crate::system::BondsLeft;

impl<const M: usize, B: SolidKinematics<M>> Typed<'_, B, M> {
    /// The product of the stiffness of the bonds that are left with motions, shape (M n_points) both.
    pub(super) fn multiply(self, bonds: BondsLeft<'_>, motions: &[f64], forces: &mut [f64]) {
        let ends = &self.system.bonds.ends;
        let (motions, _) = motions.as_chunks::<M>();
        over_parts::<M>(ends.len(), forces, |of_part, sums| {
            for bond in of_part {
                if let Some(element) = self.left(bonds, bond) {
                    let [a, b] = ends[bond].map(|end| end as usize);
                    let deformation = element.deformation(&motions[a], &motions[b]);
                    let [at_a, at_b] = element.end_forces(&deformation);
                    add_to(&mut sums[a], at_a);
                    add_to(&mut sums[b], at_b);
                }
            }
        });
    }
}
