//! The beam-like bond with two displacements and a rotation at each end (NHPD eqs 2, 3 and 9).
//!
//! Rotations are counter-clockwise. With them the shear row of B reads [0, -1, -l/2, 0, 1, -l/2]/l; the signs +l/2 of
//! the printed eq. 3 belong to clockwise rotations.

use nalgebra::{Matrix6, Vector6};

/// Unknowns of a point: displacement along x, along y, rotation.
pub const UNKNOWNS: usize = 3;

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

/// Deformation of a bond.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BondDeformation {
    /// Stretch s.
    pub stretch: f64,
    /// Shear deformation gamma, rad.
    pub shear: f64,
    /// Relative rotation theta_B - theta_A, rad.
    pub rotation: f64,
}

impl BeamBond {
    /// Deformation for the unknowns [u_x, u_y, theta] of the ends A and B (NHPD eqs 2, 3):
    ///
    /// s = [a (u_xB - u_xA) + b (u_yB - u_yA)]/l,
    /// gamma = [-b (u_xB - u_xA) + a (u_yB - u_yA)]/l - (theta_A + theta_B)/2, theta_rel = theta_B - theta_A.
    pub fn deformation(&self, end_a: &[f64], end_b: &[f64]) -> BondDeformation {
        let [a, b] = self.direction;
        let (du_x, du_y) = (end_b[0] - end_a[0], end_b[1] - end_a[1]);
        let per_length = 1.0 / self.length;
        BondDeformation {
            stretch: (a * du_x + b * du_y) * per_length,
            shear: (-b * du_x + a * du_y) * per_length - 0.5 * (end_a[2] + end_b[2]),
            rotation: end_b[2] - end_a[2],
        }
    }

    /// Strain energy 1/2 u^T K u, J (NHPD eq. 10).
    pub fn energy(&self, deformation: &BondDeformation) -> f64 {
        self.mutual_energy(deformation, deformation)
    }

    /// 1/2 u^T K u', J, for two deformations of the same bond.
    pub fn mutual_energy(&self, one: &BondDeformation, other: &BondDeformation) -> f64 {
        0.5 * (self.axial_rigidity * one.stretch * other.stretch
            + self.shear_rigidity * one.shear * other.shear
            + self.rotational_rigidity * one.rotation * other.rotation)
    }

