//! Order of the points in sweeps of corrections: owned ones along the curve, then ghosts.

use std::borrow::Cow;

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::ghosts::Ghosts;
use crate::subdomain::Subdomain;

/// Index of a point that is neither owned nor a ghost.
const NONE: u32 = u32::MAX;

/// Points in the order of the sweeps, which defines their indices.
pub(crate) struct SweepOrder<'a> {
    /// Points by index, owned ones first.
    points: Cow<'a, [u32]>,
    /// Points owned by this process.
    pub(crate) subdomain: &'a Subdomain,
    /// Ghosts, by index.
    pub(crate) ghosts: Ghosts,
}

impl<'a> SweepOrder<'a> {
    /// Order of the points of a cloud with some bonds.
    pub(crate) fn new<const D: usize>(bonds: &BondSet<D>, cloud: &'a PointCloud<D>) -> Self {
        let subdomain = &cloud.subdomain;
        let mut order = Self {
            points: cloud.owned_along_curve(),
            subdomain,
            ghosts: Ghosts::new(subdomain, bonds.ends.iter().flatten().copied()),
        };
        if !subdomain.is_whole() {
            let mut is_ghost = vec![false; cloud.len()];
            (order.ghosts.points().iter()).for_each(|&it| is_ghost[it as usize] = true);
            let along_curve = cloud.curve.iter().copied();
            (order.points.to_mut()).extend(along_curve.filter(|&it| is_ghost[it as usize]));
            let indices = order.indices();
            order.ghosts = order.ghosts.renumbered(|point| indices[point as usize]);
        }
        order
    }

    /// Points by index, owned ones first.
    pub(crate) fn all(&self) -> &[u32] {
        &self.points
    }

    /// Owned points.
    pub(crate) fn owned(&self) -> &[u32] {
        &self.points[..self.subdomain.n_owned()]
    }

    /// Index of each point of the cloud, shape (n_points).
    pub(crate) fn indices(&self) -> Vec<u32> {
        let mut indices = vec![NONE; self.subdomain.n_points()];
        for (index, &point) in (0..).zip(&*self.points) {
            indices[point as usize] = index;
        }
        indices
    }

    /// Replaces the values at ghosts by the values of their owners, by index.
    pub(crate) fn update_ghosts<const N: usize>(&self, values: &mut [[f64; N]]) {
        self.ghosts.update(values.as_flattened_mut(), N);
    }

    /// Value of each point of the cloud from the values of owned points, by index.
    pub(crate) fn of_points(&self, values: &[f64]) -> Vec<f64> {
        let mut of_points = vec![0.0; self.subdomain.n_points()];
        for (&point, &value) in self.owned().iter().zip(values) {
            of_points[point as usize] = value;
        }
        Ghosts::all(self.subdomain).update(&mut of_points, 1);
        of_points
    }
}
