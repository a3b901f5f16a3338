//! How much of the mass a mode moves.

use ligament_model::{LumpedMass, PointCloud};

use super::masses::{Masses, inner};
use crate::unknowns::COMPONENTS;

/// The mass of a body and what of it can move.
#[derive(Debug, Clone, PartialEq)]
pub struct Moving {
    /// Mass of the whole body, kg.
    pub total: f64,
    /// Its centre, as in the mesh file, m.
    pub centre: [f64; 2],
    /// Mass that moves along x and along y, kg, and inertia about the centre, kg m^2: of all that is not held. The effective
    /// masses of all modes add up to these.
    pub free: [f64; 3],
    /// Rigid motions of size one along x, along y and about the centre, each of shape (3 n_points).
    motions: [Vec<f64>; 3],
}

impl Moving {
    /// Mass and centre of the whole body, and the share of what can move.
    pub(super) fn new(cloud: &PointCloud, mass: &LumpedMass, masses: &Masses) -> Self {
        let total: f64 = mass.mass.iter().sum();
        let middle = [0, 1].map(|axis| {
            let weighted = mass.mass.iter().zip(&cloud.positions);
            weighted.map(|(mass, p)| mass * p[axis]).sum::<f64>() / total
        });
        let motion = |of_point: &dyn Fn([f64; 2]) -> [f64; COMPONENTS]| {
            let from_middle = |p: &[f64; 2]| [p[0] - middle[0], p[1] - middle[1]];
            let positions = cloud.positions.iter();
            positions.flat_map(|p| of_point(from_middle(p))).collect()
        };
        let motions: [Vec<f64>; 3] = [
            motion(&|_| [1.0, 0.0, 0.0]),
            motion(&|_| [0.0, 1.0, 0.0]),
            motion(&|[x, y]| [-y, x, 1.0]),
        ];
        Self {
            total,
            centre: [0, 1].map(|axis| middle[axis] + cloud.origin[axis]),
            free: motions.each_ref().map(|r| inner(masses.of_dof(), r, r)),
            motions,
        }
    }

    /// phi^T M r of a normalised shape, for each of the rigid motions r.
    pub(super) fn participation(&self, masses: &Masses, shape: &[f64]) -> [f64; 3] {
        let motions = self.motions.each_ref();
        motions.map(|motion| inner(masses.of_dof(), shape, motion))
    }

    /// Effective masses or inertia of participation factors, over what can move; 0 where nothing can.
    pub fn shares(&self, participation: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| {
            let effective = participation[k] * participation[k];
            if self.free[k] > 0.0 {
                effective / self.free[k]
            } else {
                0.0
            }
        })
    }
}
