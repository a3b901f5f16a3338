//! Supports and masses of a model for an analysis of natural modes.

use std::sync::Arc;

use ligament_analysis::modal::ModalProblem;
use ligament_analysis::solver::SolverSettings;
use ligament_analysis::{Component, Supports};
use ligament_model::{LumpedMass, System};

use super::places::Places;
use crate::error::{Field, SetupError};
use crate::model::Model;
use crate::setup::Setup;
use crate::system::over_dimension;

/// Supports and masses of a model.
#[derive(Debug)]
pub struct Vibration {
    /// Supports.
    pub supports: Arc<Supports>,
    /// Masses of the points.
    pub mass: Arc<LumpedMass>,
    /// Settings of the equation solver.
    pub solver: SolverSettings,
}

impl Vibration {
    /// Supports and masses of a model.
    ///
    /// # Errors
    ///
    /// If a name of the setup is not in the body.
    pub fn new(model: &Model) -> Result<Self, SetupError> {
        over_dimension!(&model.system, system => Self::on(&model.setup, &**system))
    }

    fn on<const D: usize>(setup: &Setup, system: &dyn System<D>) -> Result<Self, SetupError> {
        let materials = setup.materials.iter();
        let densities: Vec<f64> = materials.filter_map(|it| it.material.density).collect();
        Ok(Self {
            supports: Arc::new(supports(setup, system)?),
            mass: Arc::new(LumpedMass::new(&system.cloud, &densities)),
            solver: setup.solver.clone(),
        })
    }

    /// The eigenvalue problem of the supports and masses with the bonds of the model.
    pub fn problem(&self, model: &Model) -> ModalProblem {
        ModalProblem {
            system: model.system.to_bonds(),
            mass: self.mass.clone(),
            supports: self.supports.clone(),
            solver: self.solver.clone(),
        }
    }
}

/// The fixed components of the points.
fn supports<const D: usize>(setup: &Setup, system: &dyn System<D>) -> Result<Supports, SetupError> {
    let cloud = &system.cloud;
    let places = Places { setup, cloud };
    let mut supports = Supports::none(system.topology().layout);
    for (index, support) in setup.supports.iter().enumerate() {
        let points = places.points(Field::element("supports", index), &support.place)?;
        let components: Vec<Component> = support.components().collect();
        supports.hold(&support.name(index), points, &components);
    }
    Ok(supports)
}
