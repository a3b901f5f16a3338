//! Energies and records, as all drivers use them.

use std::cell::Cell;
use std::io::Read;

use ligament_model::deformation::Deformations;
use ligament_model::element::StiffnessFactors;
use ligament_model::failure::CriteriaInState;
use rayon::prelude::*;

use crate::balanced::Balanced;
use crate::bond_numbers::{BondNumbers, add_over_bonds, sum_over_bonds};
use crate::breakage::Breakage;
use crate::checkpoint::CheckpointError;
use crate::connectivity::Fragments;
use crate::contact::{ContactEnergy, ContactLoss};
use crate::history::{
    ContactAtRest, Moment, Observer, ObserverError, Onward, StepRecord, Termination,
};
use crate::load_program::groups_of_reactions;
use crate::probe;
use crate::problem::Problem;
use crate::result_fields::Solution;
use crate::serial;
use crate::serial::{Serial, Sink};
use crate::state::State;
use crate::surfaces::{SurfaceEnergy, SurfaceWork};

/// Share of the largest work of a run below which the work counts as returned: the work of a hundredth of the load.
const UNLOADED: f64 = 1e-4;

/// Energies along the path.
///
/// Between two equilibria with the same bonds everything is linear, so that the trapezoidal rule gives the work of supports and
/// loads exactly; a breakage at fixed load releases 1/2 u^T K_b u' for each broken bond, with u before and u' after it. A bond
/// whose secant falls from omega to omega' releases the same with (omega - omega') K_b; with the trapezoidal rule the energies then
/// balance for any step.
#[derive(Debug, Clone)]
pub(super) struct Energies {
    pub(super) external_work: f64,
    pub(super) released: f64,
    /// Energy that friction took.
    friction: f64,
    /// Energy stored in contacts between surfaces.
    in_contact: f64,
    /// Largest external work so far.
    largest_work: f64,
    /// Degrees of freedom that are prescribed or loaded.
    loaded: Vec<u32>,
    /// Forces and displacements of the loaded degrees of freedom in the last state.
    last_loaded: Vec<Loaded>,
    /// Temperature factor and [`InternalForces::thermal`] in the last state.
    thermal: (f64, f64),
    /// Deformations and remaining stiffness of the bonds in the last state; empty where no bond softens.
    last: (Deformations, Vec<StiffnessFactors>),
    /// Closed pairs across cracks in the last state; none where faces do not close.
    contact: ContactEnergy,
    /// Contact between surfaces in the last state.
    surfaces: SurfaceEnergy,
}

/// Force and displacement of a degree of freedom in the last state.
#[derive(Debug, Clone, Default)]
struct Loaded {
    force: f64,
    displacement: f64,
}

serial!(Loaded {
    force,
    displacement
});

impl Energies {
    /// Appends the data that do not follow from the problem and the state.
    pub(super) fn write(&self, out: &mut dyn Sink) {
        let Self {
            external_work,
            released,
            friction,
            in_contact,
            largest_work,
            last_loaded,
            thermal,
            loaded: _,
            last: _,
            contact: _,
            surfaces: _,
        } = self;
        external_work.write(out);
        released.write(out);
        friction.write(out);
        in_contact.write(out);
        largest_work.write(out);
        last_loaded.write(out);
        thermal.write(out);
    }

    /// Restores the energies from the bytes of [`Energies::write`], in an equilibrium state.
    pub(super) fn read(
        problem: &Problem,
        state: &State,
        balanced: &Balanced,
        from: &mut dyn Read,
    ) -> Result<Self, CheckpointError> {
        let mut energies = Self {
            external_work: Serial::read(from)?,
            released: Serial::read(from)?,
            friction: Serial::read(from)?,
            in_contact: Serial::read(from)?,
            largest_work: Serial::read(from)?,
            last_loaded: Serial::read(from)?,
            thermal: Serial::read(from)?,
            ..Self::unloaded(problem)
        };
        if energies.last_loaded.len() != energies.loaded.len() {
            return Err(CheckpointError::OtherModel);
        }
        energies.keep(state, balanced);
        energies.contact.keep(state, balanced);
        if !problem.contact.is_empty() {
            energies.surfaces = SurfaceEnergy::at(&balanced.touching, &state.displacement);
        }
        Ok(energies)
    }

