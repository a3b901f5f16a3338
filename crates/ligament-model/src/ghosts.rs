//! Points of other processes that a process sees, and what it tells these of its own.

use crate::portion::{Exchange, Portion};

/// The points of others that each of several processes sees. Values at them come from the processes that have them, and go to no other.
#[derive(Debug, Clone)]
pub struct Ghosts {
    exchange: &'static dyn Exchange,
    /// Own points that others see, in the order of these ranks, and their number for each rank.
    told: (Vec<u32>, Vec<usize>),
    /// Points of others that are seen here, in the order of their ranks, and their number for each rank.
    seen: (Vec<u32>, Vec<usize>),
}

impl Ghosts {
    /// The points of others among those that a process sees; all processes call this.
    pub fn new(portion: &Portion, seen: impl Iterator<Item = u32>) -> Self {
        let (exchange, partition) = (portion.exchange(), portion.partition());
        let mut seen: Vec<u32> = seen.filter(|&it| !portion.is_own(it)).collect();
        seen.sort_unstable_by_key(|&point| partition.place(point));
        seen.dedup();
        let ranks = 0..exchange.n_ranks();
        let of_rank =
            |rank| seen.partition_point(|&it| partition.place(it) < partition.first(rank));
        let from: Vec<usize> = ranks
            .map(|rank| of_rank(rank + 1) - of_rank(rank))
            .collect();
        let numbers = |values: &[u32]| values.iter().map(|&it| f64::from(it)).collect::<Vec<_>>();
        let one = vec![1; from.len()];
        let counts: Vec<f64> = from.iter().map(|&count| count as f64).collect();
        let to = exchange.swap(&counts, &one, &one).into_iter();
        let to: Vec<usize> = to.map(|count| count as usize).collect();
        let told = exchange.swap(&numbers(&seen), &from, &to).into_iter();
        Self {
            exchange,
            told: (told.map(|point| point as u32).collect(), to),
            seen: (seen, from),
        }
    }

    /// The points of others that are seen here.
    pub fn seen(&self) -> &[u32] {
        &self.seen.0
    }

    /// Points by other numbers.
    pub fn renumbered(mut self, number: impl Fn(u32) -> u32) -> Self {
        let points = self.told.0.iter_mut().chain(&mut self.seen.0);
        points.for_each(|point| *point = number(*point));
        self
    }

    /// Takes the values of the points that are seen from those who have them; so many values a point, shape (n_points, n_values).
    pub fn tell(&self, values: &mut [f64], n_values: usize) {
        let rows = |point: u32| n_values * point as usize..n_values * (point as usize + 1);
        let times = |counts: &[usize]| counts.iter().map(|it| n_values * it).collect::<Vec<_>>();
        let (told, to) = &self.told;
        let own: Vec<f64> = (told.iter())
            .flat_map(|&point| values[rows(point)].iter().copied())
            .collect();
        let (seen, from) = &self.seen;
        let of_others = self.exchange.swap(&own, &times(to), &times(from));
        for (&point, of_other) in seen.iter().zip(of_others.chunks_exact(n_values)) {
            values[rows(point)].copy_from_slice(of_other);
        }
    }
}
