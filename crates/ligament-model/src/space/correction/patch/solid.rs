//! The equations of space: forces, and moments where the points turn, in six uniform strains.

use super::forces::SolidCellForces;
use super::waves::{second, third};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::correction::patch::equations::Equations;
use crate::correction::patch::pairs::Pairs;
use crate::law::BondStiffness;

/// Equations of forces of a point.
const FORCES: usize = 13;

/// The equations of all points: 13 of forces, and with those of moments N = 18 a point.
///
/// A bond of length l from a point in the direction n, with w = V_A V_B, acts under a strain eps on its other end with the force
/// w (q_n k_n s n + q_t k_t gamma), s = n . eps n, gamma = eps n - s n, on the point with the opposite one and on both with the moment
/// -1/2 w q_t k_t l n x gamma. Six strains orthonormal as tensors make 36 numbers of these, but a bond has more to say of 18 of them
/// alone. With a = w q_n k_n and b = w q_t k_t the force in eps_jk = eps_kj is the tensor
///
/// F_i,jk = (a - b) n_i n_j n_k + b/2 (delta_ij n_k + delta_ik n_j),
///
/// which has parts of the first and the third order: along delta_jk n_i, along what the other product has at right angles to that, and
/// the third harmonics of n. Its part of the second order is nothing, and the moments, of the strains n_j n_k, are second harmonics of n:
///
/// | equations | of q_n, times w k_n | of q_t, times w k_t |
/// |---|---|---|
/// | 0 to 2 | n/sqrt 3 | 0 |
/// | 3 to 5 | 2 n/sqrt 15 | 3 n/sqrt 15 |
/// | 6 to 12 | sqrt(2/5) Y_3(n) | -sqrt(2/5) Y_3(n) |
/// | 13 to 17 | 0 | -l/2 Y_2(n) |
///
/// with harmonics of the sum of squares 1. The cells of isotropic materials have the first six alone: with g of [`SolidCellForces`]
/// sqrt 3 lambda g + 2 mu g/sqrt 3 and 2 sqrt(5/3) mu g. The equations of a point are scaled by one number for its forces and one for its
/// moments, which keeps them independent of the axes.
pub(super) struct SolidEquations<'a, const N: usize> {
    pairs: Pairs<'a>,
    /// Directions n of the other ends, seen from the points, and -l/2, m.
    places: Vec<([f64; 3], f64)>,
    /// w k_n and w k_t of the pairs, N.
    stiffness: Vec<[f64; 2]>,
    /// Factors q_0 of the pairs, to which those of the correction are the nearest.
    start: Vec<f64>,
    /// Scales of the forces and the moments of own points, by rank: one over the norm of their rows with the weights q_0.
    scale: Vec<[f64; 2]>,
    /// f of own points, by rank.
    right: Vec<[f64; N]>,
}

/// 1/sqrt 3, 2/sqrt 15, 3/sqrt 15 and sqrt(2/5).
const FIRST: f64 = 0.577_350_269_189_625_8;
const SECOND: [f64; 2] = [0.516_397_779_494_322_3, 0.774_596_669_241_483_4];
const THIRD: f64 = 0.632_455_532_033_675_9;

impl<'a, const N: usize> SolidEquations<'a, N> {
    pub(super) fn new(
        bonds: &'a BondSet<3>,
        cloud: &'a PointCloud<3>,
        forces: &SolidCellForces,
        stiffness: &BondStiffness,
        nearest_to: &[f64],
        moment_weight: f64,
    ) -> Self {
        let pairs = Pairs::new(bonds, cloud);
        let of_bond = |bond: usize| {
            let [a, b] = bonds.ends[bond].map(|end| cloud.volumes[end as usize]);
            [stiffness.axial[bond], stiffness.shear[bond]].map(|density| a * b * density)
        };
        let counted = (0..bonds.len()).filter(|&bond| cloud.counts(bonds.ends[bond]));
        let of_bonds = counted.map(|bond| {
            let [axial, shear] = of_bond(bond);
            nearest_to[bond] * bonds.length[bond] * (axial + shear)
        });
        let body_factor = energy(cloud, forces) / pairs.seats.total(of_bonds.sum::<f64>());
        let place = |point: u32, bond: u32| {
            let bond = bond as usize;
            let sign = if bonds.ends[bond][0] == point {
                1.0
            } else {
                -1.0
            };
            let direction = bonds.direction[bond].map(|cosine| sign * cosine);
            (direction, -0.5 * bonds.length[bond])
        };
        let mut squares = vec![[0.0; 2]; cloud.len()];
        for (bond, ends) in bonds.ends.iter().enumerate() {
            let [axial, shear] = of_bond(bond).map(|it| body_factor * nearest_to[bond] * it * it);
            for &end in ends {
                let [force, moment] = &mut squares[end as usize];
                *force += axial + shear;
                *moment += 0.25 * shear * bonds.length[bond].powi(2);
            }
        }
        let scale = |&point: &u32| {
            let [force, moment] = squares[point as usize].map(|square: f64| match square > 0.0 {
                true => 1.0 / square.sqrt(),
                false => 0.0,
            });
            [force, moment_weight * moment]
        };
        let right = |&point: &u32| combined(&forces[point as usize]);
        Self {
            places: pairs.values(place),
            stiffness: pairs.values(|_, bond| of_bond(bond as usize)),
            start: pairs.values(|_, bond| body_factor * nearest_to[bond as usize]),
            scale: pairs.seats.own().iter().map(scale).collect(),
            right: pairs.seats.own().iter().map(right).collect(),
            pairs,
        }
    }
}

