//! Kinematics of bonds in space.
//!
//! | element | a point has | deformation of a bond | laws |
//! |---|---|---|---|
//! | [`BeamBond`] | three displacements and three rotations | stretch, shear less the mean rotation, relative rotation | micropolar ones |
//! | [`SpringBond`] | three displacements | stretch, shear | `bbpd`, `pds` |
//!
//! The first is a beam of Euler and Bernoulli with EA = k_n, EI = k_theta l = d and a torsional stiffness GJ = d where k_t = 12 d/l^2, as in
//! textbooks, without a frame of its own.

use crate::bonds::BondSet;
use crate::deformation::SpaceDeformation;
use crate::element::{Remaining, Rigidities};
use crate::layout::Component;
use crate::tensor::{cross, dot, tangents};

/// Kinematics of the bonds of a body in space.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SolidElement {
    /// Bonds between points with rotations: [`BeamBond`].
    Beam,
    /// Bonds between points without rotations: [`SpringBond`].
    Spring,
}

/// The kinematics of a bond in space between two points with M components.
pub trait SolidKinematics<const M: usize>:
    Copy + PartialEq + std::fmt::Debug + Send + Sync + 'static
{
    /// Components of the motion of a point.
    const COMPONENTS: [Component; M];

    /// The kinematics of a bond.
    fn new(bonds: &BondSet<3>, rigidities: &Rigidities, bond: usize) -> Self;

    /// With the rigidities times what is left of them.
    fn weakened(self, remaining: &Remaining) -> Self;

    /// Length l, m, and unit vector n from A to B.
    fn geometry(&self) -> (f64, [f64; 3]);

    /// Deformation for the motions of the ends A and B, shape (M) each.
    fn deformation(&self, end_a: &[f64], end_b: &[f64]) -> SpaceDeformation;

    /// 1/2 u^T K u', J, for two deformations of the same bond.
    fn mutual_energy(&self, one: &SpaceDeformation, other: &SpaceDeformation) -> f64;

    /// Internal forces and moments K u at the ends A and B, N and N m.
    fn end_forces(&self, deformation: &SpaceDeformation) -> [[f64; M]; 2];

    /// Blocks K_AA and K_AB of K; K_BB follows from them as [`SolidKinematics::far_block`], K_BA is the transpose of K_AB.
    fn blocks(&self) -> [[[f64; M]; M]; 2];

    /// Block K_BB of K.
    fn far_block(&self) -> [[f64; M]; M];

    /// K as a sum of rigidity g g^T; the rows g take the motions of A and B to one component of the deformation.
    fn modes(&self) -> Vec<(f64, [[f64; M]; 2])>;

    /// Deformation in a uniform strain (eps_xx, eps_yy, eps_zz, gamma_xy, gamma_xz, gamma_yz) without rotations: s = n . eps n,
    /// gamma = eps n - s n.
    #[inline]
    fn deformation_in(&self, [xx, yy, zz, xy, xz, yz]: [f64; 6]) -> SpaceDeformation {
        let (_, n) = self.geometry();
        let [x, y, z] = n;
        let along = [
            xx * x + 0.5 * (xy * y + xz * z),
            yy * y + 0.5 * (xy * x + yz * z),
            zz * z + 0.5 * (xz * x + yz * y),
        ];
        let stretch = dot(n, along);
        SpaceDeformation {
            stretch,
            shear: [0, 1, 2].map(|k| along[k] - stretch * n[k]),
            rotation: [0.0; 3],
        }
    }

    /// Sum over the ends of internal force (x) position, its symmetric part (xx, yy, xy, zz, xz, yz), J.
    fn dyad(&self, deformation: &SpaceDeformation) -> [f64; 6] {
        let (length, n) = self.geometry();
        let [_, at_b] = self.end_forces(deformation);
        let [x, y, z] = n.map(|cosine| cosine * length);
        let [f, g, h] = [at_b[0], at_b[1], at_b[2]];
        [
            f * x,
            g * y,
            0.5 * (f * y + g * x),
            h * z,
            0.5 * (f * z + h * x),
            0.5 * (g * z + h * y),
        ]
    }
}

/// A spring along a bond and one across it, between points without rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringBond {
    /// Length l, m.
    pub length: f64,
    /// Unit vector n from A to B.
    pub direction: [f64; 3],
    /// Omega alpha V_A V_B k_n l, J: energy 1/2 (...) s^2.
    pub axial_rigidity: f64,
    /// Omega alpha V_A V_B k_t l, J: energy 1/2 (...) |gamma|^2.
    pub shear_rigidity: f64,
}

