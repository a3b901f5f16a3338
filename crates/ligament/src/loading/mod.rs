//! Supports, loads and probes of a setup on its model.

mod boundary;
mod places;
mod temperature;
mod vibration;

use std::sync::Arc;

use ligament_analysis::ProportionalLoading;
use ligament_analysis::driver::Problem;
use ligament_analysis::probe::Probe;
use ligament_analysis::solver::SolverSettings;
use ligament_model::failure::Criteria;
use ligament_model::{BondSystem, Bonds};

use places::Places;
pub use places::{material_of_cell, no_fail};
pub use vibration::Vibration;

use crate::error::SetupError;
use crate::setup::Setup;
use boundary::{boundary, couples_have_stiffness};

/// Supports, loads and probes of a setup, for its model.
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
    /// The loading of a setup on the points and bonds of a model.
    ///
    /// # Errors
    ///
    /// If a name of the setup is not in the body, a probe is off it, supports and loads contradict each other, or a couple acts on nothing.
    pub fn new(setup: &Setup, system: &BondSystem) -> Result<Self, SetupError> {
        let boundary = boundary(setup, &system.cloud)?;
        couples_have_stiffness(setup, &boundary, system)?;
        let places = Places {
            setup,
            cloud: &system.cloud,
        };
        places.require_probes_on_body()?;
        Ok(Self {
            boundary: Arc::new(boundary.reduced(system.layout())),
            probes: setup.probes.iter().map(|it| it.on(system)).collect(),
            solver: setup.solver,
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
