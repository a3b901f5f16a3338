//! What a modal case asks for.

use std::sync::Arc;

use ligament_analysis::modal::{ModalProblem, ModalSettings, Rotations};
use ligament_analysis::solver::SolverSettings;
use ligament_analysis::{Component, Supports};
use ligament_model::{BondSystem, LumpedMass, PointCloud};

use super::boundary::place_name;
use super::places::Places;
use super::solver;
use crate::body::Body;
use crate::case::{self, CaseError, CaseFile, Modal};

/// The supports on the points.
fn supports(case: &CaseFile, body: &dyn Body, cloud: &PointCloud) -> Result<Supports, CaseError> {
    let places = Places { case, body, cloud };
    let mut supports = Supports::none(cloud.len());
    for (index, support) in case.case.supports.iter().enumerate() {
        let points = places.points(&format!("support.{index}"), Some(&support.place))?;
        let held = &support.displacement;
        let components: Vec<Component> = [
            (Component::X, held.x),
            (Component::Y, held.y),
            (Component::Rotation, held.rotation),
        ]
        .into_iter()
        .filter_map(|(component, value)| value.map(|_| component))
        .collect();
        supports.hold(&place_name(&support.place, index), points, &components);
    }
    Ok(supports)
}

/// The masses of the points; every material of a modal case has a density.
fn mass(case: &CaseFile, cloud: &PointCloud) -> LumpedMass {
    let materials = case.case.materials.iter();
    let densities: Vec<f64> = materials.filter_map(|material| material.density).collect();
    LumpedMass::new(cloud, &densities)
}

/// What a modal case makes of its model.
#[derive(Debug)]
pub struct Vibration {
    /// Supports.
    pub supports: Arc<Supports>,
    /// Masses of the points.
    pub mass: Arc<LumpedMass>,
    /// How the equations are solved.
    pub solver: SolverSettings,
}

impl Vibration {
    /// That of a case on the points of its body.
    ///
    /// # Errors
    ///
    /// If a name of the case is not in the body.
    pub fn of(case: &CaseFile, body: &dyn Body, cloud: &PointCloud) -> Result<Self, CaseError> {
        Ok(Self {
            supports: Arc::new(supports(case, body, cloud)?),
            mass: Arc::new(mass(case, cloud)),
            solver: solver(case),
        })
    }

    /// The problem that it makes of the bonds.
    pub fn problem(&self, system: &Arc<BondSystem>) -> ModalProblem {
        ModalProblem {
            system: system.clone(),
            mass: self.mass.clone(),
            supports: self.supports.clone(),
            solver: self.solver,
        }
    }
}

/// Which modes, and how.
pub fn modal(modal: &Modal) -> ModalSettings {
    ModalSettings {
        modes: modal.modes as usize,
        rotations: match modal.rotations {
            case::Rotations::Auto => None,
            case::Rotations::Inertia => Some(Rotations::Inertia),
            case::Rotations::Massless => Some(Rotations::Massless),
        },
        tolerance: modal.tolerance,
    }
}
