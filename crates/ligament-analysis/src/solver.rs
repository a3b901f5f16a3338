//! Settings of the solver of the equations, and choices where they are left open.

use std::fmt::{self, Display, Formatter};
use std::sync::Arc;

use ligament_linalg::Elimination;
pub use ligament_linalg::FactorKind;
use ligament_model::communicator::SingleProcess;
#[cfg(feature = "case")]
use ligament_model::word::{WordOrAuto, open};
use ligament_model::{Bonds, case_type};
use thiserror::Error;

use crate::critical_step::CriticalStep;
use crate::distributed_matrix::Processes;

/// Largest number of threads: with thousands, waking them takes longer than the work.
pub const MOST_THREADS: u32 = 1024;

// A factor that was updated in place depends on all its updates: a resumed run repeats those since the factor was last computed anew.
case_type! {
    /// How the equations are solved. The results are the same up to rounding.
    #[derive(Debug, Clone, PartialEq)]
    #[case(serde(default))]
    pub struct SolverSettings {
        /// How the equations are solved: with a factor of the matrix or without a matrix.
        #[case(serde(with = "open", skip_serializing_if = "Option::is_none"), schemars(with = "WordOrAuto<Method>"))]
        pub method: Option<Method>,
        /// Force that the iteration leaves out of balance after a breakage, relative to the forces that may act at a point: 1e-8. Bonds that
        /// are nearer to each other than a hundred times this, relatively, break together.
        #[range("minimum" = 1e-10, "maximum" = 1e-3)]
        #[case(serde(skip_serializing_if = "is_usual_tolerance"))]
        pub tolerance: f64,
        /// The factorisation of the stiffness.
        #[case(serde(with = "open"), schemars(with = "WordOrAuto<Factorisation>"))]
        pub factorisation: Option<Factorisation>,
        /// The order of elimination.
        #[case(serde(with = "open"), schemars(with = "WordOrAuto<Ordering>"))]
        pub ordering: Option<Ordering>,
        /// What happens to the factor when bonds break.
        #[case(serde(with = "open"), schemars(with = "WordOrAuto<Update>"))]
        pub update: Option<Update>,
        /// Broken bonds between two factors that are made anew.
        #[range("minimum" = 1)]
        #[case(serde(skip_serializing_if = "is_usual_interval"))]
        pub rebuild_every: usize,
        /// Threads; without it one for each processor. Results do not depend on it.
        #[range("minimum" = 1, "maximum" = MOST_THREADS)]
        pub threads: Option<u32>,
        /// Memory that a run may take, GB; without it what the machine has left. A run that would take more is refused; where the method is
        /// open, bodies in the plane whose factor does not fit are solved without a matrix.
        #[range("exclusiveMinimum" = 0)]
        pub memory: Option<f64>,
        /// Number of points in space from which conjugate gradients have a third level. The factor of the second takes memory as n^(4/3) and
        /// time as n^2 for n points: at 47,000 points both levels are made in 1.7 times the time without a third, and at 97,000 a run takes 1.2 times
        /// the memory (measured).
        #[case(serde(skip))]
        pub clusters_from: usize,
        /// Whether a run goes on where the intact stiffness has more negative eigenvalues than its rotations explain.
        #[case(serde(skip))]
        pub allows_unstable: bool,
        /// Bytes available for the matrix and its factor; `None` where they are unknown.
        #[case(serde(skip))]
        pub factor_memory: Option<usize>,
        /// Processes that solve the equations.
        #[case(serde(skip))]
        pub communicator: Processes,
    }
}

#[cfg(feature = "case")]
fn is_usual_tolerance(tolerance: &f64) -> bool {
    *tolerance == SolverSettings::default().tolerance
}

#[cfg(feature = "case")]
fn is_usual_interval(broken: &usize) -> bool {
    *broken == SolverSettings::default().rebuild_every
}

case_type! {
    /// Method to solve the equations.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[auto("`direct` in the plane as long as the factor fits into memory and in space up to 5,000 points, and where the iteration cannot; `iterative` beyond.")]
    pub enum Method {
        /// With a factor of the matrix.
        Direct,
        /// By conjugate gradients without a matrix, for positive definite stiffness.
        Iterative,
    }
}

/// Reason for the choice of a method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reason {
    /// The settings name the method.
    Named,
    /// The settings contain this key, which applies to a factor alone.
    NamedForFactor(&'static str),
    /// Conjugate gradients cannot solve these equations.
    Unfit(Unfit),
    /// Limit of the number of points, below which a factor costs less than conjugate gradients.
    Points(usize),
    /// The memory of the matrix and its factor, compared with the available memory.
    Memory {
        /// Bytes needed; a lower bound, where they do not fit.
        needed: usize,
        /// Bytes available.
        available: usize,
    },
    /// The stiffness is definite.
    Definite,
}

