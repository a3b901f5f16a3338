//! Bonds of a body in motion: their forces at a time, and those that break then.

use std::sync::Arc;
use std::time::Instant;

use ligament_model::failure::Criteria;

use crate::balanced::Balanced;
use crate::bond_numbers::BondNumbers;
use crate::breakage::Breakage;
use crate::breaking::{BreakingOrder, BreakingRule, next_to_break};
use crate::connectivity::decremental::Connectivity;
use crate::contact::{self, Contact};
use crate::costs::Costs;
use crate::driver::breaks::{Breaking, CriteriaAtDeformations};
use crate::driver::dissipation;
use crate::error::SetupError;
use crate::history::{BreakRecord, Observer};
use crate::problem::Problem;
use crate::softening::Softening;
use crate::state::State;
use ligament_model::element::BondDeformation;

/// All bonds at their limits break in a step, with those that differ from the first of them by rounding.
const RULE: BreakingRule = BreakingRule {
    order: BreakingOrder::Ratio,
    bonds_per_iteration: usize::MAX,
    tie_tolerance: 1e-8,
};

/// Bonds of a body in motion.
pub(super) struct Body {
    /// Problem with the criteria of bonds that began to soften.
    pub(super) problem: Problem,
    pub(super) numbers: BondNumbers,
    pub(super) connectivity: Connectivity,
    contact: Contact,
    pub(super) state: State,
    /// Deformations, forces and energy of the bonds at the time of the state.
    pub(super) balanced: Balanced,
    /// Number of broken bonds.
    pub(super) broken: usize,
    pub(super) costs: Costs,
}

/// Place of a breakage in a history.
#[derive(Clone, Copy)]
pub(super) struct BreakTime {
    /// Next row of the history.
    pub(super) row: usize,
    /// Number of the time step.
    pub(super) time_step: usize,
}

impl Body {
    /// Unloaded body with all its bonds, or the body of a restored state.
    pub(super) fn new(problem: &Problem, numbers: BondNumbers, restored: Option<State>) -> Self {
        let system = &*problem.system;
        let n_bonds = system.ends().len();
        let state = restored.unwrap_or_else(|| State {
            softening: Softening::of_sound_bonds(&problem.criteria, n_bonds),
            ..State::fresh(system)
        });
        let broken = state.broken_bonds();
        Self {
            connectivity: match broken {
                0 => Connectivity::new(system),
                _ => Connectivity::held(system, &state.intact),
            },
            contact: Contact::new(system, &state.intact),
            balanced: Balanced::unloaded(system),
            problem: problem.clone(),
            costs: Costs::default(),
            numbers,
            state,
            broken,
        }
    }

    /// Computes deformations, forces and energy at the displacements and the time of the state, and breaks the bonds that have come to their
    /// limits. `before` are the displacements of the step before (n_degrees_of_freedom).
    pub(super) fn move_to(
        &mut self,
        before: &dyn Fn() -> Vec<f64>,
        at: BreakTime,
        observer: &mut dyn Observer,
    ) -> Result<Breakage, SetupError> {
        let start = Instant::now();
        self.deform();
        self.soften();
        let problem = self.problem.clone();
        let criteria = problem.criteria_in(&self.state, &self.balanced);
        let beyond = self.beyond_limits(&criteria);
        let mut breakage = Breakage::default();
        if !beyond.is_empty() {
            breakage = self.break_bonds(&beyond, &criteria, before, at, observer)?;
        }
        self.sum_forces();
        self.costs.bonds += start.elapsed();
        Ok(breakage)
    }

    /// Deformations, forces and energy at the displacements and the time of the state.
    pub(super) fn measure(&mut self) {
        self.deform();
        self.sum_forces();
    }

    fn deform(&mut self) {
        let State {
            intact,
            displacement,
            load_factor,
            ..
        } = &self.state;
        let expansion = self.problem.loads.thermal_strain(*load_factor);
        let system = &self.problem.system;
        // Its memory returns to the pool before the new deformations need some.
        self.balanced.deformations = Default::default();
        self.balanced.deformations = system.deformations(intact, displacement, expansion);
        self.balanced.forget_stresses();
    }

