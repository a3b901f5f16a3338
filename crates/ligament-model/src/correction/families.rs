//! The sweeps of the domain correction over the families of the points.

use super::members::{BLOCK, Members};
use super::sweeps::SweptFamilies;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::parallel;

/// Number of members of a family whose factors are computed together: the processor does square roots and divisions in pairs.
const LANES: usize = 4;

/// Families of the owned points along the curve; `index` is the position of a point in the order of the sweeps.
pub(super) struct Families<'a, const D: usize> {
    coefficients: Coefficients<'a, D>,
    /// Factor Omega of each member.
    domain_factor: Vec<f64>,
    /// Energy density e_A of the continuum along the axes at the owned points, by index, J/m^3.
    target: Vec<[f64; D]>,
    /// Ratios e_A/etil_A along the axes at the points, by index.
    ratios: Vec<[f64; D]>,
    /// Ratios before the last sweep, by index.
    before: Vec<[f64; D]>,
}

/// Members of the families with the coefficients of a sweep.
struct Coefficients<'a, const D: usize> {
    members: Members<'a, D>,
    /// Squares of the direction cosines along each axis.
    squares: [Vec<f64>; D],
    /// Product of 1/4 V_B and the density of the bond under a strain of size one along each axis, J/m^3.
    energy: Vec<[f64; D]>,
}

impl<'a, const D: usize> Families<'a, D> {
    /// Families with all factors 1.
    ///
    /// `density(axis, bond)` is alpha (k_n s^2 + k_t |gamma|^2) l under a strain of size one along an axis, `targets` (D, n_points) the
    /// energy densities e_A of the continuum.
    pub(super) fn new(
        bonds: &'a BondSet<D>,
        cloud: &'a PointCloud<D>,
        density: impl Fn(usize, usize) -> f64 + Sync,
        targets: &[Vec<f64>; D],
    ) -> Self {
        let coefficients = Coefficients::new(bonds, cloud, density);
        let domain_factor = vec![1.0; coefficients.energy.len()];
        let at = |point: u32| std::array::from_fn(|axis| targets[axis][point as usize]);
        let own = coefficients.members.order.owned().iter();
        let target: Vec<[f64; D]> = own.map(|&point| at(point)).collect();
        let mut ratios = vec![[0.0; D]; coefficients.members.order.all().len()];
        let blocks = ratios.chunks_mut(BLOCK).zip(target.chunks(BLOCK));
        parallel::for_each(blocks.enumerate(), |(number, (ratios, target))| {
            for (index, (ratios, &target)) in (number * BLOCK..).zip(ratios.iter_mut().zip(target))
            {
                let factors = &domain_factor[coefficients.members.family(index)];
                *ratios = coefficients.energy_ratios(index, factors, target);
            }
        });
        coefficients.members.order.update_ghosts(&mut ratios);
        Self {
            coefficients,
            domain_factor,
            target,
            before: ratios.clone(),
            ratios,
        }
    }
}

impl<const D: usize> SweptFamilies for Families<'_, D> {
    fn sweep(&mut self) -> f64 {
        std::mem::swap(&mut self.ratios, &mut self.before);
        let (coefficients, before, target) = (&self.coefficients, &self.before, &self.target);
        let factors = coefficients.members.blocks(&mut self.domain_factor);
        let ratios = self.ratios[..target.len()].chunks_mut(BLOCK);
        let blocks = factors.into_iter().zip(ratios).enumerate();
        let changes: Vec<f64> = parallel::map(blocks, |(number, (mut factors, ratios))| {
            let mut change = [0.0; LANES];
            for (index, ratio) in (number * BLOCK..).zip(ratios) {
                let own;
                (own, factors) = factors.split_at_mut(coefficients.members.family(index).len());
                coefficients.update(index, before, own, &mut change);
                *ratio = coefficients.energy_ratios(index, own, target[index]);
            }
            change.iter().sum()
        });
        let order = &coefficients.members.order;
        order.update_ghosts(&mut self.ratios);
        // Every bond occurs once at either end.
        0.5 * order.subdomain.sum(changes.iter().sum::<f64>())
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
        self.coefficients.members.bond_values(&self.domain_factor)
    }
}

