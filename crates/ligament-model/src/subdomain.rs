//! Points and bonds of a body on one process.
//!
//! Each process knows all points and owns some of them; each point has one owner. A process has the bonds that end at an owned point, so
//! that it computes every sum over the bonds of an owned point, in their order, by itself. The owner of the first end of a bond owns the
//! bond: counts and sums over bonds include each bond once. A single process owns everything.

use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

use crate::communicator::{Communicator, Solo, Wire};

/// Assignment of the points to ranks: parts of the body by recursive bisection.
#[derive(Debug, Clone)]
pub struct Partition {
    /// First position of each rank, and the number of points.
    starts: Vec<usize>,
    /// Points in the order of their ranks, and the position of each point in that order; `None` for one rank, whose order is that of the
    /// points.
    order: Option<[Vec<u32>; 2]>,
}

impl Partition {
    /// The partition with all points on one rank.
    pub fn whole(n_points: usize) -> Self {
        Self {
            starts: vec![0, n_points],
            order: None,
        }
    }

    /// Divides the points into equal parts: cuts them at the median of the longest side, with a function that halves some points, until
    /// every border between ranks is a cut; the number of ranks need not be a power of two.
    pub fn new(n_points: usize, n_ranks: usize, halve: &dyn Fn(&mut [u32])) -> Self {
        if n_ranks == 1 {
            return Self::whole(n_points);
        }
        let starts: Vec<usize> = (0..=n_ranks)
            .map(|rank| rank * n_points / n_ranks)
            .collect();
        let mut points: Vec<u32> = (0..n_points as u32).collect();
        bisect(halve, &mut points, 0, &starts);
        for ends in starts.windows(2) {
            points[ends[0]..ends[1]].sort_unstable();
        }
        let mut places = vec![0; n_points];
        for (place, &point) in points.iter().enumerate() {
            places[point as usize] = place as u32;
        }
        Self {
            starts,
            order: Some([points, places]),
        }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.first(self.n_ranks())
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of ranks.
    pub fn n_ranks(&self) -> usize {
        self.starts.len() - 1
    }

    /// The points of a rank, ascending.
    pub fn points(&self, rank: usize) -> impl ExactSizeIterator<Item = u32> + Clone + '_ {
        self.places(rank).map(|place| self.point(place))
    }

    /// Positions of the points of a rank.
    pub fn places(&self, rank: usize) -> Range<usize> {
        self.starts[rank]..self.starts[rank + 1]
    }

    /// Position of the first point of a rank; for the rank after the last one, the number of points.
    pub fn first(&self, rank: usize) -> usize {
        self.starts[rank]
    }

    /// Position of a point in the order of the ranks.
    #[inline]
    pub fn place(&self, point: u32) -> usize {
        let order = self.order.as_ref();
        order.map_or(point, |[_, places]| places[point as usize]) as usize
    }

    /// Point at a position in the order of the ranks.
    fn point(&self, place: usize) -> u32 {
        let order = self.order.as_ref();
        order.map_or(place as u32, |[points, _]| points[place])
    }

    /// Rank that owns a point.
    pub fn rank(&self, point: u32) -> usize {
        self.starts
            .partition_point(|&start| start <= self.place(point))
            - 1
    }

    /// Number of values of each rank, for a number of values per point.
    pub fn counts(&self, n_values: usize) -> Vec<usize> {
        let ends = self.starts.windows(2);
        ends.map(|it| n_values * (it[1] - it[0])).collect()
    }
}

/// Orders points, the first of which has position `first` among all, so that the points of each rank are adjacent.
fn bisect(halve: &dyn Fn(&mut [u32]), points: &mut [u32], first: usize, starts: &[usize]) {
    let inside = first + 1..first + points.len();
    if points.len() < 2 || !starts.iter().any(|start| inside.contains(start)) {
        return;
    }
    halve(points);
    let middle = points.len() / 2;
    let (lower, upper) = points.split_at_mut(middle);
    bisect(halve, lower, first, starts);
    bisect(halve, upper, first + middle, starts);
}

/// Points and bonds of a body on one process, and the communicator to the other processes. Copies share their data.
#[derive(Debug, Clone)]
pub struct Subdomain {
    partition: Arc<Partition>,
    /// Positions of the owned points.
    owned: Range<usize>,
    communicator: Arc<dyn Communicator>,
}

impl Subdomain {
    /// The whole body on one process.
    pub fn whole(n_points: usize) -> Self {
        Self::new(Partition::whole(n_points), Arc::new(Solo))
    }

    /// The subdomain of this process in a partition.
    pub fn new(partition: Partition, communicator: Arc<dyn Communicator>) -> Self {
        Self {
            owned: partition.places(communicator.rank()),
            partition: Arc::new(partition),
            communicator,
        }
    }

    /// Whether this process owns all points and bonds.
    #[inline]
    pub fn is_whole(&self) -> bool {
        self.partition.n_ranks() == 1
    }

    /// Assignment of the points to ranks.
    pub fn partition(&self) -> &Arc<Partition> {
        &self.partition
    }

    /// Processes between which the body is divided.
    pub fn communicator(&self) -> &dyn Communicator {
        &*self.communicator
    }

