//! Which points hang together, and whether something holds them.
//!
//! Rounding hides a body that came loose: a factorisation of its singular matrix may well succeed. So the question is
//! settled combinatorially. Connectivity alone is not enough (half a disk may be held along y only): for every fragment
//! the rank of its held degrees of freedom on the rigid motions that cost no energy decides, and just the missing motions
//! are held.

pub mod decremental;
pub(crate) mod rigid_motions;

use ligament_model::{BondSystem, ElementKind};

use crate::unknowns::COMPONENTS;
use rigid_motions::{RigidMotions, Turn};

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
                for &bond in system.bonds.incidence.at(point) {
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
        let of_fragment = |fragment: u32| {
            let points = &self.points[fragment as usize];
            let motions = rigid_motions(system, points);
            let found = holds(points, &motions, &is_fixed, &can_hold);
            found.into_iter().map(move |degree_of_freedom| Hold {
                degree_of_freedom,
                fragment,
            })
        };
        fragments.into_iter().flat_map(of_fragment).collect()
    }

    /// The rigid motions of a fragment that cost no energy and that no fixed degree of freedom prevents: displacements and
    /// rotations of its points in each of them, shape (motions, 3 points of the fragment).
    pub fn free_motions(
        &self,
        fragment: usize,
        system: &BondSystem,
        is_fixed: impl Fn(usize) -> bool,
    ) -> Vec<Vec<f64>> {
        let points = &self.points[fragment];
        let motions = rigid_motions(system, points);
        let free = motions.left_by(&motions.spanned_by(points, is_fixed));
        let shape = |&motion| {
            let dofs = degrees_of_freedom(points);
            dofs.map(|dof| motions.value(dof, motion)).collect()
        };
        free.iter().map(shape).collect()
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

/// The rigid motions of some points that their bonds let be free.
pub(crate) fn rigid_motions<'a>(system: &'a BondSystem, points: &[u32]) -> RigidMotions<'a> {
    let mut bonds = points
        .iter()
        .flat_map(|&point| system.bonds.incidence.at(point));
    let resists = |&bond: &u32| {
        let bond = bond as usize;
        system.shear_rigidity[bond] != 0.0 || system.rotational_rigidity[bond] != 0.0
    };
    let turn = match (bonds.any(resists), system.element) {
        (false, _) => Turn::OfPositions,
        (true, kind) if kind.has_strains() => Turn::OfPositions,
        (true, ElementKind::Beam) => Turn::OfPointsAlong,
        (true, _) => Turn::Costly,
    };
    RigidMotions::of(&system.cloud.positions, points, turn)
}

/// The degrees of freedom that hold what the fixed ones leave free of the rigid motions of some points, in the order in which
/// they are found; those that hold most first.
fn holds(
    points: &[u32],
    motions: &RigidMotions<'_>,
    is_fixed: impl Fn(usize) -> bool,
    can_hold: impl Fn(usize) -> bool,
) -> Vec<usize> {
    let mut spanned = motions.spanned_by(points, &is_fixed);
    let mut holds = Vec::new();
    while spanned.len() < motions.count() {
        let candidates = degrees_of_freedom(points).filter(|&dof| can_hold(dof) && !is_fixed(dof));
        let Some(best) = motions.most_independent(&spanned, candidates) else {
            break;
        };
        motions.extend(&mut spanned, best);
        holds.push(best);
    }
    holds
}

/// Degrees of freedom of some points, in their order.
pub(crate) fn degrees_of_freedom(points: &[u32]) -> impl Iterator<Item = usize> {
    let of_point = |&point: &u32| (0..COMPONENTS).map(move |c| COMPONENTS * point as usize + c);
    points.iter().flat_map(of_point)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of four points; supports given by their degrees of freedom (point, component). No rotation can be held where
    /// the points have none.
    fn holds_of_square(turn: Turn, fixed: &[usize]) -> Vec<usize> {
        let positions = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let points = [0, 1, 2, 3];
        let motions = RigidMotions::of(&positions, &points, turn);
        let can_hold = |dof: usize| turn == Turn::OfPointsAlong || dof % COMPONENTS < 2;
        holds(&points, &motions, |dof| fixed.contains(&dof), can_hold)
    }

    /// Three gauges where the rotation is free, two where it costs energy: a third would be a support that nobody asked for.
    #[test]
    fn a_free_body_needs_as_many_gauges_as_it_has_free_motions() {
        assert_eq!(holds_of_square(Turn::OfPointsAlong, &[]).len(), 3);
        let two = holds_of_square(Turn::Costly, &[]);
        assert_eq!(two, [0, 1], "x and y of the first point");
    }

    /// Supports count for the motions that they hold: x at one point leaves y, and the rotation where that is free; x at two
    /// heights holds the rotation as well, which is one support too many where it needs none.
    #[test]
    fn supports_take_the_place_of_gauges() {
        assert_eq!(holds_of_square(Turn::Costly, &[0]), [1]);
        assert_eq!(holds_of_square(Turn::Costly, &[0, 9]), [1]);
        assert_eq!(holds_of_square(Turn::Costly, &[0, 4]), [0; 0]);
        assert_eq!(holds_of_square(Turn::OfPointsAlong, &[0]).len(), 2);
        assert_eq!(holds_of_square(Turn::OfPointsAlong, &[0, 9]).len(), 1);
        assert_eq!(holds_of_square(Turn::OfPointsAlong, &[0, 4, 9]), [0; 0]);
    }

    /// A held rotation of a point holds no translation, and nothing at all where the body does not turn freely.
    #[test]
    fn a_held_rotation_of_a_point_is_no_translation() {
        assert_eq!(holds_of_square(Turn::OfPointsAlong, &[2]).len(), 2);
        assert_eq!(holds_of_square(Turn::Costly, &[2]), [0, 1]);
    }

    /// Where rotations of points have no stiffness, a clamped point still lets the body turn about it.
    #[test]
    fn a_held_rotation_without_stiffness_holds_nothing() {
        assert_eq!(holds_of_square(Turn::OfPositions, &[0, 1, 2]).len(), 1);
        assert_eq!(holds_of_square(Turn::OfPointsAlong, &[0, 1, 2]).len(), 0);
    }
}