    /// Energies of the unloaded body.
    pub(super) fn unloaded(problem: &Problem) -> Self {
        let loaded = problem.loads.loaded_degrees_of_freedom();
        Self {
            external_work: 0.0,
            released: 0.0,
            friction: 0.0,
            in_contact: 0.0,
            surfaces: SurfaceEnergy::default(),
            largest_work: 0.0,
            thermal: (0.0, 0.0),
            last: Default::default(),
            contact: ContactEnergy::of_unloaded(&*problem.system),
            last_loaded: vec![Loaded::default(); loaded.len()],
            loaded,
        }
    }

    /// Adds the work from the last state to this one.
    pub(super) fn add_work(&mut self, problem: &Problem, state: &State, balanced: &Balanced) {
        self.external_work += self.work_to(problem, state, balanced);
        self.largest_work = self.largest_work.max(self.external_work.abs());
        self.thermal = Self::thermal_now(problem, state, balanced);
        self.last_loaded = self.loaded_now(problem, state, balanced).collect();
    }

    /// Work from the last state to this one, J.
    pub(super) fn work_to(&self, problem: &Problem, state: &State, balanced: &Balanced) -> f64 {
        let work = self.work_at(problem, state, balanced, |_| true);
        let (factor, force) = self.thermal;
        let (factor_now, force_now) = Self::thermal_now(problem, state, balanced);
        work + 0.5 * (force + force_now) * (factor_now - factor)
    }

    /// Work of prescribed motions from the last state to this one, J.
    pub(super) fn work_of_motions_to(
        &self,
        problem: &Problem,
        state: &State,
        balanced: &Balanced,
    ) -> f64 {
        let reacts = |dof| problem.loads.reacts_at(dof);
        self.work_at(problem, state, balanced, reacts)
    }

    /// Work of loads at some of the degrees of freedom from the last state to this one, J.
    fn work_at(
        &self,
        problem: &Problem,
        state: &State,
        balanced: &Balanced,
        counts: impl Fn(usize) -> bool,
    ) -> f64 {
        let now = self.loaded_now(problem, state, balanced);
        let both = self.loaded.iter().zip(now.zip(&self.last_loaded));
        let counted = both.filter(|(dof, _)| counts(**dof as usize));
        let mut work = 0.0;
        for (_, (now, last)) in counted {
            let mean_force = 0.5 * (now.force + last.force);
            work += mean_force * (now.displacement - last.displacement);
        }
        work
    }

