//! Energy dissipated by the constitutive laws of the bonds.

use ligament_model::element::StiffnessFactors;

use crate::history::BreakRecord;
use crate::problem::Problem;
use crate::state::State;

/// Updates the dissipated energy of softening bonds to their extreme deformations.
pub(super) fn soften(problem: &Problem, state: &mut State) {
    if state.softening.remaining.is_empty() {
        return;
    }
    for bond in 0..problem.system.ends().len() {
        if state.intact[bond] {
            state.dissipated[bond] = by_softening(problem, state, bond, None);
        }
    }
}

/// Adds the energy dissipated by a bond that breaks, and records the criterion by which it broke.
///
/// A brittle bond dissipates the energy that it stored at its limit: its present energy over the square of its utilisation. A
/// softening bond dissipates the whole area under its law.
pub(super) fn break_bond(problem: &Problem, state: &mut State, bond: usize, record: &BreakRecord) {
    let criterion = record.criterion;
    let after = &problem.criteria.list[criterion].after;
    state.dissipated[bond] = if after.is_brittle() {
        let left = state.softening.remaining.get(bond);
        let remaining = left.copied().unwrap_or(StiffnessFactors::WHOLE);
        let (system, deformation) = (&problem.system, &record.deformation);
        let stored = system.stored_energy(&state.intact, bond, &remaining, deformation);
        by_softening(problem, state, bond, None) + stored / record.ratio.powi(2)
    } else {
        by_softening(problem, state, bond, Some(criterion))
    };
    state.broken_by[bond] = u8::try_from(criterion).ok();
}

/// Energy that a bond dissipated by softening criteria; the total energy of the criterion `end`, whose end it reached.
fn by_softening(problem: &Problem, state: &State, bond: usize, end: Option<usize>) -> f64 {
    let of = |criterion: usize| {
        let law = &problem.criteria.list[criterion];
        let taken = if end == Some(criterion) {
            law.after.total_dissipated(bond)
        } else {
            let softened = state.softening.bond(&problem.criteria, criterion, bond);
            softened.dissipated
        };
        // A bond that never fails dissipates nothing, however large its limit.
        if taken == 0.0 {
            0.0
        } else {
            taken * problem.system.energy_at_limit(law, bond)
        }
    };
    (0..state.softening.largest.len()).map(of).sum()
}
