//! Contact between surfaces in a motion, with its rigid bodies and its energies.
//!
//! [`ContactForces`] is advanced once a time step. Its energies close the balance of a motion by central differences: over a step the forces do
//! the work 1/2 (f + f') . (u' - u) on the body and on the rigid bodies; what of it is not stored in the contacts counts as dissipated, by
//! friction and where contacts begin and end.

use std::sync::Arc;

use ligament_model::layout::Layout;
use ligament_model::surface::{Bonded, Missed, Search, Step, SurfacePair, Touch, Vector};
use ligament_model::tensor::{cross, minus, norm};

use super::energy_bound::{Drag, PairContacts};
use super::rigid::{RigidWork, add};
use crate::serial;

pub use super::rigid::{RigidBody, RigidMotion, RigidState};

/// Contacts of a motion and their rigid bodies. A copy shares the surfaces.
#[derive(Debug, Clone, Default)]
pub struct ContactProblem {
    /// Contacts.
    pub contacts: Vec<SurfaceContact>,
    /// Rigid bodies.
    pub rigid_bodies: Vec<RigidBody>,
}

/// Surfaces that may come into contact.
#[derive(Debug, Clone)]
pub struct SurfaceContact {
    /// Name in results.
    pub name: String,
    /// The surfaces, without their coordinates.
    pub surfaces: Arc<dyn SurfacePair>,
    /// Index of the rigid body that is met; `None` for contact between surfaces of the body.
    pub rigid_body: Option<usize>,
}

impl SurfaceContact {
    /// A place that the surfaces missed in a step, with the contacts after it, where points move by some way (m) along an axis at most.
    pub(crate) fn missed(
        &self,
        step: Step<'_>,
        farthest: f64,
        touches: &[Touch],
    ) -> Option<Missed> {
        let [before, now] = step.rigid.map(|it| it.displacement);
        // Two points move against each other by twice the diagonal of a cube at most.
        let way = 12.0_f64.sqrt() * farthest + norm(minus(now, before));
        let is_far = way > self.surfaces.way_seen();
        is_far
            .then(|| self.surfaces.missed(step, touches))
            .flatten()
    }
}

impl ContactProblem {
    /// Whether nothing can come into contact.
    pub fn is_empty(&self) -> bool {
        self.contacts.is_empty()
    }

    /// Whether there are contacts, and the gaps of all are linear in the motions.
    pub fn is_linear(&self) -> bool {
        !self.is_empty() && self.contacts.iter().all(|it| it.surfaces.is_linear())
    }

    /// Bound of what the contacts add to the squared frequencies of a body with a layout.
    pub fn stiffness(&self, layout: Layout) -> ContactStiffness {
        if self.is_empty() {
            return ContactStiffness::default();
        }
        let mut sums = vec![0.0; layout.n_degrees_of_freedom()];
        for contact in &self.contacts {
            contact.surfaces.add_bound(&mut sums);
        }
        let of_body = |(index, body): (usize, &RigidBody)| match &body.motion {
            RigidMotion::Prescribed { .. } => 0.0,
            RigidMotion::Free { mass, inertia, .. } => {
                let own = self.contacts.iter();
                let own = own.filter(|it| it.rigid_body == Some(index));
                // With (u + phi x r)^2 <= 2 u^2 + 2 r^2 phi^2 where it turns.
                let share = own.map(|it| {
                    let [stiffness, reach] = it.surfaces.on_rigid_body();
                    match inertia.is_finite() {
                        true => 4.0 * stiffness * (1.0 / mass).max(reach / inertia),
                        false => 2.0 * stiffness / mass,
                    }
                });
                share.sum()
            }
        };
        let rigid = self.rigid_bodies.iter().enumerate();
        ContactStiffness {
            at_degrees_of_freedom: sums,
            squared_frequency: rigid.map(of_body).fold(0.0, f64::max),
        }
    }
}

/// Energies of contacts, J.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactEnergies {
    /// Energy stored in the contacts.
    pub stored: f64,
    /// Energy that friction and the birth and end of contacts have taken so far.
    pub dissipated: f64,
    /// Work so far of what moves the rigid bodies with a prescribed motion, and of the accelerations of free ones.
    pub driving_work: f64,
    /// Kinetic energy of the free rigid bodies, with the velocities in the middles of the steps before and after.
    pub kinetic: f64,
}

