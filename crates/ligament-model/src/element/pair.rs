//! Bonds that couple their two ends alone: springs and beams.
//!
//! A spring bond has an axial and a shear spring between points without rotations (PDS; MPPD section 2.1). Its shear deformation does not
//! distinguish a rotation of the whole body from a shear: where the shear rigidity is not zero, a rigid rotation costs energy. A beam bond
//! lies between points with rotations and has a spring against their relative rotation beside the two (in the plane NHPD eqs 2, 3 and 9).

mod plane;
mod space;

use super::{Block, Element, Rigidities, StiffnessFactors, Term};
use crate::bonds::BondSet;
use crate::deformation::Deformation;
use crate::tensor::SymTensor;

/// A bond of two points in D dimensions with M components of motion each: a spring with M = D, a beam where points also have rotations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair<const D: usize, const M: usize> {
    /// Points A and B.
    pub ends: [u32; 2],
    /// Length l, m.
    pub length: f64,
    /// Unit vector n from A to B; in the plane the direction cosines (a, b).
    pub direction: [f64; D],
    /// Omega alpha V_A V_B k_n l, J: energy 1/2 (...) s^2.
    pub axial_rigidity: f64,
    /// Omega alpha V_A V_B k_t l, J: energy 1/2 (...) |gamma|^2.
    pub shear_rigidity: f64,
    /// Omega alpha V_A V_B k_theta, J: energy 1/2 (...) |theta_rel|^2; 0 between points without rotations.
    pub rotational_rigidity: f64,
}

/// Kinematics and stiffness of a [`Pair`] in the plane or in space, from the motions of its ends alone.
pub trait PairMechanics<const D: usize, const M: usize> {
    /// Deformation of the bond.
    type Deformation: Deformation;

    /// Deformation for the motions of the ends A and B, shape (M) each.
    fn between(&self, end_a: &[f64], end_b: &[f64]) -> Self::Deformation;

    /// Deformation in a uniform strain eps without rotations: s = n . eps n; the shear deformation is the rest of eps n.
    fn in_strain(&self, strain: &SymTensor<D>) -> Self::Deformation;

    /// Energy 1/2 u^T K u', J, for two deformations of the same bond.
    fn energy(&self, one: &Self::Deformation, other: &Self::Deformation) -> f64;

    /// Internal forces and moments K u at the ends A and B, N and N m.
    fn forces_at_ends(&self, deformation: &Self::Deformation) -> [[f64; M]; 2];

    /// Modes of the bond: K as a sum of rigidity g g^T over stretch, shear and relative rotation; the rows g take the motions of A and B to
    /// the size of the mode.
    fn modes(&self) -> impl Iterator<Item = (f64, [[f64; M]; 2])>;

    /// Block of K with the rows of one end (0 for A, 1 for B) and the columns of another.
    fn block(&self, rows: usize, columns: usize) -> Block<M> {
        let mut block = [[0.0; M]; M];
        for (rigidity, gradient) in self.modes() {
            for (sums, row) in block.iter_mut().zip(gradient[rows]) {
                for (sum, column) in sums.iter_mut().zip(gradient[columns]) {
                    *sum += rigidity * row * column;
                }
            }
        }
        block
    }
}

// These functions are the sweeps over all bonds: the compiler left some as calls, which cost the sweeps a fifth more time.
impl<const D: usize, const M: usize> Element<D, M> for Pair<D, M>
where
    Self: PairMechanics<D, M>,
{
    type Deformation = <Self as PairMechanics<D, M>>::Deformation;

    type Lattice = ();

    #[inline(always)]
    fn new((): &(), bonds: &BondSet<D>, rigidities: &Rigidities, _: &[bool], bond: usize) -> Self {
        Self {
            ends: bonds.ends[bond],
            length: bonds.length[bond],
            direction: bonds.direction[bond],
            axial_rigidity: rigidities.axial[bond],
            shear_rigidity: rigidities.shear[bond],
            rotational_rigidity: if M > D {
                rigidities.rotational[bond]
            } else {
                0.0
            },
        }
    }

    #[inline(always)]
    fn weakened(self, remaining: &StiffnessFactors) -> Self {
        Self {
            axial_rigidity: remaining.axial * self.axial_rigidity,
            shear_rigidity: remaining.shear * self.shear_rigidity,
            rotational_rigidity: remaining.rotational * self.rotational_rigidity,
            ..self
        }
    }

    #[inline(always)]
    fn deformation(&self, motions: &[f64]) -> Self::Deformation {
        let [a, b] = self.ends.map(|end| M * end as usize);
        self.between(&motions[a..a + M], &motions[b..b + M])
    }

    #[inline(always)]
    fn deformation_in(&self, strain: &SymTensor<D>) -> Self::Deformation {
        self.in_strain(strain)
    }

    #[inline(always)]
    fn mutual_energy(&self, one: &Self::Deformation, other: &Self::Deformation) -> f64 {
        self.energy(one, other)
    }

    #[inline(always)]
    fn forces(&self, deformation: &Self::Deformation, mut add: impl FnMut(u32, [f64; M])) {
        let [at_a, at_b] = self.forces_at_ends(deformation);
        add(self.ends[0], at_a);
        add(self.ends[1], at_b);
    }

    #[inline(always)]
    fn end_forces(&self, deformation: &Self::Deformation) -> Option<[[f64; M]; 2]> {
        Some(self.forces_at_ends(deformation))
    }

    fn dyad(&self, deformation: &Self::Deformation) -> SymTensor<D> {
        let [_, at_b] = self.forces_at_ends(deformation);
        let force = std::array::from_fn(|axis| at_b[axis]);
        SymTensor::dyad(force, self.direction.map(|cosine| cosine * self.length))
    }

    fn terms(&self) -> Vec<Term> {
        let [a, b] = self.ends.map(|end| M * end as usize);
        let term = |(rigidity, [at_a, at_b]): (f64, [[f64; M]; 2])| {
            let entries = (a..).zip(at_a).chain((b..).zip(at_b));
            let entries = entries.filter(|(_, value)| *value != 0.0);
            (rigidity, entries.collect())
        };
        self.modes().map(term).collect()
    }

    /// Blocks of K = Omega alpha V_A V_B R^T B L D B^T R (NHPD eq. 9).
    fn upper_blocks(&self, point: u32, mut add: impl FnMut(u32, Block<M>)) {
        let columns = usize::from(self.ends[1] == point);
        for (rows, &other) in self.ends.iter().enumerate() {
            if other <= point {
                add(other, self.block(rows, columns));
            }
        }
    }
}

#[cfg(test)]
mod tests;
