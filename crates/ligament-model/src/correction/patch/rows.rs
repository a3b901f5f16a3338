//! Equations of points in uniform strains: forces, and moments where the points have rotations.

use super::equations::Equations;
use super::forces::{CellForces, Points};
use super::harmonics::{count, second, third, third_of_tensor};
use super::pairs::Pairs;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::correction::sweep_order::SweepOrder;
use crate::law::BondStiffness;
use crate::tensor::{SymTensor, dot};

/// Equations of all points: 6 equations of forces a point in the plane and 13 in space; with equations of moments N = 8 and 18.
///
/// A bond of length l from a point in the direction n, with w = V_A V_B, acts under a strain eps on its other end with the force w (q_n k_n
/// s n + q_t k_t gamma), s = n . eps n, gamma = eps n - s n, on the point with the opposite force and on both with the moment -1/2 w q_t k_t
/// l n x gamma. The strains are orthonormal as tensors. With a = w q_n k_n and b = w q_t k_t the force in eps_jk = eps_kj is the tensor
///
/// F_i,jk = (a - b) n_i n_j n_k + b/2 (delta_ij n_k + delta_ik n_j),
///
/// which has parts of the first and the third order: along delta_jk n_i, along the part of the other product orthogonal to that, and the
/// third harmonics Y_3 of n. The moments, of the strains n_j n_k, are second harmonics Y_2 of n. In space a part of the second order is zero
/// for bonds, and left out of the forces of the cells. In orthonormal combinations of the forces and moments in the strains a bond has
///
/// | equations in the plane | of q_n, times w k_n | of q_t, times w k_t |
/// |---|---|---|
/// | 0, 1 | n/sqrt 2 | 0 |
/// | 2, 3 | n/2 | n/2 |
/// | 4, 5 | Y_3(n)/2 | -Y_3(n)/2 |
/// | 6, 7 | 0 | -l/sqrt 8 Y_2(n) |
///
/// | equations in space | of q_n, times w k_n | of q_t, times w k_t |
/// |---|---|---|
/// | 0 to 2 | n/sqrt 3 | 0 |
/// | 3 to 5 | 2 n/sqrt 15 | 3 n/sqrt 15 |
/// | 6 to 12 | sqrt(2/5) Y_3(n) | -sqrt(2/5) Y_3(n) |
/// | 13 to 17 | 0 | -l/2 Y_2(n) |
///
/// with harmonics of the sum of squares 1. The equations of a point are scaled by one number for its forces and one for its moments, never
/// singly, which keeps them independent of the axes.
pub(super) struct Rows<'a, const D: usize, const N: usize> {
    pairs: Pairs<'a>,
    /// Directions and lever arms of the other ends of the pairs.
    places: Vec<Place<D>>,
    /// w k_n and w k_t of the pairs, N.
    stiffness: Vec<[f64; 2]>,
    /// Reference factors q_0 of the pairs.
    start: Vec<f64>,
    /// Scales of the forces and the moments of owned points, by index: the reciprocal norm of their rows with the weights q_0.
    scale: Vec<[f64; 2]>,
    /// Right-hand sides f of owned points, by index.
    right: Vec<[f64; N]>,
}

/// Direction and lever arm of the other end of a pair.
#[derive(Debug, Clone, Copy)]
struct Place<const D: usize> {
    /// Unit vector n from the point to the other end.
    direction: [f64; D],
    /// Lever arm -l/sqrt 8, in space -l/2, m.
    lever: f64,
}

/// Coefficients of the harmonics of n in the equations, by dimension.
struct Sizes {
    /// Coefficient of n in the first equations, times q_n.
    first: f64,
    /// Coefficients of n in the second equations, times q_n and q_t.
    second: [f64; 2],
    /// Coefficient of Y_3, times q_n.
    third: f64,
    /// Coefficient of Y_2, times q_t and the length.
    turn: f64,
}

const ROOT: f64 = std::f64::consts::FRAC_1_SQRT_2;

const PLANE: Sizes = Sizes {
    first: ROOT,
    second: [0.5; 2],
    third: 0.5,
    turn: -0.5 * ROOT,
};

/// Coefficients 1/sqrt 3, 2/sqrt 15, 3/sqrt 15 and sqrt(2/5).
const SPACE: Sizes = Sizes {
    first: 0.577_350_269_189_625_8,
    second: [0.516_397_779_494_322_3, 0.774_596_669_241_483_4],
    third: 0.632_455_532_033_675_9,
    turn: -0.5,
};