/// Resultants of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactReading {
    /// Pressing force on the first surface, N; against a rigid body that on the surface of the deformable body.
    pub normal_force: Vector,
    /// Force of friction on the same surface, N.
    pub friction_force: Vector,
    /// Sum of the sizes of all pressing forces, N.
    pub pressing: f64,
    /// Area in contact, m^2.
    pub area: f64,
    /// Largest penetration that causes a force, m.
    pub penetration: f64,
}

impl ContactReading {
    /// Resultants of the integration points of a contact.
    pub(crate) fn new(touches: &[Touch]) -> Self {
        let mut reading = Self::default();
        for touch in touches.iter().filter(|it| it.depth() > 0.0) {
            let sign = if touch.is_first { 1.0 } else { -1.0 };
            add(&mut reading.normal_force, sign, touch.normal_force());
            add(&mut reading.friction_force, sign, touch.friction_force());
            reading.pressing += touch.stiffness * touch.depth();
            reading.area += touch.area;
            reading.penetration = reading.penetration.max(touch.depth());
        }
        reading
    }
}

/// State of contacts for a checkpoint; everything else follows from the motions.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ContactState {
    pairs: Vec<PairContacts>,
    rigid_bodies: Vec<RigidState>,
    energies: ContactEnergies,
}

/// Bound of what contact adds to the squared frequencies of a body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ContactStiffness {
    /// Diagonal matrix above the stiffness of all contacts, shape (n_degrees_of_freedom), N/m and N m; empty without contacts. With
    /// the masses M_i the largest squared frequency of the body grows by max (this over M_i) at most.
    pub at_degrees_of_freedom: Vec<f64>,
    /// Bound of the squared frequency of free rigid bodies, 1/s^2.
    pub squared_frequency: f64,
}

/// Forces and energies of the contacts along a motion.
#[derive(Debug)]
pub struct ContactForces {
    problem: ContactProblem,
    /// Degrees of freedom that contacts may load, ascending.
    degrees_of_freedom: Vec<u32>,
    searches: Vec<Search>,
    /// Motions at the present time, shape (n_degrees_of_freedom).
    motions: Vec<f64>,
    /// Contact forces at the present time, shape (n_degrees_of_freedom).
    forces: Vec<f64>,
    state: ContactState,
    /// The first place that a step missed, with the number of the contact.
    missed: Option<(usize, Missed)>,
}

impl ContactReading {
    /// Component of the whole force on the first surface along an axis, N.
    pub fn force(&self, axis: usize) -> f64 {
        self.normal_force[axis] + self.friction_force[axis]
    }
}

impl ContactState {
    /// Whether the state can be that of a problem.
    pub fn fits(&self, problem: &ContactProblem) -> bool {
        let fits = |(contact, it): (&SurfaceContact, &PairContacts)| {
            let mut of_drags = it.drags.iter().map(|it| &it.touch);
            let can_have = |touches: &[Touch]| contact.surfaces.can_have(touches);
            can_have(&it.touches) && of_drags.all(|touch| can_have(std::slice::from_ref(touch)))
        };
        self.pairs.len() == problem.contacts.len()
            && self.rigid_bodies.len() == problem.rigid_bodies.len()
            && problem.contacts.iter().zip(&self.pairs).all(fits)
    }
}

impl ContactForces {
    /// Contacts of a problem at time zero, for the motions then, shape (n_degrees_of_freedom), and the bonds, before steps of a
    /// length (s). Surfaces that overlap there begin without force.
    pub fn new(problem: ContactProblem, motions: &[f64], bonds: Bonded<'_>, step: f64) -> Self {
        let rigid = problem.rigid_bodies.iter().map(|it| RigidState {
            velocity: it.motion.velocity(0.0),
            ..RigidState::default()
        });
        let state = ContactState {
            pairs: vec![PairContacts::default(); problem.contacts.len()],
            rigid_bodies: rigid.collect(),
            energies: ContactEnergies::default(),
        };
        let mut contacts = Self::resumed(problem, motions, state, bonds);
        contacts.advance(0.0, 0.0, motions, bonds);
        contacts.state.energies.kinetic = contacts.kinetic_energy(step);
        contacts
    }

