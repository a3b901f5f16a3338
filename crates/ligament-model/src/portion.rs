//! The part that one of several processes has in a body: its own points, and the bonds that end at one of them.
//!
//! All processes know all points. A bond is known where one of its ends is an own point, so that a process can make every sum over the
//! bonds of its own points, in their order, and tells it to the others: a value at a point is that of one process, to the bit. What is
//! counted or added up over bonds is so by the process that has the first end of the bond.

use std::fmt::Debug;
use std::sync::Arc;

/// Numbers of all ranks together that are added up at a time.
const PIECE: usize = 1 << 18;

/// How processes tell each other numbers. Every function but [`rank`](Self::rank) and [`n_ranks`](Self::n_ranks) is called by all of
/// them in the same order, by one thread of each; what comes back is the same to the bit on all of them. What fails on one ends all.
pub trait Exchange: Debug + Send + Sync {
    /// Number of this process, from 0 on.
    fn rank(&self) -> usize;

    /// Number of the processes.
    fn n_ranks(&self) -> usize;

    /// Puts the largest of each value over all ranks in its place.
    fn largest(&self, values: &mut [f64]);

    /// The values of all ranks, so many as `counts` says of each, those of rank 0 first.
    fn gather(&self, own: &[f64], counts: &[usize]) -> Vec<f64>;

    /// Tells each rank values of its own, so many as `to` says, those for rank 0 first; gives what all of them tell this one, so many as
    /// `from` says of each. Ranks without values are not spoken to.
    fn swap(&self, own: &[f64], to: &[usize], from: &[usize]) -> Vec<f64>;

    /// Puts the bytes of rank 0 in the place of those of the others.
    fn broadcast(&self, bytes: &mut Vec<u8>);

    /// What stands at points that a rank knows nothing of: in tests something that is no number, so that it is not read unseen.
    fn stranger(&self) -> f64 {
        0.0
    }
}

/// The points of each rank: parts of the body by recursive bisection.
#[derive(Debug, Clone)]
pub struct Partition {
    /// Points in the order of their ranks, ascending within each.
    points: Vec<u32>,
    /// First point of each rank in that order, and the number of all.
    starts: Vec<usize>,
    /// Place of each point in that order.
    places: Vec<u32>,
}

impl Partition {
    /// Shares the points out evenly: cuts them at the median of the longest side, by a function that halves some points, until every border
    /// between ranks is a cut, so that the number of ranks need not be a power of two.
    pub fn new(n_points: usize, n_ranks: usize, halve: &dyn Fn(&mut [u32])) -> Self {
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
            points,
            starts,
            places,
        }
    }

    /// Number of all points.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// The points of a rank, ascending.
    pub fn points(&self, rank: usize) -> &[u32] {
        &self.points[self.starts[rank]..self.starts[rank + 1]]
    }

    /// Number over all ranks of the first point of a rank; of the one after the last the number of all.
    pub fn first(&self, rank: usize) -> usize {
        self.starts[rank]
    }

    /// Number of a point over all ranks.
    pub fn place(&self, point: u32) -> usize {
        self.places[point as usize] as usize
    }

    /// The rank that has a point.
    pub fn rank(&self, point: u32) -> usize {
        self.starts
            .partition_point(|&start| start <= self.place(point))
            - 1
    }

    /// Whether a rank has a point.
    pub fn has(&self, rank: usize, point: u32) -> bool {
        (self.starts[rank]..self.starts[rank + 1]).contains(&self.place(point))
    }

    /// Number of the points of each rank, times a number.
    pub fn counts(&self, times: usize) -> Vec<usize> {
        let ends = self.starts.windows(2);
        ends.map(|it| times * (it[1] - it[0])).collect()
    }
}

/// Orders points, of which the first stands at a place among all, so that those of each rank stand together.
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

/// The part of one of several processes in a body. A copy is of the same part.
#[derive(Debug, Clone)]
pub struct Portion {
    partition: Arc<Partition>,
    exchange: &'static dyn Exchange,
}

impl Portion {
    /// The part of this process among points that are shared out.
    pub fn new(partition: Partition, exchange: &'static dyn Exchange) -> Self {
        Self {
            partition: Arc::new(partition),
            exchange,
        }
    }

    /// The points of each rank.
    pub fn partition(&self) -> &Arc<Partition> {
        &self.partition
    }

