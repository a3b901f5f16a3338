//! A state during the iteration, with its measured quantities.

use std::sync::OnceLock;

use ligament_model::deformation::Deformations;
use ligament_model::surface::Vector;

use super::residual::{Extents, Residual};
use crate::balanced::Balanced;
use crate::contact::Contacts;
use crate::internal::InternalForces;

/// Deformations, forces, energy and residual of a state during the iteration.
pub(super) struct Iterate {
    pub(super) deformations: Deformations,
    pub(super) internal: InternalForces,
    pub(super) stored_energy: f64,
    pub(super) energy_floor: f64,
    pub(super) residual: Residual,
    pub(super) extents: Extents,
    pub(super) negative_energy: Option<f64>,
    pub(super) met: Contacts,
    /// Residual forces on rigid bodies with a mass, in the order of the loads on them, N.
    pub(super) on_rigid: Vec<Vector>,
}

impl Iterate {
    /// The iterate as an equilibrium, with its number of iterations and the mechanisms found on the way.
    pub(super) fn balanced(self, iterations: usize, mechanisms: Vec<u32>) -> Balanced {
        Balanced {
            deformations: self.deformations,
            internal: self.internal,
            stored_energy: self.stored_energy,
            energy_floor: self.energy_floor,
            residual: self.residual.relative,
            iterations,
            negative_energy: self.negative_energy,
            mechanisms,
            closed: self.met.closed,
            touching: self.met.touching.into(),
            stresses: OnceLock::new(),
        }
    }
}
