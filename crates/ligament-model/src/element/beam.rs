//! Beam bonds: displacements and rotations at each end (in the plane NHPD eqs 2, 3 and 9).
//!
//! In space the bond is a beam of Euler and Bernoulli with EA = k_n, EI = k_theta l = d and a torsional stiffness GJ = d where k_t = 12
//! d/l^2, as in textbooks, without a frame of its own: bending and torsion have one rotational stiffness (derived in `docs/space.md`).
//!
//! Rotations are counter-clockwise. With them the shear row of B reads [0, -1, -l/2, 0, 1, -l/2]/l; the signs +l/2 of
//! the printed eq. 3 belong to clockwise rotations.

use super::pair::{PairBond, PairKinematics};
use super::spring::SpringBond;
use super::{Block, BondDeformation, Rigidities, StiffnessFactors};
use crate::bonds::BondSet;
use crate::deformation::SpaceDeformation;
use crate::layout::Component;
use crate::tensor::{SymTensor, cross, dot, tangents};

/// An axial and a shear spring between points with rotations, and a spring against their relative rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamBond<const D: usize = 2> {
    /// Geometry, axial and shear rigidity.
    pub springs: SpringBond<D>,
    /// Omega alpha V_A V_B k_theta, J: energy 1/2 (...) |theta_rel|^2.
    pub rotational_rigidity: f64,
}

impl<const D: usize> BeamBond<D> {
    /// A bond of a length (m) and a direction without stiffness. Its deformations are also those of spring bonds, whose points have no
    /// rotations.
    pub fn without_stiffness(length: f64, direction: [f64; D]) -> Self {
        Self {
            springs: SpringBond {
                length,
                direction,
                axial_rigidity: 0.0,
                shear_rigidity: 0.0,
            },
            rotational_rigidity: 0.0,
        }
    }
}

impl<const D: usize> PairBond<D> for BeamBond<D> {
    #[inline(always)]
    fn new(bonds: &BondSet<D>, rigidities: &Rigidities, bond: usize) -> Self {
        Self {
            springs: SpringBond::new(bonds, rigidities, bond),
            rotational_rigidity: rigidities.rotational[bond],
        }
    }

    #[inline(always)]
    fn weakened(self, remaining: &StiffnessFactors) -> Self {
        Self {
            springs: self.springs.weakened(remaining),
            rotational_rigidity: remaining.rotational * self.rotational_rigidity,
        }
    }

    #[inline(always)]
    fn geometry(&self) -> (f64, [f64; D]) {
        self.springs.geometry()
    }
}

impl PairKinematics<2, 3> for BeamBond {
    const COMPONENTS: [Component; 3] = [Component::X, Component::Y, Component::Rotation];

    type Deformation = BondDeformation;

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