impl Display for Reason {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Named => f.write_str("as solver.method says"),
            Self::NamedForFactor(word) => {
                write!(f, "solver.{word} is given, which a factor alone has")
            }
            Self::Unfit(unfit) => unfit.fmt(f),
            &Self::Memory { needed, available } => {
                let [needed, available] = [needed, available].map(|bytes| bytes as f64 / 1e9);
                let whether = if needed > available {
                    "does not fit"
                } else {
                    "fits"
                };
                write!(
                    f,
                    "the factor {whether} into memory: {needed:.2} GB of {available:.2} GB"
                )
            }
            Self::Definite => f.write_str("no bond has a negative stiffness"),
            Self::Points(limit) => write!(
                f,
                "the direct solver is faster below {limit} points, the iterative one from there on"
            ),
        }
    }
}

/// Reason why conjugate gradients cannot solve the equations of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum Unfit {
    /// Some bond has a negative stiffness.
    #[error("some bonds have a negative stiffness, so the stiffness of the body may be indefinite")]
    Indefinite,
    /// The forces have no energy.
    #[error(
        "the forces of the bonds are not those of an energy, so that the stiffness is not symmetric"
    )]
    WithoutEnergy,
    /// The forces are not linear in the displacements.
    #[error("the forces of the bonds are not linear in the displacements")]
    NotLinear,
    /// Faces of cracks or surfaces carry pressure where they meet.
    #[error("faces of cracks or surfaces carry pressure where they meet")]
    ClosingFaces,
    /// The settings contain a key that applies to a factor alone.
    #[error("solver.{0} is about a factor, of which there is none")]
    NamedForFactor(&'static str),
    /// The analysis needs a factor.
    #[error("natural modes are counted by the signs of the pivots of a factor")]
    Modes,
}

case_type! {
    /// Factorisation of the stiffness.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[auto("`llt` where every bond has a positive shear stiffness, `ldlt` otherwise.")]
    pub enum Factorisation {
        /// L L^T, for positive definite stiffness.
        Llt,
        /// L D L^T, also for indefinite stiffness.
        Ldlt,
    }
}

impl From<Factorisation> for FactorKind {
    fn from(factorisation: Factorisation) -> Self {
        match factorisation {
            Factorisation::Llt => Self::Llt,
            Factorisation::Ldlt => Self::Ldlt,
        }
    }
}

case_type! {
    /// Elimination order.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[auto("`nested-dissection` from 2,000 points on, `minimum-degree` below.")]
    pub enum Ordering {
        /// Nested dissection of the graph of the matrix.
        NestedDissection,
        /// Approximate minimum degree of the unknowns.
        MinimumDegree,
    }
}

case_type! {
    /// Treatment of the factor when bonds break.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[auto("`incremental`.")]
    pub enum Update {
        /// The factor is changed in place, unless so many bonds break at once that making it anew costs less.
        Incremental,
        /// The factor is made anew every time.
        Refactor,
    }
}

/// Solver chosen for the equations of a problem.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SolverChoice {
    /// A factor of the matrix.
    Direct(DirectChoice),
    /// Conjugate gradients, without a matrix.
    Iterative(IterativeChoice),
    /// A matrix whose rows are distributed over processes.
    Distributed(DistributedChoice),
    /// Explicit steps in time, without equations.
    Explicit(ExplicitChoice),
}

/// Time step chosen for an explicit motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExplicitChoice {
    /// Time step, s.
    pub step: f64,
    /// Largest stable step and what limits it.
    pub critical: CriticalStep,
}

impl ExplicitChoice {
    /// Time step over the critical one.
    pub(crate) fn of_critical(&self) -> f64 {
        self.step / self.critical.step
    }
}

/// Solver chosen for several processes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DistributedChoice {
    /// Reason for conjugate gradients or a factor.
    pub reason: Reason,
    /// Number of the processes.
    pub n_ranks: usize,
    /// Residual of conjugate gradients after a breakage, see [`SolverSettings::tolerance`]; None for a factor.
    pub tolerance: Option<f64>,
}

/// Settings chosen for conjugate gradients.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IterativeChoice {
    /// Reason for conjugate gradients.
    pub reason: Reason,
    /// Residual after a breakage, see [`SolverSettings::tolerance`].
    pub tolerance: f64,
    /// Largest number of points of an aggregate, see [`points_of_aggregate`].
    pub aggregate: usize,
    /// Largest number of points of a cluster of aggregates; none without a third level.
    pub cluster: Option<usize>,
}