    /// Forces and displacements of the loaded degrees of freedom in a state.
    fn loaded_now<'a>(
        &'a self,
        problem: &'a Problem,
        state: &'a State,
        balanced: &'a Balanced,
    ) -> impl Iterator<Item = Loaded> + 'a {
        let given = problem.loads.forces(state.load_factor, &self.loaded);
        self.loaded.iter().zip(given).map(|(&dof, given)| {
            let dof = dof as usize;
            let force = if problem.loads.reacts_at(dof) {
                balanced.internal.values[dof]
            } else {
                given
            };
            Loaded {
                force,
                displacement: state.displacement[dof],
            }
        })
    }

    /// Temperature factor and [`InternalForces::thermal`] in a state.
    fn thermal_now(problem: &Problem, state: &State, balanced: &Balanced) -> (f64, f64) {
        let factor = problem.loads.temperature_factor(state.load_factor);
        (factor, balanced.internal.thermal)
    }

    /// Largest external work so far, J.
    pub(super) fn largest_work(&self) -> f64 {
        self.largest_work
    }

    /// Adds the work of what moves rigid bodies, J.
    pub(super) fn add_driving_work(&mut self, work: f64) {
        self.external_work += work;
        self.largest_work = self.largest_work.max(self.external_work.abs());
    }

    /// Half the work of the present forces on the displacements from the unloaded body, J: the stored energy under proportional
    /// loading (Clapeyron).
    pub(super) fn stored_in_proportion(&self) -> f64 {
        let of_loaded = self.last_loaded.iter();
        0.5 * of_loaded.map(|it| it.force * it.displacement).sum::<f64>()
    }

    /// Energy below which differences are rounding of earlier energies, J; an unloaded body has returned its work.
    fn floor(&self) -> f64 {
        UNLOADED * self.largest_work
    }

    /// Adds the energy released by a breakage and by softening since the last state.
    pub(super) fn add_released(
        &mut self,
        problem: &Problem,
        state: &State,
        breakage: &Breakage,
        balanced: &Balanced,
    ) {
        let expansion = problem.loads.thermal_strain(state.load_factor);
        let remaining = &state.softening.remaining;
        self.released += breakage.released(&state.displacement, expansion);
        let (before, left) = &self.last;
        let released = |(bond, left_before): (usize, &StiffnessFactors)| {
            let lost = left_before.lost(&remaining[bond]);
            let both = [before, &balanced.deformations];
            match state.intact[bond] && lost != StiffnessFactors::NOTHING {
                true => (problem.system).mutual_energy(&state.intact, bond, &lost, both),
                false => 0.0,
            }
        };
        let by_bond = left.iter().enumerate().map(released);
        if !left.is_empty() {
            add_over_bonds(&*problem.system, &mut self.released, by_bond);
        }
        self.keep(state, balanced);
    }

    /// Begins a part of a programme at this load factor.
    pub(super) fn begin_part(&mut self, load_factor: f64) {
        self.contact.begin_part(load_factor);
    }

    /// Adds the energy of pairs across cracks that opened or closed since the last state, and of friction and contact between surfaces: after a
    /// breakage, at fixed load, what pairs lost is released; between two loads it corrects the work by the trapezoidal rule. Returns the energy
    /// stored in contacts between surfaces, and what friction took since the last state.
    pub(super) fn add_contact(
        &mut self,
        problem: &Problem,
        state: &State,
        breakage: &Breakage,
        balanced: &Balanced,
    ) -> ContactAtRest {
        let loss = self.follow_contact(problem, (state, balanced), &breakage.bonds);
        let surfaces = self.follow_surfaces(problem, state, balanced);
        let mut taken = loss.friction + surfaces.dissipated;
        if breakage.bonds.is_empty() {
            taken -= surfaces.excess;
            self.external_work -= loss.closure + surfaces.excess;
        } else {
            self.released += loss.closure;
        }
        self.friction += taken;
        self.in_contact = surfaces.stored;
        ContactAtRest {
            contact_energy: surfaces.stored,
            friction_energy: taken,
        }
    }

    /// Moves to the contact between surfaces of the next state, and adds the work of what moves rigid bodies.
    pub(super) fn follow_surfaces(
        &mut self,
        problem: &Problem,
        state: &State,
        balanced: &Balanced,
    ) -> SurfaceWork {
        let touching = &balanced.touching;
        let work = (self.surfaces).follow(&problem.contact, touching, &state.displacement);
        self.add_driving_work(work.driving);
        work
    }

    /// Moves to the closed pairs of the next state, after bonds broke by their numbers, and returns the energy that left by them since the last
    /// one.
    pub(super) fn follow_contact(
        &mut self,
        problem: &Problem,
        at: (&State, &Balanced),
        broken: &[u32],
    ) -> ContactLoss {
        let expansion = |load_factor| problem.loads.thermal_strain(load_factor);
        let layout = problem.system.layout();
        self.contact.follow(at, layout, broken, &expansion)
    }

    /// Stores the deformations and the remaining stiffness of the bonds.
    fn keep(&mut self, state: &State, balanced: &Balanced) {
        let remaining = &state.softening.remaining;
        if !remaining.is_empty() {
            self.last = (balanced.deformations.clone(), remaining.clone());
        }
    }
}

/// Counters of a load step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct StepCounters {
    pub(super) step: usize,
    pub(super) broken: usize,
    pub(super) broken_in_step: usize,
    pub(super) rounds: usize,
    pub(super) solves: usize,
    pub(super) at_rest: bool,
    pub(super) negative_eigenvalues: usize,
    pub(super) largest_ratio: f64,
}

serial!(StepCounters {
    step,
    broken,
    broken_in_step,
    rounds,
    solves,
    at_rest,
    negative_eigenvalues,
    largest_ratio,
});

