//! Equilibrium of bonds that are intact or broken, by Newton-Raphson (NHPD eqs 19 to 21).

use super::equations::Equations;
use crate::balanced::Attempt;
use crate::breakage::Breakage;
use crate::history::{Observer, ObserverError};
use crate::state::State;

/// Residual above which a solution with an updated factor is refined once; it is usually some 1e-14, but weakly connected and
/// indefinite bodies magnify the rounding that accumulates from breakage to breakage.
const REFINEMENT_TOLERANCE: f64 = 1e-12;

/// Largest residual of an equilibrium accepted by the energy rule.
const LARGEST_RESIDUAL: f64 = 1e-6;

/// Largest number of Newton-Raphson iterations; more than a few mean that the factor is useless.
const ITERATION_LIMIT: usize = 25;

/// Brings a state into equilibrium at its load factor.
///
/// The bonds are linear, so that one solution suffices, which the residual verifies; the update of the factor for a breakage
/// includes that solution. NHPD's energy rule (eq. 21) also ends the iteration with a residual below 1e-6, except with an iterative
/// solver, whose residual measures its convergence.
pub(super) fn balance(
    equations: &mut Equations,
    state: &mut State,
    breakage: &Breakage,
    observer: &mut dyn Observer,
) -> Result<Attempt, ObserverError> {
    equations.prescribe(state);
    let mut mechanisms = Vec::new();
    let sought = equations.accuracy.sought(breakage);
    let is_exact = equations.solver.tolerance().is_none();
    let mut previous_energy = f64::NAN;
    let mut iterations = usize::from(equations.follow(state, breakage));
    loop {
        let iterate = equations.measure(state);
        let (residual, energy) = (iterate.residual, iterate.stored_energy);
        if iterations > 0 {
            observer.iteration(iterations, residual.relative, energy)?;
        }
        let is_changed = equations.solver.is_changed();
        let tolerance = if is_changed && iterations == 1 {
            REFINEMENT_TOLERANCE
        } else {
            sought
        };
        let may_settle = is_exact && !is_changed;
        let energy_settled =
            may_settle && equations.energy_settled(previous_energy, &iterate, LARGEST_RESIDUAL);
        if equations.is_small(&residual, tolerance) || energy_settled {
            equations.remember(iterate.extents);
            return Ok(equations.settled(iterate, iterations, mechanisms));
        }
        if iterations == ITERATION_LIMIT || !residual.relative.is_finite() {
            return Ok(equations.not_settled(&residual, iterations));
        }
        // One refinement may be needed after many updates; if it is not enough, the factor has lost its accuracy.
        if is_changed && iterations >= 2 {
            equations.solver.discard();
        }
        match equations.correction(state, &iterate, sought, &mut mechanisms) {
            Ok(correction) => equations.add_correction(state, 1.0, &correction),
            Err(unbalanced) => return Ok(Attempt::Unbalanced(unbalanced)),
        }
        previous_energy = energy;
        iterations += 1;
    }
}
