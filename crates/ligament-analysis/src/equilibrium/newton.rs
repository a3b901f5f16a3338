//! Equilibrium of bonds that are whole or broken: Newton-Raphson (NHPD eqs 19 to 21).

use super::equations::Equations;
use crate::balanced::Attempt;
use crate::breakage::Breakage;
use crate::history::{Observer, ObserverError};
use crate::state::State;

/// Residual above which a solution with a factor that was changed in place is refined once; usually it is some 1e-14, but
/// bodies that barely hang together, and indefinite ones, magnify what rounding adds from breakage to breakage.
const REFINEMENT_TOLERANCE: f64 = 1e-12;

/// A residual above this is no equilibrium whatever the energies say.
const LARGEST_RESIDUAL: f64 = 1e-6;

/// Newton-Raphson iterations after which a solve is given up; more than a few mean that the factor is worthless.
const ITERATION_LIMIT: usize = 25;

/// Brings a state into equilibrium at its load factor.
///
/// The bonds are linear: one solution gets there, and the residual tells. A breakage that the solver can follow brings its own.
/// NHPD's energy rule (eq. 21) ends the iteration as well, with a residual below 1e-6; not where the solver iterates itself, and the
/// residual tells how far it went.
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
        // One refinement may be needed after many changes; if it is not enough, the factor is worn out.
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
