//! Bonds of a body in motion: their forces at a time, and those that break then.

use std::sync::Arc;
use std::time::Instant;

use ligament_model::element::BondDeformation;
use ligament_model::failure::{CriteriaInState, Criterion};
use ligament_model::product::NearLimits;
use ligament_model::thermal::ThermalStrain;

use super::record::MotionView;
use crate::balanced::Balanced;
use crate::bond_numbers::BondNumbers;
use crate::breakage::Breakage;
use crate::breaking::{BreakingOrder, BreakingRule, next_of_near, next_to_break};
use crate::connectivity::decremental::Connectivity;
use crate::contact::faces::{self, FacePairs};
use crate::contact::{ContactSearch, LastTouching, RigidRates};
use crate::costs::Costs;
use crate::driver::breaks::{self, Breaking};
use crate::driver::energies::Energies;
use crate::driver::record::RunView;
use crate::error::SetupError;
use crate::history::{BreakRecord, Observer, Rates};
use crate::problem::Problem;
use crate::softening::Softening;
use crate::state::State;
use crate::unbalanced::Unbalanced;

/// All bonds at their limits break in a step, with those that differ from the first of them by rounding.
const RULE: BreakingRule = BreakingRule {
    order: BreakingOrder::Ratio,
    bonds_per_iteration: usize::MAX,
    tie_tolerance: 1e-8,
};

/// Largest share of the critical step for the bound of the kinetic energy, which is infinite at the critical step.
///
/// An oscillator of central differences with the phase theta a step, sin(theta/2) = omega dt/2, has the energy e = k A^2/2 cos^2(theta/2), of which
/// 1/2 v- m v+ = k A^2/4 (cos theta - cos 2 n theta) is at least -e tan^2(theta/2): with s = dt/dt_critical that is -e s^2/(1 - s^2).
const NEARLY_CRITICAL: f64 = 0.999;

/// Bonds of a body in motion.
pub(super) struct Body {
    pub(super) problem: Problem,
    pub(super) numbers: BondNumbers,
    pub(super) connectivity: Connectivity,
    contact: ContactSearch,
    /// Surfaces that moved through each other unseen in a step so far.
    missed: Option<Unbalanced>,
    pub(super) state: State,
    /// Deformations, forces and energy of the bonds at the time of the state.
    pub(super) balanced: Balanced,
    /// Whether the bonds are linear up to limits of their own, so that one sweep needs no deformations.
    in_one_sweep: bool,
    /// Number of broken bonds.
    pub(super) broken: usize,
    pub(super) costs: Costs,
}

/// Time step of a motion.
pub(super) struct TimeStep<'a> {
    /// Number of the time step.
    pub(super) number: usize,
    /// Next row of the history.
    pub(super) row: usize,
    /// Length of the step, s.
    pub(super) length: f64,
    /// Velocities in the middle of the step, shape (n_degrees_of_freedom), m/s and rad/s.
    pub(super) velocity: &'a [f64],
}

impl TimeStep<'_> {
    /// Displacements before the step, from those after it (n_degrees_of_freedom).
    fn before(&self, after: &[f64]) -> Vec<f64> {
        let both = after.iter().zip(self.velocity);
        both.map(|(now, velocity)| now - self.length * velocity)
            .collect()
    }
}

/// Bonds beyond their limits, with their deformations, in the order in which they break.
struct Beyond {
    bonds: Vec<u32>,
    deformations: Vec<BondDeformation>,
}

/// Whether the bonds of a problem are linear up to limits of their own.
fn in_one_sweep(problem: &Problem) -> bool {
    let Problem {
        system,
        criteria,
        loads,
        ..
    } = problem;
    let is_plain = |it: &Criterion| it.after.is_brittle() && it.surroundings.is_none();
    let are_plain = criteria.list.iter().all(is_plain);
    let is_cold = loads.temperature_change(0.0).is_empty();
    let is_linear = system.element.is_linear() && !system.faces_close;
    are_plain && is_cold && is_linear
}

