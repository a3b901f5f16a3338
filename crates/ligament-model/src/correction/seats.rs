//! The order in which sweeps of corrections go through the points: own ones along the curve, then those of other processes.

use std::borrow::Cow;

use crate::cloud::PointCloud;
use crate::portion::Portion;

/// The points in the order of sweeps; `rank` is the place of a point in it. In one process it is that of the curve.
pub(crate) struct Seats<'a> {
    /// The points, own ones first.
    points: Cow<'a, [u32]>,
    n_own: usize,
    portion: Option<&'a Portion>,
}

impl<'a> Seats<'a> {
    /// The order of the points of a cloud.
    pub(crate) fn new<const D: usize>(cloud: &'a PointCloud<D>) -> Self {
        let Some(portion) = &cloud.portion else {
            return Self {
                points: Cow::Borrowed(&cloud.curve),
                n_own: cloud.len(),
                portion: None,
            };
        };
        let others = cloud
            .curve
            .iter()
            .copied()
            .filter(|it| !portion.is_own(*it));
        Self {
            points: portion.own_along(&cloud.curve).chain(others).collect(),
            n_own: portion.own().len(),
            portion: Some(portion),
        }
    }

    /// All points, own ones first.
    pub(crate) fn all(&self) -> &[u32] {
        &self.points
    }

    /// The own points.
    pub(crate) fn own(&self) -> &[u32] {
        &self.points[..self.n_own]
    }

    /// Rank of each point, shape (n_points).
    pub(crate) fn ranks(&self) -> Vec<u32> {
        let mut ranks = vec![0; self.points.len()];
        for (rank, &point) in (0..).zip(&*self.points) {
            ranks[point as usize] = rank;
        }
        ranks
    }

    /// Puts the values of points of other processes, by rank, in the place of those here.
    pub(crate) fn complete<const N: usize>(&self, values: &mut [[f64; N]]) {
        let Some(portion) = self.portion else {
            return;
        };
        let mut of_points = vec![[0.0; N]; self.points.len()];
        for (&point, value) in self.own().iter().zip(&*values) {
            of_points[point as usize] = *value;
        }
        portion.complete(of_points.as_flattened_mut(), N);
        for (&point, value) in self.points.iter().zip(values) {
            *value = of_points[point as usize];
        }
    }

    /// Puts the sums over all processes in the place of some values.
    pub(crate) fn sum(&self, values: &mut [f64]) {
        if let Some(portion) = self.portion {
            portion.sum(values);
        }
    }

    /// The sum of a value over all processes.
    pub(crate) fn total(&self, value: f64) -> f64 {
        let mut sum = [value];
        self.sum(&mut sum);
        sum[0]
    }

    /// Whether this process is the first, or the only one.
    pub(crate) fn is_first(&self) -> bool {
        self.portion.is_none_or(|it| it.exchange().rank() == 0)
    }
}
