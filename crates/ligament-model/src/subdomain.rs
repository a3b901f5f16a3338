//! Points and bonds of a body on one process.
//!
//! Each point has one owner. The local points of a process are the points that it owns and points of other processes that it reads. It numbers
//! them from 0 in the order of their numbers in the body: sums over them are in the same order. It has the bonds that end at an owned point,
//! so that it computes every sum over the bonds of an owned point, in their order, by itself. The owner of the first end of a bond owns the
//! bond: counts and sums over bonds include each bond once. A single process owns everything.

use std::ops::Range;
use std::sync::Arc;

use crate::communicator::{Communicator, SingleProcess, Wire};

/// Assignment of the points of a body to ranks: parts of the body by recursive bisection.
#[derive(Debug, Clone)]
pub struct Partition {
    /// First position of each rank, and the number of points.
    starts: Vec<usize>,
    /// Points in the order of their ranks; empty for one rank.
    points: Vec<u32>,
}

impl Partition {
    /// The partition with all points on one rank.
    pub fn whole(n_points: usize) -> Self {
        Self {
            starts: vec![0, n_points],
            points: Vec::new(),
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
        Self { starts, points }
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

/// Local points of a process among several.
#[derive(Debug)]
struct LocalPoints {
    /// Number of each local point in the body, ascending, shape (n_points).
    numbers: Vec<u32>,
    /// Position of each local point in the order of the ranks, shape (n_points).
    places: Vec<u32>,
    /// Owned points, ascending.
    owned: Vec<u32>,
}

/// Points and bonds of a body on one process, and the communicator to the other processes. Copies share their data.
#[derive(Debug, Clone)]
pub struct Subdomain {
    /// First position of each rank in the order of the ranks, and the number of points of the body.
    starts: Arc<[usize]>,
    /// Positions of the owned points.
    owned: Range<usize>,
    /// Local points; `None` for one rank, which has all points in their order.
    local: Option<Arc<LocalPoints>>,
    communicator: Arc<dyn Communicator>,
}

impl Subdomain {
    /// The whole body on one process.
    pub fn whole(n_points: usize) -> Self {
        Self::new(Partition::whole(n_points), Arc::new(SingleProcess))
    }

    /// The subdomain of this process in a partition, with all points of the body.
    pub fn new(partition: Partition, communicator: Arc<dyn Communicator>) -> Self {
        let Partition { starts, points } = partition;
        let rank = communicator.rank();
        let owned = starts[rank]..starts[rank + 1];
        let local = (starts.len() > 2).then(|| {
            let mut places = vec![0; points.len()];
            for (place, &point) in (0..).zip(&points) {
                places[point as usize] = place;
            }
            Arc::new(LocalPoints {
                numbers: (0..points.len() as u32).collect(),
                places,
                owned: points[owned.clone()].to_vec(),
            })
        });
        Self {
            starts: starts.into(),
            owned,
            local,
            communicator,
        }
    }

    /// The subdomain with some of its points (ascending), among them all owned ones.
    pub fn part(&self, points: &[u32]) -> Self {
        let part = self.local.as_ref().map(|local| {
            let of_points = |all: &[u32]| points.iter().map(|&it| all[it as usize]).collect();
            let among = |owned: &u32| points.partition_point(|it| it < owned) as u32;
            Arc::new(LocalPoints {
                numbers: of_points(&local.numbers),
                places: of_points(&local.places),
                owned: local.owned.iter().map(among).collect(),
            })
        });
        Self {
            local: part,
            ..self.clone()
        }
    }

    /// Whether this process owns all points and bonds.
    #[inline]
    pub fn is_whole(&self) -> bool {
        self.local.is_none()
    }

    /// Processes between which the body is divided.
    pub fn communicator(&self) -> &dyn Communicator {
        &*self.communicator
    }

    /// Number of ranks.
    pub fn n_ranks(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of local points.
    pub fn n_points(&self) -> usize {
        let local = self.local.as_ref();
        local.map_or(self.n_all(), |it| it.numbers.len())
    }

    /// Number of points of the body.
    pub fn n_all(&self) -> usize {
        self.starts[self.n_ranks()]
    }

    /// Number of a local point in the body.
    #[inline]
    pub fn number(&self, point: u32) -> u32 {
        let local = self.local.as_ref();
        local.map_or(point, |it| it.numbers[point as usize])
    }

    /// Local point with a number in the body, if this process has it.
    pub fn point(&self, number: u32) -> Option<u32> {
        match &self.local {
            None => Some(number),
            Some(local) => {
                let place = local.numbers.binary_search(&number).ok();
                place.map(|place| place as u32)
            }
        }
    }

    /// Index in an array over the local points of the value with an index in one over the points of the body, both with some values per point;
    /// `None` for a point that this process does not have.
    pub fn local_index(&self, index: usize, n_values: usize) -> Option<usize> {
        let point = self.point((index / n_values) as u32)? as usize;
        Some(n_values * point + index % n_values)
    }

    /// Index in an array over the points of the body of the value with an index in one over the local points, both with some values per point.
    pub fn index_in_body(&self, index: usize, n_values: usize) -> usize {
        n_values * self.number((index / n_values) as u32) as usize + index % n_values
    }

    /// Numbers in the body of some points.
    pub fn numbers<const N: usize>(&self, points: [u32; N]) -> [u32; N] {
        points.map(|point| self.number(point))
    }

    /// Position of a point in the order of the ranks.
    #[inline]
    pub fn place(&self, point: u32) -> usize {
        let local = self.local.as_ref();
        local.map_or(point, |it| it.places[point as usize]) as usize
    }

    /// Position of the first point of a rank; for the rank after the last one, the number of points.
    pub fn first(&self, rank: usize) -> usize {
        self.starts[rank]
    }

    /// Rank that owns a point.
    pub fn rank(&self, point: u32) -> usize {
        let place = self.place(point);
        self.starts.partition_point(|&start| start <= place) - 1
    }

    /// Number of values of each rank, for a number of values per point.
    pub fn counts(&self, n_values: usize) -> Vec<usize> {
        let ends = self.starts.windows(2);
        ends.map(|it| n_values * (it[1] - it[0])).collect()
    }

    /// Number of owned points.
    pub fn n_owned(&self) -> usize {
        self.owned.len()
    }

    /// Owned point by its index among the owned ones.
    #[inline]
    pub fn owned_at(&self, index: usize) -> u32 {
        let local = self.local.as_ref();
        local.map_or(index as u32, |it| it.owned[index])
    }

    /// Owned points, ascending.
    pub fn owned(&self) -> impl ExactSizeIterator<Item = u32> + Clone + '_ {
        (0..self.n_owned()).map(|index| self.owned_at(index))
    }

    /// Index of a point among the owned ones; `None` for points of other processes.
    #[inline]
    pub fn row(&self, point: u32) -> Option<usize> {
        let place = self.place(point);
        let is_owned = self.owned.contains(&place);
        is_owned.then(|| place - self.owned.start)
    }

    /// Whether this process owns a point.
    #[inline]
    pub fn owns(&self, point: u32) -> bool {
        self.owned.contains(&self.place(point))
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

    /// Values of the owned points in an array over the local points, shape (n_points, M).
    pub fn from_owned<const M: usize>(&self, of_owned: Vec<[f64; M]>) -> Vec<f64> {
        if self.is_whole() {
            return of_owned.into_flattened();
        }
        let mut all = vec![self.communicator.poison(); M * self.n_points()];
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
    pub fn count(&self, local: usize) -> usize {
        self.sum(local as f64) as usize
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
    pub fn any(&self, local: bool) -> bool {
        self.communicator.any(local)
    }

    /// Smallest row over all processes, compared from its first number on; a process may have none.
    pub fn all_reduce_min<const N: usize>(&self, own: Option<[f64; N]>) -> Option<[f64; N]> {
        let all = self.all_gather_list(own.into_iter().collect()).into_iter();
        all.reduce(|one, other| if other < one { other } else { one })
    }

    /// Sends values to ranks; returns the received ones in the order of the ranks that sent them.
    pub fn send<T: Wire<N>, const N: usize>(&self, mut own: Vec<(usize, T)>) -> Vec<T> {
        own.sort_by_key(|(rank, _)| *rank);
        let communicator = self.communicator();
        let before = |rank: usize| own.partition_point(|it| it.0 < rank);
        let ranks = 0..self.n_ranks();
        let to = ranks.map(|rank| N * (before(rank + 1) - before(rank)));
        let to: Vec<usize> = to.collect();
        let one = vec![1; to.len()];
        let counts: Vec<f64> = to.iter().map(|&count| count as f64).collect();
        let from = communicator.all_to_all(&counts, &one, &one).into_iter();
        let from: Vec<usize> = from.map(|count| count as usize).collect();
        let own: Vec<f64> = own.iter().flat_map(|(_, value)| value.numbers()).collect();
        let received = communicator.all_to_all(&own, &to, &from);
        let received = received.as_chunks().0.iter();
        received.map(|numbers| T::from_numbers(*numbers)).collect()
    }

    /// Concatenates the lists of all processes on rank 0, in the order of their ranks; other ranks receive an empty list.
    pub fn gather_list<T: Wire<N>, const N: usize>(&self, own: Vec<T>) -> Vec<T> {
        self.send(own.into_iter().map(|value| (0, value)).collect())
    }

    /// Concatenates the lists of all processes in the order of their ranks.
    pub fn all_gather_list<T: Wire<N>, const N: usize>(&self, own: Vec<T>) -> Vec<T> {
        self.communicator.all_gather_list(own)
    }
}

/// Forces and bonds that this process sums: a type parameter, so that a loop over bonds checks once whether the body is divided.
pub(crate) trait Share: Copy + Sync {
    /// Index of a point among the owned ones; `None` for points of other processes.
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
        Subdomain::row(self, point)
    }

    fn rows_before(self, point: u32) -> usize {
        match &self.local {
            None => point as usize,
            Some(local) => local.owned.partition_point(|it| *it < point),
        }
    }

    #[inline]
    fn owns_bond(self, ends: [u32; 2]) -> bool {
        Subdomain::owns_bond(self, ends)
    }
}
