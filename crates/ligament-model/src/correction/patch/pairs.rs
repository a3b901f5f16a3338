//! Bonds by blocks of points along the curve, for sweeps that add to both ends of a bond at once.

use std::ops::Range;

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
pub(crate) use crate::correction::members::BLOCK;
use crate::correction::sweep_order::SweepOrder;
use crate::parallel;

/// Pairs of an owned point and the other end of a bond: one pair, from the end of the smaller index, where both ends are in a block, else
/// one from either end that is an owned point. `index` is the position of a point in the order of the sweeps.
pub(crate) struct Pairs<'a> {
    /// Points by index.
    pub(crate) order: SweepOrder<'a>,
    /// Number of points of the whole body.
    pub(crate) n_all: usize,
    n_bonds: usize,
    /// First pair of each point with its other end inside the block and outside, and the number of all pairs at the end, shape (n_own + 1,
    /// 2).
    starts: Vec<[usize; 2]>,
    /// Index of the other end of each pair.
    pub(crate) other: Vec<u32>,
    /// Bond of each pair.
    bond: Vec<u32>,
}

impl<'a> Pairs<'a> {
    /// Pairs of all bonds.
    pub(crate) fn new<const D: usize>(bonds: &BondSet<D>, cloud: &'a PointCloud<D>) -> Self {
        let order = SweepOrder::new(bonds, cloud);
        let (indices, n_own) = (order.indices(), order.owned().len());
        let mut pairs = Self {
            order,
            n_all: cloud.subdomain.n_all(),
            n_bonds: bonds.len(),
            starts: Vec::with_capacity(n_own + 1),
            other: Vec::with_capacity(bonds.len()),
            bond: Vec::with_capacity(bonds.len()),
        };
        for index in 0..n_own {
            let (point, block) = (pairs.order.owned()[index], index / BLOCK);
            let others = || {
                let family = bonds.incidence.at(point).iter();
                family.map(|&bond| (indices[bonds.neighbour(bond, point) as usize], bond))
            };
            let is_own = |other: u32| (other as usize) < n_own;
            let is_inner = |other: u32| is_own(other) && other as usize / BLOCK == block;
            let inner = others().filter(|&(other, _)| is_inner(other) && other as usize > index);
            let first_inner = pairs.other.len();
            pairs.push(inner);
            pairs.starts.push([first_inner, pairs.other.len()]);
            pairs.push(others().filter(|&(other, _)| !is_inner(other)));
        }
        pairs.starts.push([pairs.other.len(); 2]);
        pairs
    }

    fn push(&mut self, pairs: impl Iterator<Item = (u32, u32)>) {
        for (other, bond) in pairs {
            self.other.push(other);
            self.bond.push(bond);
        }
    }

    /// Number of pairs.
    pub(crate) fn len(&self) -> usize {
        self.other.len()
    }

    /// Number of owned points.
    pub(crate) fn n_points(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of blocks.
    fn n_blocks(&self) -> usize {
        self.n_points().div_ceil(BLOCK)
    }

    /// Indices of the points of a block.
    pub(crate) fn indices(&self, block: usize) -> Range<usize> {
        block * BLOCK..((block + 1) * BLOCK).min(self.n_points())
    }

    /// Pairs of a point whose other end is in the same block.
    #[inline(always)]
    pub(crate) fn inner(&self, index: usize) -> Range<usize> {
        let [inner, outer] = self.starts[index];
        inner..outer
    }

    /// Pairs of a point whose other end is in another block.
    #[inline(always)]
    pub(crate) fn outer(&self, index: usize) -> Range<usize> {
        self.starts[index][1]..self.starts[index + 1][0]
    }

    /// A value of each pair, computed from its point and its bond.
    pub(crate) fn values<T: Send>(&self, value: impl Fn(u32, u32) -> T + Sync) -> Vec<T> {
        let of_index = |index: usize| {
            let (point, value) = (self.order.owned()[index], &value);
            let pairs = self.starts[index][0]..self.starts[index + 1][0];
            self.bond[pairs].iter().map(move |&bond| value(point, bond))
        };
        parallel::flat_map(self.n_points(), of_index)
    }

    /// An array over the pairs, divided by blocks of points.
    pub(crate) fn blocks<'b, T>(&self, mut values: &'b mut [T]) -> Vec<&'b mut [T]> {
        let of_block = |block| {
            let indices = self.indices(block);
            let size = self.starts[indices.end][0] - self.starts[indices.start][0];
            values.split_off_mut(..size).unwrap_or_default()
        };
        (0..self.n_blocks()).map(of_block).collect()
    }

    /// First pair of a block.
    pub(crate) fn first(&self, block: usize) -> usize {
        self.starts[block * BLOCK][0]
    }

    /// Value of each bond from the values of its pairs, which are equal from both ends, shape (n_bonds).
    pub(crate) fn bond_values(&self, values: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut of_bonds = vec![0.0; self.n_bonds];
        for (&bond, value) in self.bond.iter().zip(values) {
            of_bonds[bond as usize] = value;
        }
        of_bonds
    }
}
