//! Summary of the solver of a run and its work.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::Text;

/// The solver and its work.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct SolverSummary {
    /// Method: `direct`, `iterative` or, with several processes, `distributed`.
    pub method: Text,
    /// Reason for the method.
    pub reason: Text,
    /// Choices for the matrix factor.
    #[serde(flatten)]
    pub factor: Option<FactorSummary>,
    /// Choices for conjugate gradients.
    #[serde(flatten)]
    pub iteration: Option<IterationSummary>,
    /// Number of processes, where several solve the equations together.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ranks: Option<usize>,
    /// Number of threads.
    pub threads: usize,
    /// Number of factorisations; of the coarse space where the method is iterative.
    pub factorisations: usize,
    /// Number of updates of the factor in place.
    pub changes: usize,
    /// Number of solves, including those after an update.
    pub solves: usize,
    /// Time in numbering, pattern and symbolic analysis, s.
    pub analysis_seconds: f64,
    /// Time in assembly, s.
    pub assembly_seconds: f64,
    /// Time in factorisations, s.
    pub factorisation_seconds: f64,
    /// Time in updates in place, including their forward substitutions, s.
    pub change_seconds: f64,
    /// Time in the backward substitutions after updates, s.
    pub backward_seconds: f64,
    /// Time in other solves, s.
    pub solve_seconds: f64,
    /// Time in loops over bonds: deformations, forces, energies, criteria, s.
    pub bonds_seconds: f64,
    /// Time in the search for detached parts, s.
    pub connectivity_seconds: f64,
}

/// Choices for the matrix factor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FactorSummary {
    /// Factorisation: `llt`, `ldlt` or, of forces without an energy, `lu`.
    pub factorisation: Text,
    /// Elimination order: `nested-dissection` or `minimum-degree`.
    pub ordering: Text,
    /// Treatment of the factor when bonds break: `incremental` or `refactor`.
    pub update: Text,
}

/// Choices for conjugate gradients, and the number of iterations.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct IterationSummary {
    /// Residual tolerance after a breakage, relative to the forces that may act at a point.
    pub tolerance: f64,
    /// Largest number of points of an aggregate whose rigid motions form the coarse space; none without a coarse space of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub aggregate: Option<usize>,
    /// Number of iterations of all solves.
    pub iterations: usize,
}
