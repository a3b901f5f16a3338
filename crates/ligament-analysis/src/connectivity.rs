//! Which points hang together, and whether something holds them.
//!
//! Rounding hides a body that came loose: a factorisation of its singular matrix may well succeed. So the question is
//! settled combinatorially. Connectivity alone is not enough (half a disk may be held along y only): for every fragment
//! the rank of its held degrees of freedom on the three rigid motions decides, and just the missing motions are held.

pub mod decremental;

use ligament_model::BondSystem;

use crate::unknowns::{COMPONENTS, Component};

/// Below this sine of the angle to what is held already, a degree of freedom holds no further rigid motion.
const RANK_TOLERANCE: f64 = 1e-6;

/// The connected parts of a body.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fragments {
    /// Fragment of each point, shape (n_points); numbered in the order of their first points.
    pub of_point: Vec<u32>,
    /// Points of each fragment, ascending.
    pub points: Vec<Vec<u32>>,
}

/// A rigid motion of a fragment that nothing held any more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hold {
    /// Degree of freedom (of 3 n_points) that is held from now on.
    pub degree_of_freedom: usize,
    /// Fragment that it belongs to.
    pub fragment: u32,
}

impl Fragments {
    /// Parts connected by intact bonds.
    pub fn find(system: &BondSystem, intact: &[bool]) -> Self {
        let n_points = system.cloud.len();
        let mut of_point = vec![u32::MAX; n_points];
        let mut points = Vec::new();
        for start in 0..n_points as u32 {
            if of_point[start as usize] != u32::MAX {
                continue;
            }
            let fragment = points.len() as u32;
            of_point[start as usize] = fragment;
            let mut reached = vec![start];
            let mut next = 0;
            while next < reached.len() {
                let point = reached[next];
                next += 1;
                for &bond in system.bonds.incidence.of(point) {
                    let neighbour = system.bonds.neighbour(bond, point);
                    if intact[bond as usize] && of_point[neighbour as usize] == u32::MAX {
                        of_point[neighbour as usize] = fragment;
                        reached.push(neighbour);
                    }
                }
            }
            reached.sort_unstable();
            points.push(reached);
        }
        Self { of_point, points }
    }

    /// The degrees of freedom to hold so that none of the given fragments can move rigidly.
    ///
    /// `is_fixed` tells what supports, loads and earlier holds prescribe; `can_hold` what has a stiffness.
    pub fn missing_holds(
        &self,
        fragments: impl IntoIterator<Item = u32>,
        system: &BondSystem,
        is_fixed: impl Fn(usize) -> bool,
        can_hold: impl Fn(usize) -> bool,
    ) -> Vec<Hold> {
        let mut holds = Vec::new();
        for fragment in fragments {
            let points = &self.points[fragment as usize];
            let motions = RigidMotions::of(system, points);
            let mut spanned = Vec::new();
            let degrees_of_freedom = || {
                points.iter().flat_map(|&point| {
                    (0..COMPONENTS).map(move |c| COMPONENTS * point as usize + c)
                })
            };
            for dof in degrees_of_freedom().filter(|&dof| is_fixed(dof)) {
                motions.extend(&mut spanned, dof);
                if spanned.len() == COMPONENTS {
                    break;
                }
            }
            while spanned.len() < COMPONENTS {
                let candidates =
                    degrees_of_freedom().filter(|&dof| can_hold(dof) && !is_fixed(dof));
                let Some(best) = motions.most_independent(&spanned, candidates) else {
                    break;
                };
                motions.extend(&mut spanned, best);
                holds.push(Hold {
                    degree_of_freedom: best,
                    fragment,
                });
            }
        }
        holds
    }

    /// Makes a fragment of a part of one; both keep the order of their first points among the others.
    fn split_off(&mut self, mut part: Vec<u32>) {
        part.sort_unstable();
        let rest = &mut self.points[self.of_point[part[0] as usize] as usize];
        let mut leaving = part.iter().peekable();
        rest.retain(|point| leaving.next_if_eq(&point).is_none());
        // The part with the first point keeps the number.
        if part[0] < rest[0] {
            std::mem::swap(&mut part, rest);
        }
        let number = self.points.partition_point(|points| points[0] < part[0]);
        for fragment in &mut self.of_point {
            *fragment += u32::from(*fragment >= number as u32);
        }
        for &point in &part {
            self.of_point[point as usize] = number as u32;
        }
        self.points.insert(number, part);
    }
}

/// The three rigid motions of a fragment, about its middle and scaled by its size.
struct RigidMotions<'a> {
    system: &'a BondSystem,
    centre: [f64; 2],
    radius: f64,
}

impl<'a> RigidMotions<'a> {
    fn of(system: &'a BondSystem, points: &[u32]) -> Self {
        let positions = || {
            points
                .iter()
                .map(|&point| system.cloud.positions[point as usize])
        };
        let centre =
            [0, 1].map(|axis| positions().map(|p| p[axis]).sum::<f64>() / points.len() as f64);
        let radius = positions()
            .map(|p| (p[0] - centre[0]).hypot(p[1] - centre[1]))
            .fold(0.0, f64::max);
        Self {
            system,
            centre,
            radius: if radius > 0.0 { radius } else { 1.0 },
        }
    }

    /// How the motions (x, y, rotation) move a degree of freedom, as a unit vector.
    fn participation(&self, degree_of_freedom: usize) -> [f64; COMPONENTS] {
        let position = self.system.cloud.positions[degree_of_freedom / COMPONENTS];
        let [x, y] = [0, 1].map(|axis| (position[axis] - self.centre[axis]) / self.radius);
        let row = match Component::of(degree_of_freedom) {
            Component::X => [1.0, 0.0, -y],
            Component::Y => [0.0, 1.0, x],
            Component::Rotation => [0.0, 0.0, 1.0],
        };
        let norm = dot(row, row).sqrt();
        row.map(|value| value / norm)
    }

    /// What of the participation the spanned directions do not hold (the directions are orthonormal).
    fn remainder(
        &self,
        spanned: &[[f64; COMPONENTS]],
        degree_of_freedom: usize,
    ) -> [f64; COMPONENTS] {
        let mut rest = self.participation(degree_of_freedom);
        for direction in spanned {
            let share = dot(rest, *direction);
            rest = [0, 1, 2].map(|i| rest[i] - share * direction[i]);
        }
        rest
    }

    fn extend(&self, spanned: &mut Vec<[f64; COMPONENTS]>, degree_of_freedom: usize) {
        let rest = self.remainder(spanned, degree_of_freedom);
        let norm = dot(rest, rest).sqrt();
        if norm > RANK_TOLERANCE {
            spanned.push(rest.map(|value| value / norm));
        }
    }

    fn most_independent(
        &self,
        spanned: &[[f64; COMPONENTS]],
        candidates: impl Iterator<Item = usize>,
    ) -> Option<usize> {
        let mut best = None;
        let mut largest = RANK_TOLERANCE * RANK_TOLERANCE;
        for dof in candidates {
            let rest = self.remainder(spanned, dof);
            if dot(rest, rest) > largest {
                (best, largest) = (Some(dof), dot(rest, rest));
            }
        }
        best
    }
}

fn dot(one: [f64; COMPONENTS], other: [f64; COMPONENTS]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}