/// Record of an equilibrium.
pub(super) fn step_record(
    problem: &Problem,
    solution: Solution<'_>,
    energies: &Energies,
    fragments: &Fragments,
    counters: StepCounters,
) -> StepRecord {
    let Solution {
        state,
        balanced,
        loads,
        ..
    } = solution;
    let reactions = loads.reactions(state.load_factor, &balanced.internal.values);
    StepRecord {
        step: counters.step,
        load_factor: state.load_factor,
        part: loads.course().map_or(0, |it| it.part),
        factors: loads
            .course()
            .map_or_else(Vec::new, |it| it.factors(state.load_factor)),
        displacement: loads.control_displacement(state.load_factor, &state.displacement),
        reaction: loads.control_force(state.load_factor, &balanced.internal),
        stored_energy: balanced.stored_energy,
        released_energy: energies.released,
        contact: problem.has_contact_at_rest().then_some(ContactAtRest {
            contact_energy: energies.in_contact,
            friction_energy: energies.friction,
        }),
        external_work: energies.external_work,
        energy_floor: balanced.energy_floor.max(energies.floor()),
        dissipated_energy: sum_over_bonds(&*problem.system, state.dissipated.iter().copied()),
        broken_bonds: counters.broken,
        broken_in_step: counters.broken_in_step,
        largest_ratio: counters.largest_ratio,
        rounds: counters.rounds,
        solves: counters.solves,
        fragments: fragments.len(),
        at_rest: counters.at_rest,
        negative_eigenvalues: counters.negative_eigenvalues,
        closed_pairs: balanced.closed.len(),
        motion: None,
        contacts: balanced.touching.readings(&problem.contact),
        rigid_bodies: balanced.touching.rigid_states(&problem.contact),
        group_forces: group_forces(problem, state.load_factor, &reactions),
        probes: probe::values(&problem.probes, solution),
    }
}

/// Forces and moments of each group on the body: the reactions that count for it and its own given forces.
fn group_forces(problem: &Problem, load_factor: f64, reactions: &[f64]) -> Vec<Vec<f64>> {
    let layout = problem.system.layout();
    let groups = problem.loads.groups();
    let owners = groups_of_reactions(groups, layout);
    let numbered = groups.iter().enumerate();
    numbered
        .zip(problem.loads.given_resultants(load_factor))
        .map(|((number, group), mut sum)| {
            for &point in &group.points {
                for (sum, dof) in sum.iter_mut().zip(layout.range(point)) {
                    if owners[dof] == Some(number) {
                        *sum += reactions[dof];
                    }
                }
            }
            sum
        })
        .collect()
}

/// Offers a state to the observer as one from which the run can continue, by what `checkpoint` writes. Returns the reason why the run ends there:
/// `end`, or a stop by the observer. Collective.
pub(super) fn offer(
    observer: &mut dyn Observer,
    numbers: &BondNumbers,
    end: Option<Termination>,
    checkpoint: &dyn Fn(&mut dyn Sink),
) -> Result<Option<Termination>, ObserverError> {
    let asked = observer.asks(end.as_ref())?;
    let has_taken_part = Cell::new(false);
    let written = |out: &mut dyn Sink| {
        has_taken_part.set(true);
        checkpoint(out);
    };
    let all_take_part = numbers.subdomain().any(asked) && !numbers.subdomain().is_whole();
    let moment = Moment {
        end: end.as_ref(),
        checkpoint: &written,
    };
    let onward = observer.moment(&moment)?;
    if all_take_part && !has_taken_part.get() {
        checkpoint(&mut ());
    }
    Ok(end.or_else(|| (onward == Onward::Stop).then_some(Termination::Stopped)))
}

/// Largest utilisation of the intact bonds; 0 without criteria.
pub(super) fn largest_ratio(problem: &Problem, state: &State, balanced: &Balanced) -> f64 {
    largest_ratio_by(
        &problem.criteria_in(state, balanced),
        problem,
        state,
        balanced,
    )
}

/// Largest utilisation of the intact bonds by some criteria.
pub(super) fn largest_ratio_by(
    criteria: &CriteriaInState<'_>,
    problem: &Problem,
    state: &State,
    balanced: &Balanced,
) -> f64 {
    let ratio = (&state.intact, balanced.deformations.measured())
        .into_par_iter()
        .enumerate()
        .filter(|(_, (intact, _))| **intact)
        .map(|(bond, (_, deformation))| criteria.utilisation(bond, deformation))
        .reduce(|| 0.0, f64::max);
    problem.system.subdomain().max(ratio)
}