    /// Lets bonds begin to soften by the stress around them, and follow their laws.
    fn soften(&mut self) {
        if self.state.softening.remaining.is_empty() {
            return;
        }
        if let Some(begun) = self.problem.beginning(&self.state, &self.balanced) {
            self.problem.criteria = Arc::new(self.problem.criteria.begun_at(&begun));
            self.state.softening.begun = begun;
        }
        let State {
            softening, intact, ..
        } = &mut self.state;
        let deformations = self.balanced.deformations.measured();
        softening.follow(&self.problem.criteria, intact, deformations, false);
        softening.settle();
        dissipation::soften(&self.problem, &mut self.state);
    }

    fn beyond_limits(&self, criteria: &Criteria) -> Vec<u32> {
        if criteria.list.is_empty() {
            return Vec::new();
        }
        let (system, deformations) = (&self.problem.system, &self.balanced.deformations);
        let in_file = |bond| system.ends_in_file(bond);
        let intact = &self.state.intact;
        next_to_break(
            &self.numbers,
            &RULE,
            deformations,
            criteria,
            intact,
            in_file,
        )
    }

    fn break_bonds(
        &mut self,
        bonds: &[u32],
        criteria: &Criteria,
        before: &dyn Fn() -> Vec<f64>,
        at: BreakTime,
        observer: &mut dyn Observer,
    ) -> Result<Breakage, SetupError> {
        let problem = self.problem.clone();
        let (system, loads) = (&*problem.system, &problem.loads);
        let time = self.state.load_factor;
        let deformation = |_, bond: usize| self.balanced.deformations[bond];
        let breaking = Breaking {
            ends: system.ends(),
            judged: CriteriaAtDeformations {
                criteria,
                deformation: &deformation,
            },
            moment: BreakRecord {
                order: self.broken,
                step: at.row,
                round: at.time_step,
                load_factor: time,
                displacement: loads.control_displacement(time, &self.state.displacement),
                reaction: loads.control_force(time, &self.balanced.internal),
                bond: 0,
                ends: [0; 2],
                criterion: 0,
                ratio: 0.0,
                deformation: BondDeformation::default(),
            },
        };
        let records = breaking.records(&self.numbers, bonds);
        observer.broke(&records)?;
        for record in &records {
            dissipation::break_bond(&problem, &mut self.state, record.bond as usize, record);
        }
        // With the displacements before the step, because the energy that leaves in it is 1/2 u^T K_b u' with those before and after.
        let now = std::mem::replace(&mut self.state.displacement, before());
        let expansion = loads.thermal_strain(time);
        let breakage = Breakage::new(system, expansion, &self.state, bonds);
        self.state.displacement = now;
        self.broken += bonds.len();
        self.connectivity
            .bonds_broke(system, &mut self.state.intact, bonds);
        self.contact = Contact::new(system, &self.state.intact);
        if breakage.n_elements() != bonds.len() {
            self.deform();
        }
        Ok(breakage)
    }

    /// Forces and energy of the bonds and of closed pairs across cracks.
    fn sum_forces(&mut self) {
        let problem = &self.problem;
        let State {
            displacement,
            load_factor,
            ..
        } = &self.state;
        let expansion = problem.loads.thermal_strain(*load_factor);
        let deformations = std::mem::take(&mut self.balanced.deformations);
        let mut swept = (problem.system).forces(self.state.bonds(), deformations, expansion);
        let gaps = self.contact.gaps(displacement, expansion);
        self.balanced.closed = self.contact.closed(&gaps);
        let layout = problem.system.layout();
        contact::add_to(&mut swept, &self.balanced.closed, layout, expansion);
        self.balanced.deformations = swept.deformations;
        self.balanced.internal = swept.internal;
        self.balanced.stored_energy = swept.stored_energy;
    }
}
