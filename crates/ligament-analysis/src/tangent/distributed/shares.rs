//! The points of each rank: parts of the body by recursive bisection.

use ligament_model::Bonds;

/// The points of each rank, and the numbers of the points over all ranks.
#[derive(Debug)]
pub(super) struct Shares {
    /// Points in the order of their ranks, ascending within each.
    points: Vec<u32>,
    /// First point of each rank in that order, and the number of all.
    starts: Vec<usize>,
    /// Place of each point in that order.
    places: Vec<u32>,
}

impl Shares {
    /// Shares the points out evenly: cuts them at the median of the longest side until every border between ranks is a cut, so that the
    /// number of ranks need not be a power of two.
    pub(super) fn new(system: &dyn Bonds, n_ranks: usize) -> Self {
        let n_points = system.n_points();
        let starts: Vec<usize> = (0..=n_ranks)
            .map(|rank| rank * n_points / n_ranks)
            .collect();
        let mut points: Vec<u32> = (0..n_points as u32).collect();
        bisect(system, &mut points, 0, &starts);
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

    /// The points of a rank, ascending.
    pub(super) fn points(&self, rank: usize) -> &[u32] {
        &self.points[self.starts[rank]..self.starts[rank + 1]]
    }

    /// Number of a point over all ranks.
    pub(super) fn place(&self, point: u32) -> usize {
        self.places[point as usize] as usize
    }

    /// Whether a rank has a point.
    pub(super) fn has(&self, rank: usize, point: u32) -> bool {
        (self.starts[rank]..self.starts[rank + 1]).contains(&self.place(point))
    }

    /// Number of the points of each rank, times a number.
    pub(super) fn counts(&self, times: usize) -> Vec<usize> {
        let ends = self.starts.windows(2);
        ends.map(|it| times * (it[1] - it[0])).collect()
    }
}

/// Orders points, of which the first stands at a place among all, so that those of each rank stand together.
fn bisect(system: &dyn Bonds, points: &mut [u32], first: usize, starts: &[usize]) {
    let inside = first + 1..first + points.len();
    if points.len() < 2 || !starts.iter().any(|start| inside.contains(start)) {
        return;
    }
    system.halve(points);
    let middle = points.len() / 2;
    let (lower, upper) = points.split_at_mut(middle);
    bisect(system, lower, first, starts);
    bisect(system, upper, first + middle, starts);
}
