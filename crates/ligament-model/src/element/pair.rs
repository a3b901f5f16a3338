//! Bonds that couple their two ends and nothing else.

use std::marker::PhantomData;

use super::{Block, BondDeformation, Element, Elements, Remaining, Rigidities, Term};
use crate::bonds::BondSet;
use crate::layout::Component;

/// The kinematics of a bond between two points with M components.
pub trait PairKinematics<const M: usize>:
    Copy + PartialEq + std::fmt::Debug + Send + Sync + 'static
{
    /// Components of the motion of a point.
    const COMPONENTS: [Component; M];

    /// The kinematics of a bond.
    fn new(bonds: &BondSet, rigidities: &Rigidities, bond: usize) -> Self;

    /// With the rigidities times what is left of them.
    fn weakened(self, remaining: &Remaining) -> Self;

    /// Length l, m, and direction cosines (a, b) from A to B.
    fn geometry(&self) -> (f64, [f64; 2]);

    /// Deformation for the motions of the ends A and B, shape (M) each.
    fn deformation(&self, end_a: &[f64], end_b: &[f64]) -> BondDeformation;

    /// 1/2 u^T K u', J, for two deformations of the same bond.
    fn mutual_energy(&self, one: &BondDeformation, other: &BondDeformation) -> f64;

    /// Internal forces and moments K u at the ends A and B, N and N m.
    fn end_forces(&self, deformation: &BondDeformation) -> [[f64; M]; 2];

    /// K as a sum of rigidity g g^T over the M ways in which the bond deforms; the rows g take the motions of A and B to the
    /// size of each: (s, gamma) or (s, gamma, theta_rel).
    fn modes(&self) -> [(f64, [[f64; M]; 2]); M];
}

/// The elements of bonds that couple their ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pairs<B>(PhantomData<B>);

impl<B> Default for Pairs<B> {
    fn default() -> Self {
        Self(PhantomData)
    }
}

impl<const M: usize, B: PairKinematics<M>> Elements<M> for Pairs<B> {
    const COMPONENTS: [Component; M] = B::COMPONENTS;

    type Element = Pair<B>;

    #[inline(always)]
    fn element(
        &self,
        bonds: &BondSet,
        rigidities: &Rigidities,
        _: &[bool],
        bond: usize,
    ) -> Pair<B> {
        Pair {
            ends: bonds.ends[bond],
            bond: B::new(bonds, rigidities, bond),
        }
    }

    fn turns_freely(&self) -> bool {
        // Without rotations of the points a bond takes that of the body for a shear.
        B::COMPONENTS.contains(&Component::Rotation)
    }
}

/// A bond of two points: its ends and what happens between them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair<B> {
    /// Points A and B.
    pub ends: [u32; 2],
    /// Kinematics and rigidities.
    pub bond: B,
}

// The sweeps over all bonds are these functions: the compiler left some as calls, which cost them a fifth more time.
impl<const M: usize, B: PairKinematics<M>> Element<M> for Pair<B> {
    #[inline(always)]
    fn weakened(self, remaining: &Remaining) -> Self {
        Self {
            bond: self.bond.weakened(remaining),
            ..self
        }
    }

    #[inline(always)]
    fn deformation(&self, motions: &[f64]) -> BondDeformation {
        let [a, b] = self.ends.map(|end| M * end as usize);
        self.bond
            .deformation(&motions[a..a + M], &motions[b..b + M])
    }

    /// s = a^2 eps_xx + b^2 eps_yy + a b gamma_xy, gamma = a b (eps_yy - eps_xx) + (a^2 - b^2) gamma_xy/2.
    #[inline(always)]
    fn deformation_in(&self, [xx, yy, xy]: [f64; 3]) -> BondDeformation {
        let (_, [a, b]) = self.bond.geometry();
        let stretch = a * a * xx + b * b * yy + a * b * xy;
        let shear = a * b * (yy - xx) + 0.5 * (a * a - b * b) * xy;
        BondDeformation::new([stretch, shear, 0.0])
    }

    #[inline(always)]
    fn mutual_energy(&self, one: &BondDeformation, other: &BondDeformation) -> f64 {
        self.bond.mutual_energy(one, other)
    }

    #[inline(always)]
    fn forces(&self, deformation: &BondDeformation, mut add: impl FnMut(u32, [f64; M])) {
        let [at_a, at_b] = self.bond.end_forces(deformation);
        add(self.ends[0], at_a);
        add(self.ends[1], at_b);
    }

    #[inline(always)]
    fn end_forces(&self, deformation: &BondDeformation) -> Option<[[f64; M]; 2]> {
        Some(self.bond.end_forces(deformation))
    }

    fn dyad(&self, deformation: &BondDeformation) -> [f64; 3] {
        let (length, direction) = self.bond.geometry();
        let [_, at_b] = self.bond.end_forces(deformation);
        let (f_x, f_y) = (at_b[0], at_b[1]);
        let [xi_x, xi_y] = direction.map(|cosine| cosine * length);
        [f_x * xi_x, f_y * xi_y, 0.5 * (f_x * xi_y + f_y * xi_x)]
    }

    fn terms(&self) -> Vec<Term> {
        let [a, b] = self.ends.map(|end| M * end as usize);
        let term = |(rigidity, [at_a, at_b]): (f64, [[f64; M]; 2])| {
            let entries = (a..).zip(at_a).chain((b..).zip(at_b));
            let entries = entries.filter(|(_, value)| *value != 0.0);
            (rigidity, entries.collect())
        };
        self.bond.modes().into_iter().map(term).collect()
    }

    /// Blocks of K = Omega alpha V_A V_B R^T B L D B^T R (NHPD eq. 9).
    fn upper_blocks(&self, point: u32, mut add: impl FnMut(u32, Block<M>)) {
        let column_end = usize::from(self.ends[1] == point);
        let modes = self.bond.modes();
        for (row_end, &other) in self
            .ends
            .iter()
            .enumerate()
            .filter(|(_, end)| **end <= point)
        {
            let mut block = [[0.0; M]; M];
            for (rigidity, gradient) in &modes {
                for (sums, row) in block.iter_mut().zip(gradient[row_end]) {
                    for (sum, column) in sums.iter_mut().zip(gradient[column_end]) {
                        *sum += rigidity * row * column;
                    }
                }
            }
            add(other, block);
        }
    }
}