    /// Contacts of a problem with the state that they had at some motions, shape (n_degrees_of_freedom), and the bonds then.
    pub fn resumed(
        problem: ContactProblem,
        motions: &[f64],
        state: ContactState,
        bonds: Bonded<'_>,
    ) -> Self {
        let surfaces = problem.contacts.iter().map(|it| &it.surfaces);
        let mut loaded: Vec<u32> = surfaces.flat_map(|it| it.degrees_of_freedom()).collect();
        loaded.sort_unstable();
        loaded.dedup();
        let mut contacts = Self {
            searches: vec![Search::default(); problem.contacts.len()],
            degrees_of_freedom: loaded,
            forces: vec![0.0; motions.len()],
            motions: motions.to_vec(),
            problem,
            state,
            missed: None,
        };
        let numbered = (0..).zip(bonds.intact).filter(|it| !it.1);
        let broken: Vec<u32> = numbered.map(|it| it.0).collect();
        contacts.join(&broken);
        contacts.load_body();
        contacts
    }

    /// Adds the faces of cracks across which bonds broke to the surfaces that have such faces.
    pub fn join(&mut self, broken: &[u32]) {
        let contacts = self.problem.contacts.iter();
        for (contact, search) in contacts.zip(&mut self.searches) {
            contact.surfaces.join(search, &mut broken.iter().copied());
        }
    }

    /// Moves to the next time (s), after a step (s) to given motions, shape (n_degrees_of_freedom), with the bonds that are left.
    ///
    /// Free rigid bodies move by velocity Verlet. The result does not depend on the number of threads.
    pub fn advance(
        &mut self,
        time: f64,
        step: f64,
        motions: &[f64],
        bonds: Bonded<'_>,
    ) -> ContactEnergies {
        let rigid = self.state.rigid_bodies.clone();
        self.move_rigid_bodies(time, step);
        self.meet(&rigid, motions, bonds);
        let before: Vec<f64> = self.at_loaded(&self.forces);
        self.load_body();
        let mut on_body = 0.0;
        for (&dof, before) in self.degrees_of_freedom.iter().zip(before) {
            let dof = dof as usize;
            let way = motions[dof] - self.motions[dof];
            on_body += 0.5 * (before + self.forces[dof]) * way;
            self.motions[dof] = motions[dof];
        }
        let work = self.load_rigid_bodies(&rigid, step);
        let touches = self.state.pairs.iter().flat_map(|it| &it.touches);
        let stored = touches.map(Touch::energy).fold(0.0, |sum, it| sum + it);
        let kinetic = self.kinetic_energy(step);
        let energies = &mut self.state.energies;
        energies.dissipated -= on_body + work.on_driven + work.on_free + (stored - energies.stored);
        energies.driving_work += work.of_acceleration - work.on_driven;
        energies.stored = stored;
        energies.kinetic = kinetic;
        self.state.energies
    }

    /// Adds the contact forces at the present time times a factor to forces on the body, shape (n_degrees_of_freedom), N and N m.
    pub fn add_forces(&self, factor: f64, forces: &mut [f64]) {
        for &dof in &self.degrees_of_freedom {
            forces[dof as usize] += factor * self.forces[dof as usize];
        }
    }

    /// Energies at the present time.
    pub fn energies(&self) -> ContactEnergies {
        self.state.energies
    }

    /// State of each rigid body.
    pub fn rigid_bodies(&self) -> &[RigidState] {
        &self.state.rigid_bodies
    }

    /// The first place that a step so far missed, with the number of the contact.
    pub(crate) fn missed(&self) -> Option<(usize, Missed)> {
        self.missed
    }

    /// State for a checkpoint.
    pub fn state(&self) -> &ContactState {
        &self.state
    }

    /// Resultants of each contact.
    pub fn readings(&self) -> Vec<ContactReading> {
        let pairs = self.state.pairs.iter();
        pairs.map(|it| ContactReading::new(&it.touches)).collect()
    }