impl<'a, const D: usize> Coefficients<'a, D> {
    fn new(
        bonds: &'a BondSet<D>,
        cloud: &'a PointCloud<D>,
        density: impl Fn(usize, usize) -> f64 + Sync,
    ) -> Self {
        let members = Members::new(bonds, cloud);
        let squares = std::array::from_fn(|axis| {
            members.values(0.0, |_, bond| bonds.direction[bond as usize][axis].powi(2))
        });
        let energy = members.values([0.0; D], |point, bond| {
            let quarter = 0.25 * cloud.volumes[bonds.neighbour(bond, point) as usize];
            std::array::from_fn(|axis| quarter * density(axis, bond as usize))
        });
        Self {
            squares,
            energy,
            members,
        }
    }

    /// NHPD eq. 13 for the `factors` Omega of a family, from the ratios of all points; adds |change of Omega| to `change`.
    fn update(
        &self,
        index: usize,
        ratios: &[[f64; D]],
        factors: &mut [f64],
        change: &mut [f64; LANES],
    ) {
        let (family, own) = (self.members.family(index), ratios[index]);
        let (neighbours, last_neighbours) = self.members.neighbour[family.clone()].as_chunks();
        let squares: [_; D] =
            std::array::from_fn(|axis| self.squares[axis][family.clone()].as_chunks());
        let (factors, last_factors) = factors.as_chunks_mut();
        for (k, (neighbours, factors)) in neighbours.iter().zip(factors).enumerate() {
            let squares = squares.map(|(chunks, _)| &chunks[k]);
            update_members(own, ratios, neighbours, squares, factors, change);
        }
        let [change, ..] = change;
        let change = std::array::from_mut(change);
        for (k, (&neighbour, factor)) in last_neighbours.iter().zip(last_factors).enumerate() {
            let (squares, factor) = (
                squares.map(|(_, last)| std::array::from_ref(&last[k])),
                std::array::from_mut(factor),
            );
            update_members(own, ratios, &[neighbour], squares, factor, change);
        }
    }

    /// Ratios e_A/etil_A along the axes at a point, with the trial energy density of NHPD eq. 12.
    fn energy_ratios(&self, index: usize, factors: &[f64], target: [f64; D]) -> [f64; D] {
        let members = self.energy[self.members.family(index)].iter().zip(factors);
        let mut trial = [0.0; D];
        for (density, omega) in members {
            (0..D).for_each(|axis| trial[axis] += omega * density[axis]);
        }
        std::array::from_fn(|axis| target[axis] / trial[axis])
    }
}

/// NHPD eq. 13 for some members of a family, from the ratios of the point itself and of all points.
///
/// With q = 2 p, the sum of the ratios of both ends, Omega/sqrt((a/p_x)^2 + (b/p_y)^2) is
/// Omega q_x q_y / (2 sqrt(a^2 q_y^2 + b^2 q_x^2)), and with a third axis Omega q_x q_y q_z over
/// 2 sqrt((a q_y q_z)^2 + (b q_x q_z)^2 + (c q_x q_y)^2).
#[inline(always)]
fn update_members<const D: usize, const N: usize>(
    own: [f64; D],
    ratios: &[[f64; D]],
    neighbours: &[u32; N],
    along: [&[f64; N]; D],
    factors: &mut [f64; N],
    change: &mut [f64; N],
) {
    let mut q = [[0.0; N]; D];
    for k in 0..N {
        let other = ratios[neighbours[k] as usize];
        (0..D).for_each(|axis| q[axis][k] = own[axis] + other[axis]);
    }
    for k in 0..N {
        // Product of q along the other axes.
        let others = |axis: usize| match D {
            2 => q[1 - axis][k],
            _ => q[usize::from(axis == 0)][k] * q[2 - usize::from(axis == 2)][k],
        };
        let mut squares = along[0][k] * (others(0) * others(0));
        for (axis, along) in along.iter().enumerate().skip(1) {
            squares += along[k] * (others(axis) * others(axis));
        }
        let factor = factors[k] * (0.5 * q[0][k] * others(0)) / squares.sqrt();
        change[k] += (factor - factors[k]).abs();
        factors[k] = factor;
    }
}