    /// Internal forces and moment K u at the ends A and B, N and N m.
    pub fn end_forces(&self, deformation: &BondDeformation) -> [[f64; UNKNOWNS]; 2] {
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

    /// Element stiffness K = Omega alpha V_A V_B R^T B L D B^T R (NHPD eq. 9), shape (6, 6).
    pub fn stiffness(&self) -> Matrix6<f64> {
        let modes = self.modes().into_iter();
        modes.fold(Matrix6::zeros(), |sum, (rigidity, gradient)| {
            let gradient = Vector6::from(gradient);
            sum + rigidity * gradient * gradient.transpose()
        })
    }

    /// K as a sum over stretch, shear and relative rotation of rigidity g g^T, with the rows g of B^T R (NHPD eq. 3), which
    /// take the unknowns of A and B to (s, gamma, theta_rel).
    pub fn modes(&self) -> [(f64, [f64; 2 * UNKNOWNS]); 3] {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The unknowns of both ends, one after the other.
    fn end_unknowns(end_a: &[f64], end_b: &[f64]) -> Vector6<f64> {
        Vector6::new(end_a[0], end_a[1], end_a[2], end_b[0], end_b[1], end_b[2])
    }

    fn bond(angle: f64, shear_sign: f64) -> BeamBond {
        BeamBond {
            length: 0.7,
            direction: [angle.cos(), angle.sin()],
            axial_rigidity: 5.0,
            shear_rigidity: 3.0 * shear_sign,
            rotational_rigidity: 0.2 * shear_sign,
        }
    }

    /// A rigid motion moves a point by translation + rotation x position, and turns it by the rotation.
    fn rigid_motion(bond: &BeamBond, translation: [f64; 2], rotation: f64) -> Vector6<f64> {
        let at = |p: [f64; 2]| {
            [
                translation[0] - rotation * p[1],
                translation[1] + rotation * p[0],
                rotation,
            ]
        };
        let b = [
            2.0 + bond.length * bond.direction[0],
            -1.0 + bond.length * bond.direction[1],
        ];
        end_unknowns(&at([2.0, -1.0]), &at(b))
    }

    /// Exactly three zero-energy modes, all rigid motions; round-off of entries of size 50 bounds them at 1e-12.
    #[test]
    fn three_zero_energy_modes() {
        for shear_sign in [1.0, -1.0] {
            let bond = bond(0.6, shear_sign);
            let eigenvalues = bond.stiffness().symmetric_eigenvalues();
            assert_eq!(
                eigenvalues
                    .iter()
                    .filter(|value| value.abs() < 1e-12)
                    .count(),
                3
            );
            for (translation, rotation) in
                [([1.0, 0.0], 0.0), ([0.0, 1.0], 0.0), ([0.3, -0.2], 1.0)]
            {
                let u = rigid_motion(&bond, translation, rotation);
                assert!((bond.stiffness() * u).norm() < 1e-12);
                let deformation = bond.deformation(&u.as_slice()[..3], &u.as_slice()[3..]);
                assert!(
                    deformation.stretch.abs()
                        + deformation.shear.abs()
                        + deformation.rotation.abs()
                        < 1e-14
                );
            }
        }
    }

    /// force = d energy / du and stiffness = d force / du by central differences; both are exact for a quadratic
    /// energy, so that only round-off (1e-16 / 1e-4 steps) remains.
    #[test]
    fn forces_and_stiffness_are_derivatives() {
        let bond = bond(2.1, 1.0);
        let u = Vector6::new(0.3, -0.1, 0.2, 0.5, 0.4, -0.3);
        let deformation =
            |u: &Vector6<f64>| bond.deformation(&u.as_slice()[..3], &u.as_slice()[3..]);
        let force = |u: &Vector6<f64>| {
            let [a, b] = bond.end_forces(&deformation(u));
            end_unknowns(&a, &b)
        };
        let step = 1e-4;
        for i in 0..6 {
            let mut forward = u;
            forward[i] += step;
            let mut backward = u;
            backward[i] -= step;
            let slope = (bond.energy(&deformation(&forward))
                - bond.energy(&deformation(&backward)))
                / (2.0 * step);
            assert!((slope - force(&u)[i]).abs() < 1e-10, "force {i}");
            let column = (force(&forward) - force(&backward)) / (2.0 * step);
            assert!(
                (column - bond.stiffness().column(i)).norm() < 1e-9,
                "column {i}"
            );
        }
        assert!(force(&u).norm() > 0.1, "the test must see forces");
    }

    /// Turning the bond and its unknowns together leaves the energy as it is.
    #[test]
    fn energy_does_not_depend_on_the_orientation() {
        let u = Vector6::new(0.3, -0.1, 0.2, 0.5, 0.4, -0.3);
        let straight = bond(0.4, 1.0);
        let reference =
            straight.energy(&straight.deformation(&u.as_slice()[..3], &u.as_slice()[3..]));
        for turn in [0.3, 1.2, 2.9, -2.0] {
            let (sin, cos) = f64::sin_cos(turn);
            let turned = bond(0.4 + turn, 1.0);
            let rotate = |p: &[f64]| [cos * p[0] - sin * p[1], sin * p[0] + cos * p[1], p[2]];
            let (a, b) = (rotate(&u.as_slice()[..3]), rotate(&u.as_slice()[3..]));
            assert!((turned.energy(&turned.deformation(&a, &b)) / reference - 1.0).abs() < 1e-13);
        }
    }
}
