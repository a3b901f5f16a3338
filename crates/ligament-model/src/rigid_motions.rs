//! Rigid motions of some points that cost no energy, and the degrees of freedom that prevent them.

use crate::layout::{Component, Layout};
use crate::subdomain::Subdomain;
use crate::tensor::{dot, minus, norm};

/// Sine of the angle to the motions already prevented, below which a degree of freedom prevents no further rigid motion.
const RANK_TOLERANCE: f64 = 1e-6;

/// Ratio of the work of loads on a free motion to their size below which they are in equilibrium: well above the rounding of loads spread
/// over many points, and below the accuracy of interest.
const BALANCE_TOLERANCE: f64 = 1e-6;

/// A rigid motion in space: displacements along x, y and z at the middle, and angles about x, y and z times the radius.
type Motion = [f64; 6];

/// Rigid motions of some points in D dimensions that cost no energy, about their centroid and scaled by their size: translations, and rotations
/// unless they cost energy.
pub(crate) struct RigidMotions<'a, const D: usize> {
    layout: Layout,
    positions: &'a [[f64; D]],
    centre: [f64; D],
    radius: f64,
    turn: Turn,
}

/// Cost and effect of rotating some points as a whole.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Turn {
    /// Rotation that costs energy: bonds between points without rotations resist it by their shear.
    Costly,
    /// Free rotation of the positions only; the points' own rotations have no stiffness, so that fixing one prevents nothing.
    OfPositions,
    /// Free rotation of the positions and of the points.
    OfPointsAlong,
}

/// Values of a component, at a position from the middle over the radius, in the unit motions: a rotation omega moves a position r by omega x
/// r.
fn row<const D: usize>(turn: Turn, component: Component, place: [f64; D]) -> Motion {
    let along = |axis: usize| if axis < D { place[axis] } else { 0.0 };
    let [x, y, z] = [0, 1, 2].map(along);
    let (moves, turns) = match turn {
        Turn::Costly => (0.0, 0.0),
        Turn::OfPositions => (1.0, 0.0),
        Turn::OfPointsAlong => (1.0, 1.0),
    };
    let mut row = match component {
        Component::X => [1.0, 0.0, 0.0, 0.0, z, -y],
        Component::Y => [0.0, 1.0, 0.0, -z, 0.0, x],
        Component::Z => [0.0, 0.0, 1.0, y, -x, 0.0],
        _ => [0.0; 6],
    };
    row[3..].iter_mut().for_each(|angle| *angle *= moves);
    if component.is_rotation() {
        row[component.in_space()] = turns;
    }
    row
}

/// Unit rigid motions of points at positions about a centre, each as a column over their degrees of freedom.
pub(crate) fn columns<const D: usize>(
    layout: Layout,
    positions: &[[f64; D]],
    centre: [f64; D],
) -> Vec<Vec<f64>> {
    let motion = |of_body: &Component| -> Vec<f64> {
        let at_point = |position: &[f64; D]| {
            let place = minus(*position, centre);
            let rows = layout.components.iter();
            rows.map(move |it| row(Turn::OfPointsAlong, *it, place)[of_body.in_space()])
        };
        positions.iter().flat_map(at_point).collect()
    };
    layout.of_body().iter().map(motion).collect()
}

impl<'a, const D: usize> RigidMotions<'a, D> {
    /// The rigid motions of `points` among `positions`.
    pub(crate) fn new(
        layout: Layout,
        positions: &'a [[f64; D]],
        points: &[u32],
        turn: Turn,
    ) -> Self {
        let subdomain = Subdomain::whole(points.len());
        Self {
            turn,
            ..Self::of_body(layout, positions, points, &subdomain)
        }
    }

    /// The rigid motions of a body with some points on this process; points rotate along. Collective.
    pub(crate) fn of_body(
        layout: Layout,
        positions: &'a [[f64; D]],
        owned: &[u32],
        subdomain: &Subdomain,
    ) -> Self {
        let chosen = || owned.iter().map(|&point| positions[point as usize]);
        let mut sums: [f64; D] = std::array::from_fn(|axis| chosen().map(|p| p[axis]).sum());
        subdomain.all_reduce_sum(&mut sums);
        let centre = sums.map(|sum| sum / subdomain.n_all() as f64);
        let size = |place: [f64; D]| match place.as_slice() {
            [x, y] => x.hypot(*y),
            _ => norm(place),
        };
        let radius = chosen().map(|p| size(minus(p, centre))).fold(0.0, f64::max);
        let radius = subdomain.max(radius);
        Self {
            layout,
            positions,
            centre,
            radius: if radius > 0.0 { radius } else { 1.0 },
            turn: Turn::OfPointsAlong,
        }
    }