impl Body {
    /// Unloaded body with all its bonds, or the body of a restored state.
    pub(super) fn new(problem: &Problem, numbers: BondNumbers, restored: Option<State>) -> Self {
        let system = &*problem.system;
        let n_bonds = system.ends.len();
        let state = restored.unwrap_or_else(|| State {
            softening: Softening::of_sound_bonds(&problem.criteria, n_bonds),
            ..State::fresh(system)
        });
        let broken = state.broken_bonds();
        let mut contact = ContactSearch::new(problem);
        contact.faces = FacePairs::new(system, &state.intact);
        let numbered = (0..).zip(&state.intact).filter(|it| !it.1);
        contact.surfaces.join(numbered.map(|it| it.0));
        Self {
            connectivity: match broken {
                0 => Connectivity::new(system),
                _ => Connectivity::held(system, &state.intact),
            },
            contact,
            missed: None,
            balanced: Balanced::unloaded(system),
            in_one_sweep: in_one_sweep(problem),
            problem: problem.clone(),
            costs: Costs::default(),
            numbers,
            state,
            broken,
        }
    }

    /// Computes the forces at the displacements and the time of the state, and breaks the bonds that have come to their limits.
    ///
    /// With `is_whole` the deformations and the energy of the bonds are computed as well; otherwise they may stay those of an earlier time.
    pub(super) fn move_to(
        &mut self,
        step: &TimeStep<'_>,
        is_whole: bool,
        observer: &mut dyn Observer,
    ) -> Result<Breakage, SetupError> {
        let start = Instant::now();
        let breakage = match self.in_one_sweep && !is_whole {
            true => self.move_in_one_sweep(step, observer)?,
            false => self.move_with_deformations(step, observer)?,
        };
        self.costs.bonds += start.elapsed();
        Ok(breakage)
    }

    fn move_with_deformations(
        &mut self,
        step: &TimeStep<'_>,
        observer: &mut dyn Observer,
    ) -> Result<Breakage, SetupError> {
        self.deform();
        self.soften();
        let problem = self.problem.clone();
        let criteria = problem.criteria_in(&self.state, &self.balanced);
        let bonds = self.beyond_limits(&criteria);
        let mut breakage = Breakage::default();
        if !bonds.is_empty() {
            let of_bond = |&bond: &u32| self.balanced.deformations[bond as usize];
            let deformations = bonds.iter().map(of_bond).collect();
            let beyond = Beyond {
                bonds,
                deformations,
            };
            breakage = self.break_bonds(&beyond, &criteria, step, observer)?;
            if breakage.n_elements() != beyond.bonds.len() {
                self.deform();
            }
        }
        self.sum_forces();
        Ok(breakage)
    }

    /// Moves bonds that are linear until they break by limits of their own, without storing their deformations.
    fn move_in_one_sweep(
        &mut self,
        step: &TimeStep<'_>,
        observer: &mut dyn Observer,
    ) -> Result<Breakage, SetupError> {
        let problem = self.problem.clone();
        let (system, criteria) = (&*problem.system, &*problem.criteria);
        let State {
            intact,
            displacement,
            ..
        } = &self.state;
        let limits = NearLimits {
            criteria,
            factor: RULE.near(),
        };
        let forces = &mut self.balanced.internal.values;
        let near = system.forces_near_limits(self.state.bonds(), displacement, limits, forces);
        if near.is_empty() {
            return Ok(Breakage::default());
        }
        let measured = system.measured(intact, displacement, &near);
        let near: Vec<(u32, BondDeformation)> = near.into_iter().zip(measured).collect();
        let in_file = |bond| system.ends_in_file(bond);
        let criteria = criteria.without_state();
        let bonds = next_of_near(&RULE, &near, &criteria, in_file);
        if bonds.is_empty() {
            return Ok(Breakage::default());
        }
        let deformations = system.measured(intact, displacement, &bonds);
        let beyond = Beyond {
            bonds,
            deformations,
        };
        let breakage = self.break_bonds(&beyond, &criteria, step, observer)?;
        let lost = breakage.unbalanced_force(&self.state.displacement, ThermalStrain::NONE);
        for (dof, force) in lost {
            self.balanced.internal.values[dof] -= force;
        }
        Ok(breakage)
    }