    /// How the processes tell each other numbers.
    pub fn exchange(&self) -> &'static dyn Exchange {
        self.exchange
    }

    /// The own points, ascending.
    pub fn own(&self) -> &[u32] {
        self.partition.points(self.exchange.rank())
    }

    /// The own points in the order in which some points come.
    pub fn own_along<'a>(&'a self, points: &'a [u32]) -> impl Iterator<Item = u32> + 'a {
        points.iter().copied().filter(|&point| self.is_own(point))
    }

    /// Whether a point is an own one.
    pub fn is_own(&self, point: u32) -> bool {
        self.partition.has(self.exchange.rank(), point)
    }

    /// Place of a point among the own ones.
    #[inline]
    pub fn own_place(&self, point: u32) -> Option<usize> {
        let rank = self.exchange.rank();
        let place = self.partition.place(point);
        let starts = &self.partition.starts;
        (starts[rank]..starts[rank + 1])
            .contains(&place)
            .then(|| place - starts[rank])
    }

    /// Whether a bond, of which the ends are given, is known here.
    pub fn knows(&self, ends: [u32; 2]) -> bool {
        ends.iter().any(|&end| self.is_own(end))
    }

    /// Whether a bond, of which the ends A < B are given, is counted here.
    pub fn counts(&self, [first, _]: [u32; 2]) -> bool {
        self.is_own(first)
    }

    /// Puts the values of every point that its own process has in the place of those here; so many values a point, shape
    /// (n_points, n_values). That sends the whole body to every process: [`Ghosts`](crate::ghosts::Ghosts) tell what is needed near cuts.
    pub fn complete(&self, values: &mut [f64], n_values: usize) {
        let rows = |point: u32| n_values * point as usize..n_values * (point as usize + 1);
        let own = self.own().iter();
        let own: Vec<f64> = own
            .flat_map(|&point| values[rows(point)].iter().copied())
            .collect();
        let all = self.exchange.gather(&own, &self.partition.counts(n_values));
        for (&point, told) in self.partition.points.iter().zip(all.chunks_exact(n_values)) {
            values[rows(point)].copy_from_slice(told);
        }
    }

    /// Values of own points among those of all points, shape (n_points, M).
    pub fn spread<const M: usize>(&self, of_own: &[[f64; M]]) -> Vec<f64> {
        let mut all = vec![self.exchange.stranger(); M * self.partition.points.len()];
        for (&point, values) in self.own().iter().zip(of_own) {
            all[M * point as usize..][..M].copy_from_slice(values);
        }
        all
    }

    /// Puts the sums over all ranks, added up in their order, in the place of some values.
    pub fn sum(&self, values: &mut [f64]) {
        // A piece at a time: those of all ranks take no more memory than this.
        for piece in values.chunks_mut((PIECE / self.exchange.n_ranks()).max(1)) {
            let counts = vec![piece.len(); self.exchange.n_ranks()];
            let all = self.exchange.gather(piece, &counts);
            piece.fill(0.0);
            for of_rank in all.chunks_exact(piece.len()) {
                for (sum, value) in piece.iter_mut().zip(of_rank) {
                    *sum += value;
                }
            }
        }
    }

    /// The sum of a value over all ranks.
    pub fn total(&self, value: f64) -> f64 {
        let mut sum = [value];
        self.sum(&mut sum);
        sum[0]
    }

    /// Puts the largest of each value over all ranks in its place.
    pub fn largest(&self, values: &mut [f64]) {
        self.exchange.largest(values);
    }

    /// Whether something is so on some rank.
    pub fn any(&self, here: bool) -> bool {
        let mut some = [f64::from(u8::from(here))];
        self.largest(&mut some);
        some[0] > 0.0
    }

    /// Of what each rank may have found the one with the smallest numbers, from the first on; each is some numbers.
    pub fn least<const N: usize>(&self, own: Option<[f64; N]>) -> Option<[f64; N]> {
        let all = self.concatenated(own.as_slice()).into_iter();
        all.reduce(|one, other| if other < one { other } else { one })
    }

    /// Lists of all ranks, one after the other, from rank 0 on; each entry is some numbers.
    pub fn concatenated<const N: usize>(&self, own: &[[f64; N]]) -> Vec<[f64; N]> {
        concatenated(self.exchange, own)
    }
}

/// Whether something is so here or, where a body is shared out, on some rank.
pub fn any(portion: Option<&Portion>, here: bool) -> bool {
    portion.map_or(here, |it| it.any(here))
}

/// The largest of a value over all processes.
pub fn largest(portion: Option<&Portion>, here: f64) -> f64 {
    let mut largest = [here];
    if let Some(portion) = portion {
        portion.largest(&mut largest);
    }
    largest[0]
}

/// Whether a bond, of which the ends are given, is counted here: every one where a body is not shared out.
#[inline]
pub fn counts(portion: Option<&Portion>, ends: [u32; 2]) -> bool {
    portion.is_none_or(|it| it.counts(ends))
}

/// What is added up of the bonds that a process knows: a type, so that a loop over bonds asks once whether the body is shared out.
pub(crate) trait Share: Copy {
    /// Place of a point in an array over the points whose forces are added up here.
    fn row(self, point: u32) -> Option<usize>;

    /// Whether a bond, of which the ends are given, is counted here.
    fn counts(self, ends: [u32; 2]) -> bool;
}

/// The share of the only process.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Whole;

impl Share for Whole {
    #[inline(always)]
    fn row(self, point: u32) -> Option<usize> {
        Some(point as usize)
    }

    #[inline(always)]
    fn counts(self, _: [u32; 2]) -> bool {
        true
    }
}

impl Share for &Portion {
    #[inline]
    fn row(self, point: u32) -> Option<usize> {
        self.own_place(point)
    }

    #[inline]
    fn counts(self, ends: [u32; 2]) -> bool {
        Portion::counts(self, ends)
    }
}

/// Lists of all ranks, one after the other, from rank 0 on; each entry is some numbers.
pub fn concatenated<const N: usize>(
    exchange: &(impl Exchange + ?Sized),
    own: &[[f64; N]],
) -> Vec<[f64; N]> {
    let mut counts = vec![0.0; exchange.n_ranks()];
    counts[exchange.rank()] = own.len() as f64;
    exchange.largest(&mut counts);
    let counts: Vec<usize> = counts.iter().map(|&it| N * it as usize).collect();
    let all = exchange.gather(own.as_flattened(), &counts);
    all.as_chunks().0.to_vec()
}
