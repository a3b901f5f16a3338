//! The rigid motions of some points that cost no energy, and what of them degrees of freedom hold.

use super::degrees_of_freedom;
use crate::unknowns::{COMPONENTS, Component};

/// Below this sine of the angle to what is held already, a degree of freedom holds no further rigid motion.
const RANK_TOLERANCE: f64 = 1e-6;

/// A rigid motion: displacements along x and y at the middle, and the angle times the radius.
pub(crate) type Motion = [f64; COMPONENTS];

/// The rigid motions of some points, about their middle and scaled by their size: two translations, and the rotation where
/// it costs no energy either.
pub(crate) struct RigidMotions<'a> {
    positions: &'a [[f64; 2]],
    pub(crate) centre: [f64; 2],
    pub(crate) radius: f64,
    turn: Turn,
}

/// What the rotation of some points as a whole costs and moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Turn {
    /// It costs energy: bonds between points without rotations resist it by their shear.
    Costly,
    /// It is free and moves the points; their own rotations have no stiffness, so that holding one holds nothing.
    OfPositions,
    /// It is free, and the points turn along.
    OfPointsAlong,
}

impl<'a> RigidMotions<'a> {
    /// Those of `points` among `positions`.
    pub(crate) fn of(positions: &'a [[f64; 2]], points: &[u32], turn: Turn) -> Self {
        let chosen = || points.iter().map(|&point| positions[point as usize]);
        let centre =
            [0, 1].map(|axis| chosen().map(|p| p[axis]).sum::<f64>() / points.len() as f64);
        let radius = chosen()
            .map(|p| (p[0] - centre[0]).hypot(p[1] - centre[1]))
            .fold(0.0, f64::max);
        Self {
            positions,
            centre,
            radius: if radius > 0.0 { radius } else { 1.0 },
            turn,
        }
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        match self.turn {
            Turn::Costly => 2,
            Turn::OfPositions | Turn::OfPointsAlong => 3,
        }
    }

    /// How the motions (x, y, rotation) move a degree of freedom, m a m (a rotation: as an angle times the radius).
    fn row(&self, degree_of_freedom: usize) -> Motion {
        let position = self.positions[degree_of_freedom / COMPONENTS];
        let [x, y] = [0, 1].map(|axis| (position[axis] - self.centre[axis]) / self.radius);
        let [turn_x, turn_y, turn] = match self.turn {
            Turn::Costly => [0.0; 3],
            Turn::OfPositions => [-y, x, 0.0],
            Turn::OfPointsAlong => [-y, x, 1.0],
        };
        match Component::of(degree_of_freedom) {
            Component::X => [1.0, 0.0, turn_x],
            Component::Y => [0.0, 1.0, turn_y],
            Component::Rotation => [0.0, 0.0, turn],
        }
    }

    /// What a motion does to a degree of freedom, m or rad.
    pub(crate) fn value(&self, degree_of_freedom: usize, motion: Motion) -> f64 {
        let value = dot(self.row(degree_of_freedom), motion);
        match Component::of(degree_of_freedom) {
            Component::Rotation => value / self.radius,
            Component::X | Component::Y => value,
        }
    }

    /// Orthonormal directions of the motions that the spanned ones leave, translations first.
    pub(crate) fn left_by(&self, spanned: &[Motion]) -> Vec<Motion> {
        let mut all = spanned.to_vec();
        for motion in 0..self.count() {
            let mut unit = [0.0; COMPONENTS];
            unit[motion] = 1.0;
            let rest = without(unit, &all);
            let norm = dot(rest, rest).sqrt();
            if norm > RANK_TOLERANCE {
                all.push(rest.map(|value| value / norm));
            }
        }
        all.split_off(spanned.len())
    }

    /// Work of forces (N) and couples (N m) at some degrees of freedom on a motion, and the sum of their sizes, N.
    pub(crate) fn work(
        &self,
        motion: Motion,
        forces: impl Iterator<Item = (usize, f64)>,
    ) -> [f64; 2] {
        forces.fold([0.0; 2], |[work, size], (dof, force)| {
            let force = match Component::of(dof) {
                Component::Rotation => force / self.radius,
                Component::X | Component::Y => force,
            };
            [
                work + force * dot(self.row(dof), motion),
                size + force.abs(),
            ]
        })
    }

    /// What of a degree of freedom the spanned directions do not hold (the directions are orthonormal).
    fn remainder(&self, spanned: &[Motion], degree_of_freedom: usize) -> Motion {
        let row = self.row(degree_of_freedom);
        let norm = dot(row, row).sqrt();
        if norm == 0.0 {
            return row;
        }
        without(row.map(|value| value / norm), spanned)
    }

    /// Adds the direction that a degree of freedom holds, if there is a new one.
    pub(crate) fn extend(&self, spanned: &mut Vec<Motion>, degree_of_freedom: usize) {
        let rest = self.remainder(spanned, degree_of_freedom);
        let norm = dot(rest, rest).sqrt();
        if norm > RANK_TOLERANCE {
            spanned.push(rest.map(|value| value / norm));
        }
    }

    /// Orthonormal directions of the motions that the fixed degrees of freedom of some points hold.
    pub(crate) fn spanned_by(
        &self,
        points: &[u32],
        is_fixed: impl Fn(usize) -> bool,
    ) -> Vec<Motion> {
        let mut spanned = Vec::new();
        for dof in degrees_of_freedom(points).filter(|&dof| is_fixed(dof)) {
            self.extend(&mut spanned, dof);
            if spanned.len() == self.count() {
                break;
            }
        }
        spanned
    }

    /// The degree of freedom that holds most of what the spanned directions do not.
    pub(crate) fn most_independent(
        &self,
        spanned: &[Motion],
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

    /// Of the motions along x, along y and of rotation those that the spanned directions leave free: translations of the
    /// whole by 1 m, and a rotation by an angle of 1 rad about the place that they hold, or the middle.
    pub(crate) fn free(&self, spanned: &[Motion]) -> [Option<Motion>; COMPONENTS] {
        let mut held = spanned.to_vec();
        let mut free = [None; COMPONENTS];
        for axis in 0..2 {
            let mut unit = [0.0; COMPONENTS];
            unit[axis] = 1.0;
            if spanned
                .iter()
                .all(|direction| direction[axis].abs() < RANK_TOLERANCE)
            {
                free[axis] = Some(unit);
                held.push(unit);
            }
        }
        let turn = without([0.0, 0.0, 1.0], &held);
        if held.len() < self.count() && turn[2] > RANK_TOLERANCE {
            free[2] = Some(turn.map(|value| value / turn[2] * self.radius));
        }
        free
    }
}

/// What of a vector is orthogonal to some orthonormal directions.
fn without(vector: Motion, directions: &[Motion]) -> Motion {
    directions.iter().fold(vector, |rest, direction| {
        let share = dot(rest, *direction);
        [0, 1, 2].map(|i| rest[i] - share * direction[i])
    })
}

fn dot(one: Motion, other: Motion) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}
