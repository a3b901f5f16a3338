//! How large the equations of a model are: what its work goes with, on every machine.

use anyhow::Context;
use ligament::setup::ELASTIC_ENERGY_TOLERANCE;
use ligament::{Loading, Model};
use ligament_analysis::Equilibrium;

/// Sizes of the equations of equilibrium, with the order of elimination that the program chooses.
#[derive(Debug, Clone, Copy)]
pub(super) struct Equations {
    /// Unknowns: the order of the stiffness matrix.
    pub(super) unknowns: f64,
    /// Entries of its lower triangle.
    pub(super) matrix: f64,
    /// Values of its factor.
    pub(super) factor: f64,
    /// Multiplications that the factor takes.
    pub(super) multiplications: f64,
}

impl Equations {
    /// The sizes of the equations of a model.
    ///
    /// # Errors
    ///
    /// If its supports and loads, or the equations, cannot be made.
    pub(super) fn from_model(model: &Model) -> anyhow::Result<Self> {
        let loading = Loading::new(model)?;
        let problem = loading.problem(model);
        let equilibrium = Equilibrium::new(&problem, ELASTIC_ENERGY_TOLERANCE)?;
        let stiffness = equilibrium.stiffness();
        let stiffness = stiffness.context("the equations are solved without a matrix")?;
        let symbolic = stiffness.symbolic();
        Ok(Self {
            unknowns: stiffness.unknowns().len() as f64,
            matrix: symbolic.pattern().n_entries() as f64,
            factor: symbolic.n_factor_values() as f64,
            multiplications: symbolic.n_multiplications(),
        })
    }
}
