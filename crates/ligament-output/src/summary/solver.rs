//! The solver of a run and its work.

use serde::{Deserialize, Serialize};

use super::Text;

/// The solver and its work.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct SolverSummary {
    /// `direct`, `iterative` or, of several processes, `distributed`.
    pub method: Text,
    /// Why it was this one.
    pub reason: Text,
    /// What was chosen for a factor.
    #[serde(flatten)]
    pub factor: Option<FactorSummary>,
    /// What was chosen for conjugate gradients.
    #[serde(flatten)]
    pub iteration: Option<IterationSummary>,
    /// Processes, where several solve the equations together.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ranks: Option<usize>,
    /// Threads.
    pub threads: usize,
    /// Factorisations; of the coarse space where the method is iterative.
    pub factorisations: usize,
    /// Changes of a factor in place.
    pub changes: usize,
    /// Solves, those after a change included.
    pub solves: usize,
    /// Time in numbering, pattern and symbolic analysis, s.
    pub analysis_seconds: f64,
    /// Time in assembly, s.
    pub assembly_seconds: f64,
    /// Time in factorisations, s.
    pub factorisation_seconds: f64,
    /// Time in changes in place, with the forward substitution that goes along, s.
    pub change_seconds: f64,
    /// Time in the backward substitutions that follow them, s.
    pub backward_seconds: f64,
    /// Time in other solves, s.
    pub solve_seconds: f64,
    /// Time on bonds: deformations, forces, energies, criterion, s.
    pub bonds_seconds: f64,
    /// Time in the search for loose parts, s.
    pub connectivity_seconds: f64,
}

/// What was chosen for a factor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FactorSummary {
    /// Factorisation: `llt`, `ldlt` or, of forces without an energy, `lu`.
    pub factorisation: Text,
    /// Order of elimination: `nested-dissection` or `minimum-degree`.
    pub ordering: Text,
    /// What happened to the factor when bonds broke: `incremental` or `refactor`.
    pub update: Text,
}

/// What was chosen for conjugate gradients, and what they took.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct IterationSummary {
    /// Force left out of balance after a breakage, relative to the forces that may act at a point.
    pub tolerance: f64,
    /// Points at most of the aggregates whose rigid motions are its coarse space, where it has one of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub aggregate: Option<usize>,
    /// Iterations of all solves.
    pub iterations: usize,
}
