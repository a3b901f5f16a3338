//! Aggregates: small connected parts of a body, whose rigid motions span the coarse space.

use ligament_model::Bonds;

/// Partition of a body into aggregates of a few dozen points each.
pub(super) struct Aggregates {
    /// Points of each aggregate.
    pub(super) points: Vec<Vec<u32>>,
    /// Aggregate of each point, shape (n_points).
    pub(super) of_point: Vec<u32>,
}

impl Aggregates {
    /// Aggregates of at most `largest` points by recursive bisection of the coordinates, split into parts that are connected by
    /// intact bonds (n_bonds).
    pub(super) fn new(system: &dyn Bonds, intact: &[bool], largest: usize) -> Self {
        let n_points = system.n_points();
        let mut parts = Self {
            points: Vec::new(),
            of_point: vec![0; n_points],
        };
        let mut all: Vec<u32> = (0..n_points as u32).collect();
        let mut boxes: Vec<&mut [u32]> = vec![&mut all];
        while let Some(points) = boxes.pop() {
            if points.len() > largest {
                let middle = points.len() / 2;
                system.halve(points);
                let (lower, upper) = points.split_at_mut(middle);
                boxes.extend([upper, lower]);
            } else if !points.is_empty() {
                points.sort_unstable();
                parts.add_connected(system, intact, points);
            }
        }
        parts
    }

    /// Number of aggregates.
    pub(super) fn len(&self) -> usize {
        self.points.len()
    }

    /// Adds the connected parts of some points (ascending), in the order of their first points.
    fn add_connected(&mut self, system: &dyn Bonds, intact: &[bool], points: &[u32]) {
        const OPEN: u32 = u32::MAX;
        for &point in points {
            self.of_point[point as usize] = OPEN;
        }
        let families = system.families();
        for &start in points {
            if self.of_point[start as usize] != OPEN {
                continue;
            }
            let number = self.points.len() as u32;
            self.of_point[start as usize] = number;
            let mut part = vec![start];
            let mut next = 0;
            while let Some(&point) = part.get(next) {
                next += 1;
                for neighbour in families.connected(point, intact) {
                    if self.of_point[neighbour as usize] == OPEN {
                        self.of_point[neighbour as usize] = number;
                        part.push(neighbour);
                    }
                }
            }
            part.sort_unstable();
            self.points.push(part);
        }
    }
}
