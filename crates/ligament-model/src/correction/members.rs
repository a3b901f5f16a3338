//! Bonds listed by family, in the order in which sweeps over families read them.
//!
//! A bond occurs twice here, once in the family of either end. That takes more memory than bonds and their incidence, during a correction,
//! but a sweep is then one sequential pass over memory, without a search for the bonds of a point, and one thread computes all sums of a
//! point.

use super::sweep_order::SweepOrder;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::parallel;

/// Number of points whose sums one thread computes; fixed, so that sums are the same for any number of threads.
pub(crate) const BLOCK: usize = 1024;

/// Bonds listed by family: each occurs in the family of either end that is an owned point. `index` is the position of a point in the order
/// of the sweeps.
pub(crate) struct Members<'a, const D: usize> {
    bonds: &'a BondSet<D>,
    cloud: &'a PointCloud<D>,
    pub(crate) order: SweepOrder<'a>,
    /// First member of the family of each point, and the number of all members at the end, shape (n_own + 1).
    starts: Vec<usize>,
    /// Index of the other end of each member.
    pub(crate) neighbour: Vec<u32>,
}

impl<'a, const D: usize> Members<'a, D> {
    /// Members of the families of owned points.
    pub(crate) fn new(bonds: &'a BondSet<D>, cloud: &'a PointCloud<D>) -> Self {
        let order = SweepOrder::new(bonds, cloud);
        let indices = order.indices();
        let mut starts = vec![0];
        let mut size = 0;
        for &point in order.owned() {
            size += bonds.incidence.at(point).len();
            starts.push(size);
        }
        let mut members = Self {
            bonds,
            cloud,
            order,
            starts,
            neighbour: Vec::new(),
        };
        members.neighbour = members.values(0, |point, bond| {
            indices[bonds.neighbour(bond, point) as usize]
        });
        members
    }

    /// Number of the bonds of the whole body.
    pub(crate) fn n_bonds(&self) -> usize {
        self.bonds.count(self.cloud)
    }

    /// Largest of a value over all processes.
    pub(crate) fn largest(&self, value: f64) -> f64 {
        self.cloud.subdomain.max(value)
    }

    /// Number of owned points.
    pub(crate) fn n_points(&self) -> usize {
        self.starts.len() - 1
    }

    /// Members of the family of a point.
    #[inline(always)]
    pub(crate) fn family(&self, index: usize) -> std::ops::Range<usize> {
        self.starts[index]..self.starts[index + 1]
    }

    /// A value of each member, computed from its point and its bond; `first` only fills the array.
    pub(crate) fn values<T: Clone + Send>(
        &self,
        first: T,
        value: impl Fn(u32, u32) -> T + Sync,
    ) -> Vec<T> {
        let mut values = vec![first; self.starts[self.n_points()]];
        self.over_blocks(&mut values, |index, values| {
            let point = self.order.owned()[index];
            for (slot, &bond) in values.iter_mut().zip(self.bonds.incidence.at(point)) {
                *slot = value(point, bond);
            }
        });
        values
    }

    /// Applies a function to the values of each family, in parallel.
    pub(crate) fn over_blocks<T: Send>(
        &self,
        values: &mut [T],
        each: impl Fn(usize, &mut [T]) + Sync,
    ) {
        let blocks = self.blocks(values).into_iter().enumerate();
        parallel::for_each(blocks, |(number, mut values)| {
            let last = ((number + 1) * BLOCK).min(self.n_points());
            for index in number * BLOCK..last {
                let own;
                (own, values) = values.split_at_mut(self.family(index).len());
                each(index, own);
            }
        });
    }

    /// An array over the members, divided by blocks of points.
    pub(crate) fn blocks<'b, T>(&self, mut values: &'b mut [T]) -> Vec<&'b mut [T]> {
        let mut blocks = Vec::new();
        for first in (0..self.n_points()).step_by(BLOCK) {
            let last = (first + BLOCK).min(self.n_points());
            let block;
            (block, values) = values.split_at_mut(self.starts[last] - self.starts[first]);
            blocks.push(block);
        }
        blocks
    }

    /// Value of each bond from the values of its members, which are equal at both ends, shape (n_bonds).
    pub(crate) fn bond_values<T: Copy + Default + Send + Sync>(&self, values: &[T]) -> Vec<T> {
        if !self.cloud.subdomain.is_whole() {
            return self.values_of_local_bonds(values);
        }
        // Bonds with the same first end are consecutive, at the end of its family.
        let of_others = self.cloud.over_points(|point| {
            let is_second = |&bond: &u32| self.bonds.ends[bond as usize][0] != point;
            self.bonds.incidence.at(point).partition_point(is_second)
        });
        let mut of_bonds = vec![T::default(); self.bonds.len()];
        let mut rest = of_bonds.as_mut_slice();
        let mut own: Vec<&mut [T]> = (0..)
            .zip(&of_others)
            .map(|(point, others)| {
                let count = self.bonds.incidence.at(point).len() - others;
                rest.split_off_mut(..count).unwrap_or_default()
            })
            .collect();
        for (index, &point) in self.cloud.curve.iter().enumerate() {
            let others = of_others[point as usize];
            own[point as usize].copy_from_slice(&values[self.family(index)][others..]);
        }
        of_bonds
    }

    /// Value of each bond of this process, whose first end may be a point of another process.
    fn values_of_local_bonds<T: Copy + Default>(&self, values: &[T]) -> Vec<T> {
        let mut of_bonds = vec![T::default(); self.bonds.len()];
        let families = self.order.owned().iter();
        let members = families.flat_map(|&point| self.bonds.incidence.at(point));
        for (&bond, &value) in members.zip(values) {
            of_bonds[bond as usize] = value;
        }
        of_bonds
    }
}
