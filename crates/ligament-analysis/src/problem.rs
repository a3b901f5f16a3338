//! A problem: a body and what happens to it.

use std::sync::Arc;

use ligament_model::Bonds;
use ligament_model::failure::Criteria;

use crate::load_program::LoadProgram;
use crate::probe::Probe;
use crate::solver::SolverSettings;

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
