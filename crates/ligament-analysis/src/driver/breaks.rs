//! Bonds that break: their records, and the energy that the constitutive laws of the bonds dissipate.

use ligament_model::communicator::Wire;
use ligament_model::element::{BondDeformation, StiffnessFactors};
use ligament_model::failure::CriteriaInState;

use crate::bond_numbers::BondNumbers;
use crate::history::BreakRecord;
use crate::internal::InternalForces;
use crate::problem::Problem;
use crate::softening::energy_at_limit;
use crate::state::State;

/// Criteria, with the deformation of a bond by its index among the breaking bonds and its local number.
pub(super) type Judged<'a> = (
    &'a CriteriaInState<'a>,
    &'a dyn Fn(usize, usize) -> BondDeformation,
);

/// Bonds that are about to break in a state of a run.
pub(super) struct Breaking<'a> {
    pub(super) problem: &'a Problem,
    pub(super) numbers: &'a BondNumbers,
    pub(super) criteria: &'a CriteriaInState<'a>,
    /// Deformation of a bond, by its index among the breaking bonds and its local number.
    pub(super) deformation: &'a dyn Fn(usize, usize) -> BondDeformation,
    /// Step, round and number of bonds broken before, which all records have in common.
    pub(super) moment: BreakRecord,
}

impl Breaking<'_> {
    /// Records of bonds that break, given by global numbers, in their order; adds the energies that they dissipate to a state with its internal
    /// forces. Collective.
    pub(super) fn apply(
        &self,
        state: &mut State,
        internal: &InternalForces,
        bonds: &[u32],
    ) -> Vec<BreakRecord> {
        let (loads, load_factor) = (&self.problem.loads, state.load_factor);
        let moment = BreakRecord {
            load_factor,
            displacement: loads.control_displacement(load_factor, &state.displacement),
            reaction: loads.control_force(load_factor, internal),
            ..self.moment
        };
        let numbers = self.numbers;
        let owned = bonds.iter().enumerate().filter_map(|(place, &number)| {
            let bond = numbers.local(number).filter(|&it| numbers.owns(it))?;
            self.record(place, bond, (number, moment))
        });
        let mut records = numbers.subdomain().all_gather_list(owned.collect());
        records.sort_unstable_by_key(|it| it.order);
        for record in &records {
            if let Some(bond) = numbers.local(record.bond) {
                dissipate(self.problem, state, bond, record);
            }
        }
        records
    }

    /// Record of a bond with a global number, at its index among the breaking bonds.
    fn record(
        &self,
        place: usize,
        bond: usize,
        (number, moment): (u32, BreakRecord),
    ) -> Option<BreakRecord> {
        let deformation = (self.deformation)(place, bond);
        let verdict = self.criteria.breaking(bond, &deformation)?;
        let ends = self.problem.system.ends[bond];
        Some(BreakRecord {
            order: moment.order + place + 1,
            bond: number,
            ends: self.numbers.subdomain().numbers(ends),
            criterion: verdict.criterion,
            ratio: verdict.ratio(),
            deformation,
            ..moment
        })
    }
}

/// Updates the dissipated energy of softening bonds to their extreme deformations.
pub(super) fn soften(problem: &Problem, state: &mut State) {
    if state.softening.remaining.is_empty() {
        return;
    }
    let criteria = state.softening.criteria(&problem.criteria);
    for bond in 0..problem.system.ends.len() {
        if state.intact[bond] {
            state.dissipated[bond] = by_softening(problem, state, &criteria, (bond, None));
        }
    }
}

/// Adds the energy dissipated by a bond that breaks, and records the criterion by which it broke.
///
/// A brittle bond dissipates the energy that it stored at its limit: its present energy over the square of its utilisation. A
/// softening bond dissipates the whole area under its law.
fn dissipate(problem: &Problem, state: &mut State, bond: usize, record: &BreakRecord) {
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

impl Wire<14> for BreakRecord {
    fn numbers(&self) -> [f64; 14] {
        let [order, step, round, criterion] =
            [self.order, self.step, self.round, self.criterion].map(|it| it as f64);
        let [bond, a, b] = [self.bond, self.ends[0], self.ends[1]].map(f64::from);
        let [stretch, shear, rotation] = self.deformation.strains();
        let Self {
            load_factor,
            displacement,
            reaction,
            ratio,
            ..
        } = *self;
        [
            order,
            step,
            round,
            criterion,
            bond,
            a,
            b,
            load_factor,
            displacement,
            reaction,
            ratio,
            stretch,
            shear,
            rotation,
        ]
    }

    fn from_numbers(numbers: [f64; 14]) -> Self {
        let [order, step, round, criterion, bond, a, b, ..] = numbers.map(|it| it as usize);
        let [
            ..,
            load_factor,
            displacement,
            reaction,
            ratio,
            stretch,
            shear,
            rotation,
        ] = numbers;
        Self {
            order,
            step,
            round,
            criterion,
            bond: bond as u32,
            ends: [a as u32, b as u32],
            load_factor,
            displacement,
            reaction,
            ratio,
            deformation: BondDeformation::new([stretch, shear, rotation]),
        }
    }
}