    /// The body at its time for a row of the history, after steps of a share of the critical one.
    pub(super) fn now<'a>(
        &'a self,
        energies: &'a Energies,
        rates: Rates<'a>,
        of_critical: f64,
    ) -> MotionView<'a> {
        let square = of_critical.min(NEARLY_CRITICAL).powi(2);
        MotionView {
            missed: self.missed.as_ref(),
            below_zero: square / (1.0 - square),
            rounding: 0.0,
            broken: self.broken,
            body: RunView {
                problem: &self.problem,
                numbers: &self.numbers,
                fragments: self.connectivity.fragments(),
                state: &self.state,
                balanced: &self.balanced,
                energies,
                costs: &self.costs,
                rates: Some(rates),
            },
        }
    }

    /// Deformations, forces and energy at the displacements and the time of the state.
    pub(super) fn measure(&mut self) {
        self.deform();
        self.sum_forces();
        self.balanced.touching = self.state.surfaces.shared();
        self.load_by_surfaces();
    }

    /// Begins the contact between surfaces at the present motions, without force where surfaces overlap; returns the rates of the rigid bodies.
    pub(super) fn begin_contact(&mut self) -> Vec<RigidRates> {
        if !self.problem.contact.is_empty() {
            self.state.surfaces = LastTouching::new(Arc::default(), &self.state.displacement);
        }
        self.touch(0.0, &mut []);
        self.problem.contact.rates_at_start(&self.balanced.touching)
    }

    /// Moves friction and contact by a step (s) to the present motions, with the forces of contact on the points and on the rigid bodies.
    pub(super) fn touch(&mut self, step: f64, rates: &mut [RigidRates]) {
        let Self {
            problem,
            contact,
            state,
            balanced,
            missed,
            ..
        } = self;
        let surfaces = &problem.contact;
        if !surfaces.is_empty() {
            surfaces.advance(step, rates, &mut state.rigid);
            let touching = contact.touching_in_time(state);
            *missed = missed.take().or_else(|| contact.missed(state, &touching));
            surfaces.accelerate(step, &touching, rates);
            balanced.touching = touching.into();
        }
        contact.settle(state, balanced);
        self.load_by_surfaces();
    }

    /// Adds the forces of contact between surfaces to the internal forces.
    fn load_by_surfaces(&mut self) {
        let (surfaces, balanced) = (&self.problem.contact, &mut self.balanced);
        let (touching, internal) = (&balanced.touching, &mut balanced.internal);
        touching.add_forces(surfaces, -1.0, &mut internal.values);
        internal.on_rigid_bodies = touching.forces_on_rigid_bodies(surfaces);
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
        self.problem
            .begin_softening(&mut self.state, &self.balanced);
        let State {
            softening, intact, ..
        } = &mut self.state;
        let deformations = self.balanced.deformations.measured();
        softening.follow(&self.problem.criteria, intact, deformations, false);
        softening.settle();
        breaks::soften(&self.problem, &mut self.state);
    }

    fn beyond_limits(&self, criteria: &CriteriaInState<'_>) -> Vec<u32> {
        if criteria.criteria().list.is_empty() {
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
        beyond: &Beyond,
        criteria: &CriteriaInState<'_>,
        step: &TimeStep<'_>,
        observer: &mut dyn Observer,
    ) -> Result<Breakage, SetupError> {
        let problem = self.problem.clone();
        let (system, loads) = (&*problem.system, &problem.loads);
        let deformation = |place: usize, _| beyond.deformations[place];
        let breaking = Breaking {
            problem: &problem,
            numbers: &self.numbers,
            criteria,
            deformation: &deformation,
            moment: BreakRecord {
                order: self.broken,
                step: step.row,
                round: step.number,
                ..BreakRecord::default()
            },
        };
        let bonds = &beyond.bonds;
        let records = breaking.apply(&mut self.state, &self.balanced.internal, bonds);
        observer.broke(&records)?;
        // With the displacements before the step, because the energy that leaves in it is 1/2 u^T K_b u' with those before and after.
        let before = step.before(&self.state.displacement);
        let now = std::mem::replace(&mut self.state.displacement, before);
        let expansion = loads.thermal_strain(self.state.load_factor);
        let breakage = Breakage::new(system, expansion, &self.state, bonds);
        self.state.displacement = now;
        self.broken += bonds.len();
        self.connectivity
            .bonds_broke(system, &mut self.state.intact, bonds);
        self.contact.follow(&self.state.intact, bonds);
        Ok(breakage)
    }

    /// Forces and energy of the bonds and of closed pairs across cracks.
    fn sum_forces(&mut self) {
        let problem = &self.problem;
        let expansion = problem.loads.thermal_strain(self.state.load_factor);
        let deformations = std::mem::take(&mut self.balanced.deformations);
        let mut swept = (problem.system).forces(self.state.bonds(), deformations, expansion);
        self.balanced.closed = self.contact.closed(&self.state, expansion).1;
        let layout = problem.system.layout;
        faces::add_to(&mut swept, &self.balanced.closed, layout, expansion);
        self.balanced.deformations = swept.deformations;
        self.balanced.internal = swept.internal;
        self.balanced.stored_energy = swept.stored_energy;
    }
}
