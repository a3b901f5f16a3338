//! Pairs in the plane.
//!
//! Rotations are counter-clockwise. With them the shear row of B reads [0, -1, -l/2, 0, 1, -l/2]/l; the signs +l/2 of
//! the printed eq. 3 (NHPD) belong to clockwise rotations.

use super::{Pair, PairMechanics};
use crate::element::BondDeformation;
use crate::tensor::SymTensor;

impl<const M: usize> PairMechanics<2, M> for Pair<2, M> {
    type Deformation = BondDeformation;

    /// Deformation for the motions [u_x, u_y, theta] of the ends A and B (NHPD eqs 2, 3):
    ///
    /// s = [a (u_xB - u_xA) + b (u_yB - u_yA)]/l,
    /// gamma = [-b (u_xB - u_xA) + a (u_yB - u_yA)]/l - (theta_A + theta_B)/2, theta_rel = theta_B - theta_A;
    ///
    /// of a spring without the rotations.
    #[inline(always)]
    fn between(&self, end_a: &[f64], end_b: &[f64]) -> BondDeformation {
        let [a, b] = self.direction;
        let (du_x, du_y) = (end_b[0] - end_a[0], end_b[1] - end_a[1]);
        let per_length = 1.0 / self.length;
        let stretch = (a * du_x + b * du_y) * per_length;
        let shear = (-b * du_x + a * du_y) * per_length;
        if M == 2 {
            return BondDeformation::new([stretch, shear, 0.0]);
        }
        let shear = shear - 0.5 * (end_a[2] + end_b[2]);
        BondDeformation::new([stretch, shear, end_b[2] - end_a[2]])
    }

    /// Deformation s = a^2 eps_xx + b^2 eps_yy + a b gamma_xy, gamma = a b (eps_yy - eps_xx) + (a^2 - b^2) gamma_xy/2.
    #[inline(always)]
    fn in_strain(&self, strain: &SymTensor<2>) -> BondDeformation {
        let [a, b] = self.direction;
        let [xx, yy, xy] = [strain.at(0, 0), strain.at(1, 1), strain.at(0, 1)];
        let stretch = a * a * xx + b * b * yy + a * b * (2.0 * xy);
        let shear = a * b * (yy - xx) + (a * a - b * b) * xy;
        BondDeformation::new([stretch, shear, 0.0])
    }

    #[inline(always)]
    fn energy(&self, one: &BondDeformation, other: &BondDeformation) -> f64 {
        let of_springs = 0.5
            * (self.axial_rigidity * one.stretch() * other.stretch()
                + self.shear_rigidity * one.shear() * other.shear());
        if M == 2 {
            return of_springs;
        }
        of_springs + 0.5 * (self.rotational_rigidity * one.rotation() * other.rotation())
    }

    #[inline(always)]
    fn forces_at_ends(&self, deformation: &BondDeformation) -> [[f64; M]; 2] {
        let [a, b] = self.direction;
        let per_length = 1.0 / self.length;
        let axial = self.axial_rigidity * deformation.stretch() * per_length;
        let transverse = self.shear_rigidity * deformation.shear() * per_length;
        let (force_x, force_y) = (axial * a - transverse * b, axial * b + transverse * a);
        let half_moment = -0.5 * (self.shear_rigidity * deformation.shear());
        let moment = self.rotational_rigidity * deformation.rotation();
        let at_a = [-force_x, -force_y, half_moment - moment];
        let at_b = [force_x, force_y, half_moment + moment];
        [at_a, at_b].map(|forces| std::array::from_fn(|component| forces[component]))
    }

    /// K as a sum over stretch, shear and relative rotation of rigidity g g^T, with the rows g of B^T R (NHPD eq. 3), which
    /// take the motions of A and B to (s, gamma, theta_rel).
    fn modes(&self) -> impl Iterator<Item = (f64, [[f64; M]; 2])> {
        let [a, b] = self.direction.map(|cosine| cosine / self.length);
        let modes: [(f64, [[f64; 3]; 2]); 3] = [
            (self.axial_rigidity, [[-a, -b, 0.0], [a, b, 0.0]]),
            (self.shear_rigidity, [[b, -a, -0.5], [-b, a, -0.5]]),
            (
                self.rotational_rigidity,
                [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]],
            ),
        ];
        let of_ends = |ends: [[f64; 3]; 2]| ends.map(|row| std::array::from_fn(|it| row[it]));
        let own = modes.into_iter().take(M);
        own.map(move |(rigidity, ends)| (rigidity, of_ends(ends)))
    }
}