    /// Owned points, ascending.
    pub fn owned(&self) -> impl ExactSizeIterator<Item = u32> + Clone + '_ {
        self.owned.clone().map(|place| self.partition.point(place))
    }

    /// Whether this process owns a point.
    #[inline]
    pub fn owns(&self, point: u32) -> bool {
        self.owned.contains(&self.partition.place(point))
    }

    /// Whether this process has a bond with given ends, because it owns one of them.
    pub fn contains_bond(&self, ends: [u32; 2]) -> bool {
        ends.iter().any(|&end| self.owns(end))
    }

    /// Whether this process owns a bond with ends A < B.
    #[inline]
    pub fn owns_bond(&self, [first, _]: [u32; 2]) -> bool {
        self.owns(first)
    }

    /// Replaces the values at every point by those of its owner, shape (n_points, n_values). The whole body is sent to every process;
    /// [`Ghosts`](crate::ghosts::Ghosts) exchange only values near cuts.
    pub fn all_gather_points(&self, values: &mut [f64], n_values: usize) {
        if self.is_whole() {
            return;
        }
        let rows = |point: u32| n_values * point as usize..n_values * (point as usize + 1);
        let owned = self.owned();
        let owned: Vec<f64> = owned
            .flat_map(|point| values[rows(point)].iter().copied())
            .collect();
        let counts = self.partition.counts(n_values);
        let all = self.communicator.all_gather(&owned, &counts);
        let points = (0..self.partition.len()).map(|place| self.partition.point(place));
        for (point, received) in points.zip(all.chunks_exact(n_values)) {
            values[rows(point)].copy_from_slice(received);
        }
    }

    /// Values at all points from those at owned points, shape (n_points, n_values) both.
    pub fn gathered<'a>(&self, values: &'a [f64]) -> Cow<'a, [f64]> {
        if self.is_whole() {
            return Cow::Borrowed(values);
        }
        let mut all = values.to_vec();
        self.all_gather_points(&mut all, values.len() / self.partition.len());
        Cow::Owned(all)
    }

    /// Values of the owned points in an array over all points, shape (n_points, M).
    pub fn from_owned<const M: usize>(&self, of_owned: Vec<[f64; M]>) -> Vec<f64> {
        if self.is_whole() {
            return of_owned.into_flattened();
        }
        let mut all = vec![self.communicator.poison(); M * self.partition.len()];
        for (point, values) in self.owned().zip(&of_owned) {
            all[M * point as usize..][..M].copy_from_slice(values);
        }
        all
    }

    /// Replaces each value by its sum over all processes, in the order of their ranks.
    pub fn all_reduce_sum(&self, values: &mut [f64]) {
        self.communicator.all_reduce_sum(values);
    }

    /// Sum of a value over all processes.
    pub fn sum(&self, value: f64) -> f64 {
        let mut sum = [value];
        self.all_reduce_sum(&mut sum);
        sum[0]
    }

    /// Sum of a count over all processes.
    pub fn count(&self, here: usize) -> usize {
        self.sum(here as f64) as usize
    }

    /// Replaces each value by its largest over all processes.
    pub fn all_reduce_max(&self, values: &mut [f64]) {
        self.communicator.all_reduce_max(values);
    }

    /// Largest of a value over all processes.
    pub fn max(&self, value: f64) -> f64 {
        let mut largest = [value];
        self.all_reduce_max(&mut largest);
        largest[0]
    }

    /// Whether a condition holds on some process.
    pub fn any(&self, here: bool) -> bool {
        self.communicator.any(here)
    }

    /// Smallest row over all processes, compared from its first number on; a process may have none.
    pub fn all_reduce_min<const N: usize>(&self, own: Option<[f64; N]>) -> Option<[f64; N]> {
        let all = self.all_gather_list(own.into_iter().collect()).into_iter();
        all.reduce(|one, other| if other < one { other } else { one })
    }

    /// Concatenates the lists of all processes in the order of their ranks.
    pub fn all_gather_list<T: Wire<N>, const N: usize>(&self, own: Vec<T>) -> Vec<T> {
        self.communicator.all_gather_list(own)
    }
}

/// Forces and bonds that this process sums: a type parameter, so that a loop over bonds checks once whether the body is divided.
pub(crate) trait Share: Copy + Sync {
    /// Position of a point in an array over the owned points; `None` for points of other processes.
    fn row(self, point: u32) -> Option<usize>;

    /// Number of owned points before a point.
    fn rows_before(self, point: u32) -> usize;

    /// Whether this process owns a bond with given ends.
    fn owns_bond(self, ends: [u32; 2]) -> bool;
}

/// The share of a single process, which owns everything.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Whole;

impl Share for Whole {
    #[inline(always)]
    fn row(self, point: u32) -> Option<usize> {
        Some(point as usize)
    }

    fn rows_before(self, point: u32) -> usize {
        point as usize
    }

    #[inline(always)]
    fn owns_bond(self, _: [u32; 2]) -> bool {
        true
    }
}

impl Share for &Subdomain {
    #[inline]
    fn row(self, point: u32) -> Option<usize> {
        let place = self.partition.place(point);
        let is_owned = self.owned.contains(&place);
        is_owned.then(|| place - self.owned.start)
    }

    fn rows_before(self, point: u32) -> usize {
        match &self.partition.order {
            None => point as usize,
            Some([points, _]) => points[self.owned.clone()].partition_point(|it| *it < point),
        }
    }

    #[inline]
    fn owns_bond(self, ends: [u32; 2]) -> bool {
        Subdomain::owns_bond(self, ends)
    }
}
