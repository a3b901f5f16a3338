//! The bond of a pair of springs, along it and across it, between points without rotation (PDS; MPPD section 2.1).
//!
//! Its shear deformation does not know a rotation of the whole body from a shear: where its shear rigidity is not zero, a
//! rigid rotation costs energy.

use super::pair::PairKinematics;
use super::{BondDeformation, Remaining, Rigidities};
use crate::bonds::BondSet;
use crate::layout::Component;

/// Geometry and rigidity of one bond.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringBond {
    /// Length l, m.
    pub length: f64,
    /// Direction cosines (a, b) from A to B.
    pub direction: [f64; 2],
    /// Omega alpha V_A V_B k_n l, J: energy 1/2 (...) s^2.
    pub axial_rigidity: f64,
    /// Omega alpha V_A V_B k_t l, J: energy 1/2 (...) gamma^2.
    pub shear_rigidity: f64,
}

impl PairKinematics<2> for SpringBond {
    const COMPONENTS: [Component; 2] = [Component::X, Component::Y];

    #[inline]
    fn new(bonds: &BondSet, rigidities: &Rigidities, bond: usize) -> Self {
        Self {
            length: bonds.length[bond],
            direction: bonds.direction[bond],
            axial_rigidity: rigidities.axial[bond],
            shear_rigidity: rigidities.shear[bond],
        }
    }

    #[inline]
    fn weakened(self, remaining: &Remaining) -> Self {
        Self {
            axial_rigidity: remaining.axial * self.axial_rigidity,
            shear_rigidity: remaining.shear * self.shear_rigidity,
            ..self
        }
    }

    #[inline]
    fn geometry(&self) -> (f64, [f64; 2]) {
        (self.length, self.direction)
    }

    /// Deformation for the displacements of the ends A and B:
    ///
    /// s = [a (u_xB - u_xA) + b (u_yB - u_yA)]/l, gamma = [-b (u_xB - u_xA) + a (u_yB - u_yA)]/l.
    #[inline(always)]
    fn deformation(&self, end_a: &[f64], end_b: &[f64]) -> BondDeformation {
        let [a, b] = self.direction;
        let (du_x, du_y) = (end_b[0] - end_a[0], end_b[1] - end_a[1]);
        let per_length = 1.0 / self.length;
        let stretch = (a * du_x + b * du_y) * per_length;
        let shear = (-b * du_x + a * du_y) * per_length;
        BondDeformation::new([stretch, shear, 0.0])
    }

    /// 1/2 u^T K u', J, for two deformations of the same bond.
    #[inline]
    fn mutual_energy(&self, one: &BondDeformation, other: &BondDeformation) -> f64 {
        0.5 * (self.axial_rigidity * one.stretch() * other.stretch()
            + self.shear_rigidity * one.shear() * other.shear())
    }

    /// Internal forces K u at the ends A and B, N.
    #[inline]
    fn end_forces(&self, deformation: &BondDeformation) -> [[f64; 2]; 2] {
        let [a, b] = self.direction;
        let per_length = 1.0 / self.length;
        let axial = self.axial_rigidity * deformation.stretch() * per_length;
        let transverse = self.shear_rigidity * deformation.shear() * per_length;
        let (force_x, force_y) = (axial * a - transverse * b, axial * b + transverse * a);
        [[-force_x, -force_y], [force_x, force_y]]
    }

    /// K as a sum over stretch and shear of rigidity g g^T.
    fn modes(&self) -> [(f64, [[f64; 2]; 2]); 2] {
        let [a, b] = [
            self.direction[0] / self.length,
            self.direction[1] / self.length,
        ];
        [
            (self.axial_rigidity, [[-a, -b], [a, b]]),
            (self.shear_rigidity, [[b, -a], [-b, a]]),
        ]
    }
}
