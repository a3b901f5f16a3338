//! Solvers of the tangent equations, updated while bonds break.

pub(crate) mod direct;
pub(crate) mod distributed;
mod factor_record;
pub(crate) mod iterative;
pub(crate) mod solving;
mod terms;
pub(crate) mod unsymmetric;

use std::io::Read;

use ligament_linalg::{FactorError, Factorisation, ForwardSubstituted, Inertia};

use crate::breakage::Breakage;
use crate::checkpoint::CheckpointError;
use crate::contact::resisting::Resisting;
use crate::costs::Costs;
use crate::serial::Sink;
use crate::state::State;
use ligament_model::element::Term;
use ligament_model::thermal::ThermalStrain;

/// Share of its diagonal that an added support adds where faces close: enough to make a detached part definite, and little enough
/// that closing faces carry the part after one more iteration. It is part of the tangent only, never of the forces.
const SOFT_HOLD: f64 = 1e-6;

/// Ratio u . K u / sum k_i u_i^2, with the stiffnesses k_i of single points, at which the resistance to a motion u is rounding. It
/// is some 1e-16 for a motion without energy, and 1e-12 for the softest motion of a bar a thousand points long.
pub(crate) const UNRESISTED: f64 = 1e-14;

/// Residual of the linear equations that an iterative solver may leave; a direct one leaves rounding.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum AllowedResidual {
    /// Share of the norm of the force.
    Share(f64),
    /// Largest residuals at the unknowns, shape (n_unknowns), N and N m.
    AtMost(Vec<f64>),
}

/// A factor updated for a breakage, and the resulting correction after its forward substitution.
pub(crate) struct HalfUpdated<'a> {
    pub(crate) factor: &'a dyn Factorisation,
    pub(crate) correction: ForwardSubstituted,
}

/// Reason why a solver that is ready has no solution.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Unsolved {
    /// The stiffness does not resist a motion, shape (n_unknowns), and the solver needs a definite stiffness; zeros where the
    /// motion is unknown.
    Indefinite(Vec<f64>),
    /// Bonds or loads differ between the ranks.
    Disagreement,
}

/// A solver of K du = f with the tangent stiffness K of a state.
///
/// Corrections and forces are at the unknowns, shape (n_unknowns). A solver may be inexact: the residual of a state is always
/// computed from its bonds.
pub(crate) trait TangentSolver {
    /// Updates the solver for a breakage and returns the correction K' du = (K - K') u with the stiffness K' of the intact bonds,
    /// where both can be computed together.
    fn follow(
        &mut self,
        breakage: &Breakage,
        state: &State,
        expansion: ThermalStrain<'_>,
        costs: &mut Costs,
    ) -> Option<Vec<f64>>;

    /// Whether the solver can be updated for changes of this number of elements.
    fn can_update(&self, _n_elements: usize) -> bool {
        false
    }

    /// Factor of K; None where there is none at present.
    fn factor(&self) -> Option<&dyn Factorisation> {
        None
    }

    /// Updates the solver for a breakage like [`TangentSolver::follow`], but leaves the backward substitution to the caller; None
    /// where the solver has no factor or must compute it anew.
    fn update_and_forward_solve(
        &mut self,
        _breakage: &Breakage,
        _state: &State,
        _expansion: ThermalStrain<'_>,
        _costs: &mut Costs,
    ) -> Option<HalfUpdated<'_>> {
        None
    }

    /// Updates the solver for the softening of bonds.
    fn update_for_softening(&mut self, state: &State, costs: &mut Costs);

    /// Adds to K the [falling stiffness](crate::equilibrium::falling) of softening bonds, with their local numbers, in place of that added
    /// before, for a solver whose factor can have it. Returns whether K changes.
    fn fall(&mut self, _falling: Vec<(u32, Term)>) -> bool {
        false
    }

    /// Updates the solver for the motions that contacts resist, in the order of the keys; does nothing where there can be no contact.
    fn close(&mut self, resisting: Vec<Resisting>, costs: &mut Costs);

    /// Makes the solver ready for a state. Returns the degrees of freedom of vanishing pivots, which must be fixed in the state
    /// before the solver is made ready again.
    ///
    /// # Errors
    ///
    /// If K has no factor.
    fn prepare(&mut self, state: &State, costs: &mut Costs) -> Result<Vec<usize>, FactorError>;

    /// Correction for residual forces, zero at fixed degrees of freedom. The solver must be ready.
    ///
    /// # Errors
    ///
    /// If the solver needs a definite stiffness and found a motion without energy, or if bonds differ between the ranks.
    fn solve(
        &mut self,
        state: &State,
        force: Vec<f64>,
        left: AllowedResidual,
        costs: &mut Costs,
    ) -> Result<Vec<f64>, Unsolved>;

    /// Corrections for two residual forces, like [`TangentSolver::solve`].
    ///
    /// # Errors
    ///
    /// As in [`TangentSolver::solve`].
    fn solve_both(
        &mut self,
        state: &State,
        [one, other]: [Vec<f64>; 2],
        left: AllowedResidual,
        costs: &mut Costs,
    ) -> Result<[Vec<f64>; 2], Unsolved> {
        let one = self.solve(state, one, left.clone(), costs)?;
        Ok([one, self.solve(state, other, left, costs)?])
    }

    /// Relative residual to which an iterative solver solves after a breakage; none for a direct one.
    fn tolerance(&self) -> Option<f64>;

    /// Whether K was updated in place, with the rounding of these updates.
    fn is_changed(&self) -> bool;

    /// Makes the solver recompute K from the bonds the next time.
    fn discard(&mut self);

    /// A copy of the solver in its present state, for runs that begin from it; None where it cannot be copied.
    fn intact(&self) -> Option<Box<dyn IntactSolver>> {
        None
    }

    /// Numbers of positive and negative eigenvalues of K; none where they are not known.
    fn inertia(&self) -> Option<Inertia>;

    /// Appends the bytes from which the solver is restored bit for bit.
    fn write(&self, out: &mut dyn Sink);

    /// Restores a newly built solver from the bytes of [`TangentSolver::write`].
    ///
    /// # Errors
    ///
    /// If the bytes are damaged or belong to another model, or if the factor differs in any bit.
    fn restore(&mut self, from: &mut dyn Read) -> Result<(), CheckpointError>;
}

/// A solver of an intact body, which does not change: each run begins with a copy.
pub(crate) trait IntactSolver: Send + Sync {
    /// An independent copy, ready to solve.
    fn copied(&self) -> Box<dyn TangentSolver>;
}
