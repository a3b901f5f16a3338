//! Connected parts of a body.

use ligament_model::connected::first_points;
use ligament_model::subdomain::Subdomain;
use ligament_model::{BondSet, PointCloud};

/// Connected parts of points that pairs link, over all processes.
pub(crate) struct Parts {
    /// Number in the body of the first point of each point's part, shape (n_points).
    first: Vec<u32>,
    count: usize,
}

impl Parts {
    /// Connected parts of the points of a body by pairs of them; collective.
    pub(crate) fn new(subdomain: &Subdomain, pairs: impl Iterator<Item = [u32; 2]>) -> Self {
        let first = first_points(subdomain, pairs);
        let is_first = |point: &u32| first[*point as usize] == subdomain.number(*point);
        let firsts = subdomain.owned().filter(is_first);
        Self {
            count: subdomain.count(firsts.count()),
            first,
        }
    }

    /// Connected parts of the points of a body by its bonds; collective.
    pub(crate) fn of_bonds<const D: usize>(cloud: &PointCloud<D>, bonds: &BondSet<D>) -> Self {
        Self::new(&cloud.subdomain, bonds.ends.iter().copied())
    }

    /// Number in the body of the first point of the part of a point.
    pub(crate) fn part(&self, point: u32) -> u32 {
        self.first[point as usize]
    }

    /// Number of parts.
    pub(crate) fn count(&self) -> usize {
        self.count
    }
}
