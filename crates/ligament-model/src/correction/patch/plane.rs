//! The equations of the plane: forces, and moments where the points turn, in three uniform strains.

use super::equations::Equations;
use super::forces::Points;
use super::pairs::Pairs;
use crate::bonds::BondSet;
use crate::correction::seats::Seats;
use crate::law::BondStiffness;

/// The equations of all points: 6 of forces, and with those of moments N = 8 a point.
///
/// A bond of length l from a point in the direction n, with t across it and w = V_A V_B, acts under a strain eps on its other end with
/// the force w (q_n k_n s n + q_t k_t gamma t), s = n.eps n, gamma = t.eps n, on the point with the opposite one and on both with the
/// moment -1/2 w q_t k_t l gamma. In the strains I/sqrt 2 and, orthonormal to it and to each other, diag(1, -1)/sqrt 2 and
/// eps_xy = 1/sqrt 2, with the angle theta of n, s = (1, cos 2 theta, sin 2 theta)/sqrt 2 and gamma = (0, -sin 2 theta, cos 2 theta)/sqrt 2.
/// The products with n and t are waves of theta and 3 theta, so that in the orthonormal combinations
///
/// (F_1x, F_1y), (F_2x + F_3y, F_3x - F_2y)/sqrt 2, (F_2x - F_3y, F_3x + F_2y)/sqrt 2, (M_2, M_3)
///
/// of the forces F_k and moments M_k in the strains k = 1 to 3 a bond has
///
/// | equations | of q_n, times w k_n | of q_t, times w k_t |
/// |---|---|---|
/// | 0, 1 | (cos theta, sin theta)/sqrt 2 | 0 |
/// | 2, 3 | (cos theta, sin theta)/2 | (cos theta, sin theta)/2 |
/// | 4, 5 | (cos 3 theta, sin 3 theta)/2 | -(cos 3 theta, sin 3 theta)/2 |
/// | 6, 7 | 0 | -l/sqrt 8 (-sin 2 theta, cos 2 theta) |
///
/// and M_1 is nothing. The equations of a point are scaled by one number for its forces and one for its moments, never each by
/// itself, which keeps them independent of the axes.
pub(super) struct PlaneEquations<'a, const N: usize> {
    pairs: Pairs<'a>,
    /// Places of the other ends, seen from the points.
    places: Vec<Place>,
    /// w k_n and w k_t of the pairs, N.
    stiffness: Vec<[f64; 2]>,
    /// Factors q_0 of the pairs, to which those of the correction are the nearest.
    start: Vec<f64>,
    /// Scales of the forces and the moments of own points, by rank: one over the norm of their rows with the weights q_0.
    scale: Vec<[f64; 2]>,
    /// f of own points, by rank.
    right: Vec<[f64; N]>,
}

/// Where the other end of a pair is.
#[derive(Debug, Clone, Copy)]
struct Place {
    /// n, from the point to the other.
    direction: [f64; 2],
    /// -l/sqrt 8, m.
    lever: f64,
}

const ROOT: f64 = std::f64::consts::FRAC_1_SQRT_2;

impl Place {
    /// The waves (cos, sin) of theta, 2 theta and 3 theta.
    #[inline(always)]
    fn waves(&self) -> [[f64; 2]; 3] {
        let [a, b] = self.direction;
        let (a2, b2) = (a * a - b * b, 2.0 * a * b);
        [[a, b], [a2, b2], [a * a2 - b * b2, b * a2 + a * b2]]
    }
}

