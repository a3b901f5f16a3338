//! The beam-like bond with two displacements and a rotation at each end (NHPD eqs 2, 3 and 9).
//!
//! Rotations are counter-clockwise. With them the shear row of B reads [0, -1, -l/2, 0, 1, -l/2]/l; the signs +l/2 of
//! the printed eq. 3 belong to clockwise rotations.

use super::{BondDeformation, Element, UNKNOWNS};
use crate::system::BondSystem;

/// Geometry and rigidity of one bond.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamBond {
    /// Length l, m.
    pub length: f64,
    /// Direction cosines (a, b) from A to B.
    pub direction: [f64; 2],
    /// Omega alpha V_A V_B k_n l, J: energy 1/2 (...) s^2.
    pub axial_rigidity: f64,
    /// Omega alpha V_A V_B k_t l, J: energy 1/2 (...) gamma^2.
    pub shear_rigidity: f64,
    /// Omega alpha V_A V_B k_theta, J: energy 1/2 (...) theta_rel^2.
    pub rotational_rigidity: f64,
}

impl Element for BeamBond {
    #[inline]
    fn of(system: &BondSystem, bond: usize) -> Self {
        Self {
            length: system.bonds.length[bond],
            direction: system.bonds.direction[bond],
            axial_rigidity: system.axial_rigidity[bond],
            shear_rigidity: system.shear_rigidity[bond],
            rotational_rigidity: system.rotational_rigidity[bond],
        }
    }

    /// Deformation for the unknowns [u_x, u_y, theta] of the ends A and B (NHPD eqs 2, 3):
    ///
    /// s = [a (u_xB - u_xA) + b (u_yB - u_yA)]/l,
    /// gamma = [-b (u_xB - u_xA) + a (u_yB - u_yA)]/l - (theta_A + theta_B)/2, theta_rel = theta_B - theta_A.
    #[inline]
    fn deformation(&self, end_a: &[f64], end_b: &[f64]) -> BondDeformation {
        let [a, b] = self.direction;
        let (du_x, du_y) = (end_b[0] - end_a[0], end_b[1] - end_a[1]);
        let per_length = 1.0 / self.length;
        BondDeformation {
            stretch: (a * du_x + b * du_y) * per_length,
            shear: (-b * du_x + a * du_y) * per_length - 0.5 * (end_a[2] + end_b[2]),
            rotation: end_b[2] - end_a[2],
        }
    }

    /// 1/2 u^T K u', J, for two deformations of the same bond.
    #[inline]
    fn mutual_energy(&self, one: &BondDeformation, other: &BondDeformation) -> f64 {
        0.5 * (self.axial_rigidity * one.stretch * other.stretch
            + self.shear_rigidity * one.shear * other.shear
            + self.rotational_rigidity * one.rotation * other.rotation)
    }

    /// Internal forces and moment K u at the ends A and B, N and N m.
    #[inline]
    fn end_forces(&self, deformation: &BondDeformation) -> [[f64; UNKNOWNS]; 2] {
        let [a, b] = self.direction;
        let per_length = 1.0 / self.length;
        let axial = self.axial_rigidity * deformation.stretch * per_length;
        let shear = self.shear_rigidity * deformation.shear;
        let transverse = shear * per_length;
        let (force_x, force_y) = (axial * a - transverse * b, axial * b + transverse * a);
        let half_moment = -0.5 * shear;
        let moment = self.rotational_rigidity * deformation.rotation;
        [
            [-force_x, -force_y, half_moment - moment],
            [force_x, force_y, half_moment + moment],
        ]
    }

    /// K as a sum over stretch, shear and relative rotation of rigidity g g^T, with the rows g of B^T R (NHPD eq. 3), which
    /// take the unknowns of A and B to (s, gamma, theta_rel).
    fn modes(&self) -> [(f64, [f64; 2 * UNKNOWNS]); 3] {
        let [a, b] = [
            self.direction[0] / self.length,
            self.direction[1] / self.length,
        ];
        [
            (self.axial_rigidity, [-a, -b, 0.0, a, b, 0.0]),
            (self.shear_rigidity, [b, -a, -0.5, -b, a, -0.5]),
            (self.rotational_rigidity, [0.0, 0.0, -1.0, 0.0, 0.0, 1.0]),
        ]
    }
}
