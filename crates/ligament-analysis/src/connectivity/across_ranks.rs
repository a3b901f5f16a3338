//! Which points hang together in a body that processes share out.
//!
//! Each process knows which points its bonds hold together. It tells the others of the ends of bonds to points of other processes, so that
//! all join what hangs together across, and each point takes what its own process found.

use ligament_model::Bonds;
use ligament_model::portion::Portion;

/// The first of the points that hang together with each point by intact bonds of all processes, shape (n_points).
pub(super) fn first_points(system: &dyn Bonds, portion: &Portion, intact: &[bool]) -> Vec<f64> {
    let mut here = Parts::new(system.n_points());
    let left = || {
        let bonds = system.ends().iter().zip(intact);
        bonds.filter(|(_, intact)| **intact).map(|(ends, _)| *ends)
    };
    for ends in left() {
        here.join(ends);
    }
    let across = left().filter(|ends| !ends.iter().all(|&end| portion.is_own(end)));
    let mut border: Vec<u32> = across.flatten().collect();
    border.sort_unstable();
    border.dedup();
    let joined = border.into_iter().map(|point| [point, here.first(point)]);
    let joined: Vec<_> = joined.map(|it| it.map(f64::from)).collect();
    let mut all = Parts::new(system.n_points());
    for pair in portion.concatenated(&joined) {
        all.join(pair.map(|it| it as u32));
    }
    let mut firsts = vec![0.0; system.n_points()];
    for &point in portion.own() {
        firsts[point as usize] = f64::from(all.first(here.first(point)));
    }
    portion.complete(&mut firsts, 1);
    firsts
}

/// Points that hang together, each set of them led by its first point.
struct Parts {
    /// A point of the same part that is not after it, shape (n_points).
    before: Vec<u32>,
}

impl Parts {
    /// Every point by itself.
    fn new(n_points: usize) -> Self {
        Self {
            before: (0..n_points as u32).collect(),
        }
    }

    /// The first point of the part of a point.
    fn first(&mut self, mut point: u32) -> u32 {
        while self.before[point as usize] != point {
            let next = self.before[point as usize];
            self.before[point as usize] = self.before[next as usize];
            point = self.before[point as usize];
        }
        point
    }

    /// Makes one part of those of two points.
    fn join(&mut self, points: [u32; 2]) {
        let [one, other] = points.map(|point| self.first(point));
        let [first, last] = [one.min(other), one.max(other)];
        self.before[last as usize] = first;
    }
}
