//! Equilibrium of bonds that are intact or broken, by Newton-Raphson (NHPD eqs 19 to 21).

use super::equations::{Iterate, Iteration, Method};
use super::path_following::Target;
use crate::unbalanced::Unbalanced;

/// Residual above which a solution with an updated factor is refined once; it is usually some 1e-14, but weakly connected and
/// indefinite bodies magnify the rounding that accumulates from breakage to breakage.
const REFINEMENT_TOLERANCE: f64 = 1e-12;

/// Largest residual of an equilibrium accepted by the energy rule, and of an equilibrium at the value of a motion.
const LARGEST_RESIDUAL: f64 = 1e-6;
const LARGEST_AT_TARGET: f64 = 1e-8;

/// Largest number of iterations; more than a few mean that the factor is useless.
const ITERATION_LIMIT: usize = 25;

/// Largest number of iterations to the value of a motion.
const LIMIT_AT_TARGET: usize = 1000;

/// Equilibrium at a load factor, or at the value of a motion with the load factor as an unknown ([`Target`]).
///
/// The bonds are linear, so that one solution suffices, which the residual verifies; the update of the factor for a breakage
/// includes that solution. NHPD's energy rule (eq. 21) also ends the iteration with a small residual, except with an iterative
/// solver, whose residual measures its convergence.
pub(super) struct Newton<'a> {
    pub(super) target: Option<&'a Target>,
}

impl Method for Newton<'_> {
    fn is_met(&mut self, at: &mut Iteration<'_>, iterate: &mut Iterate) -> bool {
        let solver = &at.equations.solver;
        let (is_changed, is_exact) = (solver.is_changed(), solver.tolerance().is_none());
        if let Some(target) = self.target {
            let is_small = at.is_small(iterate, at.sought())
                || is_exact && at.energy_settled(iterate, LARGEST_AT_TARGET);
            return is_small && target.is_met(&at.state.displacement);
        }
        let tolerance = match is_changed && at.number == 1 {
            true => REFINEMENT_TOLERANCE,
            false => at.sought(),
        };
        at.is_small(iterate, tolerance)
            || is_exact && !is_changed && at.energy_settled(iterate, LARGEST_RESIDUAL)
    }

    fn gives_up(&self, at: &Iteration<'_>) -> bool {
        at.number == self.target.map_or(ITERATION_LIMIT, |_| LIMIT_AT_TARGET)
    }

    fn correct(
        &mut self,
        at: &mut Iteration<'_>,
        iterate: &Iterate,
    ) -> Result<Iterate, Unbalanced> {
        let sought = at.sought();
        let (equations, state) = (&mut *at.equations, &mut *at.state);
        // One refinement may be needed after many updates; if it is not enough, the factor has lost its accuracy.
        if equations.solver.is_changed() && at.number >= 2 {
            equations.solver.discard();
        }
        let mut correction = equations.correction(state, iterate, sought, &mut at.mechanisms)?;
        if let Some(target) = self.target {
            let growth = equations.displacement_rate(state, &*target.rate)?;
            state.load_factor += target.constrain(equations, &mut correction, state, &growth)?;
            equations.prescribe(state);
        }
        equations.add_correction(state, 1.0, &correction);
        Ok(equations.measure(state))
    }
}
