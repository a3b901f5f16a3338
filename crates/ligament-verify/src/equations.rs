//! Sizes of the equations of a model, a measure of the work on any machine.

use anyhow::Context;
use ligament::setup::ELASTIC_ENERGY_TOLERANCE;
use ligament::{Loading, Model};
use ligament_analysis::Equilibrium;

/// Sizes of the equations of equilibrium, with the program's elimination order.
#[derive(Debug, Clone, Copy)]
pub(super) struct Equations {
    /// Number of bonds.
    pub(super) bonds: f64,
    /// Number of unknowns, the order of the stiffness matrix.
    pub(super) unknowns: f64,
    /// Number of entries of the matrix's lower triangle.
    pub(super) matrix: f64,
    /// Number of values of the matrix's factor.
    pub(super) factor: f64,
    /// Number of multiplications of the factorisation.
    pub(super) multiplications: f64,
}

impl Equations {
    /// The sizes of the equations of a model.
    ///
    /// # Errors
    ///
    /// If the supports and loads, or the equations, cannot be set up.
    pub(super) fn from_model(model: &Model) -> anyhow::Result<Self> {
        let loading = Loading::new(model)?;
        let problem = loading.problem(model);
        let equilibrium = Equilibrium::new(&problem, ELASTIC_ENERGY_TOLERANCE)?;
        let stiffness = equilibrium.stiffness();
        let stiffness = stiffness.context("the equations are solved without a matrix")?;
        let symbolic = stiffness.symbolic();
        Ok(Self {
            bonds: model.plane().bonds.len() as f64,
            unknowns: stiffness.unknowns().len() as f64,
            matrix: symbolic.pattern().n_entries() as f64,
            factor: symbolic.n_factor_values() as f64,
            multiplications: symbolic.n_multiplications(),
        })
    }
}