/// The combinations of the forces of the cells at a point; no moments.
fn combined<const N: usize>(&[bulk, shear]: &[[f64; 3]; 2]) -> [f64; N] {
    let mut all = [0.0; N];
    for axis in 0..3 {
        all[axis] = FIRST * (3.0 * bulk[axis] + 2.0 * shear[axis]);
        all[3 + axis] = 10.0 * FIRST / 5.0_f64.sqrt() * shear[axis];
    }
    all
}

/// The work of the cells, summed over the six strains, J: sum of (lambda + 4 mu) g . x; that of a bond is w l (q_n k_n + q_t k_t).
fn energy(cloud: &PointCloud<3>, forces: &SolidCellForces) -> f64 {
    let work = |([bulk, shear], position): (&[[f64; 3]; 2], &[f64; 3])| {
        let along = |axis: usize| (bulk[axis] + 4.0 * shear[axis]) * position[axis];
        along(0) + along(1) + along(2)
    };
    forces.iter().zip(&cloud.positions).map(work).sum()
}

impl<const N: usize> Equations<N> for SolidEquations<'_, N> {
    const FORCES: usize = FORCES;

    fn pairs(&self) -> &Pairs<'_> {
        &self.pairs
    }

    fn stiffness(&self) -> &[[f64; 2]] {
        &self.stiffness
    }

    fn start(&self) -> &[f64] {
        &self.start
    }

    fn right(&self) -> &[[f64; N]] {
        &self.right
    }

    #[inline(always)]
    fn scale(&self, rank: usize) -> [f64; N] {
        let [force, moment] = self.scale[rank];
        std::array::from_fn(|row| if row < FORCES { force } else { moment })
    }

    #[inline(always)]
    fn forces(&self, pair: usize, [axial, shear]: [f64; 2]) -> [f64; N] {
        let (n, lever) = self.places[pair];
        let (one, two) = (FIRST * axial, SECOND[0] * axial + SECOND[1] * shear);
        let (three, turn) = (THIRD * (axial - shear), lever * shear);
        let mut all = [0.0; N];
        for axis in 0..3 {
            all[axis] = one * n[axis];
            all[3 + axis] = two * n[axis];
        }
        for (row, wave) in third(n).into_iter().enumerate() {
            all[6 + row] = three * wave;
        }
        if N > FORCES {
            for (row, wave) in second(n).into_iter().enumerate() {
                all[FORCES + row] = turn * wave;
            }
        }
        all
    }

    #[inline(always)]
    fn strains(&self, pair: usize, sum: &[f64; N]) -> [f64; 2] {
        let (n, lever) = self.places[pair];
        let along = |from: usize| n[0] * sum[from] + n[1] * sum[from + 1] + n[2] * sum[from + 2];
        let product = |from: usize, waves: &[f64]| -> f64 {
            let rows = waves.iter().enumerate();
            rows.map(|(row, wave)| wave * sum[from + row]).sum()
        };
        let (one, two) = (FIRST * along(0), along(3));
        let three = THIRD * product(6, &third(n));
        let turn = if N > FORCES {
            lever * product(FORCES, &second(n))
        } else {
            0.0
        };
        [
            one + SECOND[0] * two + three,
            SECOND[1] * two - three + turn,
        ]
    }
}
