//! Energy dissipated by the constitutive laws of the bonds.

use ligament_model::element::StiffnessFactors;
use ligament_model::failure::CriteriaInState;

use crate::history::BreakRecord;
use crate::problem::Problem;
use crate::softening::energy_at_limit;
use crate::state::State;

/// Updates the dissipated energy of softening bonds to their extreme deformations.
pub(super) fn soften(problem: &Problem, state: &mut State) {
    if state.softening.remaining.is_empty() {
        return;
    }
    let criteria = state.softening.criteria(&problem.criteria);
    for bond in 0..problem.system.ends().len() {
        if state.intact[bond] {
            state.dissipated[bond] = by_softening(problem, state, &criteria, (bond, None));
        }
    }
}

/// Adds the energy dissipated by a bond that breaks, and records the criterion by which it broke.
///
/// A brittle bond dissipates the energy that it stored at its limit: its present energy over the square of its utilisation. A
/// softening bond dissipates the whole area under its law.
pub(super) fn break_bond(problem: &Problem, state: &mut State, bond: usize, record: &BreakRecord) {
    let criterion = record.criterion;
    let criteria = state.softening.criteria(&problem.criteria);
    state.dissipated[bond] = if criteria.after(criterion).is_brittle() {
        let left = state.softening.remaining.get(bond);
        let remaining = left.copied().unwrap_or(StiffnessFactors::WHOLE);
        let (system, deformation) = (&problem.system, &record.deformation);
        let stored = system.stored_energy(&state.intact, bond, &remaining, deformation);
        by_softening(problem, state, &criteria, (bond, None)) + stored / record.ratio.powi(2)
    } else {
        by_softening(problem, state, &criteria, (bond, Some(criterion)))
    };
    state.broken_by[bond] = u8::try_from(criterion).ok();
}

/// Energy that a bond dissipated by softening criteria; the total energy of the criterion `end`, whose end it reached.
fn by_softening(
    problem: &Problem,
    state: &State,
    criteria: &CriteriaInState<'_>,
    (bond, end): (usize, Option<usize>),
) -> f64 {
    let of = |criterion: usize| {
        let taken = if end == Some(criterion) {
            criteria.after(criterion).total_dissipated(bond)
        } else {
            let softened = state.softening.bond(&problem.criteria, criterion, bond);
            softened.dissipated
        };
        // A bond that never fails dissipates nothing, however large its limit.
        if taken == 0.0 {
            0.0
        } else {
            taken * energy_at_limit(&*problem.system, criteria, criterion, bond)
        }
    };
    (0..state.softening.largest.len()).map(of).sum()
}