/// Settings chosen for a factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DirectChoice {
    /// Reason for a factor.
    pub reason: Reason,
    /// Factorisation.
    pub factorisation: FactorKind,
    /// Whether the stiffness is unsymmetric, and is factorised as L U instead.
    pub unsymmetric: bool,
    /// Elimination order.
    pub ordering: Ordering,
    /// Treatment of the factor when bonds break.
    pub update: Update,
    /// Interval in the number of broken bonds at which the factor is computed anew, see [`SolverSettings::rebuild_every`].
    pub rebuild_every: usize,
    /// Largest number of elements changed at once for an update in place; beyond it, a new factor costs less.
    pub most_bonds_in_place: usize,
}

impl Default for SolverSettings {
    fn default() -> Self {
        Self {
            method: None,
            tolerance: 1e-8,
            factorisation: None,
            ordering: None,
            update: None,
            rebuild_every: 1000,
            threads: None,
            memory: None,
            clusters_from: POINTS_FOR_CLUSTERS,
            allows_unstable: false,
            factor_memory: None,
            communicator: Processes(Arc::new(SingleProcess)),
        }
    }
}

/// Number of points from which the order is nested dissection, and parts of the body may be postponed. It leaves less fill than minimum degree
/// (measured on plates: as much at 1,000 points, 20 % fewer multiplications at 3,000, and a third fewer at 40,000).
pub const POINTS_FOR_DISSECTION: usize = 2_000;

/// Least tie tolerance as a multiple of the tolerance of conjugate gradients: bonds whose measures are closer may come in any
/// order.
pub const TIED: f64 = 100.0;

/// Number of points from which conjugate gradients are chosen, by the number of axes of a body.
pub fn points_for_iteration(n_axes: usize) -> usize {
    if n_axes > 2 { 5_000 } else { 200_000 }
}

/// Number of points in space from which conjugate gradients take less time than a factor for the few solutions of a body of which no bond
/// breaks: at 2,700 points two solutions take 0.3 s instead of 2.8.
const POINTS_FOR_FEW: usize = 500;

/// Largest number of points of an aggregate whose rigid motions span the coarse space, by the number of axes of a body.
///
/// In the plane halving squares of four times as many points ended at ten costs the least time: with at most 5, 10, 20 and 40
/// points of 160,000 a breakage took 12.5, 15, 23 and 26 iterations and 1.3, 1.0, 1.2 and 1.5 times as long.
pub fn points_of_aggregate(n_axes: usize) -> usize {
    if n_axes > 2 { 40 } else { 10 }
}

/// Number of points in space from which clusters of aggregates span the space of a third level, see [`SolverSettings::clusters_from`].
pub const POINTS_FOR_CLUSTERS: usize = 50_000;

/// Largest number of points of a cluster: some sixty aggregates, so that the factor of the clusters costs nothing (512 of them in a body of
/// 10^6 points). The second level takes few more iterations than with a quarter of the points (12 for 9, measured).
const POINTS_OF_CLUSTER: usize = 2560;

impl SolverSettings {
    /// Settings for a few solutions with all bonds of a body, by conjugate gradients in space unless a method was named.
    pub fn for_few_solutions(&self, system: &dyn Bonds) -> Self {
        let is_solid = n_axes(system) > 2 && system.n_points() >= POINTS_FOR_FEW;
        let iterates = self.method.is_none() && is_solid && self.unfit(system).is_none();
        Self {
            method: if iterates {
                Some(Method::Iterative)
            } else {
                self.method
            },
            ..self.clone()
        }
    }

    /// Method for the equations of some bonds, and the reason for it.
    ///
    /// # Errors
    ///
    /// If conjugate gradients were named and cannot solve the equations.
    pub fn chosen_method(&self, system: &dyn Bonds) -> Result<(Method, Reason), Unfit> {
        match self.method {
            Some(Method::Direct) => Ok((Method::Direct, Reason::Named)),
            Some(Method::Iterative) => match self.unfit(system) {
                Some(unfit) => Err(unfit),
                None => Ok((Method::Iterative, Reason::Named)),
            },
            None => Ok(self.suitable_method(system)),
        }
    }