impl SpringBond {
    /// (A n n^T + S P)/l^2, with the axial and shear rigidity.
    fn stiffness(&self) -> [[f64; 3]; 3] {
        let per_square = 1.0 / (self.length * self.length);
        let axial = (self.axial_rigidity - self.shear_rigidity) * per_square;
        let shear = self.shear_rigidity * per_square;
        let n = self.direction;
        std::array::from_fn(|row| {
            std::array::from_fn(|column| {
                let unit = if row == column { shear } else { 0.0 };
                axial * n[row] * n[column] + unit
            })
        })
    }

    /// Force on the end B for a stretch and a shear, N.
    #[inline(always)]
    fn force(&self, deformation: &SpaceDeformation) -> [f64; 3] {
        let per_length = 1.0 / self.length;
        let axial = self.axial_rigidity * deformation.stretch * per_length;
        let shear = self.shear_rigidity * per_length;
        [0, 1, 2].map(|k| axial * self.direction[k] + shear * deformation.shear[k])
    }
}

impl SolidKinematics<3> for SpringBond {
    const COMPONENTS: [Component; 3] = [Component::X, Component::Y, Component::Z];

    #[inline(always)]
    fn new(bonds: &BondSet<3>, rigidities: &Rigidities, bond: usize) -> Self {
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
    fn geometry(&self) -> (f64, [f64; 3]) {
        (self.length, self.direction)
    }

    /// Deformation for the displacements of the ends: s = n . du/l, gamma = P du/l.
    #[inline(always)]
    fn deformation(&self, end_a: &[f64], end_b: &[f64]) -> SpaceDeformation {
        let n = self.direction;
        let per_length = 1.0 / self.length;
        let slope = [0, 1, 2].map(|k| (end_b[k] - end_a[k]) * per_length);
        let stretch = dot(n, slope);
        SpaceDeformation {
            stretch,
            shear: [0, 1, 2].map(|k| slope[k] - stretch * n[k]),
            rotation: [0.0; 3],
        }
    }

    #[inline]
    fn mutual_energy(&self, one: &SpaceDeformation, other: &SpaceDeformation) -> f64 {
        0.5 * (self.axial_rigidity * one.stretch * other.stretch
            + self.shear_rigidity * dot(one.shear, other.shear))
    }

    #[inline(always)]
    fn end_forces(&self, deformation: &SpaceDeformation) -> [[f64; 3]; 2] {
        let force = self.force(deformation);
        [force.map(|value| -value), force]
    }

    fn blocks(&self) -> [[[f64; 3]; 3]; 2] {
        let own = self.stiffness();
        [own, own.map(|row| row.map(|value| -value))]
    }

    fn far_block(&self) -> [[f64; 3]; 3] {
        self.stiffness()
    }

    fn modes(&self) -> Vec<(f64, [[f64; 3]; 2])> {
        let n = self.direction;
        let [one, other] = tangents(n);
        let mode = |rigidity: f64, along: [f64; 3]| {
            let at_b = along.map(|component| component / self.length);
            (rigidity, [at_b.map(|value| -value), at_b])
        };
        let modes = [
            mode(self.axial_rigidity, n),
            mode(self.shear_rigidity, one),
            mode(self.shear_rigidity, other),
        ];
        modes.into_iter().filter(|(it, _)| *it != 0.0).collect()
    }
}

/// A pair of springs between points that turn, and a spring against their relative rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamBond {
    /// Geometry, axial and shear rigidity.
    pub springs: SpringBond,
    /// Omega alpha V_A V_B k_theta, J: energy 1/2 (...) |dphi|^2.
    pub rotational_rigidity: f64,
}

impl BeamBond {
    /// Block of K with the rows of one end and the columns of the other, or of the same; signs are -1 for A and 1 for B.
    ///
    /// gamma = sum over the ends of sign P u/l + 1/2 n x phi, so that with N v = n x v, N^T N = P and P N = N the blocks are
    ///
    /// u u: sign sign (A n n^T + S P)/l^2, u phi: sign S N/(2 l), phi u: -sign S N/(2 l), phi phi: S P/4 + sign sign R.
    fn block(&self, rows: f64, columns: f64) -> [[f64; 6]; 6] {
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

impl SolidKinematics<6> for BeamBond {
    const COMPONENTS: [Component; 6] = Component::IN_SPACE;

    #[inline(always)]
    fn new(bonds: &BondSet<3>, rigidities: &Rigidities, bond: usize) -> Self {
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
    fn geometry(&self) -> (f64, [f64; 3]) {
        self.springs.geometry()
    }

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

    fn blocks(&self) -> [[[f64; 6]; 6]; 2] {
        [self.block(-1.0, -1.0), self.block(-1.0, 1.0)]
    }

    fn far_block(&self) -> [[f64; 6]; 6] {
        self.block(1.0, 1.0)
    }

    fn modes(&self) -> Vec<(f64, [[f64; 6]; 2])> {
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
        modes.retain(|(rigidity, _)| *rigidity != 0.0);
        modes
    }
}

#[cfg(test)]
mod tests;
