//! Nested dissection of the points, an elimination order for meshes.
//!
//! A part is cut at the median of its longer side (George 1973); the points of one half that are bonded with the other half form
//! the separator, and are eliminated after both halves.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use ligament_model::Bonds;
use ligament_model::CoupledPoints;

use crate::unknowns::Unknowns;

/// Largest number of points of a part that is not cut any further: most of them are bonded with each other, and smaller parts were
/// measured to save 0.2 % of the fill.
const SMALLEST_PART: usize = 12;

/// Least number of points of a part whose two sides are parallel tasks.
const TASK: usize = 1024;

/// Unknowns in elimination order: the unknowns of a point together, points by nested dissection.
pub fn elimination_order(system: &dyn Bonds, unknowns: &Unknowns) -> Vec<usize> {
    points_in_order(system)
        .into_iter()
        .flat_map(|point| unknowns.of_point(point as usize))
        .map(|(unknown, _)| unknown)
        .collect()
}

/// Points in the order of nested dissection.
fn points_in_order(system: &dyn Bonds) -> Vec<u32> {
    let n_points = system.n_points() as u32;
    let dissection = Dissection {
        system,
        coupled: &system.coupled_points,
        half: (0..n_points).map(|_| AtomicU32::new(0)).collect(),
        halves: AtomicU32::new(0),
    };
    dissection.part(&mut (0..n_points).collect::<Vec<_>>())
}

/// Data common to all parts, which are dissected in parallel: each task writes at its own points alone, and any half number of
/// another part that it may read is valid.
struct Dissection<'a> {
    system: &'a dyn Bonds,
    coupled: &'a CoupledPoints,
    /// Number of the last half to which a point was assigned.
    half: Vec<AtomicU32>,
    halves: AtomicU32,
}

impl Dissection<'_> {
    /// Points of a part in elimination order.
    fn part(&self, points: &mut [u32]) -> Vec<u32> {
        if points.len() <= SMALLEST_PART {
            return points.to_vec();
        }
        let n_points = points.len();
        let middle = n_points / 2;
        self.system.halve(points);
        let (lower, upper) = points.split_at_mut(middle);
        let [in_lower, in_upper] = [&*lower, &*upper].map(|half| self.mark(half));
        let rim_of_lower = self.rim(lower, in_upper);
        let rim_of_upper = self.rim(upper, in_lower);
        let (separator, cut, whole) = if rim_of_lower.len() < rim_of_upper.len() {
            (rim_of_lower, lower, upper)
        } else {
            (rim_of_upper, upper, lower)
        };
        let in_separator = self.mark(&separator);
        let mut inner: Vec<u32> = cut
            .iter()
            .copied()
            .filter(|&point| !self.is_in(point, in_separator))
            .collect();
        let (mut order, of_whole) = if n_points < TASK {
            (self.part(&mut inner), self.part(whole))
        } else {
            rayon::join(|| self.part(&mut inner), || self.part(whole))
        };
        order.extend(of_whole);
        order.extend(separator);
        order
    }

    /// Points of one half that elements couple with the other.
    fn rim(&self, half: &[u32], other_half: u32) -> Vec<u32> {
        let touches = |point: u32| {
            let mut coupled = self.coupled.at(point);
            coupled.any(|other| self.is_in(other, other_half))
        };
        half.iter()
            .copied()
            .filter(|&point| touches(point))
            .collect()
    }

    fn is_in(&self, point: u32, half: u32) -> bool {
        self.half[point as usize].load(Relaxed) == half
    }

    fn mark(&self, points: &[u32]) -> u32 {
        let number = self.halves.fetch_add(1, Relaxed) + 1;
        for &point in points {
            self.half[point as usize].store(number, Relaxed);
        }
        number
    }
}