    /// Memory limit of a matrix and its factor in bytes, where it decides between the methods: in the plane a factor that fits
    /// costs less than conjugate gradients for any number of points (`docs/solvers.md`).
    pub(crate) fn bound_of_factor(&self, system: &dyn Bonds) -> Option<usize> {
        let decides = self.method.is_none() && n_axes(system) == 2 && self.unfit(system).is_none();
        self.factor_memory.filter(|_| decides)
    }

    /// Settings of conjugate gradients for some bonds.
    pub(crate) fn iterative_choice(&self, system: &dyn Bonds, reason: Reason) -> IterativeChoice {
        IterativeChoice {
            reason,
            tolerance: self.tolerance,
            aggregate: points_of_aggregate(n_axes(system)),
            cluster: (n_axes(system) > 2 && system.n_points() >= self.clusters_from)
                .then_some(POINTS_OF_CLUSTER),
        }
    }

    fn suitable_method(&self, system: &dyn Bonds) -> (Method, Reason) {
        let limit = points_for_iteration(n_axes(system));
        let is_large = system.n_points() >= limit;
        match self.unfit(system).filter(|_| is_large) {
            Some(Unfit::NamedForFactor(word)) => (Method::Direct, Reason::NamedForFactor(word)),
            Some(unfit) => (Method::Direct, Reason::Unfit(unfit)),
            None if is_large => (Method::Iterative, Reason::Points(limit)),
            None => (Method::Direct, Reason::Points(limit)),
        }
    }

    /// Solver of several processes for the equations of some bonds.
    ///
    /// # Errors
    ///
    /// If several processes cannot solve these equations.
    pub(crate) fn distributed_choice(
        &self,
        system: &dyn Bonds,
        n_ranks: usize,
    ) -> Result<DistributedChoice, Unfit> {
        let open = Self {
            method: None,
            ..self.clone()
        };
        let (is_definite, reason) = match (open.unfit(system), self.method) {
            (None, Some(Method::Direct)) => (false, Reason::Named),
            (None, Some(Method::Iterative)) => (true, Reason::Named),
            (None, None) => (true, Reason::Definite),
            (Some(Unfit::Indefinite), None | Some(Method::Direct)) => {
                (false, Reason::Unfit(Unfit::Indefinite))
            }
            (Some(unfit), _) => return Err(unfit),
        };
        if system.faces_close {
            return Err(Unfit::ClosingFaces);
        }
        Ok(DistributedChoice {
            reason,
            n_ranks,
            tolerance: is_definite.then_some(self.tolerance),
        })
    }

    fn unfit(&self, system: &dyn Bonds) -> Option<Unfit> {
        let named = [
            (self.factorisation.is_some(), "factorisation"),
            (self.ordering.is_some(), "ordering"),
            (self.update.is_some(), "update"),
        ];
        if !system.element.has_energy() {
            return Some(Unfit::WithoutEnergy);
        }
        if !system.element.is_linear() {
            return Some(Unfit::NotLinear);
        }
        if system.rigidities().some_negative(&system.subdomain) {
            return Some(Unfit::Indefinite);
        }
        let named = named.into_iter().find(|(is_named, _)| *is_named);
        named.map(|(_, word)| Unfit::NamedForFactor(word))
    }
}

/// Number of space axes of a body.
pub fn n_axes(system: &dyn Bonds) -> usize {
    let components = system.layout.components.iter();
    components.filter(|it| !it.is_rotation()).count()
}

impl SolverChoice {
    /// Tie tolerance for a requested one, see [`TIED`].
    pub fn tie_tolerance(&self, asked: f64) -> f64 {
        let tolerance = self.tolerance().map(|it| TIED * it);
        tolerance.map_or(asked, |tied| asked.max(tied))
    }

    /// Whether the solver is iterative.
    pub fn iterates(&self) -> bool {
        self.tolerance().is_some()
    }

    /// Residual after a breakage, see [`SolverSettings::tolerance`]; None for a direct solver.
    fn tolerance(&self) -> Option<f64> {
        match self {
            Self::Direct(_) | Self::Explicit(_) => None,
            Self::Iterative(choice) => Some(choice.tolerance),
            Self::Distributed(choice) => choice.tolerance,
        }
    }
}

impl Ordering {
    /// Default ordering for a number of points.
    pub fn suited_to(n_points: usize) -> Self {
        if n_points < POINTS_FOR_DISSECTION {
            Self::MinimumDegree
        } else {
            Self::NestedDissection
        }
    }
}

impl From<Ordering> for Elimination {
    fn from(ordering: Ordering) -> Self {
        match ordering {
            Ordering::MinimumDegree => Self::MinimumDegree,
            Ordering::NestedDissection => Self::NestedDissection,
        }
    }
}
