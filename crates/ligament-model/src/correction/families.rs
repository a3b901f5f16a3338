//! The bonds seen from their points: what a sweep of the domain correction reads, in the order in which it reads it.
//!
//! A bond stands here twice, once in the family of either end. That takes more memory than bonds and their incidence, for
//! the time of the correction, but a sweep is then one pass over memory in its order, without a search for the bonds of a
//! point, and all sums of a point are the work of one thread.

use rayon::prelude::*;

use super::domain::StrainMode;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;

/// Points a block; fixed, so that the order of summation is fixed too.
const BLOCK: usize = 1024;

/// Members of a family whose factors are computed at once: square roots and divisions go in pairs through the processor.
const LANES: usize = 4;

/// The families of some points, one after the other; all but `ends` are arrays over their members.
struct Block {
    /// Where the family of each point ends, shape (points of the block).
    ends: Vec<u32>,
    /// Rank of the other end B.
    neighbour: Vec<u32>,
    /// a^2.
    along_x: Vec<f64>,
    /// b^2.
    along_y: Vec<f64>,
    /// 1/4 V_B times the bond's density under a strain of size one along x and along y, J/m^3.
    energy: Vec<[f64; 2]>,
    /// Omega.
    domain_factor: Vec<f64>,
}

/// The families of all points, with the factors Omega as they are.
pub(super) struct Families<'a> {
    bonds: &'a BondSet,
    /// The points in the order of their ranks.
    order: &'a [u32],
    blocks: Vec<Block>,
    /// e_A of the continuum, by rank, J/m^3.
    target: Vec<f64>,
    /// e_A/etil_A along x and y, by rank.
    ratios: Vec<[f64; 2]>,
    /// The same before the last sweep.
    before: Vec<[f64; 2]>,
}

impl<'a> Families<'a> {
    /// The families with all factors 1.
    ///
    /// `density(mode, bond)` is alpha (k_n s^2 + k_t gamma^2) l under a strain of size one, `target` (n_points) the
    /// energy density e_A of the continuum.
    pub(super) fn new(
        bonds: &'a BondSet,
        cloud: &'a PointCloud,
        density: impl Fn(StrainMode, usize) -> f64 + Sync,
        target: &[f64],
    ) -> Self {
        let order = &cloud.curve;
        let mut ranks = vec![0; order.len()];
        for (rank, &point) in order.iter().enumerate() {
            ranks[point as usize] = rank as u32;
        }
        let blocks: Vec<Block> = order
            .par_chunks(BLOCK)
            .map(|points| Block::new(points, bonds, cloud, &ranks, &density))
            .collect();
        let target: Vec<f64> = order.iter().map(|&point| target[point as usize]).collect();
        let mut ratios = vec![[0.0; 2]; order.len()];
        blocks
            .par_iter()
            .zip(ratios.par_chunks_mut(BLOCK))
            .zip(target.par_chunks(BLOCK))
            .for_each(|((block, ratios), target)| block.energy_ratios(target, ratios));
        Self {
            bonds,
            order,
            blocks,
            target,
            before: ratios.clone(),
            ratios,
        }
    }

    /// One sweep of NHPD eq. 13; the sum over the bonds of |change of Omega|.
    pub(super) fn sweep(&mut self) -> f64 {
        std::mem::swap(&mut self.ratios, &mut self.before);
        let before = &self.before;
        let changes: Vec<f64> = self
            .blocks
            .par_iter_mut()
            .zip(self.ratios.par_chunks_mut(BLOCK))
            .zip(self.target.par_chunks(BLOCK))
            .enumerate()
            .map(|(number, ((block, ratios), target))| {
                let change = block.update(number * BLOCK, before);
                block.energy_ratios(target, ratios);
                change
            })
            .collect();
        // Every bond was met at either end.
        0.5 * changes.iter().sum::<f64>()
    }

    /// Largest |etil/e - 1| of a point along x or y.
    pub(super) fn largest_residual(&self) -> f64 {
        let ratios = self.ratios.as_flattened().iter();
        ratios.map(|r| (1.0 / r - 1.0).abs()).fold(0.0, f64::max)
    }

    /// Omega of every bond, shape (n_bonds).
    pub(super) fn into_domain_factors(self) -> Vec<f64> {
        let mut factors = vec![0.0; self.bonds.len()];
        for (points, block) in self.order.chunks(BLOCK).zip(self.blocks) {
            for (&point, members) in points.iter().zip(block.families()) {
                // The bonds whose first end is the point follow one another, at the end of its family.
                let family = self.bonds.incidence.of(point);
                let is_second = |&bond: &u32| self.bonds.ends[bond as usize][0] != point;
                let others = family.partition_point(is_second);
                if let Some(&bond) = family.get(others) {
                    let own = &block.domain_factor[members.start + others..members.end];
                    factors[bond as usize..][..own.len()].copy_from_slice(own);
                }
            }
        }
        factors
    }
}

