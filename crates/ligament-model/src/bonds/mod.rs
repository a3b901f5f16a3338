//! Dual-horizon bonds: one record for each pair of points, at least one of which lies in the horizon of the other.

pub mod composition;
mod first_bonds;
pub mod hole;
pub mod outline;
pub mod parts;
pub mod precrack;
pub(crate) mod retained;
mod search;
pub mod star;

use std::sync::Arc;

use crate::cloud::PointCloud;
pub use composition::Composition;
use parts::Parts;
use retained::retained;

/// All bonds of a body, as arrays over the bonds.
///
/// Bonds are ordered by their first end, then by their second. They lie in the plane, or for D = 3 in space.
#[derive(Debug, Clone, PartialEq)]
pub struct BondSet<const D: usize = 2> {
    /// Points A < B of each bond, shape (n_bonds).
    pub ends: Arc<[[u32; 2]]>,
    /// Lengths l, shape (n_bonds), m.
    pub length: Vec<f64>,
    /// Direction cosines from A to B, shape (n_bonds).
    pub direction: Vec<[f64; D]>,
    /// Bond horizons H, shape (n_bonds), m.
    pub horizon: Arc<[f64]>,
    /// Bonds of each point.
    pub incidence: Arc<Incidence>,
    /// Composition of the bonds that cross an interface; empty until they are traced through the body.
    pub composition: Composition,
}

/// Lists of the bonds of each point, ascending; in the order of [`BondSet`] the neighbours ascend as well.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Incidence {
    offsets: Vec<usize>,
    bonds: Vec<u32>,
}

impl<const D: usize> BondSet<D> {
    /// Number of bonds.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Number of bonds of the whole body, for a cloud whose points are distributed over processes.
    pub fn count(&self, cloud: &PointCloud<D>) -> usize {
        let owned = self.ends.iter();
        let owned = owned.filter(|it| cloud.subdomain.owns_bond(**it));
        cloud.subdomain.count(owned.count())
    }

    /// Whether the set has no bond.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The other end of a bond of `point`.
    pub fn neighbour(&self, bond: u32, point: u32) -> u32 {
        let [a, b] = self.ends[bond as usize];
        if a == point { b } else { a }
    }

    /// Owned points of a cloud without any bond, ascending.
    pub fn lone_points(&self, cloud: &PointCloud<D>) -> Vec<u32> {
        let owned = cloud.subdomain.owned();
        owned
            .filter(|&point| self.incidence.at(point).is_empty())
            .collect()
    }

    /// The subset of bonds for which `keep` (n_bonds) is true.
    pub fn retained(self, keep: &[bool]) -> Self {
        let ends: Arc<[[u32; 2]]> = retained(self.ends.to_vec(), keep).into();
        let incidence = Incidence::new(&ends, self.incidence.n_points());
        Self {
            ends,
            length: retained(self.length, keep),
            direction: retained(self.direction, keep),
            horizon: retained(self.horizon.to_vec(), keep).into(),
            incidence: incidence.into(),
            composition: self.composition.retained(keep),
        }
    }

    /// The bond set with its composition, traced through the convex parts of the body.
    pub fn through(self, parts: &impl Parts<D>, cloud: &PointCloud<D>) -> Self {
        Self {
            composition: Composition::new(parts, &self.ends, cloud),
            ..self
        }
    }
}

impl Incidence {
    /// The bonds of each point, from the ends in the order of [`BondSet`].
    pub(crate) fn new(ends: &[[u32; 2]], n_points: usize) -> Self {
        let numbered = (0..).zip(ends);
        let pairs = numbered.flat_map(|(bond, ends)| ends.map(|end| (end, bond)));
        Self::from_pairs(pairs, n_points)
    }

    /// Lists of numbers for `n_points` points, from pairs of a point and a number, in the order of the pairs.
    pub fn from_pairs(pairs: impl Iterator<Item = (u32, u32)> + Clone, n_points: usize) -> Self {
        let mut offsets = vec![0; n_points + 1];
        for (point, _) in pairs.clone() {
            offsets[point as usize + 1] += 1;
        }
        for point in 0..n_points {
            offsets[point + 1] += offsets[point];
        }
        let mut next = offsets.clone();
        let mut bonds = vec![0; offsets[n_points]];
        for (point, bond) in pairs {
            bonds[next[point as usize]] = bond;
            next[point as usize] += 1;
        }
        Self { offsets, bonds }
    }

    /// Number of points.
    pub fn n_points(&self) -> usize {
        self.offsets.len() - 1
    }

    /// The list of a point: in [`BondSet::incidence`] its bonds, ascending.
    pub fn at(&self, point: u32) -> &[u32] {
        &self.bonds[self.offsets[point as usize]..self.offsets[point as usize + 1]]
    }
}