    /// Finds the contacts at new motions, given the rigid bodies before the step.
    fn meet(&mut self, before: &[RigidState], motions: &[f64], bonds: Bonded<'_>) {
        let loaded = self.degrees_of_freedom.iter().map(|&dof| dof as usize);
        let ways = loaded.map(|dof| (motions[dof] - self.motions[dof]).abs());
        let farthest = ways.fold(0.0, f64::max);
        for (index, contact) in self.problem.contacts.iter().enumerate() {
            let place = |all: &[RigidState]| {
                let body = contact.rigid_body.map(|it| all[it].pose());
                body.unwrap_or_default()
            };
            let step = Step {
                before: &self.motions,
                now: motions,
                rigid: [place(before), place(&self.state.rigid_bodies)],
                bonds,
            };
            let pair = &mut self.state.pairs[index];
            let surfaces = &*contact.surfaces;
            let touches = surfaces.touches(&mut self.searches[index], step, &pair.touches);
            if self.missed.is_none() {
                let missed = contact.missed(step, farthest, &touches);
                self.missed = missed.map(|it| (index, it));
            }
            *pair = pair.after(surfaces, step, touches);
        }
    }

    /// Computes the forces of the present contacts on the body.
    fn load_body(&mut self) {
        for &dof in &self.degrees_of_freedom {
            self.forces[dof as usize] = 0.0;
        }
        for (contact, it) in self.problem.contacts.iter().zip(&self.state.pairs) {
            contact.surfaces.add_forces(&it.touches, &mut self.forces);
            for Drag { touch, force } in &it.drags {
                contact.surfaces.add_force(touch, *force, &mut self.forces);
            }
        }
    }

    fn at_loaded(&self, values: &[f64]) -> Vec<f64> {
        let loaded = self.degrees_of_freedom.iter();
        loaded.map(|&dof| values[dof as usize]).collect()
    }

    fn move_rigid_bodies(&mut self, time: f64, step: f64) {
        let bodies = self.problem.rigid_bodies.iter();
        for (body, state) in bodies.zip(&mut self.state.rigid_bodies) {
            body.motion.advance(time, step, state);
        }
    }

    /// Loads the rigid bodies with the present contacts, given their states before the step; returns the sum of the works on them.
    fn load_rigid_bodies(&mut self, before: &[RigidState], step: f64) -> RigidWork {
        let mut sum = RigidWork::default();
        for (index, body) in self.problem.rigid_bodies.iter().enumerate() {
            let state = &mut self.state.rigid_bodies[index];
            (state.force, state.moment) = Default::default();
            let contacts = self.problem.contacts.iter().zip(&self.state.pairs);
            let own = contacts.filter(|(contact, _)| contact.rigid_body == Some(index));
            let forces = own.flat_map(|(_, it)| {
                let touches = it.touches.iter().map(|it| (it, it.force()));
                touches.chain(it.drags.iter().map(|it| (&it.touch, it.force)))
            });
            for (touch, force) in forces {
                add(&mut state.force, -1.0, force);
                add(&mut state.moment, -1.0, cross(touch.arm, force));
            }
            let work = body.motion.accelerate(step, &before[index], state);
            sum.on_driven += work.on_driven;
            sum.on_free += work.on_free;
            sum.of_acceleration += work.of_acceleration;
        }
        sum
    }

    /// Kinetic energy of the free rigid bodies, with the velocities half a step (s) before and after.
    fn kinetic_energy(&self, step: f64) -> f64 {
        let bodies = self.problem.rigid_bodies.iter();
        bodies
            .zip(&self.state.rigid_bodies)
            .map(|(body, state)| body.motion.kinetic_energy(step, state))
            .fold(0.0, |sum, it| sum + it)
    }
}

serial!(Touch {
    place,
    onto,
    weights,
    arm,
    normal,
    overlap,
    offset,
    slip,
    stiffness,
    credit,
    area,
    is_first
});
serial!(ContactReading {
    normal_force,
    friction_force,
    pressing,
    area,
    penetration
});
serial!(ContactEnergies {
    stored,
    dissipated,
    driving_work,
    kinetic
});
serial!(ContactState {
    pairs,
    rigid_bodies,
    energies
});