impl Block {
    fn new(
        points: &[u32],
        bonds: &BondSet,
        cloud: &PointCloud,
        ranks: &[u32],
        density: impl Fn(StrainMode, usize) -> f64,
    ) -> Self {
        let sizes = points.iter().map(|&point| bonds.incidence.of(point).len());
        let size = sizes.sum();
        let mut block = Self {
            ends: Vec::with_capacity(points.len()),
            neighbour: Vec::with_capacity(size),
            along_x: Vec::with_capacity(size),
            along_y: Vec::with_capacity(size),
            energy: Vec::with_capacity(size),
            domain_factor: vec![1.0; size],
        };
        for &point in points {
            for &bond in bonds.incidence.of(point) {
                let neighbour = bonds.neighbour(bond, point) as usize;
                let bond = bond as usize;
                let [a, b] = bonds.direction[bond];
                let quarter = 0.25 * cloud.volumes[neighbour];
                block.neighbour.push(ranks[neighbour]);
                block.along_x.push(a * a);
                block.along_y.push(b * b);
                let modes = [StrainMode::UniaxialX, StrainMode::UniaxialY];
                block
                    .energy
                    .push(modes.map(|mode| quarter * density(mode, bond)));
            }
            block.ends.push(block.neighbour.len() as u32);
        }
        block
    }

    /// The members of the family of each point.
    fn families(&self) -> impl Iterator<Item = std::ops::Range<usize>> {
        let mut start = 0;
        let ends = self.ends.iter().map(|&end| end as usize);
        ends.map(move |end| std::mem::replace(&mut start, end)..end)
    }

    /// Omega of every member after NHPD eq. 13, from the ratios of all points; `first` is the rank of the first point.
    /// Gives the sum of |change of Omega|.
    fn update(&mut self, first: usize, ratios: &[[f64; 2]]) -> f64 {
        let mut change = [0.0; LANES];
        let mut start = 0;
        for (point, &end) in self.ends.iter().enumerate() {
            let family = start..end as usize;
            start = end as usize;
            let own = ratios[first + point];
            let (neighbours, last_neighbours) = self.neighbour[family.clone()].as_chunks();
            let (along_x, last_along_x) = self.along_x[family.clone()].as_chunks();
            let (along_y, last_along_y) = self.along_y[family.clone()].as_chunks();
            let (factors, last_factors) = self.domain_factor[family].as_chunks_mut();
            let members = neighbours.iter().zip(along_x).zip(along_y).zip(factors);
            for (((neighbours, aa), bb), factors) in members {
                update(own, ratios, neighbours, aa, bb, factors, &mut change);
            }
            let members = (last_neighbours.iter().zip(last_along_x))
                .zip(last_along_y)
                .zip(last_factors);
            for (((&neighbour, &aa), &bb), factor) in members {
                let factor = std::array::from_mut(factor);
                let [change, ..] = &mut change;
                let change = std::array::from_mut(change);
                update(own, ratios, &[neighbour], &[aa], &[bb], factor, change);
            }
        }
        change.iter().sum()
    }

    /// e_A/etil_A along x and y of the points, with the trial energy density of NHPD eq. 12.
    fn energy_ratios(&self, target: &[f64], ratios: &mut [[f64; 2]]) {
        for ((family, e), ratio) in self.families().zip(target).zip(ratios) {
            let members = self.energy[family.clone()]
                .iter()
                .zip(&self.domain_factor[family]);
            let trial = members.fold([0.0; 2], |[x, y], (density, omega)| {
                [x + omega * density[0], y + omega * density[1]]
            });
            *ratio = trial.map(|trial| e / trial);
        }
    }
}

/// NHPD eq. 13 for some members of a family, from the ratios of the point itself and of all; adds |change of Omega|.
///
/// With q = 2 p, the sum of the ratios of both ends, Omega/sqrt((a/p_x)^2 + (b/p_y)^2) is
/// Omega q_x q_y / (2 sqrt(a^2 q_y^2 + b^2 q_x^2)).
#[inline(always)]
fn update<const N: usize>(
    own: [f64; 2],
    ratios: &[[f64; 2]],
    neighbours: &[u32; N],
    along_x: &[f64; N],
    along_y: &[f64; N],
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