    /// Motions of a body, as indices in a [`Motion`]: translations first.
    fn motions(&self) -> impl Iterator<Item = (Component, usize)> + use<D> {
        let of_body = self.layout.of_body().iter();
        of_body.map(|&component| (component, component.in_space()))
    }

    /// Degrees of freedom of some points, in their order.
    fn degrees_of_freedom<'p>(
        &self,
        points: &'p [u32],
    ) -> impl Iterator<Item = usize> + use<'p, D> {
        let layout = self.layout;
        points.iter().flat_map(move |&point| layout.range(point))
    }

    /// Number of the motions.
    fn count(&self) -> usize {
        match self.turn {
            Turn::Costly => D,
            Turn::OfPositions | Turn::OfPointsAlong => self.layout.of_body().len(),
        }
    }

    /// Values of a degree of freedom in the unit motions, m per m (a rotation: as an angle times the radius).
    fn row(&self, degree_of_freedom: usize) -> Motion {
        let position = self.positions[self.layout.point(degree_of_freedom) as usize];
        let place: [f64; D] =
            std::array::from_fn(|axis| (position[axis] - self.centre[axis]) / self.radius);
        row(self.turn, self.layout.component(degree_of_freedom), place)
    }

    /// Value of a degree of freedom in a motion, m or rad.
    fn value(&self, degree_of_freedom: usize, motion: Motion) -> f64 {
        let value = dot(self.row(degree_of_freedom), motion);
        if self.layout.component(degree_of_freedom).is_rotation() {
            value / self.radius
        } else {
            value
        }
    }

    /// Orthonormal basis of the motions orthogonal to the spanned ones, translations first.
    fn left_by(&self, spanned: &[Motion]) -> Vec<Motion> {
        let mut all = spanned.to_vec();
        for (_, motion) in self.motions().take(self.count()) {
            let mut unit = [0.0; 6];
            unit[motion] = 1.0;
            let rest = orthogonal_part(unit, &all);
            let norm = dot(rest, rest).sqrt();
            if norm > RANK_TOLERANCE {
                all.push(rest.map(|value| value / norm));
            }
        }
        all.split_off(spanned.len())
    }

    /// Work of forces (N) and couples (N m) at some degrees of freedom on a motion, and the sum of their absolute values, N.
    fn work(&self, motion: Motion, forces: impl Iterator<Item = (usize, f64)>) -> [f64; 2] {
        forces.fold([0.0; 2], |[work, size], (dof, force)| {
            let is_couple = self.layout.component(dof).is_rotation();
            let force = if is_couple {
                force / self.radius
            } else {
                force
            };
            [
                work + force * dot(self.row(dof), motion),
                size + force.abs(),
            ]
        })
    }

    /// Component of the unit row of a degree of freedom orthogonal to the (orthonormal) spanned directions.
    fn remainder(&self, spanned: &[Motion], degree_of_freedom: usize) -> Motion {
        let row = self.row(degree_of_freedom);
        let norm = dot(row, row).sqrt();
        if norm == 0.0 {
            return row;
        }
        orthogonal_part(row.map(|value| value / norm), spanned)
    }

    /// Adds the direction that a degree of freedom prevents, if it is a new one.
    fn extend(&self, spanned: &mut Vec<Motion>, degree_of_freedom: usize) {
        let rest = self.remainder(spanned, degree_of_freedom);
        let norm = dot(rest, rest).sqrt();
        if norm > RANK_TOLERANCE {
            spanned.push(rest.map(|value| value / norm));
        }
    }

    /// Orthonormal basis of the motions that the fixed degrees of freedom of some points prevent.
    fn spanned_by(&self, points: &[u32], is_fixed: impl Fn(usize) -> bool) -> Vec<Motion> {
        let mut spanned = Vec::new();
        for dof in self.degrees_of_freedom(points).filter(|&dof| is_fixed(dof)) {
            self.extend(&mut spanned, dof);
            if spanned.len() == self.count() {
                break;
            }
        }
        spanned
    }

    /// The degree of freedom with the largest part orthogonal to the spanned directions.
    fn most_independent(
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

    /// Free motions among the translations along the axes and the rotations, given the spanned directions: translations of the whole by 1 m,
    /// and rotations by 1 rad about the place that is fixed, or the middle.
    fn free(&self, spanned: &[Motion]) -> Vec<(Component, Motion)> {
        let mut held = spanned.to_vec();
        let mut free = Vec::new();
        for (component, place) in self.motions() {
            let mut unit = [0.0; 6];
            unit[place] = 1.0;
            if !component.is_rotation() {
                if (spanned.iter()).all(|direction| direction[place].abs() < RANK_TOLERANCE) {
                    free.push((component, unit));
                    held.push(unit);
                }
                continue;
            }
            let turn = orthogonal_part(unit, &held);
            if held.len() < self.count() && turn[place] > RANK_TOLERANCE {
                let by_one = turn.map(|value| value / turn[place] * self.radius);
                free.push((component, by_one));
                let size = dot(turn, turn).sqrt();
                held.push(turn.map(|value| value / size));
            }
        }
        free
    }

    /// Degrees of freedom to fix so that no motion of `points` is free, beyond the fixed ones, in the order in which they are found; the
    /// most effective first. Only those for which `can_hold` returns true are chosen.
    pub(crate) fn holds(
        &self,
        points: &[u32],
        is_fixed: impl Fn(usize) -> bool,
        can_hold: impl Fn(usize) -> bool,
    ) -> Vec<usize> {
        let mut spanned = self.spanned_by(points, &is_fixed);
        let mut holds = Vec::new();
        while spanned.len() < self.count() {
            let candidates = self
                .degrees_of_freedom(points)
                .filter(|&dof| can_hold(dof) && !is_fixed(dof));
            let Some(best) = self.most_independent(&spanned, candidates) else {
                break;
            };
            self.extend(&mut spanned, best);
            holds.push(best);
        }
        holds
    }

    /// Displacements and rotations of `points` in each motion that no fixed degree of freedom prevents, shape (n_motions,
    /// n_degrees_of_freedom of the points).
    pub(crate) fn free_shapes(
        &self,
        points: &[u32],
        is_fixed: impl Fn(usize) -> bool,
    ) -> Vec<Vec<f64>> {
        let free = self.left_by(&self.spanned_by(points, is_fixed));
        self.moved(points, &free)
    }

    /// Displacements and rotations of `points` in all motions, shape (n_motions, n_degrees_of_freedom of the points).
    pub(crate) fn shapes(&self, points: &[u32]) -> Vec<Vec<f64>> {
        self.moved(points, &self.left_by(&[]))
    }

    fn moved(&self, points: &[u32], motions: &[Motion]) -> Vec<Vec<f64>> {
        let shape = |&motion| {
            let dofs = self.degrees_of_freedom(points);
            dofs.map(|dof| self.value(dof, motion)).collect()
        };
        motions.iter().map(shape).collect()
    }

    /// Motions of `points` that no fixed degree of freedom prevents, with the work of forces (by degree of freedom, N and N m) on them.
    pub(crate) fn free_motions(
        &self,
        points: &[u32],
        is_fixed: impl Fn(usize) -> bool,
        force: impl Fn(usize) -> f64,
    ) -> Vec<FreeMotion> {
        let spanned = self.spanned_by(points, is_fixed);
        let free = self.free(&spanned).into_iter();
        free.map(|(component, motion)| {
            let forces = self.degrees_of_freedom(points).map(|dof| (dof, force(dof)));
            let [load, size] = self.work(motion, forces);
            let parts = motion.iter().map(|part| part.abs());
            let length = parts.fold(0.0, f64::max);
            FreeMotion {
                component,
                load,
                imbalance: if load == 0.0 {
                    0.0
                } else {
                    load.abs() / (size * length)
                },
            }
        })
        .collect()
    }
}

