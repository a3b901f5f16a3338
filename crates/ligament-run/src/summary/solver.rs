//! The solver of a run and its work.

use ligament_analysis::costs::Costs;
use ligament_analysis::solver::{FactorKind, Ordering, SolverChoice, Update};
use serde::Serialize;

/// The solver and its work.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SolverSummary {
    /// Factorisation: `llt`, `ldlt` or, of forces without an energy, `lu`.
    pub factorisation: &'static str,
    /// Order of elimination: `nested-dissection` or `minimum-degree`.
    pub ordering: &'static str,
    /// What happened to the factor when bonds broke: `incremental` or `refactor`.
    pub update: &'static str,
    /// Threads.
    pub threads: usize,
    /// Factorisations.
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

impl SolverSummary {
    /// What was chosen, and what it cost.
    pub fn new(costs: &Costs, choice: &SolverChoice) -> Self {
        Self {
            factorisation: match choice.factorisation {
                _ if choice.unsymmetric => "lu",
                FactorKind::Llt => "llt",
                FactorKind::Ldlt => "ldlt",
            },
            ordering: match choice.ordering {
                Ordering::NestedDissection => "nested-dissection",
                Ordering::MinimumDegree => "minimum-degree",
            },
            update: match choice.update {
                Update::Incremental => "incremental",
                Update::Refactor => "refactor",
            },
            threads: rayon::current_num_threads(),
            factorisations: costs.factorisations,
            changes: costs.changes,
            solves: costs.solves,
            analysis_seconds: costs.analysis.as_secs_f64(),
            assembly_seconds: costs.assembly.as_secs_f64(),
            factorisation_seconds: costs.factorisation.as_secs_f64(),
            change_seconds: costs.change.as_secs_f64(),
            backward_seconds: costs.backward.as_secs_f64(),
            solve_seconds: costs.solve.as_secs_f64(),
            bonds_seconds: costs.bonds.as_secs_f64(),
            connectivity_seconds: costs.connectivity.as_secs_f64(),
        }
    }
}