    #[inline(always)]
    fn deformation_in(&self, strain: &SymTensor<2>) -> BondDeformation {
        self.springs.deformation_in(strain)
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
    fn modes(&self) -> impl Iterator<Item = (f64, [[f64; 3]; 2])> {
        let of_springs = self.springs.modes().zip([0.0, -0.5]);
        let of_springs = of_springs
            .map(|((rigidity, gradient), turn)| (rigidity, gradient.map(|[x, y]| [x, y, turn])));
        let rotation = [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
        of_springs.chain([(self.rotational_rigidity, rotation)])
    }
}

impl BeamBond<3> {
    /// Block of K with the rows of one end and the columns of the other, or of the same; `rows` and `columns` are -1 for A and 1 for B.
    ///
    /// gamma = sum over the ends of sign P u/l + 1/2 n x phi, so that with N v = n x v, N^T N = P and P N = N the blocks are
    ///
    /// u u: sign sign (A n n^T + S P)/l^2, u phi: sign S N/(2 l), phi u: -sign S N/(2 l), phi phi: S P/4 + sign sign R.
    fn coupling(&self, rows: f64, columns: f64) -> Block<6> {
        let SpringBond {
            length,
            direction: n,
            shear_rigidity: shear,
            ..
        } = self.springs;
        let both = rows * columns;
        let of_displacements = self.springs.stiffness();
        let [x, y, z] = n;
        let turn = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
        let lever = 0.5 * shear / length;
        let mut block = [[0.0; 6]; 6];
        for row in 0..3 {
            for column in 0..3 {
                let unit = if row == column { 1.0 } else { 0.0 };
                let across = unit - n[row] * n[column];
                block[row][column] = both * of_displacements[row][column];
                block[row][3 + column] = rows * lever * turn[row][column];
                block[3 + row][column] = -columns * lever * turn[row][column];
                block[3 + row][3 + column] =
                    0.25 * shear * across + both * self.rotational_rigidity * unit;
            }
        }
        block
    }
}

impl PairKinematics<3, 6> for BeamBond<3> {
    const COMPONENTS: [Component; 6] = Component::IN_SPACE;

    type Deformation = SpaceDeformation;

    /// Deformation for the displacements and rotations of the ends: s = n . du/l, gamma = P du/l - 1/2 (phi_A + phi_B) x n,
    /// dphi = phi_B - phi_A.
    #[inline(always)]
    fn deformation(&self, end_a: &[f64], end_b: &[f64]) -> SpaceDeformation {
        let without_rotations = self.springs.deformation(end_a, end_b);
        let mean = [3, 4, 5].map(|k| 0.5 * (end_a[k] + end_b[k]));
        let turned = cross(mean, self.springs.direction);
        SpaceDeformation {
            shear: [0, 1, 2].map(|k| without_rotations.shear[k] - turned[k]),
            rotation: [3, 4, 5].map(|k| end_b[k] - end_a[k]),
            ..without_rotations
        }
    }

    #[inline]
    fn deformation_in(&self, strain: &SymTensor<3>) -> SpaceDeformation {
        self.springs.deformation_in(strain)
    }

    #[inline]
    fn mutual_energy(&self, one: &SpaceDeformation, other: &SpaceDeformation) -> f64 {
        self.springs.mutual_energy(one, other)
            + 0.5 * (self.rotational_rigidity * dot(one.rotation, other.rotation))
    }

    /// Forces -+(A s n + S gamma)/l and moments -S/2 n x gamma -+ R dphi at A and B.
    #[inline(always)]
    fn end_forces(&self, deformation: &SpaceDeformation) -> [[f64; 6]; 2] {
        let [x, y, z] = self.springs.force(deformation);
        let half_shear = -0.5 * self.springs.shear_rigidity;
        let half = cross(self.springs.direction, deformation.shear).map(|it| half_shear * it);
        let moment = (deformation.rotation).map(|it| self.rotational_rigidity * it);
        [
            [
                -x,
                -y,
                -z,
                half[0] - moment[0],
                half[1] - moment[1],
                half[2] - moment[2],
            ],
            [
                x,
                y,
                z,
                half[0] + moment[0],
                half[1] + moment[1],
                half[2] + moment[2],
            ],
        ]
    }

    fn block(&self, rows: usize, columns: usize) -> Block<6> {
        let sign = |end: usize| if end == 0 { -1.0 } else { 1.0 };
        self.coupling(sign(rows), sign(columns))
    }

    fn modes(&self) -> impl Iterator<Item = (f64, [[f64; 6]; 2])> {
        let n = self.springs.direction;
        let mode = |rigidity: f64, along: [f64; 3], turn: [f64; 3], sign_a: f64| {
            let [x, y, z] = along.map(|component| component / self.springs.length);
            let [u, v, w] = turn;
            let at_a = [-x, -y, -z, sign_a * u, sign_a * v, sign_a * w];
            (rigidity, [at_a, [x, y, z, u, v, w]])
        };
        let mut modes = vec![mode(self.springs.axial_rigidity, n, [0.0; 3], 1.0)];
        // -t . (phi x n)/2 = -phi . (n x t)/2.
        for tangent in tangents(n) {
            let turn = cross(n, tangent).map(|it| -0.5 * it);
            modes.push(mode(self.springs.shear_rigidity, tangent, turn, 1.0));
        }
        for axis in 0..3 {
            let mut turn = [0.0; 3];
            turn[axis] = 1.0;
            modes.push(mode(self.rotational_rigidity, [0.0; 3], turn, -1.0));
        }
        modes.into_iter().filter(|(rigidity, _)| *rigidity != 0.0)
    }
}

#[cfg(test)]
mod tests;