/// Sum over the strains of |gamma|^2 of a bond, where that of s^2 is 1.
const fn shear_share(dimension: usize) -> f64 {
    0.5 * (dimension as f64 - 1.0)
}

impl<'a, const D: usize, const N: usize> Rows<'a, D, N> {
    const SIZES: Sizes = if D == 2 { PLANE } else { SPACE };

    const N_SECOND: usize = count(D, 2);

    const N_THIRD: usize = count(D, 3);

    pub(super) fn new(
        bonds: &'a BondSet<D>,
        points: &'a Points<'_, D>,
        stiffness: &BondStiffness,
        nearest_to: &[f64],
        moment_weight: f64,
    ) -> Self {
        let Points { cloud, forces, .. } = points;
        let pairs = Pairs::new(bonds, cloud);
        let body_factor = body_factor(bonds, points, stiffness, nearest_to, &pairs.order);
        let of_bond = |bond: usize| {
            let [a, b] = bonds.ends[bond].map(|end| cloud.volumes[end as usize]);
            [stiffness.axial[bond], stiffness.shear[bond]].map(|density| a * b * density)
        };
        let lever = |bond: usize| Self::SIZES.turn * bonds.length[bond];
        let place = |point: u32, bond: u32| {
            let [first, _] = bonds.ends[bond as usize];
            let sign = if first == point { 1.0 } else { -1.0 };
            Place {
                direction: bonds.direction[bond as usize].map(|cosine| sign * cosine),
                lever: lever(bond as usize),
            }
        };
        let mut squares = vec![[0.0; 2]; cloud.len()];
        for (bond, ends) in bonds.ends.iter().enumerate() {
            let [axial, shear] = of_bond(bond).map(|it| body_factor * nearest_to[bond] * it * it);
            for &end in ends {
                let [force, moment] = &mut squares[end as usize];
                *force += axial + shear_share(D) * shear;
                *moment += shear * lever(bond).powi(2);
            }
        }
        let scale = |&point: &u32| {
            let [force, moment] = squares[point as usize].map(|square: f64| match square > 0.0 {
                true => 1.0 / square.sqrt(),
                false => 0.0,
            });
            [force, moment_weight * moment]
        };
        let right = |&point: &u32| combined::<D, N>(forces.on_point(point));
        Self {
            places: pairs.values(place),
            stiffness: pairs.values(|_, bond| of_bond(bond as usize)),
            start: pairs.values(|_, bond| body_factor * nearest_to[bond as usize]),
            scale: pairs.order.owned().iter().map(scale).collect(),
            right: pairs.order.owned().iter().map(right).collect(),
            pairs,
        }
    }
}

/// Combinations of the forces on a point in the strains; the moments are zero.
fn combined<const D: usize, const N: usize>(forces: &[[f64; D]]) -> [f64; N] {
    let mut all = [0.0; N];
    if D == 2 {
        let [xx, yy, xy] = [0, 1, 2].map(|strain| [forces[strain][0], forces[strain][1]]);
        let first = [0, 1].map(|axis| ROOT * (xx[axis] + yy[axis]));
        let second = [0, 1].map(|axis| ROOT * (xx[axis] - yy[axis]));
        let combinations = [
            first,
            [ROOT * (second[0] + xy[1]), ROOT * (xy[0] - second[1])],
            [ROOT * (second[0] - xy[1]), ROOT * (xy[0] + second[1])],
        ];
        all[..6].copy_from_slice(combinations.as_flattened());
        return all;
    }
    // Force tensor F_i,jk.
    let force = |i: usize, [j, k]: [usize; 2]| {
        let mut strains = SymTensor::<D>::COMPONENTS.iter();
        let strain = strains.position(|it| *it == [j.min(k), j.max(k)]);
        let size = if j == k { 1.0 } else { ROOT };
        strain.map_or(0.0, |strain| size * forces[strain][i])
    };
    let Sizes {
        first,
        second: [_, second],
        third,
        ..
    } = SPACE;
    for i in 0..3 {
        let of_volume = force(i, [0, 0]) + force(i, [1, 1]) + force(i, [2, 2]);
        let across = force(0, [0, i]) + force(1, [1, i]) + force(2, [2, i]);
        all[i] = first * of_volume;
        all[3 + i] = second * (across - of_volume / 3.0);
    }
    let symmetric =
        |[i, j, k]: [usize; 3]| (force(i, [j, k]) + force(j, [i, k]) + force(k, [i, j])) / 3.0;
    for (row, wave) in third_of_tensor(symmetric).into_iter().enumerate() {
        all[6 + row] = third * wave;
    }
    all
}