/// A rigid motion that no support prevents.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeMotion {
    /// A translation along an axis, or a rotation.
    pub component: Component,
    /// Force of the given loads at load factor 1 along the motion, N; for a rotation the moment about the fixed place, or the middle of the
    /// points, N m.
    pub load: f64,
    /// Work of the loads along the motion, relative to the sum of their absolute values, 0 to 1.
    pub imbalance: f64,
}

impl FreeMotion {
    /// Whether the loads are in equilibrium along the motion.
    pub fn is_balanced(&self) -> bool {
        self.imbalance <= BALANCE_TOLERANCE
    }
}

/// Part of a motion orthogonal to some orthonormal directions.
fn orthogonal_part(motion: Motion, directions: &[Motion]) -> Motion {
    directions.iter().fold(motion, |rest, direction| {
        let share = dot(rest, *direction);
        std::array::from_fn(|i| rest[i] - share * direction[i])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of four points; supports given by their degrees of freedom (point, component). No rotation can be held where
    /// the points have none.
    fn holds_of_square(turn: Turn, fixed: &[usize]) -> Vec<usize> {
        let positions = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let points = [0, 1, 2, 3];
        let layout = Layout {
            n_points: 4,
            components: &Component::ALL,
        };
        let motions = RigidMotions::new(layout, &positions, &points, turn);
        let can_hold =
            |dof: usize| turn == Turn::OfPointsAlong || !layout.component(dof).is_rotation();
        motions.holds(&points, |dof| fixed.contains(&dof), can_hold)
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

    const CUBE: [[f64; 3]; 8] = [
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [0.0, 2.0, 0.0],
        [2.0, 2.0, 0.0],
        [0.0, 0.0, 2.0],
        [2.0, 0.0, 2.0],
        [0.0, 2.0, 2.0],
        [2.0, 2.0, 2.0],
    ];

    fn motions(turn: Turn) -> RigidMotions<'static, 3> {
        let layout = Layout {
            n_points: 8,
            components: &Component::IN_SPACE,
        };
        let points: Vec<u32> = (0..8).collect();
        RigidMotions::new(layout, &CUBE, &points, turn)
    }

    fn holds_of_cube(turn: Turn, fixed: &[usize]) -> usize {
        let points: Vec<u32> = (0..8).collect();
        let can_hold = |dof: usize| turn == Turn::OfPointsAlong || dof % 6 < 3;
        let holds = motions(turn).holds(&points, |dof| fixed.contains(&dof), can_hold);
        holds.len()
    }

    /// Six, or three where rotations cost energy. A ball joint at a corner leaves the three rotations, a second one the turn about the line
    /// through both, a clamped point nothing; where points have no rotational stiffness a clamped point is a ball joint.
    #[test]
    fn supports_of_a_cube_take_the_place_of_gauges() {
        assert_eq!(holds_of_cube(Turn::OfPointsAlong, &[]), 6);
        assert_eq!(holds_of_cube(Turn::OfPositions, &[]), 6);
        assert_eq!(holds_of_cube(Turn::Costly, &[]), 3);
        assert_eq!(holds_of_cube(Turn::Costly, &[0, 7, 14]), 0);
        assert_eq!(holds_of_cube(Turn::OfPointsAlong, &[0, 1, 2]), 3);
        assert_eq!(
            holds_of_cube(Turn::OfPointsAlong, &[0, 1, 2, 42, 43, 44]),
            1
        );
        assert_eq!(holds_of_cube(Turn::OfPointsAlong, &[0, 1, 2, 3, 4, 5]), 0);
        assert_eq!(holds_of_cube(Turn::OfPositions, &[0, 1, 2, 3, 4, 5]), 3);
    }

    /// Hung up along z at three corners of the bottom, the cube may slide along x and y and turn about z. A force along x at the top then
    /// does work on the first, and on the turn if it is off the middle: moments about the middle, (0, 1, 0) to its left.
    #[test]
    fn free_motions_and_their_loads() {
        let fixed = [2, 8, 14];
        let points: Vec<u32> = (0..8).collect();
        let free = motions(Turn::OfPointsAlong).free_motions(
            &points,
            |dof| fixed.contains(&dof),
            |dof| if dof == 6 * 6 { 5.0 } else { 0.0 },
        );
        let found: Vec<_> = free.iter().map(|it| it.component).collect();
        assert_eq!(found, [Component::X, Component::Y, Component::RotationZ]);
        let loads = [5.0, 0.0, -5.0];
        for (motion, expected) in free.iter().zip(loads) {
            assert!((motion.load - expected).abs() < 1e-12, "{motion:?}");
        }
    }
}
