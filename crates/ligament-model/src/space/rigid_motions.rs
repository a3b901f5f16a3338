//! The rigid motions of points in space: three translations and three rotations.

use super::element::SolidElement;
use super::system::SolidSystem;
use crate::interface::{Bonds, CentralMotions};
use crate::layout::Component;
use crate::portion::any;
use crate::rigid_motions::{RigidMotions, Turn};
use crate::tensor::dot;

impl SolidSystem {
    /// The rigid motions of some points that their bonds let be free.
    pub(super) fn rigid_motions(&self, points: &[u32]) -> RigidMotions<'_, 3, 6> {
        let mut bonds = points
            .iter()
            .flat_map(|&point| self.bonds.incidence.at(point));
        let resist = bonds.any(|&bond| self.rigidities.resist_rotations(bond as usize));
        let resist = any(self.portion(), resist);
        let turn = match (resist, self.element) {
            (true, SolidElement::Beam) => Turn::OfPointsAlong,
            (true, SolidElement::Spring) => Turn::Costly,
            (false, _) => Turn::OfPositions,
        };
        self.motions(points, turn)
    }

    /// All rigid motions of some points, whatever they cost, with rotations along which the points turn.
    pub(super) fn all_motions(&self, points: &[u32]) -> RigidMotions<'_, 3, 6> {
        self.motions(points, Turn::OfPointsAlong)
    }

    fn motions(&self, points: &[u32], turn: Turn) -> RigidMotions<'_, 3, 6> {
        let size = |p: [f64; 3]| dot(p, p).sqrt();
        let positions = &self.cloud.positions;
        RigidMotions::new(self.layout(), positions, points, turn, (size, row_in_space))
    }

    /// The rigid motions of the whole body about the centre of its masses (n_points).
    pub(super) fn central_motions(&self, masses: &[f64]) -> CentralMotions {
        let total: f64 = masses.iter().sum();
        let middle = [0, 1, 2].map(|axis| {
            let weighted = masses.iter().zip(&self.cloud.positions);
            weighted.map(|(mass, p)| mass * p[axis]).sum::<f64>() / total
        });
        let components = self.components();
        let motion = |number: usize| -> Vec<f64> {
            let at_point = |p: &[f64; 3]| {
                let place = [0, 1, 2].map(|axis| p[axis] - middle[axis]);
                (components.iter())
                    .map(move |it| row_in_space(Turn::OfPointsAlong, *it, place)[number])
            };
            self.cloud.positions.iter().flat_map(at_point).collect()
        };
        CentralMotions {
            centre: [0, 1, 2]
                .map(|axis| middle[axis] + self.cloud.origin[axis])
                .to_vec(),
            motions: (0..6).map(motion).collect(),
        }
    }
}

/// Row of a degree of freedom in space: a rotation omega moves a place r by omega x r.
fn row_in_space(turn: Turn, component: Component, [x, y, z]: [f64; 3]) -> [f64; 6] {
    let (moves, turns) = match turn {
        Turn::Costly => (0.0, 0.0),
        Turn::OfPositions => (1.0, 0.0),
        Turn::OfPointsAlong => (1.0, 1.0),
    };
    let row = match component {
        Component::X => [1.0, 0.0, 0.0, 0.0, z, -y],
        Component::Y => [0.0, 1.0, 0.0, -z, 0.0, x],
        Component::Z => [0.0, 0.0, 1.0, y, -x, 0.0],
        Component::RotationX => return [0.0, 0.0, 0.0, turns, 0.0, 0.0],
        Component::RotationY => return [0.0, 0.0, 0.0, 0.0, turns, 0.0],
        Component::RotationZ | Component::Rotation => return [0.0, 0.0, 0.0, 0.0, 0.0, turns],
    };
    let [a, b, c, u, v, w] = row;
    [a, b, c, moves * u, moves * v, moves * w]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::Layout;

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

    fn motions(turn: Turn) -> RigidMotions<'static, 3, 6> {
        let layout = Layout {
            n_points: 8,
            components: &Component::IN_SPACE,
        };
        let size = |p: [f64; 3]| p.iter().map(|x| x * x).sum::<f64>().sqrt();
        let points: Vec<u32> = (0..8).collect();
        RigidMotions::new(layout, &CUBE, &points, turn, (size, row_in_space))
    }

    fn holds(turn: Turn, fixed: &[usize]) -> usize {
        let points: Vec<u32> = (0..8).collect();
        let can_hold = |dof: usize| turn == Turn::OfPointsAlong || dof % 6 < 3;
        let holds = motions(turn).holds(&points, |dof| fixed.contains(&dof), can_hold);
        holds.len()
    }

    /// Six, or three where rotations cost energy. A ball joint at a corner leaves the three rotations, a second one the turn about the line
    /// through both, a clamped point nothing; where points have no rotational stiffness a clamped point is a ball joint.
    #[test]
    fn supports_take_the_place_of_gauges() {
        assert_eq!(holds(Turn::OfPointsAlong, &[]), 6);
        assert_eq!(holds(Turn::OfPositions, &[]), 6);
        assert_eq!(holds(Turn::Costly, &[]), 3);
        assert_eq!(holds(Turn::Costly, &[0, 7, 14]), 0);
        assert_eq!(holds(Turn::OfPointsAlong, &[0, 1, 2]), 3);
        assert_eq!(holds(Turn::OfPointsAlong, &[0, 1, 2, 42, 43, 44]), 1);
        assert_eq!(holds(Turn::OfPointsAlong, &[0, 1, 2, 3, 4, 5]), 0);
        assert_eq!(holds(Turn::OfPositions, &[0, 1, 2, 3, 4, 5]), 3);
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
