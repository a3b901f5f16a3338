//! The equations of the plane: forces, and moments where the points turn, in three uniform strains.

use super::dual::Equations;
use super::forces::Points;
use crate::bonds::BondSet;
use crate::correction::members::Members;
use crate::law::BondStiffness;

/// The equations of all points: 6 of forces, and with those of moments N = 9 a point.
///
/// A bond of length l from a point in the direction n, with t across it and w = V_A V_B, acts under a strain eps on the point with the
/// force -w (q_n k_n s n + q_t k_t gamma t), s = n.eps n, gamma = t.eps n, and with the moment -1/2 w q_t k_t l gamma.
///
/// The equations of a point are scaled by one number for its forces and one for its moments, never each by itself, which keeps them
/// independent of the axes.
pub(super) struct PlaneEquations<'a, const N: usize> {
    members: Members<'a>,
    /// What a member does.
    actions: Vec<Action>,
    /// Uncorrected factors alpha c_0 of the members.
    start: Vec<f64>,
    /// Scales of the forces and the moments, by rank.
    scale: Vec<[f64; 2]>,
    /// f, by rank.
    right: Vec<[f64; N]>,
}

/// Forces and moment of a member in a strain of size one.
#[derive(Debug, Clone, Copy, Default)]
struct Action {
    /// n, from the point to the other.
    direction: [f64; 2],
    /// w k_n, N.
    axial: f64,
    /// w k_t, N.
    shear: f64,
    /// l/2, m.
    lever: f64,
}

const ROOT: f64 = std::f64::consts::FRAC_1_SQRT_2;

impl Action {
    /// s and gamma in each of the strains.
    #[inline(always)]
    fn strains(&self) -> ([f64; 3], [f64; 3]) {
        let [a, b] = self.direction;
        let root = std::f64::consts::SQRT_2;
        (
            [a * a, b * b, root * a * b],
            [-a * b, a * b, ROOT * (a * a - b * b)],
        )
    }
}

impl<'a, const N: usize> PlaneEquations<'a, N> {
    pub(super) fn new(
        bonds: &'a BondSet,
        points: &'a Points<'_>,
        stiffness: &BondStiffness,
        alpha: &[f64],
        moment_weight: f64,
    ) -> Self {
        let Points { cloud, forces, .. } = points;
        let members = Members::new(bonds, cloud);
        let actions = members.values(|point, bond| {
            let [first, _] = bonds.ends[bond as usize];
            let other = bonds.neighbour(bond, point) as usize;
            let bond = bond as usize;
            let sign = if first == point { 1.0 } else { -1.0 };
            let weight = cloud.volumes[point as usize] * cloud.volumes[other];
            Action {
                direction: bonds.direction[bond].map(|cosine| sign * cosine),
                axial: weight * stiffness.axial[bond],
                shear: weight * stiffness.shear[bond],
                lever: 0.5 * bonds.length[bond],
            }
        });
        let body_factor = body_factor(bonds, points, stiffness, alpha);
        let start = members.values(|_, bond| body_factor * alpha[bond as usize]);
        let right = cloud.curve.iter().map(|&point| {
            let forces = &forces[point as usize];
            std::array::from_fn(|row| {
                if row < 6 {
                    forces[row / 2][row % 2]
                } else {
                    0.0
                }
            })
        });
        let mut equations = Self {
            right: right.collect(),
            scale: Vec::new(),
            members,
            actions,
            start,
        };
        equations.scale = (0..cloud.len())
            .map(|rank| equations.scale_of(rank, moment_weight))
            .collect();
        equations
    }

    /// One over the norm of the rows of a point's forces and moments, with the weights q_0.
    fn scale_of(&self, rank: usize, moment_weight: f64) -> [f64; 2] {
        let mut squares = [0.0; 2];
        for member in self.members.family(rank) {
            for row in self.rows(member) {
                for (k, value) in row.iter().enumerate() {
                    squares[usize::from(k >= 6)] += self.start[member] * value * value;
                }
            }
        }
        let [force, moment] = squares.map(|it| if it > 0.0 { 1.0 / it.sqrt() } else { 0.0 });
        [force, moment_weight * moment]
    }
}

/// c_0: makes the energy of the bonds of the body that of its cells, in the mean over the strains.
fn body_factor(
    bonds: &BondSet,
    points: &Points<'_>,
    stiffness: &BondStiffness,
    alpha: &[f64],
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
        alpha[bond] * a * b * bonds.length[bond] * densities
    };
    of_cells / (0..bonds.len()).map(of_bond).sum::<f64>()
}

impl<const N: usize> Equations<N> for PlaneEquations<'_, N> {
    fn members(&self) -> &Members<'_> {
        &self.members
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
    fn exponents(&self, member: usize, own: &[f64; N], other: &[f64; N]) -> [f64; 2] {
        let action = &self.actions[member];
        let [a, b] = action.direction;
        let (s, g) = action.strains();
        let (mut along, mut across) = ([0.0; 2], [0.0; 2]);
        let mut turn = 0.0;
        for k in 0..3 {
            let x = other[2 * k] - own[2 * k];
            let y = other[2 * k + 1] - own[2 * k + 1];
            along = [along[0] + s[k] * x, along[1] + s[k] * y];
            across = [across[0] + g[k] * x, across[1] + g[k] * y];
            if N > 6 {
                turn += g[k] * (own[6 + k] + other[6 + k]);
            }
        }
        [
            action.axial * (a * along[0] + b * along[1]),
            action.shear * (a * across[1] - b * across[0] - action.lever * turn),
        ]
    }

    #[inline(always)]
    fn add(&self, member: usize, factors: [f64; 2], sum: &mut [f64; N]) {
        let action = &self.actions[member];
        let [a, b] = action.direction;
        let (s, g) = action.strains();
        let (axial, shear) = (-action.axial * factors[0], -action.shear * factors[1]);
        for k in 0..3 {
            let (along, across) = (axial * s[k], shear * g[k]);
            sum[2 * k] += along * a - across * b;
            sum[2 * k + 1] += along * b + across * a;
            if N > 6 {
                sum[6 + k] += across * action.lever;
            }
        }
    }
}
