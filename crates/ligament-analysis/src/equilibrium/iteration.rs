//! The iteration to equilibrium: one loop for all ways to correct a state.

use super::equations::{Equations, Iterate};
use crate::balanced::Attempt;
use crate::breakage::Breakage;
use crate::history::{Observer, ObserverError};
use crate::state::State;
use crate::unbalanced::Unbalanced;

/// Method to correct a state until it is in equilibrium.
pub(super) trait Method {
    /// First iterate of a state; a correction that the solver makes with its update for the breakage is the first one.
    fn begin(&mut self, at: &mut Iteration<'_>) -> Iterate {
        at.begin()
    }

    /// Whether an iterate is an equilibrium; an earlier iterate, to which the state returns, may take its place.
    fn is_met(&mut self, at: &mut Iteration<'_>, iterate: &mut Iterate) -> bool;

    /// Records an equilibrium.
    fn settle(&mut self, _at: &mut Iteration<'_>) {}

    /// Whether no further correction is tried.
    fn gives_up(&self, at: &Iteration<'_>) -> bool;

    /// Corrects the state and measures it.
    ///
    /// # Errors
    ///
    /// If there is no correction.
    fn correct(&mut self, at: &mut Iteration<'_>, iterate: &Iterate)
    -> Result<Iterate, Unbalanced>;
}

/// A state on its way to equilibrium after a breakage.
pub(super) struct Iteration<'a> {
    pub(super) equations: &'a mut Equations,
    pub(super) state: &'a mut State,
    pub(super) breakage: &'a Breakage,
    /// Number of corrections so far.
    pub(super) number: usize,
    /// Points of mechanisms that the solver found, which are fixed from now on.
    pub(super) mechanisms: Vec<u32>,
    /// Energy of the iterate before, J; NaN at the first one.
    previous_energy: f64,
}

impl Iteration<'_> {
    /// Sets the prescribed motions, updates the solver for the breakage, and measures the state.
    pub(super) fn begin(&mut self) -> Iterate {
        self.equations.prescribe(self.state);
        self.number = usize::from(self.equations.follow(self.state, self.breakage));
        self.measure()
    }

    pub(super) fn measure(&mut self) -> Iterate {
        self.equations.measure(self.state)
    }

    /// Relative residual to be reached.
    pub(super) fn sought(&self) -> f64 {
        self.equations.accuracy.sought(self.breakage)
    }

    /// Whether the residual of an iterate is within the tolerance; before the first solution it must be zero, as without loads.
    pub(super) fn is_small(&self, iterate: &Iterate, tolerance: f64) -> bool {
        let costs = &self.equations.costs;
        let is_guess = costs.solves == 0 && costs.changes == 0;
        iterate.residual.relative <= if is_guess { 0.0 } else { tolerance }
    }

    /// Whether the energy of an iterate equals the energy of the previous one to the tolerance (NHPD eq. 21), and its residual is at most
    /// `largest_residual`.
    pub(super) fn energy_settled(&self, iterate: &Iterate, largest_residual: f64) -> bool {
        let energy = iterate.stored_energy;
        let change = ((energy - self.previous_energy) / energy).abs();
        change < self.equations.energy_tolerance && iterate.residual.relative <= largest_residual
    }
}

/// Brings a state into equilibrium after a breakage by a method.
///
/// # Errors
///
/// If the observer fails. A missing equilibrium is not an error.
pub(super) fn balance(
    equations: &mut Equations,
    state: &mut State,
    breakage: &Breakage,
    method: &mut dyn Method,
    observer: &mut dyn Observer,
) -> Result<Attempt, ObserverError> {
    let mut at = Iteration {
        equations,
        state,
        breakage,
        number: 0,
        mechanisms: Vec::new(),
        previous_energy: f64::NAN,
    };
    let mut iterate = method.begin(&mut at);
    loop {
        let (residual, energy) = (iterate.residual, iterate.stored_energy);
        if at.number > 0 {
            observer.iteration(at.number, residual.relative, energy)?;
        }
        if method.is_met(&mut at, &mut iterate) {
            method.settle(&mut at);
            at.equations.remember(iterate.extents);
            return Ok(at.equations.settled(iterate, at.number, at.mechanisms));
        }
        if method.gives_up(&at) || !residual.relative.is_finite() {
            let reason = at.equations.unsettled(&residual, at.number);
            return Ok(Attempt::Unbalanced(reason));
        }
        at.previous_energy = energy;
        iterate = match method.correct(&mut at, &iterate) {
            Ok(next) => next,
            Err(reason) => return Ok(Attempt::Unbalanced(reason)),
        };
        at.number += 1;
    }
}
