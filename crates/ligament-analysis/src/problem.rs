//! Problem: a body with its loads, criteria and probes.

use std::sync::Arc;

use ligament_model::Bonds;
use ligament_model::failure::Criteria;

use crate::load_program::LoadProgram;
use crate::probe::Probe;
use crate::solver::SolverSettings;

/// Problem: bonds, loads, criteria, solver and probes. A copy shares its data.
#[derive(Clone)]
pub struct Problem {
    /// Bonds between the points of the body.
    pub system: Arc<dyn Bonds>,
    /// Failure criteria; empty in an elastic analysis.
    pub criteria: Arc<Criteria>,
    /// Supports and loads.
    pub loads: Arc<dyn LoadProgram>,
    /// Settings of the solver of the equations.
    pub solver: SolverSettings,
    /// Probes of the history.
    pub probes: Arc<[Probe]>,
}
