//! Supports, loads and probes of a setup on its model.

mod boundary;
mod contact;
mod fronts;
mod motion;
mod near_cells;
mod places;
mod probes;
mod programme;
mod restraints;
mod rigid_surface;
mod samples;
mod temperature;
mod tips;
mod vibration;

use std::sync::Arc;

use ligament_analysis::contact::ContactProblem;
use ligament_analysis::driver::Problem;
use ligament_analysis::motion::MotionProblem;
use ligament_analysis::probe::{Probe, Reading};
use ligament_analysis::solver::SolverSettings;
use ligament_analysis::{LoadProgram, LoadsInTime, ProportionalLoading, StagedLoading, gauges};
use ligament_model::System;

pub use contact::contact_problem;
pub use motion::Inertia;
pub(crate) use near_cells::REACH;
pub use near_cells::near_cells;
use places::Places;
pub(crate) use places::points_known_to_all;
pub use places::{material_of_cell, no_fail};
pub use vibration::Vibration;

use crate::error::{Fault, Field, SetupError};
use crate::model::Model;
use crate::setup::{self, Setup};
use crate::system::over_dimension;
use boundary::{ActiveLoads, boundary, require_rotational_stiffness};
use motion::{in_time, inertia};
use programme::staged;
use restraints::restrained;

/// Supports, loads and probes of a setup, for its model.
#[derive(Debug)]
pub struct Loading {
    /// Supports and loads at load factor 1.
    pub boundary: Arc<ProportionalLoading>,
    /// Supports and loads at the first part of the stages; none without stages.
    pub staged: Option<Arc<StagedLoading>>,
    /// Supports and loads as functions of time; none without a motion.
    pub in_time: Option<Arc<LoadsInTime>>,
    /// Masses, initial velocities and quiet edges; none without a motion.
    pub inertia: Option<Inertia>,
    /// Contacts between surfaces; empty without a motion.
    pub contact: ContactProblem,
    /// Coefficient of friction on faces of cracks that close.
    pub face_friction: f64,
    /// Probes.
    pub probes: Arc<[Probe]>,
    /// Settings of the equation solver.
    pub solver: SolverSettings,
}

impl Loading {
    /// The loading of a model.
    ///
    /// # Errors
    ///
    /// If a name of the setup is not in the body, a probe is off the body or its section crosses no bond, supports and loads contradict
    /// each other, or a couple acts on points without rotational stiffness.
    pub fn new(model: &Model) -> Result<Self, SetupError> {
        over_dimension!(&model.system, system => Self::on(&model.setup, &**system))
    }

    /// The loading of a setup on the points and bonds of its model.
    fn on<const D: usize>(setup: &Setup, system: &dyn System<D>) -> Result<Self, SetupError> {
        let cloud = &system.cloud;
        let boundary = boundary(setup, cloud, ActiveLoads::All)?;
        require_rotational_stiffness::<D>(setup, &boundary, system)?;
        let places = Places { setup, cloud };
        places.require_probes_on_body()?;
        let numbered = setup.probes.iter().enumerate();
        let probes = numbered.map(|it| probes::on(it, places, system));
        let probes: Arc<[Probe]> = probes.collect::<Result<_, _>>()?;
        require_crossed_sections(setup, &probes, system)?;
        let staged = staged(setup, system, &probes)?;
        let (in_time, inertia) = match setup.analysis.is_motion() {
            true => (
                Some(in_time(setup, system)?),
                Some(inertia(setup, system.topology().layout, cloud)?),
            ),
            false => (None, None),
        };
        let contact = contact::contacts(setup, system)?;
        let boundary = restrained(setup, system, boundary, ActiveLoads::All)?;
        // A body in motion moves by its inertia, and contact may hold a free one; the loads of stages do not balance one another at all times.
        let is_proportional = staged.is_none() && in_time.is_none() && !setup.has_contact();
        let boundary = match is_proportional && gauges::decide_displacement(system, &boundary) {
            true => boundary.displaced_by_all(),
            false => boundary,
        };
        Ok(Self {
            staged: staged.map(Arc::new),
            in_time: in_time.map(Arc::new),
            inertia,
            contact,
            face_friction: setup.closing_friction,
            boundary: Arc::new(boundary),
            probes,
            solver: setup.solver.clone(),
        })
    }

    /// The problem of this loading with the bonds of its model and their failure criteria.
    pub fn problem(&self, model: &Model) -> Problem {
        let loads: Arc<dyn LoadProgram> = match (&self.staged, &self.in_time) {
            (_, Some(in_time)) => in_time.clone(),
            (Some(staged), None) => staged.clone(),
            (None, None) => self.boundary.clone(),
        };
        Problem {
            system: model.system.to_bonds(),
            criteria: model.criteria.clone(),
            loads,
            solver: self.solver.clone(),
            probes: self.probes.clone(),
            notches: model.notches.clone(),
            face_friction: self.face_friction,
            contact: self.contact.clone(),
        }
    }

    /// The problem of this loading as a motion in time; `None` without a motion.
    pub fn motion(&self, problem: &Problem) -> Option<MotionProblem> {
        let inertia = self.inertia.as_ref()?;
        Some(MotionProblem {
            problem: problem.clone(),
            mass: inertia.mass.clone(),
            initial_velocity: inertia.initial_velocity.clone(),
            dashpots: inertia.dashpots.clone(),
        })
    }
}

/// Refuses probes of a force through a line that no bond crosses, or that passes through elements of the far field.
fn require_crossed_sections<const D: usize>(
    setup: &Setup,
    probes: &[Probe],
    system: &dyn System<D>,
) -> Result<(), SetupError> {
    for (index, (asked, probe)) in setup.probes.iter().zip(probes).enumerate() {
        let field = Field::element("probes", index).part("reading");
        if let setup::Reading::Section { line, .. } = asked.reading
            && probes::crosses_far_field(system, line)
        {
            return Err(field.error(Fault::ThroughElements));
        }
        if let Reading::SectionForce { bonds, .. } = &probe.reading
            && !system.topology().subdomain.any(!bonds.is_empty())
        {
            return Err(field.error(Fault::NothingCrossed));
        }
    }
    Ok(())
}
