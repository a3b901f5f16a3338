//! The order in which sweeps of corrections go through the points: own ones along the curve, then those of other processes that are bonded to
//! them. What a sweep gives to points near the parts of others is told to these, and nothing else is.

use std::borrow::Cow;

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::ghosts::Ghosts;
use crate::portion::Portion;

/// Rank of a point that is neither an own one nor bonded to one.
const NONE: u32 = u32::MAX;

/// The points in the order of sweeps; `rank` is the place of a point in it. In one process it is that of the curve.
pub(crate) struct Seats<'a> {
    /// The points, own ones first.
    points: Cow<'a, [u32]>,
    n_own: usize,
    portion: Option<&'a Portion>,
    /// Points of other processes, by rank.
    ghosts: Option<Ghosts>,
}

impl<'a> Seats<'a> {
    /// The order of the points of a cloud with some bonds.
    pub(crate) fn new<const D: usize>(bonds: &BondSet<D>, cloud: &'a PointCloud<D>) -> Self {
        let mut seats = Self {
            points: Cow::Borrowed(&cloud.curve),
            n_own: cloud.len(),
            portion: cloud.portion.as_ref(),
            ghosts: None,
        };
        if let Some(portion) = seats.portion {
            let mut is_seen = vec![false; cloud.len()];
            let seen = bonds.ends.iter().flatten().copied();
            let seen = seen.filter(|&end| !portion.is_own(end));
            seen.for_each(|end| is_seen[end as usize] = true);
            let others = cloud.curve.iter().copied();
            let others = others.filter(|&it| is_seen[it as usize]);
            seats.points = portion.own_along(&cloud.curve).chain(others).collect();
            seats.n_own = portion.own().len();
            let ranks = seats.ranks(cloud.len());
            let ghosts = Ghosts::new(portion, seats.points.iter().copied());
            seats.ghosts = Some(ghosts.renumbered(|point| ranks[point as usize]));
        }
        seats
    }

    /// The points by rank, own ones first.
    pub(crate) fn all(&self) -> &[u32] {
        &self.points
    }

    /// The own points.
    pub(crate) fn own(&self) -> &[u32] {
        &self.points[..self.n_own]
    }

    /// Rank of each of so many points.
    pub(crate) fn ranks(&self, n_points: usize) -> Vec<u32> {
        let mut ranks = vec![NONE; n_points];
        for (rank, &point) in (0..).zip(&*self.points) {
            ranks[point as usize] = rank;
        }
        ranks
    }

    /// Puts the values of points of other processes, by rank, in the place of those here.
    pub(crate) fn complete<const N: usize>(&self, values: &mut [[f64; N]]) {
        self.complete_rows(values.as_flattened_mut(), N);
    }

    /// Puts the values of points of other processes, by rank and so many a point, in the place of those here.
    pub(crate) fn complete_rows(&self, values: &mut [f64], n_values: usize) {
        if let Some(ghosts) = &self.ghosts {
            ghosts.tell(values, n_values);
        }
    }

    /// The value of each of so many points from those of own points, by rank.
    pub(crate) fn of_points(&self, values: &[f64], n_points: usize) -> Vec<f64> {
        let mut of_points = vec![0.0; n_points];
        for (&point, &value) in self.own().iter().zip(values) {
            of_points[point as usize] = value;
        }
        if let Some(portion) = self.portion {
            portion.complete(&mut of_points, 1);
        }
        of_points
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
