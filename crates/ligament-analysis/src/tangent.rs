//! Solvers of the equations of an equilibrium, kept up while bonds break.

pub(crate) mod direct;
pub(crate) mod distributed;
pub(crate) mod iterative;
mod making;
pub(crate) mod solving;
mod terms;
pub(crate) mod unsymmetric;

use ligament_linalg::{FactorError, Factorisation, ForwardSubstituted, Inertia};

use crate::breakage::Breakage;
use crate::checkpoint::CheckpointError;
use crate::costs::Costs;
use crate::state::State;
use ligament_model::contact::ClosedPair;
use ligament_model::thermal::ThermalStrain;

/// Share of its diagonal that a hold adds where faces close: enough to make a loose part definite, and so little that faces which
/// close carry the part in one more iteration. What it adds stands in the tangent alone, never in the forces.
const SOFT_HOLD: f64 = 1e-6;

/// Share of the stiffness of the points, each by itself, at which what resists a motion u of them together is rounding:
/// u . K u of a motion that costs no energy is some 1e-16 of sum k_i u_i^2, that of the softest motion of a bar a thousand points
/// long 1e-12.
pub(crate) const UNRESISTED: f64 = 1e-14;

/// The force that a solver which iterates may leave out of balance; an exact one leaves rounding.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum AllowedResidual {
    /// Share of the norm of the force.
    Share(f64),
    /// Sizes at the unknowns, shape (n_unknowns), N and N m.
    AtMost(Vec<f64>),
}

/// A factor that took in a breakage, and the correction that it asks for after the forward substitution.
pub(crate) struct HalfUpdated<'a> {
    pub(crate) factor: &'a dyn Factorisation,
    pub(crate) correction: ForwardSubstituted,
}

/// Why a solver that is ready has no solution.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Unsolved {
    /// The stiffness does not resist a motion, shape (n_unknowns), and the solver needs one that does; zero where the motion is not
    /// known.
    Indefinite(Vec<f64>),
    /// Ranks have other bonds left or another load.
    Disagreement,
}

/// A solver of K du = f with the tangent stiffness K of a state.
///
/// Corrections and forces are at the unknowns, shape (n_unknowns). A solver may be exact or only near: the residual of a state
/// is always taken from its bonds.
pub(crate) trait TangentSolver {
    /// Takes in a breakage and gives the correction that it asks for, where both can be had together: K' du = (K - K') u with the
    /// matrix K' of the bonds that are left.
    fn follow(
        &mut self,
        breakage: &Breakage,
        state: &State,
        expansion: ThermalStrain<'_>,
        costs: &mut Costs,
    ) -> Option<Vec<f64>>;

    /// Whether changes of so many elements can be taken in as they come.
    fn can_update(&self, _n_elements: usize) -> bool {
        false
    }

    /// What stands for K at present; None where that is no factor.
    fn factor(&self) -> Option<&dyn Factorisation> {
        None
    }

    /// Takes in a breakage as [`TangentSolver::follow`] does, but leaves the backward substitution to the caller; None where the solver
    /// has no factor, or must make it anew.
    fn update_and_forward_solve(
        &mut self,
        _breakage: &Breakage,
        _state: &State,
        _expansion: ThermalStrain<'_>,
        _costs: &mut Costs,
    ) -> Option<HalfUpdated<'_>> {
        None
    }

    /// Takes in how far bonds have softened.
    fn update_for_softening(&mut self, state: &State, costs: &mut Costs);

    /// Takes in which pairs across cracks are closed; none are where faces do not close.
    fn close(&mut self, closed: &[ClosedPair], costs: &mut Costs);

    /// Gets ready to solve for a state; gives the degrees of freedom that nothing holds, by their vanishing pivots. Those must be held in
    /// the state, and the solver made ready again.
    ///
    /// # Errors
    ///
    /// If K has no factor.
    fn prepare(&mut self, state: &State, costs: &mut Costs) -> Result<Vec<usize>, FactorError>;

    /// The correction for forces that nothing balances, zero where the state is held. The solver must be ready.
    ///
    /// # Errors
    ///
    /// If the solver needs a definite stiffness, and met a motion that costs no energy; or if ranks have other bonds left.
    fn solve(
        &mut self,
        state: &State,
        force: Vec<f64>,
        left: AllowedResidual,
        costs: &mut Costs,
    ) -> Result<Vec<f64>, Unsolved>;

    /// Residual, relative to the forces that may act, up to which a solver that iterates goes after a breakage; none of an exact one.
    fn tolerance(&self) -> Option<f64>;

    /// Whether the solver's form of K went through changes, and with them through rounding.
    fn is_changed(&self) -> bool;

    /// Makes the solver start anew from the bonds the next time.
    fn discard(&mut self);

    /// Numbers of positive and negative eigenvalues of K; none where they are not known.
    fn inertia(&self) -> Option<Inertia>;

    /// Appends what it takes to make the solver again, to the bit.
    fn write(&self, out: &mut Vec<u8>);

    /// Makes a fresh solver as it was when the bytes were written.
    ///
    /// # Errors
    ///
    /// If the bytes are damaged or of another model, or the factor comes out with other bits.
    fn restore(&mut self, from: &mut &[u8]) -> Result<(), CheckpointError>;
}
