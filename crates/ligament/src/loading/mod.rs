//! Supports, loads and probes of a setup on its model.

mod boundary;
mod places;
mod temperature;
mod vibration;

use ligament_analysis::Boundary;
use ligament_analysis::driver::Problem;
use ligament_analysis::probe::Probe;
use ligament_analysis::stiffness::SolverSettings;
use ligament_model::BondSystem;
use ligament_model::failure::Criteria;

pub use places::{material_of_cell, no_fail};
pub use vibration::Vibration;

use crate::error::SetupError;
use crate::setup::Setup;
use boundary::{boundary, couples_have_stiffness};

/// What a setup does to its model, and what it reads off.
#[derive(Debug)]
pub struct Loading {
    /// Supports and loads.
    pub boundary: Boundary,
    /// Probes.
    pub probes: Vec<Probe>,
    /// How the equations are solved.
    pub solver: SolverSettings,
}

impl Loading {
    /// The loading of a setup on the points and bonds of a model.
    ///
    /// # Errors
    ///
    /// If a name of the setup is not in the body, supports and loads contradict each other, or a couple acts on nothing.
    pub fn new(setup: &Setup, system: &BondSystem) -> Result<Self, SetupError> {
        let boundary = boundary(setup, &system.cloud)?;
        couples_have_stiffness(setup, &boundary, system)?;
        Ok(Self {
            boundary,
            probes: setup.probes.iter().map(|it| it.on(system)).collect(),
            solver: setup.solver,
        })
    }

    /// The problem that it makes of the bonds and their failure criteria.
    pub fn problem<'a>(&'a self, system: &'a BondSystem, criteria: &'a Criteria) -> Problem<'a> {
        Problem {
            system,
            criteria,
            boundary: &self.boundary,
            solver: self.solver,
            probes: &self.probes,
        }
    }
}