impl<'a, const N: usize> PlaneEquations<'a, N> {
    pub(super) fn new(
        bonds: &'a BondSet,
        points: &'a Points<'_>,
        stiffness: &BondStiffness,
        nearest_to: &[f64],
        moment_weight: f64,
    ) -> Self {
        let Points { cloud, forces, .. } = points;
        let pairs = Pairs::new(bonds, cloud);
        let body_factor = body_factor(bonds, points, stiffness, nearest_to, &pairs.seats);
        let of_bond = |bond: usize| {
            let [a, b] = bonds.ends[bond].map(|end| cloud.volumes[end as usize]);
            [stiffness.axial[bond], stiffness.shear[bond]].map(|density| a * b * density)
        };
        let place = |point: u32, bond: u32| {
            let [first, _] = bonds.ends[bond as usize];
            let sign = if first == point { 1.0 } else { -1.0 };
            Place {
                direction: bonds.direction[bond as usize].map(|cosine| sign * cosine),
                lever: lever(bonds.length[bond as usize]),
            }
        };
        let mut squares = vec![[0.0; 2]; cloud.len()];
        for (bond, ends) in bonds.ends.iter().enumerate() {
            let [axial, shear] = of_bond(bond).map(|it| body_factor * nearest_to[bond] * it * it);
            for &end in ends {
                let [force, moment] = &mut squares[end as usize];
                *force += axial + 0.5 * shear;
                *moment += shear * lever(bonds.length[bond]).powi(2);
            }
        }
        let scale = |&point: &u32| {
            let [force, moment] = squares[point as usize].map(|square: f64| {
                if square > 0.0 {
                    1.0 / square.sqrt()
                } else {
                    0.0
                }
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

/// -l/sqrt 8.
fn lever(length: f64) -> f64 {
    -0.5 * ROOT * length
}

/// The combinations of the forces on a point in the strains eps_xx, eps_yy and eps_xy; no moments.
fn combined<const N: usize>(&[xx, yy, xy]: &[[f64; 2]; 3]) -> [f64; N] {
    let first = [0, 1].map(|axis| ROOT * (xx[axis] + yy[axis]));
    let second = [0, 1].map(|axis| ROOT * (xx[axis] - yy[axis]));
    let combinations = [
        first,
        [ROOT * (second[0] + xy[1]), ROOT * (xy[0] - second[1])],
        [ROOT * (second[0] - xy[1]), ROOT * (xy[0] + second[1])],
    ];
    let mut all = [0.0; N];
    all[..6].copy_from_slice(combinations.as_flattened());
    all
}

/// c_0: makes the energy of the bonds of the body that of its cells, in the mean over the strains.
fn body_factor(
    bonds: &BondSet,
    points: &Points<'_>,
    stiffness: &BondStiffness,
    nearest_to: &[f64],
    seats: &Seats<'_>,
) -> f64 {
    let Points { cloud, forces, .. } = points;
    let work = |(forces, [x, y]): (&[[f64; 2]; 3], &[f64; 2])| {
        forces[0][0] * x + forces[1][1] * y + ROOT * (forces[2][0] * y + forces[2][1] * x)
    };
    let of_cells: f64 = forces.iter().zip(&cloud.positions).map(work).sum();
    let of_bond = |bond: usize| {
        let [a, b] = bonds.ends[bond].map(|end| cloud.volumes[end as usize]);
        // In the mean over the three strains s^2 and gamma^2 do not depend on the direction: their sums are 1 and 1/2.
        let densities = stiffness.axial[bond] + 0.5 * stiffness.shear[bond];
        nearest_to[bond] * a * b * bonds.length[bond] * densities
    };
    let counted = (0..bonds.len()).filter(|&bond| cloud.counts(bonds.ends[bond]));
    of_cells / seats.total(counted.map(of_bond).sum::<f64>())
}

impl<const N: usize> Equations<N> for PlaneEquations<'_, N> {
    const FORCES: usize = 6;

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
        std::array::from_fn(|row| if row < 6 { force } else { moment })
    }

    #[inline(always)]
    fn forces(&self, pair: usize, [axial, shear]: [f64; 2]) -> [f64; N] {
        let place = &self.places[pair];
        let [[a, b], [a2, b2], [a3, b3]] = place.waves();
        let (first, turn) = (ROOT * axial, place.lever * shear);
        let (second, third) = (0.5 * (axial + shear), 0.5 * (axial - shear));
        let all = [
            first * a,
            first * b,
            second * a,
            second * b,
            third * a3,
            third * b3,
            -turn * b2,
            turn * a2,
        ];
        std::array::from_fn(|row| all[row])
    }

    #[inline(always)]
    fn strains(&self, pair: usize, sum: &[f64; N]) -> [f64; 2] {
        let place = &self.places[pair];
        let [[a, b], [a2, b2], [a3, b3]] = place.waves();
        let first = ROOT * (a * sum[0] + b * sum[1]);
        let second = 0.5 * (a * sum[2] + b * sum[3]);
        let third = 0.5 * (a3 * sum[4] + b3 * sum[5]);
        let turn = if N > 6 {
            place.lever * (a2 * sum[7] - b2 * sum[6])
        } else {
            0.0
        };
        [first + second + third, second - third + turn]
    }
}
