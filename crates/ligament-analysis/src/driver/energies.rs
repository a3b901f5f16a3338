//! Energies along a run, as all drivers count them.

use std::io::Read;

use ligament_model::deformation::Deformations;
use ligament_model::element::StiffnessFactors;
use serde::{Deserialize, Serialize};

use crate::balanced::Balanced;
use crate::bond_numbers::add_over_bonds;
use crate::breakage::Breakage;
use crate::checkpoint::CheckpointError;
use crate::contact::faces::{FaceEnergy, FaceLoss};
use crate::contact::{LastTouching, SurfaceEnergy, SurfaceWork};
use crate::history::InMotion;
use crate::problem::Problem;
use crate::serial::{Serial, Sink};
use crate::state::State;

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
    pub(super) friction: f64,
    /// Energy stored in contacts between surfaces.
    pub(super) in_contact: f64,
    /// Number of time steps and energies of a motion, J; the energies of contact are separate. Zero in statics.
    pub(super) motion: InMotion,
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
    contact: FaceEnergy,
    /// Contact between surfaces in the last state.
    surfaces: SurfaceEnergy,
}

/// Force and displacement of a degree of freedom in the last state.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
struct Loaded {
    force: f64,
    displacement: f64,
}

impl Energies {
    /// Appends the data that do not follow from the problem and the state.
    pub(super) fn write(&self, out: &mut dyn Sink) {
        let Self {
            external_work,
            released,
            friction,
            in_contact,
            motion,
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
        motion.write(out);
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
            motion: Serial::read(from)?,
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
            energies.surfaces = SurfaceEnergy::new(&problem.contact, state.surfaces.clone());
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
            motion: InMotion::default(),
            surfaces: SurfaceEnergy::new(&problem.contact, LastTouching::default()),
            largest_work: 0.0,
            thermal: (0.0, 0.0),
            last: Default::default(),
            contact: FaceEnergy::of_unloaded(&*problem.system),
            last_loaded: vec![Loaded::default(); loaded.len()],
            loaded,
        }
    }

    /// Adds the work and the released energy from the last state to this one, in which bonds broke.
    pub(super) fn account(
        &mut self,
        problem: &Problem,
        (state, balanced): (&State, &Balanced),
        breakage: &Breakage,
    ) {
        self.add_work(problem, state, balanced);
        self.add_released(problem, state, breakage, balanced);
    }

    /// Adds the work from the last state to this one.
    fn add_work(&mut self, problem: &Problem, state: &State, balanced: &Balanced) {
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
    pub(super) fn floor(&self) -> f64 {
        UNLOADED * self.largest_work
    }

    /// Adds the energy released by a breakage and by softening since the last state.
    fn add_released(
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
            let both = [before, &balanced.deformations];
            let system = &problem.system;
            self.released += system.energy_lost_by_cells(&state.intact, [left, remaining], both);
        }
        self.keep(state, balanced);
    }

    /// Begins a part of a programme at this load factor.
    pub(super) fn begin_part(&mut self, load_factor: f64) {
        self.contact.begin_part(load_factor);
    }

    /// Time steps and energies of a motion.
    pub(super) fn in_motion(&self) -> InMotion {
        InMotion {
            contact_energy: self.in_contact,
            friction_energy: self.friction,
            ..self.motion
        }
    }

    /// Adds the energy of pairs across cracks that opened or closed since the last state, and of friction and contact between surfaces: after a
    /// breakage, at fixed load, what pairs lost is released; between two loads it corrects the work by the trapezoidal rule.
    pub(super) fn add_contact(
        &mut self,
        problem: &Problem,
        state: &State,
        breakage: &Breakage,
        balanced: &Balanced,
    ) {
        let loss = self.follow_contact(problem, (state, balanced), &breakage.bonds);
        let surfaces = self.follow_surfaces(problem, state);
        let mut dissipated = loss.friction + surfaces.dissipated;
        if breakage.bonds.is_empty() {
            dissipated -= surfaces.excess;
            self.external_work -= loss.closure + surfaces.excess;
        } else {
            self.released += loss.closure;
        }
        self.friction += dissipated;
        self.in_contact = surfaces.stored;
    }

    /// Adds the energies of pairs across cracks and of contact between surfaces, in a step with inertia. The energy that
    /// pairs lose where they open and close counts as friction there.
    pub(super) fn add_contact_in_motion(
        &mut self,
        problem: &Problem,
        at: (&State, &Balanced),
        broken: &[u32],
    ) {
        let loss = self.follow_contact(problem, at, broken);
        let surfaces = self.follow_surfaces(problem, at.0);
        self.friction += loss.closure + loss.friction + surfaces.dissipated;
        self.in_contact = surfaces.stored;
    }

    /// Moves to the contact between surfaces of the next state, and adds the work of what moves rigid bodies.
    pub(super) fn follow_surfaces(&mut self, problem: &Problem, state: &State) -> SurfaceWork {
        let n = state.displacement.len();
        let work = (self.surfaces).follow(&problem.contact, &state.surfaces, n);
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
    ) -> FaceLoss {
        let expansion = |load_factor| problem.loads.thermal_strain(load_factor);
        let layout = problem.system.layout;
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
