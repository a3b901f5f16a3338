//! A problem: a body and what happens to it.

use std::borrow::Cow;
use std::sync::Arc;

use ligament_model::Bonds;
use ligament_model::failure::Criteria;
use ligament_model::stress::point_strain::Motion;

use crate::balanced::Balanced;
use crate::load_program::LoadProgram;
use crate::probe::Probe;
use crate::solver::SolverSettings;
use crate::state::State;

/// A problem: bonds, what acts on them, and what to read off. A copy shares the parts.
#[derive(Clone)]
pub struct Problem {
    /// The bond system.
    pub system: Arc<dyn Bonds>,
    /// Failure criteria; an elastic analysis has none.
    pub criteria: Arc<Criteria>,
    /// Supports and loads.
    pub loads: Arc<dyn LoadProgram>,
    /// Settings of the solver of the equations.
    pub solver: SolverSettings,
    /// Probes.
    pub probes: Arc<[Probe]>,
}

impl Problem {
    /// The criteria with the limits and measures that the bonds have in an equilibrium.
    pub fn criteria_in(&self, state: &State, balanced: &Balanced) -> Cow<'_, Criteria> {
        let motion = Motion {
            intact: &state.intact,
            displacement: &state.displacement,
            expansion: self.loads.thermal_strain(state.load_factor),
        };
        let (system, deformations) = (&*self.system, &balanced.deformations);
        self.criteria.in_state(system, motion, deformations)
    }
}
