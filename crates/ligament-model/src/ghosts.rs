//! Ghosts: copies of the points of other processes that a process reads.

use std::ops::Range;

use crate::subdomain::Subdomain;

/// Ghosts of a process. Only the owner of a point sends its values, and only to processes that read the point.
#[derive(Debug, Clone)]
pub struct Ghosts {
    subdomain: Subdomain,
    /// Owned points that other processes read, in the order of the ranks of these, and their number for each rank.
    sent: (Vec<u32>, Vec<usize>),
    /// Ghosts in the order of the ranks of their owners, and their number for each rank.
    received: (Vec<u32>, Vec<usize>),
}

impl Ghosts {
    /// The ghosts among the points that a process reads; collective.
    pub fn new(subdomain: &Subdomain, read: impl Iterator<Item = u32>) -> Self {
        let mut ghosts: Vec<u32> = match subdomain.is_whole() {
            true => Vec::new(),
            false => read.filter(|&it| !subdomain.owns(it)).collect(),
        };
        ghosts.sort_unstable_by_key(|&point| subdomain.place(point));
        ghosts.dedup();
        let before =
            |rank| ghosts.partition_point(|&it| subdomain.place(it) < subdomain.first(rank));
        let ranks = 0..subdomain.n_ranks();
        let from: Vec<usize> = ranks.map(|rank| before(rank + 1) - before(rank)).collect();
        let exchange = |values: &[f64], to: &[usize], from: &[usize]| {
            subdomain.communicator().all_to_all(values, to, from)
        };
        let one = vec![1; from.len()];
        let counts: Vec<f64> = from.iter().map(|&count| count as f64).collect();
        let to = exchange(&counts, &one, &one).into_iter();
        let to: Vec<usize> = to.map(|count| count as usize).collect();
        // Processes number points differently; all know the index of a point among those of its owner.
        let index = |&it: &u32| (subdomain.place(it) - subdomain.first(subdomain.rank(it))) as f64;
        let indices: Vec<f64> = ghosts.iter().map(index).collect();
        let sent = exchange(&indices, &from, &to).into_iter();
        Self {
            subdomain: subdomain.clone(),
            sent: (
                sent.map(|index| subdomain.owned_at(index as usize))
                    .collect(),
                to,
            ),
            received: (ghosts, from),
        }
    }

    /// All local points of other processes; collective.
    pub fn all(subdomain: &Subdomain) -> Self {
        Self::new(subdomain, 0..subdomain.n_points() as u32)
    }

    /// Points that are ghosts, in the order of the ranks of their owners.
    pub fn points(&self) -> &[u32] {
        &self.received.0
    }

    /// The ghosts with points renumbered by a function.
    pub fn renumbered(mut self, number: impl Fn(u32) -> u32) -> Self {
        let points = self.sent.0.iter_mut().chain(&mut self.received.0);
        points.for_each(|point| *point = number(*point));
        self
    }

    /// Replaces the values at the ghosts by the values of their owners, shape (n_points, n_values); collective.
    pub fn update(&self, values: &mut [f64], n_values: usize) {
        let of_owners = self.exchanged(values, n_values, &self.sent, &self.received.1);
        let ghosts = self.received.0.iter();
        for (&ghost, of_owner) in ghosts.zip(of_owners.chunks_exact(n_values)) {
            values[row(ghost, n_values)].copy_from_slice(of_owner);
        }
    }

    /// Adds the values at the ghosts to the values at their owners, shape (n_points, n_values); collective.
    pub fn add_to_owners(&self, values: &mut [f64], n_values: usize) {
        let of_ghosts = self.exchanged(values, n_values, &self.received, &self.sent.1);
        let owned = self.sent.0.iter();
        for (&owned, of_ghost) in owned.zip(of_ghosts.chunks_exact(n_values)) {
            let of_owned = values[row(owned, n_values)].iter_mut();
            of_owned.zip(of_ghost).for_each(|(sum, term)| *sum += term);
        }
    }

    /// Values that other processes send in their order, `from` of each, for the values of some points that are sent to them.
    fn exchanged(
        &self,
        values: &[f64],
        n_values: usize,
        (sent, to): &(Vec<u32>, Vec<usize>),
        from: &[usize],
    ) -> Vec<f64> {
        if self.subdomain.is_whole() {
            return Vec::new();
        }
        let times = |counts: &[usize]| counts.iter().map(|it| n_values * it).collect::<Vec<_>>();
        let rows = sent.iter().map(|&point| &values[row(point, n_values)]);
        let sent: Vec<f64> = rows.flatten().copied().collect();
        let communicator = self.subdomain.communicator();
        communicator.all_to_all(&sent, &times(to), &times(from))
    }
}

/// Range of the values of a point, with `n_values` for each.
fn row(point: u32, n_values: usize) -> Range<usize> {
    n_values * point as usize..n_values * (point as usize + 1)
}
