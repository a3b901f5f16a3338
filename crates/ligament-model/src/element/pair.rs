//! Bonds that couple their two ends and nothing else.

use std::marker::PhantomData;

use super::{Block, BondDeformation, Element, Elements, Remaining, Rigidities, Term, UNKNOWNS};
use crate::bonds::BondSet;

/// The kinematics of a bond between two points.
pub trait PairKinematics: Copy + PartialEq + std::fmt::Debug + Send + Sync + 'static {
    /// Whether the points turn.
    const TURNS_POINTS: bool;

    /// The kinematics of a bond.
    fn new(bonds: &BondSet, rigidities: &Rigidities, bond: usize) -> Self;

    /// With the rigidities times what is left of them.
    fn weakened(self, remaining: &Remaining) -> Self;

    /// Length l, m, and direction cosines (a, b) from A to B.
    fn geometry(&self) -> (f64, [f64; 2]);

    /// Deformation for the unknowns [u_x, u_y, theta] of the ends A and B.
    fn deformation(&self, end_a: &[f64], end_b: &[f64]) -> BondDeformation;

    /// 1/2 u^T K u', J, for two deformations of the same bond.
    fn mutual_energy(&self, one: &BondDeformation, other: &BondDeformation) -> f64;

    /// Internal forces and moments K u at the ends A and B, N and N m.
    fn end_forces(&self, deformation: &BondDeformation) -> [[f64; UNKNOWNS]; 2];

    /// K as a sum over stretch, shear and relative rotation of rigidity g g^T; the rows g take the unknowns of A and B to
    /// (s, gamma, theta_rel).
    fn modes(&self) -> [(f64, [f64; 2 * UNKNOWNS]); 3];
}

/// The elements of bonds that couple their ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pairs<B>(PhantomData<B>);

impl<B> Default for Pairs<B> {
    fn default() -> Self {
        Self(PhantomData)
    }
}

impl<B: PairKinematics> Elements for Pairs<B> {
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

    fn turns_points(&self) -> bool {
        B::TURNS_POINTS
    }

    fn turns_freely(&self) -> bool {
        B::TURNS_POINTS
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
impl<B: PairKinematics> Element for Pair<B> {
    #[inline(always)]
    fn weakened(self, remaining: &Remaining) -> Self {
        Self {
            bond: self.bond.weakened(remaining),
            ..self
        }
    }

    #[inline(always)]
    fn deformation(&self, unknowns: &[f64]) -> BondDeformation {
        let [a, b] = self.ends.map(|end| UNKNOWNS * end as usize);
        self.bond
            .deformation(&unknowns[a..a + UNKNOWNS], &unknowns[b..b + UNKNOWNS])
    }

    /// s = a^2 eps_xx + b^2 eps_yy + a b gamma_xy, gamma = a b (eps_yy - eps_xx) + (a^2 - b^2) gamma_xy/2.
    #[inline(always)]
    fn deformation_in(&self, [xx, yy, xy]: [f64; 3]) -> BondDeformation {
        let (_, [a, b]) = self.bond.geometry();
        BondDeformation {
            stretch: a * a * xx + b * b * yy + a * b * xy,
            shear: a * b * (yy - xx) + 0.5 * (a * a - b * b) * xy,
            rotation: 0.0,
        }
    }

    #[inline(always)]
    fn mutual_energy(&self, one: &BondDeformation, other: &BondDeformation) -> f64 {
        self.bond.mutual_energy(one, other)
    }

    #[inline(always)]
    fn forces(&self, deformation: &BondDeformation, mut add: impl FnMut(u32, [f64; UNKNOWNS])) {
        let [at_a, at_b] = self.bond.end_forces(deformation);
        add(self.ends[0], at_a);
        add(self.ends[1], at_b);
    }

    fn end_forces(&self, deformation: &BondDeformation) -> Option<[[f64; UNKNOWNS]; 2]> {
        Some(self.bond.end_forces(deformation))
    }

    fn dyad(&self, deformation: &BondDeformation) -> [f64; 3] {
        let (length, direction) = self.bond.geometry();
        let [_, [f_x, f_y, _]] = self.bond.end_forces(deformation);
        let [xi_x, xi_y] = direction.map(|cosine| cosine * length);
        [f_x * xi_x, f_y * xi_y, 0.5 * (f_x * xi_y + f_y * xi_x)]
    }

    fn terms(&self) -> [Term; 3] {
        let [a, b] = self.ends.map(|end| UNKNOWNS * end as usize);
        let degrees_of_freedom = [a, a + 1, a + 2, b, b + 1, b + 2];
        self.bond.modes().map(|(rigidity, gradient)| {
            let entries = degrees_of_freedom.into_iter().zip(gradient);
            (
                rigidity,
                entries.filter(|(_, value)| *value != 0.0).collect(),
            )
        })
    }

    /// Blocks of K = Omega alpha V_A V_B R^T B L D B^T R (NHPD eq. 9).
    fn upper_blocks(&self, point: u32, mut add: impl FnMut(u32, Block)) {
        let column_end = usize::from(self.ends[1] == point);
        let modes = self.bond.modes();
        for (row_end, &other) in self
            .ends
            .iter()
            .enumerate()
            .filter(|(_, end)| **end <= point)
        {
            let mut block = [[0.0; UNKNOWNS]; UNKNOWNS];
            for (rigidity, gradient) in &modes {
                let [rows, columns] = [row_end, column_end].map(|end| &gradient[UNKNOWNS * end..]);
                for (sums, row) in block.iter_mut().zip(rows) {
                    for (sum, column) in sums.iter_mut().zip(columns) {
                        *sum += rigidity * row * column;
                    }
                }
            }
            add(other, block);
        }
    }
}