/// Factor c_0 for which the bonds of the body have the energy of its cells, in the mean over the strains.
fn body_factor<const D: usize>(
    bonds: &BondSet<D>,
    points: &Points<'_, D>,
    stiffness: &BondStiffness,
    nearest_to: &[f64],
    order: &SweepOrder<'_>,
) -> f64 {
    let Points { cloud, forces, .. } = points;
    let of_bond = |bond: usize| {
        let [a, b] = bonds.ends[bond].map(|end| cloud.volumes[end as usize]);
        // Averaged over the strains, s^2 and |gamma|^2 do not depend on the direction.
        let densities = stiffness.axial[bond] + shear_share(D) * stiffness.shear[bond];
        nearest_to[bond] * a * b * bonds.length[bond] * densities
    };
    let counted = (0..bonds.len()).filter(|&bond| cloud.subdomain.owns_bond(bonds.ends[bond]));
    work(cloud, forces) / order.subdomain.sum(counted.map(of_bond).sum::<f64>())
}

/// Work of the cells in all strains, J; collective.
fn work<const D: usize>(cloud: &PointCloud<D>, forces: &CellForces<D>) -> f64 {
    let of_point = |point: u32| {
        let (forces, x) = (forces.on_point(point), cloud.positions[point as usize]);
        let strains = forces.iter().zip(SymTensor::<D>::COMPONENTS);
        let of_strain = |(force, &[i, j]): (&[f64; D], &[usize; 2])| match i == j {
            true => force[i] * x[i],
            false => ROOT * (force[i] * x[j] + force[j] * x[i]),
        };
        strains.map(of_strain).sum::<f64>()
    };
    let owned = cloud.subdomain.owned();
    cloud.subdomain.sum(owned.map(of_point).sum())
}

impl<const D: usize, const N: usize> Equations<N> for Rows<'_, D, N> {
    const FORCES: usize = 2 * D + Self::N_THIRD;

    fn pairs(&self) -> &Pairs<'_> {
        &self.pairs
    }

    fn stiffness(&self) -> &[[f64; 2]] {
        &self.stiffness
    }

    fn start(&self) -> &[f64] {
        &self.start
    }

    fn right_hand_sides(&self) -> &[[f64; N]] {
        &self.right
    }

    #[inline(always)]
    fn scale(&self, index: usize) -> [f64; N] {
        let [force, moment] = self.scale[index];
        std::array::from_fn(|row| if row < Self::FORCES { force } else { moment })
    }

    #[inline(always)]
    fn forces(&self, pair: usize, [axial, shear]: [f64; 2]) -> [f64; N] {
        let Place {
            direction: n,
            lever,
        } = self.places[pair];
        let Sizes {
            first,
            second: sizes,
            ..
        } = Self::SIZES;
        let (one, two) = (first * axial, sizes[0] * axial + sizes[1] * shear);
        let (three, turn) = (Self::SIZES.third * (axial - shear), lever * shear);
        let mut all = [0.0; N];
        for axis in 0..D {
            all[axis] = one * n[axis];
            all[D + axis] = two * n[axis];
        }
        let waves = third(n);
        for row in 0..Self::N_THIRD {
            all[2 * D + row] = three * waves[row];
        }
        if N > Self::FORCES {
            let waves = second(n);
            for row in 0..Self::N_SECOND {
                all[Self::FORCES + row] = turn * waves[row];
            }
        }
        all
    }

    #[inline(always)]
    fn strains(&self, pair: usize, sum: &[f64; N]) -> [f64; 2] {
        let Place {
            direction: n,
            lever,
        } = self.places[pair];
        let along = |from: usize| dot(n, std::array::from_fn(|axis| sum[from + axis]));
        let product = |from: usize, waves: &[f64]| -> f64 {
            let rows = waves.iter().enumerate();
            rows.map(|(row, wave)| wave * sum[from + row]).sum()
        };
        let (one, two) = (Self::SIZES.first * along(0), along(D));
        let three = Self::SIZES.third * product(2 * D, &third(n)[..Self::N_THIRD]);
        let turn = if N > Self::FORCES {
            lever * product(Self::FORCES, &second(n)[..Self::N_SECOND])
        } else {
            0.0
        };
        let [of_axial, of_shear] = Self::SIZES.second;
        [one + of_axial * two + three, of_shear * two - three + turn]
    }
}
