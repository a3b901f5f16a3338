//! Connected parts of the points of a body, over all processes.
//!
//! Each process finds the points connected by its pairs and labels each set by its first point. Neighbours exchange these labels at
//! ghosts until none finds an earlier one.

use crate::ghosts::Ghosts;
use crate::subdomain::Subdomain;

/// Number in the body of the first point of the part of each local point, by pairs of points on all processes, shape (n_points); collective.
pub fn first_points(subdomain: &Subdomain, pairs: impl Iterator<Item = [u32; 2]>) -> Vec<u32> {
    let n_points = subdomain.n_points();
    let mut sets = Parts::new(n_points);
    pairs.for_each(|points| sets.join(points));
    let ghosts = Ghosts::all(subdomain);
    let number = |point: u32| f64::from(subdomain.number(point));
    let mut names: Vec<f64> = (0..n_points as u32).map(number).collect();
    let mut of_points = names.clone();
    loop {
        for point in subdomain.owned() {
            of_points[point as usize] = names[sets.first(point) as usize];
        }
        ghosts.update(&mut of_points, 1);
        let mut is_earlier = false;
        for &ghost in ghosts.points() {
            let name = &mut names[sets.first(ghost) as usize];
            is_earlier |= of_points[ghost as usize] < *name;
            *name = name.min(of_points[ghost as usize]);
        }
        if !subdomain.any(is_earlier) {
            break;
        }
    }
    of_points.into_iter().map(|name| name as u32).collect()
}

/// Disjoint sets of connected points, each represented by its first point.
struct Parts {
    /// A point of the same set that is not after it, shape (n_points).
    before: Vec<u32>,
}

impl Parts {
    /// Sets of single points.
    fn new(n_points: usize) -> Self {
        Self {
            before: (0..n_points as u32).collect(),
        }
    }

    /// First point of the set of a point.
    fn first(&mut self, mut point: u32) -> u32 {
        while self.before[point as usize] != point {
            let next = self.before[point as usize];
            self.before[point as usize] = self.before[next as usize];
            point = self.before[point as usize];
        }
        point
    }

    /// Joins the sets of two points.
    fn join(&mut self, points: [u32; 2]) {
        let [one, other] = points.map(|point| self.first(point));
        let [first, last] = [one.min(other), one.max(other)];
        self.before[last as usize] = first;
    }
}
