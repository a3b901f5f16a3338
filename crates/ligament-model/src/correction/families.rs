//! The sweeps of the domain correction over the families of the points.

use rayon::prelude::*;

use super::members::{BLOCK, Members};
use super::strain_mode::StrainMode;
use super::sweeps::SweptFamilies;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;

/// Members of a family whose factors are computed at once: square roots and divisions go in pairs through the processor.
const LANES: usize = 4;

/// The families of own points along the curve; `rank` is the place of a point in the order of the sweeps.
pub(super) struct Families<'a> {
    coefficients: Coefficients<'a>,
    /// Omega of each member.
    domain_factor: Vec<f64>,
    /// e_A of the continuum along x and y of own points, by rank, J/m^3.
    target: Vec<[f64; 2]>,
    /// e_A/etil_A along x and y of the points, by rank.
    ratios: Vec<[f64; 2]>,
    /// The ratios before the last sweep, by rank.
    before: Vec<[f64; 2]>,
}

/// What a sweep multiplies the factors with: the members of the families, and arrays over them.
struct Coefficients<'a> {
    members: Members<'a>,
    /// a^2.
    along_x: Vec<f64>,
    /// b^2.
    along_y: Vec<f64>,
    /// 1/4 V_B times the bond's density under a strain of size one along x and along y, J/m^3.
    energy: Vec<[f64; 2]>,
}

impl<'a> Families<'a> {
    /// The families with all factors 1.
    ///
    /// `density(mode, bond)` is alpha (k_n s^2 + k_t gamma^2) l under a strain of size one, `targets` (2, n_points) the
    /// energy densities e_A of the continuum.
    pub(super) fn new(
        bonds: &'a BondSet,
        cloud: &'a PointCloud,
        density: impl Fn(StrainMode, usize) -> f64 + Sync,
        targets: &[Vec<f64>; 2],
    ) -> Self {
        let coefficients = Coefficients::new(bonds, cloud, density);
        let domain_factor = vec![1.0; coefficients.energy.len()];
        let at = |point: u32| [0, 1].map(|axis| targets[axis][point as usize]);
        let own = coefficients.members.seats.own().iter();
        let target: Vec<[f64; 2]> = own.map(|&point| at(point)).collect();
        let mut ratios = vec![[0.0; 2]; coefficients.members.seats.all().len()];
        let own = ratios.par_iter_mut().zip(&target).enumerate();
        own.for_each(|(rank, (ratios, &target))| {
            let factors = &domain_factor[coefficients.members.family(rank)];
            *ratios = coefficients.energy_ratios(rank, factors, target);
        });
        coefficients.members.seats.complete(&mut ratios);
        Self {
            coefficients,
            domain_factor,
            target,
            before: ratios.clone(),
            ratios,
        }
    }
}

impl SweptFamilies for Families<'_> {
    fn sweep(&mut self) -> f64 {
        std::mem::swap(&mut self.ratios, &mut self.before);
        let (coefficients, before, target) = (&self.coefficients, &self.before, &self.target);
        let changes: Vec<f64> = (
            coefficients.members.blocks(&mut self.domain_factor),
            self.ratios[..target.len()].par_chunks_mut(BLOCK),
        )
            .into_par_iter()
            .enumerate()
            .map(|(number, (mut factors, ratios))| {
                let mut change = [0.0; LANES];
                for (rank, ratio) in (number * BLOCK..).zip(ratios) {
                    let own;
                    (own, factors) = factors.split_at_mut(coefficients.members.family(rank).len());
                    coefficients.update(rank, before, own, &mut change);
                    *ratio = coefficients.energy_ratios(rank, own, target[rank]);
                }
                change.iter().sum()
            })
            .collect();
        let seats = &coefficients.members.seats;
        seats.complete(&mut self.ratios);
        // Every bond was met at either end.
        0.5 * seats.total(changes.iter().sum::<f64>())
    }

    fn n_bonds(&self) -> usize {
        self.coefficients.members.n_bonds()
    }

    fn largest_residual(&self) -> f64 {
        let ratios = self.ratios.as_flattened().iter();
        let residuals = ratios.map(|r| (1.0 / r - 1.0).abs());
        self.coefficients
            .members
            .largest(residuals.fold(0.0, f64::max))
    }

    fn into_domain_factors(self) -> Vec<f64> {
        self.coefficients.members.of_bonds(&self.domain_factor)
    }
}

