//! The beam-like bond with two displacements and a rotation at each end (NHPD eqs 2, 3 and 9).
//!
//! Rotations are counter-clockwise. With them the shear row of B reads [0, -1, -l/2, 0, 1, -l/2]/l; the signs +l/2 of
//! the printed eq. 3 belong to clockwise rotations.

use super::pair::PairKinematics;
use super::spring::SpringBond;
use super::{BondDeformation, Remaining, Rigidities};
use crate::bonds::BondSet;
use crate::layout::Component;

/// A pair of springs between points that turn, and a spring against their relative rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamBond {
    /// Geometry, axial and shear rigidity.
    pub springs: SpringBond,
    /// Omega alpha V_A V_B k_theta, J: energy 1/2 (...) theta_rel^2.
    pub rotational_rigidity: f64,
}

impl PairKinematics<3> for BeamBond {
    const COMPONENTS: [Component; 3] = [Component::X, Component::Y, Component::Rotation];

    #[inline]
    fn new(bonds: &BondSet, rigidities: &Rigidities, bond: usize) -> Self {
        Self {
            springs: SpringBond::new(bonds, rigidities, bond),
            rotational_rigidity: rigidities.rotational[bond],
        }
    }

    #[inline]
    fn weakened(self, remaining: &Remaining) -> Self {
        Self {
            springs: self.springs.weakened(remaining),
            rotational_rigidity: remaining.rotational * self.rotational_rigidity,
        }
    }

    #[inline]
    fn geometry(&self) -> (f64, [f64; 2]) {
        self.springs.geometry()
    }

    /// Deformation for the motions [u_x, u_y, theta] of the ends A and B (NHPD eqs 2, 3):
    ///
    /// s = [a (u_xB - u_xA) + b (u_yB - u_yA)]/l,
    /// gamma = [-b (u_xB - u_xA) + a (u_yB - u_yA)]/l - (theta_A + theta_B)/2, theta_rel = theta_B - theta_A.
    #[inline(always)]
    fn deformation(&self, end_a: &[f64], end_b: &[f64]) -> BondDeformation {
        let without_rotations = self.springs.deformation(end_a, end_b);
        BondDeformation::new([
            without_rotations.stretch(),
            without_rotations.shear() - 0.5 * (end_a[2] + end_b[2]),
            end_b[2] - end_a[2],
        ])
    }

    /// 1/2 u^T K u', J, for two deformations of the same bond.
    #[inline]
    fn mutual_energy(&self, one: &BondDeformation, other: &BondDeformation) -> f64 {
        self.springs.mutual_energy(one, other)
            + 0.5 * (self.rotational_rigidity * one.rotation() * other.rotation())
    }

    /// Internal forces and moment K u at the ends A and B, N and N m.
    #[inline]
    fn end_forces(&self, deformation: &BondDeformation) -> [[f64; 3]; 2] {
        let [[a_x, a_y], [b_x, b_y]] = self.springs.end_forces(deformation);
        let half_moment = -0.5 * (self.springs.shear_rigidity * deformation.shear());
        let moment = self.rotational_rigidity * deformation.rotation();
        [
            [a_x, a_y, half_moment - moment],
            [b_x, b_y, half_moment + moment],
        ]
    }

    /// K as a sum over stretch, shear and relative rotation of rigidity g g^T, with the rows g of B^T R (NHPD eq. 3), which
    /// take the motions of A and B to (s, gamma, theta_rel).
    fn modes(&self) -> [(f64, [[f64; 3]; 2]); 3] {
        let [(axial_rigidity, stretch), (shear_rigidity, shear)] = self.springs.modes();
        let rotation = [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
        [
            (axial_rigidity, stretch.map(|[x, y]| [x, y, 0.0])),
            (shear_rigidity, shear.map(|[x, y]| [x, y, -0.5])),
            (self.rotational_rigidity, rotation),
        ]
    }
}
