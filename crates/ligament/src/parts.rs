//! Connected parts of a body.

use ligament_model::{BondSet, PointCloud};

/// Connected parts of points that pairs link.
pub(crate) struct Parts {
    /// First point of each point's part, shape (n_points).
    first: Vec<u32>,
}

impl Parts {
    /// Connected parts of points by pairs of them.
    pub(crate) fn new(n_points: usize, pairs: impl Iterator<Item = [u32; 2]>) -> Self {
        let mut first: Vec<u32> = (0..n_points as u32).collect();
        let root = |first: &mut [u32], mut point: u32| {
            while first[point as usize] != point {
                first[point as usize] = first[first[point as usize] as usize];
                point = first[point as usize];
            }
            point
        };
        for [one, other] in pairs {
            let roots = [one, other].map(|it| root(&mut first, it));
            first[roots[0].max(roots[1]) as usize] = roots[0].min(roots[1]);
        }
        for point in 0..n_points as u32 {
            first[point as usize] = root(&mut first, point);
        }
        Self { first }
    }

    /// Connected parts of the points of a body by its bonds, over all processes.
    pub(crate) fn of_bonds<const D: usize>(cloud: &PointCloud<D>, bonds: &BondSet<D>) -> Self {
        let known = Self::new(cloud.len(), bonds.ends.iter().copied());
        if cloud.subdomain.is_whole() {
            return known;
        }
        let numbered = (0..)
            .zip(known.first)
            .filter(|(point, first)| point != first);
        let pairs = numbered.map(|(point, first)| [point, first]).collect();
        let all = cloud.subdomain.all_gather_list(pairs);
        Self::new(cloud.len(), all.into_iter())
    }

    /// First point of the part of a point.
    pub(crate) fn part(&self, point: u32) -> u32 {
        self.first[point as usize]
    }

    /// Number of parts.
    pub(crate) fn count(&self) -> usize {
        let firsts = self.first.iter().enumerate();
        firsts
            .filter(|(point, first)| *point == **first as usize)
            .count()
    }
}