impl<'a> Coefficients<'a> {
    fn new(
        bonds: &'a BondSet,
        cloud: &'a PointCloud,
        density: impl Fn(StrainMode, usize) -> f64 + Sync,
    ) -> Self {
        let members = Members::new(bonds, cloud);
        let along =
            |axis: usize| members.values(|_, bond| bonds.direction[bond as usize][axis].powi(2));
        let energy = members.values(|point, bond| {
            let quarter = 0.25 * cloud.volumes[bonds.neighbour(bond, point) as usize];
            [StrainMode::UniaxialX, StrainMode::UniaxialY]
                .map(|mode| quarter * density(mode, bond as usize))
        });
        Self {
            along_x: along(0),
            along_y: along(1),
            energy,
            members,
        }
    }

    /// NHPD eq. 13 for the `factors` Omega of a family, from the ratios of all points; adds |change of Omega|.
    fn update(
        &self,
        rank: usize,
        ratios: &[[f64; 2]],
        factors: &mut [f64],
        change: &mut [f64; LANES],
    ) {
        let (family, own) = (self.members.family(rank), ratios[rank]);
        let (neighbours, last_neighbours) = self.members.neighbour[family.clone()].as_chunks();
        let (along_x, last_along_x) = self.along_x[family.clone()].as_chunks();
        let (along_y, last_along_y) = self.along_y[family].as_chunks();
        let (factors, last_factors) = factors.as_chunks_mut();
        let members = neighbours.iter().zip(along_x).zip(along_y).zip(factors);
        for (((neighbours, aa), bb), factors) in members {
            update_members(own, ratios, neighbours, [aa, bb], factors, change);
        }
        let members = (last_neighbours.iter().zip(last_along_x))
            .zip(last_along_y)
            .zip(last_factors);
        for (((&neighbour, &aa), &bb), factor) in members {
            let (factor, [change, ..]) = (std::array::from_mut(factor), &mut *change);
            let change = std::array::from_mut(change);
            update_members(own, ratios, &[neighbour], [&[aa], &[bb]], factor, change);
        }
    }

    /// e_A/etil_A along x and y of a point, with the trial energy density of NHPD eq. 12.
    fn energy_ratios(&self, rank: usize, factors: &[f64], target: [f64; 2]) -> [f64; 2] {
        let members = self.energy[self.members.family(rank)].iter().zip(factors);
        let trial = members.fold([0.0; 2], |[x, y], (density, omega)| {
            [x + omega * density[0], y + omega * density[1]]
        });
        [target[0] / trial[0], target[1] / trial[1]]
    }
}

/// NHPD eq. 13 for some members of a family, from the ratios of the point itself and of all.
///
/// With q = 2 p, the sum of the ratios of both ends, Omega/sqrt((a/p_x)^2 + (b/p_y)^2) is
/// Omega q_x q_y / (2 sqrt(a^2 q_y^2 + b^2 q_x^2)).
#[inline(always)]
fn update_members<const N: usize>(
    own: [f64; 2],
    ratios: &[[f64; 2]],
    neighbours: &[u32; N],
    [along_x, along_y]: [&[f64; N]; 2],
    factors: &mut [f64; N],
    change: &mut [f64; N],
) {
    let (mut q_x, mut q_y) = ([0.0; N], [0.0; N]);
    for k in 0..N {
        let other = ratios[neighbours[k] as usize];
        (q_x[k], q_y[k]) = (own[0] + other[0], own[1] + other[1]);
    }
    for k in 0..N {
        let squares = along_x[k] * (q_y[k] * q_y[k]) + along_y[k] * (q_x[k] * q_x[k]);
        let factor = factors[k] * (0.5 * q_x[k] * q_y[k]) / squares.sqrt();
        change[k] += (factor - factors[k]).abs();
        factors[k] = factor;
    }
}
