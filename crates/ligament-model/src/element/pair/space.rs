//! Pairs in space.
//!
//! A pair of points with rotations is a beam of Euler and Bernoulli with EA = k_n, EI = k_theta l = d and a torsional stiffness GJ = d where
//! k_t = 12 d/l^2, as in textbooks, without a frame of its own: bending and torsion have one rotational stiffness (derived in
//! `docs/space.md`).

use super::{Pair, PairMechanics};
use crate::deformation::SpaceDeformation;
use crate::element::Block;
use crate::tensor::{SymTensor, cross, dot, tangents};

impl<const M: usize> Pair<3, M> {
    /// Deformation for the slope v of the displacement along the bond: stretch n . v and shear P v.
    #[inline(always)]
    fn deformed(&self, slope: [f64; 3]) -> SpaceDeformation {
        let stretch = dot(self.direction, slope);
        SpaceDeformation {
            stretch,
            shear: [0, 1, 2].map(|k| slope[k] - stretch * self.direction[k]),
            rotation: [0.0; 3],
        }
    }

    /// Stiffness (A n n^T + S P)/l^2, with the axial rigidity A and the shear rigidity S, N/m.
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
}

impl<const M: usize> PairMechanics<3, M> for Pair<3, M> {
    type Deformation = SpaceDeformation;

    /// Deformation for the displacements and rotations of the ends: s = n . du/l, gamma = P du/l - 1/2 (phi_A + phi_B) x n,
    /// dphi = phi_B - phi_A; of a spring without the rotations.
    #[inline(always)]
    fn between(&self, end_a: &[f64], end_b: &[f64]) -> SpaceDeformation {
        let per_length = 1.0 / self.length;
        let without_rotations =
            self.deformed([0, 1, 2].map(|k| (end_b[k] - end_a[k]) * per_length));
        if M == 3 {
            return without_rotations;
        }
        let mean = [3, 4, 5].map(|k| 0.5 * (end_a[k] + end_b[k]));
        let turned = cross(mean, self.direction);
        SpaceDeformation {
            shear: [0, 1, 2].map(|k| without_rotations.shear[k] - turned[k]),
            rotation: [3, 4, 5].map(|k| end_b[k] - end_a[k]),
            ..without_rotations
        }
    }

    #[inline]
    fn in_strain(&self, strain: &SymTensor<3>) -> SpaceDeformation {
        self.deformed(strain.times(self.direction))
    }

    #[inline]
    fn energy(&self, one: &SpaceDeformation, other: &SpaceDeformation) -> f64 {
        let of_springs = 0.5
            * (self.axial_rigidity * one.stretch * other.stretch
                + self.shear_rigidity * dot(one.shear, other.shear));
        if M == 3 {
            return of_springs;
        }
        of_springs + 0.5 * (self.rotational_rigidity * dot(one.rotation, other.rotation))
    }

    /// Forces -+(A s n + S gamma)/l and moments -S/2 n x gamma -+ R dphi at A and B.
    #[inline(always)]
    fn forces_at_ends(&self, deformation: &SpaceDeformation) -> [[f64; M]; 2] {
        let per_length = 1.0 / self.length;
        let axial = self.axial_rigidity * deformation.stretch * per_length;
        let shear = self.shear_rigidity * per_length;
        let force = [0, 1, 2].map(|k| axial * self.direction[k] + shear * deformation.shear[k]);
        let half_shear = -0.5 * self.shear_rigidity;
        let half = cross(self.direction, deformation.shear).map(|it| half_shear * it);
        let moment = (deformation.rotation).map(|it| self.rotational_rigidity * it);
        let at_a = |component: usize| match component {
            0..3 => -force[component],
            _ => half[component - 3] - moment[component - 3],
        };
        let at_b = |component: usize| match component {
            0..3 => force[component],
            _ => half[component - 3] + moment[component - 3],
        };
        [std::array::from_fn(at_a), std::array::from_fn(at_b)]
    }

    /// Modes of the bond, with the shear spring along both directions across the bond; modes without stiffness are left out.
    fn modes(&self) -> impl Iterator<Item = (f64, [[f64; M]; 2])> {
        let n = self.direction;
        let mode = |rigidity: f64, along: [f64; 3], turn: [f64; 3], sign_a: f64| {
            let [x, y, z] = along.map(|component| component / self.length);
            let [u, v, w] = turn;
            let at_a = [-x, -y, -z, sign_a * u, sign_a * v, sign_a * w];
            let ends = [at_a, [x, y, z, u, v, w]];
            (rigidity, ends.map(|row| std::array::from_fn(|it| row[it])))
        };
        let mut modes = vec![mode(self.axial_rigidity, n, [0.0; 3], 1.0)];
        // -t . (phi x n)/2 = -phi . (n x t)/2.
        for tangent in tangents(n) {
            let turn = cross(n, tangent).map(|it| -0.5 * it);
            modes.push(mode(self.shear_rigidity, tangent, turn, 1.0));
        }
        for axis in 0..3 {
            let mut turn = [0.0; 3];
            turn[axis] = 1.0;
            modes.push(mode(self.rotational_rigidity, [0.0; 3], turn, -1.0));
        }
        let own = modes.into_iter().take(M);
        own.filter(|(rigidity, _)| *rigidity != 0.0)
    }

    /// Block of K with the rows of one end and the columns of another.
    ///
    /// gamma = sum over the ends of sign P u/l + 1/2 n x phi, so that with N v = n x v, N^T N = P and P N = N the blocks are
    ///
    /// u u: sign sign (A n n^T + S P)/l^2, u phi: sign S N/(2 l), phi u: -sign S N/(2 l), phi phi: S P/4 + sign sign R.
    fn block(&self, rows: usize, columns: usize) -> Block<M> {
        let [rows, columns] = [rows, columns].map(|end| if end == 0 { -1.0 } else { 1.0 });
        let both = rows * columns;
        let of_displacements = self.stiffness();
        let (n, shear) = (self.direction, self.shear_rigidity);
        let [x, y, z] = n;
        let turn = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
        let lever = 0.5 * shear / self.length;
        let mut block = [[0.0; M]; M];
        for row in 0..3 {
            for column in 0..3 {
                block[row][column] = both * of_displacements[row][column];
                if M > 3 {
                    let unit = if row == column { 1.0 } else { 0.0 };
                    let across = unit - n[row] * n[column];
                    block[row][3 + column] = rows * lever * turn[row][column];
                    block[3 + row][column] = -columns * lever * turn[row][column];
                    block[3 + row][3 + column] =
                        0.25 * shear * across + both * self.rotational_rigidity * unit;
                }
            }
        }
        block
    }
}
