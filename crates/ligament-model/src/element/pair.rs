//! Bonds that couple their two ends alone.

use std::marker::PhantomData;

use super::{Block, BondDeformation, Element, Elements, Rigidities, StiffnessFactors, Term};
use crate::bonds::BondSet;
use crate::deformation::Deformation;
use crate::layout::Component;
use crate::tensor::SymTensor;

/// Geometry and rigidities of a bond of two points in D dimensions.
pub trait PairBond<const D: usize>:
    Copy + PartialEq + std::fmt::Debug + Send + Sync + 'static
{
    /// The bond with a given number.
    fn new(bonds: &BondSet<D>, rigidities: &Rigidities, bond: usize) -> Self;

    /// The bond with its rigidities times the remaining factors.
    fn weakened(self, remaining: &StiffnessFactors) -> Self;

    /// Length l, m, and unit vector n from A to B.
    fn geometry(&self) -> (f64, [f64; D]);
}

/// Kinematics of a bond in D dimensions between two points with M components.
pub trait PairKinematics<const D: usize, const M: usize>: PairBond<D> {
    /// Components of the motion of a point.
    const COMPONENTS: [Component; M];

    /// Deformation of the bond.
    type Deformation: Deformation;

    /// Deformation for the motions of the ends A and B, shape (M) each.
    fn deformation(&self, end_a: &[f64], end_b: &[f64]) -> Self::Deformation;

    /// Deformation in a uniform strain eps without rotations: s = n . eps n; the shear deformation is the rest of eps n.
    fn deformation_in(&self, strain: &SymTensor<D>) -> Self::Deformation;

    /// 1/2 u^T K u', J, for two deformations of the same bond.
    fn mutual_energy(&self, one: &Self::Deformation, other: &Self::Deformation) -> f64;

    /// Internal forces and moments K u at the ends A and B, N and N m.
    fn end_forces(&self, deformation: &Self::Deformation) -> [[f64; M]; 2];

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

/// Deformation that criteria measure, for the motions of the ends A and B of a bond, less that of a thermal strain.
pub fn measured<const D: usize, const M: usize>(
    bond: &impl PairKinematics<D, M>,
    ends: [[f64; M]; 2],
    free: Option<&SymTensor<D>>,
) -> BondDeformation {
    let [a, b] = &ends;
    let whole = bond.deformation(a, b);
    let free = free.map(|strain| bond.deformation_in(strain));
    free.map_or(whole, |free| whole.less(&free)).measured()
}

/// Elements of bonds that couple their ends alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pairs<B>(PhantomData<B>);

impl<B> Default for Pairs<B> {
    fn default() -> Self {
        Self(PhantomData)
    }
}

impl<const D: usize, const M: usize, B: PairKinematics<D, M>> Elements<D, M> for Pairs<B> {
    const COMPONENTS: [Component; M] = B::COMPONENTS;

    type Element = Pair<B>;

    #[inline(always)]
    fn element(
        &self,
        bonds: &BondSet<D>,
        rigidities: &Rigidities,
        _: &[bool],
        bond: usize,
    ) -> Pair<B> {
        Pair {
            ends: bonds.ends[bond],
            bond: B::new(bonds, rigidities, bond),
        }
    }

    fn rotates_freely(&self) -> bool {
        // Without rotations of the points a rotation of the body is a shear of its bonds.
        B::COMPONENTS.iter().any(|it| it.is_rotation())
    }
}

/// A bond of two points: its ends and its kinematics.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair<B> {
    /// Points A and B.
    pub ends: [u32; 2],
    /// Kinematics and rigidities.
    pub bond: B,
}

// These functions are the sweeps over all bonds: the compiler left some as calls, which cost the sweeps a fifth more time.
impl<const D: usize, const M: usize, B: PairKinematics<D, M>> Element<D, M> for Pair<B> {
    type Deformation = B::Deformation;

    #[inline(always)]
    fn weakened(self, remaining: &StiffnessFactors) -> Self {
        Self {
            bond: self.bond.weakened(remaining),
            ..self
        }
    }

    #[inline(always)]
    fn deformation(&self, motions: &[f64]) -> B::Deformation {
        let [a, b] = self.ends.map(|end| M * end as usize);
        self.bond
            .deformation(&motions[a..a + M], &motions[b..b + M])
    }

    #[inline(always)]
    fn deformation_in(&self, strain: &SymTensor<D>) -> B::Deformation {
        self.bond.deformation_in(strain)
    }

    #[inline(always)]
    fn mutual_energy(&self, one: &B::Deformation, other: &B::Deformation) -> f64 {
        self.bond.mutual_energy(one, other)
    }

    #[inline(always)]
    fn forces(&self, deformation: &B::Deformation, mut add: impl FnMut(u32, [f64; M])) {
        let [at_a, at_b] = self.bond.end_forces(deformation);
        add(self.ends[0], at_a);
        add(self.ends[1], at_b);
    }

    #[inline(always)]
    fn end_forces(&self, deformation: &B::Deformation) -> Option<[[f64; M]; 2]> {
        Some(self.bond.end_forces(deformation))
    }

    fn dyad(&self, deformation: &B::Deformation) -> SymTensor<D> {
        let (length, direction) = self.bond.geometry();
        let [_, at_b] = self.bond.end_forces(deformation);
        let force = std::array::from_fn(|axis| at_b[axis]);
        SymTensor::dyad(force, direction.map(|cosine| cosine * length))
    }

    fn terms(&self) -> Vec<Term> {
        let [a, b] = self.ends.map(|end| M * end as usize);
        let term = |(rigidity, [at_a, at_b]): (f64, [[f64; M]; 2])| {
            let entries = (a..).zip(at_a).chain((b..).zip(at_b));
            let entries = entries.filter(|(_, value)| *value != 0.0);
            (rigidity, entries.collect())
        };
        self.bond.modes().map(term).collect()
    }

    /// Blocks of K = Omega alpha V_A V_B R^T B L D B^T R (NHPD eq. 9).
    fn upper_blocks(&self, point: u32, mut add: impl FnMut(u32, Block<M>)) {
        let columns = usize::from(self.ends[1] == point);
        for (rows, &other) in self.ends.iter().enumerate() {
            if other <= point {
                add(other, self.bond.block(rows, columns));
            }
        }
    }
}
