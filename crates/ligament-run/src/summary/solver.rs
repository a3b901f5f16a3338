//! The solver of a run and its work.

use ligament_analysis::costs::Costs;
use ligament_analysis::solver;
use ligament_analysis::solver::{DirectChoice, FactorKind, Ordering, SolverChoice, Update};
use serde::{Serialize, Serializer};

/// The solver and its work.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SolverSummary {
    /// `direct`, `iterative` or, of several processes, `distributed`.
    pub method: &'static str,
    /// Why it was this one.
    pub reason: Reason,
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
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FactorSummary {
    /// Factorisation: `llt`, `ldlt` or, of forces without an energy, `lu`.
    pub factorisation: &'static str,
    /// Order of elimination: `nested-dissection` or `minimum-degree`.
    pub ordering: &'static str,
    /// What happened to the factor when bonds broke: `incremental` or `refactor`.
    pub update: &'static str,
}

/// What was chosen for conjugate gradients, and what they took.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct IterationSummary {
    /// Force left out of balance after a breakage, relative to the forces that may act at a point.
    pub tolerance: f64,
    /// Points at most of the aggregates whose rigid motions are its coarse space, where it has one of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub aggregate: Option<usize>,
    /// Iterations of all solves.
    pub iterations: usize,
}

impl FactorSummary {
    fn new(choice: &DirectChoice) -> Self {
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
        }
    }
}

/// Why a method was chosen, as words.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reason(solver::Reason);

impl Serialize for Reason {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&self.0)
    }
}

impl SolverSummary {
    /// What was chosen, and what it cost.
    pub fn new(costs: &Costs, choice: &SolverChoice) -> Self {
        let iterations = costs.iterations;
        let iteration = |tolerance, aggregate| IterationSummary {
            tolerance,
            aggregate,
            iterations,
        };
        let (method, reason, factor, iteration) = match choice {
            SolverChoice::Direct(it) => ("direct", it.reason, Some(FactorSummary::new(it)), None),
            &SolverChoice::Iterative(it) => {
                let iteration = iteration(it.tolerance, Some(it.aggregate));
                ("iterative", it.reason, None, Some(iteration))
            }
            SolverChoice::Distributed(it) => {
                let iteration = it.tolerance.map(|it| iteration(it, None));
                ("distributed", it.reason, None, iteration)
            }
        };
        let ranks = match choice {
            SolverChoice::Distributed(it) => Some(it.n_ranks),
            SolverChoice::Direct(_) | SolverChoice::Iterative(_) => None,
        };
        Self {
            method,
            reason: Reason(reason),
            factor,
            iteration,
            ranks,
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
