//! Supports, loads and probes of a case on its model.

use std::sync::Arc;

use ligament_analysis::ProportionalLoading;
use ligament_analysis::driver::Problem;
use ligament_analysis::probe::Probe;
use ligament_analysis::solver::SolverSettings;
use ligament_model::BondSystem;
use ligament_model::failure::Criteria;

use super::boundary::{boundary, couples_have_stiffness};
use super::{probes, solver};
use crate::body::Body;
use crate::case::{CaseError, CaseFile};

/// What a case does to its model, and what it reads off.
#[derive(Debug)]
pub struct Loading {
    /// Supports and loads.
    pub boundary: Arc<ProportionalLoading>,
    /// Probes.
    pub probes: Arc<[Probe]>,
    /// How the equations are solved.
    pub solver: SolverSettings,
}

impl Loading {
    /// That of a case on the points and bonds of its body.
    ///
    /// # Errors
    ///
    /// If a name of the case is not in the body, supports and loads contradict each other, or a couple acts on nothing.
    pub fn of(case: &CaseFile, body: &dyn Body, system: &BondSystem) -> Result<Self, CaseError> {
        let boundary = boundary(case, body, &system.cloud)?;
        couples_have_stiffness(case, &boundary, system)?;
        Ok(Self {
            boundary: Arc::new(boundary),
            probes: probes(case, system).into(),
            solver: solver(case),
        })
    }

    /// The problem that it makes of the bonds and their failure criteria.
    pub fn problem(&self, system: &Arc<BondSystem>, criteria: &Arc<Criteria>) -> Problem {
        Problem {
            system: system.clone(),
            criteria: criteria.clone(),
            loads: self.boundary.clone(),
            solver: self.solver,
            probes: self.probes.clone(),
        }
    }
}
