//! The intact body from which several runs begin.

use super::run::Run;
use super::start::{Start, begin};
use super::way::StopRules;
use crate::equilibrium::{Equilibrium, IntactEquilibrium};
use crate::error::SetupError;
use crate::history::{Observer, Termination};
use crate::problem::Problem;
use crate::state::State;

/// Intact body with the equations of a problem, their factor and the elastic solution, from which runs begin that differ in the limits of
/// their bonds alone.
///
/// A run that begins from here has the bits of a run that prepares itself. Only a direct solver with a symmetric factor is shared; with
/// another one each run prepares itself.
pub struct Prepared {
    energy_tolerance: f64,
    shared: Option<(IntactEquilibrium, Start)>,
}

impl Prepared {
    /// Factorises the stiffness of the intact body and solves once at load factor one; `energy_tolerance` is that of the runs.
    ///
    /// # Errors
    ///
    /// If the equations cannot be set up, or the observer fails.
    pub fn new(
        problem: &Problem,
        energy_tolerance: f64,
        observer: &mut dyn Observer,
    ) -> Result<Self, SetupError> {
        let mut equilibrium = Equilibrium::new(problem, energy_tolerance)?;
        let start = begin(problem, &mut equilibrium, observer)?;
        Ok(Self {
            energy_tolerance,
            shared: equilibrium.intact().map(|it| (it, start)),
        })
    }

    /// End of all runs where the intact model is unstable, unless the problem allows that.
    pub fn refused(&self, problem: &Problem) -> Option<Termination> {
        let (_, start) = self.shared.as_ref()?;
        start.elastic.refused(problem)
    }

    /// Whether the runs share the factor.
    pub fn is_shared(&self) -> bool {
        self.shared.is_some()
    }

    /// Run of a problem that differs from the prepared one in its criteria, before its first step; also returns the equilibrium at load
    /// factor one, if there is one.
    pub(super) fn begun<'a>(
        &self,
        problem: &Problem,
        stop: StopRules,
        observer: &'a mut dyn Observer,
    ) -> Result<(Run<'a>, Option<State>), SetupError> {
        let Some((intact, start)) = &self.shared else {
            return Run::begin(problem, self.energy_tolerance, stop, observer);
        };
        let equilibrium = intact.judged_by(&problem.criteria);
        let mut start = start.clone();
        start.read_off(problem);
        Ok(Run::begun(problem, (equilibrium, start), stop, observer))
    }
}
