//! Contact between surfaces: where they touch in a state, the forces there, and the motions that they resist.
//!
//! The law ([`ligament_model::surface`]) is one of steps at the present positions. Friction and the depth of contacts that began with an
//! overlap follow from the last time step, or from the last equilibrium.

use std::borrow::Cow;
use std::sync::Arc;

use ligament_model::held::{HeldMotion, held_motions};
use ligament_model::layout::Layout;
use ligament_model::surface::{Bonded, Missed, Pose, Search, Step, Touch, Vector};
use ligament_model::sweep::BondSweep;
use ligament_model::tensor::{cross, dot, norm};
use serde::{Deserialize, Serialize};

use super::energy_bound::PairContacts;
use super::problem::{ContactProblem, ContactReading, SurfaceContact};
use super::resisting::{ACROSS, Resisting};
use super::rigid_body::{Resultant, RigidState, add};

/// Share of the length of a facet by which surfaces move in an iteration at most: overlaps deeper than the length of a facet are not
/// detected.
const FARTHEST: f64 = 0.25;

/// Share of the elastic stiffness that a sliding contact is assumed to have across its direction of sliding.
const SLIDING: f64 = 0.5;

/// Rounding by which friction at its limit falls short of it.
const ROUNDING: f64 = 1e-10;

/// Contact between surfaces in a state.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Touching {
    /// Contacts of each pair of surfaces; none before the first search.
    pub pairs: Vec<PairContacts>,
    /// Place of each rigid body.
    pub rigid: Vec<Pose>,
}

impl Touching {
    /// Integration points in contact.
    pub fn touches(&self) -> impl Iterator<Item = &Touch> {
        self.pairs.iter().flat_map(|it| &it.touches)
    }

    /// Integration points of a contact, by its number; none before the first search.
    pub(super) fn touches_of(&self, contact: usize) -> &[Touch] {
        self.pairs.get(contact).map_or(&[], |it| &it.touches)
    }

    /// Place of a rigid body, by its number.
    pub(super) fn pose(&self, body: usize) -> Pose {
        self.rigid.get(body).copied().unwrap_or_default()
    }

    /// Stored energy, J.
    pub fn energy(&self) -> f64 {
        self.touches()
            .map(Touch::energy)
            .fold(0.0, |sum, it| sum + it)
    }

    /// Largest work of the forces that a depth (m) causes where surfaces press, or at one place of a stiffness (N/m) that may just touch, on
    /// points with the largest displacement (m), or on rigid bodies, J.
    pub(crate) fn largest_work(&self, depth: f64, displacement: f64, stiffness: f64) -> f64 {
        let pressed = self.touches().filter(|it| it.depth() > 0.0);
        let pressed: f64 = pressed.map(|it| it.stiffness).sum();
        pressed.max(stiffness) * depth * displacement.max(self.largest_way())
    }

    /// Largest displacement of a rigid body, m.
    fn largest_way(&self) -> f64 {
        let ways = self.rigid.iter().map(|it| norm(it.displacement));
        ways.fold(0.0, f64::max)
    }

    /// Resultants of each contact of a problem; none before the first search.
    pub fn readings(&self, problem: &ContactProblem) -> Vec<ContactReading> {
        let contacts = 0..problem.contacts.len();
        contacts
            .map(|it| ContactReading::new(self.touches_of(it)))
            .collect()
    }

    /// States of the rigid bodies of a problem, at rest.
    pub(crate) fn rigid_states(&self, problem: &ContactProblem) -> Vec<RigidState> {
        let loads = self.on_rigid_bodies(problem).into_iter().enumerate();
        let state = |(body, [force, moment]): (usize, Resultant)| {
            let pose = self.pose(body);
            RigidState {
                displacement: pose.displacement,
                rotation: pose.rotation,
                force,
                moment,
                ..RigidState::default()
            }
        };
        loads.map(state).collect()
    }

    /// Adds the forces of the contacts on the points of a body, times a factor, to forces of shape (n_degrees_of_freedom), N and N m.
    pub fn add_forces(&self, problem: &ContactProblem, factor: f64, forces: &mut [f64]) {
        for (contact, pair) in problem.contacts.iter().zip(&self.pairs) {
            for (touch, force) in pair.forces() {
                let force = force.map(|it| factor * it);
                contact.surfaces.add_force(touch, force, forces);
            }
        }
    }

    /// Forces of the contacts on the points of a body, shape (n), N and N m.
    pub fn forces(&self, problem: &ContactProblem, n: usize) -> Vec<f64> {
        let mut forces = vec![0.0; n];
        self.add_forces(problem, 1.0, &mut forces);
        forces
    }

    /// Force and moment of the contacts on each rigid body, N and N m.
    pub(crate) fn on_rigid_bodies(&self, problem: &ContactProblem) -> Vec<Resultant> {
        let mut sums = vec![Resultant::default(); problem.rigid_bodies.len()];
        for (contact, pair) in problem.contacts.iter().zip(&self.pairs) {
            let Some(body) = contact.rigid_body else {
                continue;
            };
            let [sum, moment] = &mut sums[body];
            for (touch, force) in pair.forces() {
                add(sum, -1.0, force);
                add(moment, -1.0, cross(touch.arm, force));
            }
        }
        sums
    }

    /// Force of the contacts on each rigid body, N.
    pub fn forces_on_rigid_bodies(&self, problem: &ContactProblem) -> Vec<Vector> {
        let loads = self.on_rigid_bodies(problem);
        loads.into_iter().map(|[force, _]| force).collect()
    }

    /// Adds the internal forces by which the points bear the contacts to the sums over the bonds.
    pub(crate) fn add_to(&self, swept: &mut BondSweep, problem: &ContactProblem, layout: Layout) {
        swept.internal.on_rigid_bodies = self.forces_on_rigid_bodies(problem);
        let forces = self.forces(problem, swept.internal.values.len());
        for (dof, force) in forces.into_iter().enumerate().filter(|it| it.1 != 0.0) {
            swept.internal.values[dof] -= force;
            swept.sizes[dof] += force.abs();
            let scale = if layout.component(dof).is_rotation() {
                &mut swept.internal.moment_scale
            } else {
                &mut swept.internal.force_scale
            };
            *scale = scale.max(swept.sizes[dof]);
        }
    }

    /// Motions that the contacts resist, in the order of their keys; the keys of faces of cracks come before them.
    pub(crate) fn resisting(&self, problem: &ContactProblem, layout: Layout) -> Vec<Resisting> {
        let of_touch = |(number, contact, touch): (u64, &SurfaceContact, &Touch)| {
            let friction = contact.surfaces.friction();
            let mut all = vec![across(number, contact, touch)];
            if friction > 0.0 {
                let share = share_held(touch, friction);
                let held = held_motions(layout, touch.normal, (touch.friction_force(), share));
                let held = held.into_iter();
                all.extend(held.map(|it| along(number, contact, touch, it)));
            }
            all
        };
        let pressed = self.numbered(problem).filter(|it| it.2.depth() > 0.0);
        pressed.flat_map(of_touch).collect()
    }

    /// The motion that each contact resists when it is closed, its gap (m), and the change of the gap by a rigid body with the load factor
    /// (m); for open contacts as well where surfaces list them. In the order of the keys.
    pub(crate) fn gaps(&self, problem: &ContactProblem) -> Vec<(Resisting, f64, f64)> {
        let of_touch = |(number, contact, touch): (u64, &SurfaceContact, &Touch)| {
            let body = contact.rigid_body.map(|it| &problem.rigid_bodies[it]);
            let carried = body
                .map(|it| it.motion.displacement(1.0))
                .unwrap_or_default();
            let shift = -dot(carried, touch.normal);
            (across(number, contact, touch), -touch.depth(), shift)
        };
        self.numbered(problem).map(of_touch).collect()
    }

    /// Integration points in contact, each with its number and its contact.
    fn numbered<'a>(
        &'a self,
        problem: &'a ContactProblem,
    ) -> impl Iterator<Item = (u64, &'a SurfaceContact, &'a Touch)> {
        let contacts = (1_u64..).zip(problem.contacts.iter().zip(&self.pairs));
        contacts.flat_map(|(number, (contact, pair))| {
            let touches = pair.touches.iter();
            touches.map(move |it| ((number << 32) | u64::from(it.place), contact, it))
        })
    }
}

/// Motion along its normal that a contact with a number resists.
fn across(number: u64, contact: &SurfaceContact, touch: &Touch) -> Resisting {
    Resisting {
        key: (number, ACROSS),
        way: touch.normal,
        stiffness: touch.stiffness,
        row: contact.surfaces.row(touch, touch.normal),
    }
}

/// Motion that the friction of a contact with a number resists.
fn along(number: u64, contact: &SurfaceContact, touch: &Touch, held: HeldMotion) -> Resisting {
    Resisting {
        key: (number, held.number),
        way: held.way,
        stiffness: held.share * touch.stiffness,
        row: contact.surfaces.row(touch, held.way),
    }
}

/// Share of the elastic stiffness that friction has: 1 where the contact sticks.
fn share_held(touch: &Touch, friction: f64) -> f64 {
    let limit = friction * touch.depth();
    if norm(touch.slip) < (1.0 - ROUNDING) * limit {
        1.0
    } else {
        SLIDING
    }
}

/// Contact between surfaces in the last equilibrium or after the last time step, from which the next step begins. A copy shares it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LastTouching {
    touching: Arc<Touching>,
    /// Motions of all points, shape (n_degrees_of_freedom); empty before the first step, in which the points begin without motion.
    motions: Arc<[f64]>,
}

impl LastTouching {
    /// Contact that was stored with a state and the motions of its points (n_degrees_of_freedom); empty without contacts.
    pub(crate) fn restored(touching: Touching, motions: &[f64]) -> Self {
        match touching.pairs.is_empty() {
            true => Self::default(),
            false => Self::new(touching.into(), motions),
        }
    }

    /// Contact after a step with the motions of all points (n_degrees_of_freedom).
    pub fn new(touching: Arc<Touching>, motions: &[f64]) -> Self {
        Self {
            touching,
            motions: motions.into(),
        }
    }

    /// The contact, which a copy shares.
    pub(crate) fn shared(&self) -> Arc<Touching> {
        self.touching.clone()
    }

    /// The contact.
    pub fn touching(&self) -> &Touching {
        &self.touching
    }

    /// Motions of all points, shape (n).
    pub(super) fn motions(&self, n: usize) -> Cow<'_, [f64]> {
        match self.motions.is_empty() {
            true => Cow::Owned(vec![0.0; n]),
            false => Cow::Borrowed(&self.motions),
        }
    }

    /// Whether it can belong to a problem.
    pub(crate) fn fits(&self, problem: &ContactProblem) -> bool {
        let Touching { pairs, rigid } = &*self.touching;
        let can_have = |(contact, pair): (&SurfaceContact, &PairContacts)| {
            let can_have = |touches: &[Touch]| contact.surfaces.can_have(touches);
            let mut drags = pair.drags.iter().map(|it| &it.touch);
            can_have(&pair.touches) && drags.all(|it| can_have(std::slice::from_ref(it)))
        };
        pairs.is_empty()
            || (pairs.len() == problem.contacts.len()
                && rigid.len() == problem.rigid_bodies.len()
                && problem.contacts.iter().zip(pairs).all(can_have))
    }
}

/// A step from the last contact: the contact before it, and the motions and bonds after it.
#[derive(Clone, Copy)]
pub struct ContactStep<'a> {
    /// Contact before the step.
    pub last: &'a LastTouching,
    /// Bonds after the step.
    pub bonds: Bonded<'a>,
    /// Motions of all points after the step, shape (n_degrees_of_freedom).
    pub motions: &'a [f64],
}

impl ContactStep<'_> {
    /// Motions of all points before the step, shape (n_degrees_of_freedom).
    fn before(&self) -> Cow<'_, [f64]> {
        self.last.motions(self.motions.len())
    }

    /// The step as a contact sees it, from motions of all points (n_degrees_of_freedom) to a contact after it.
    fn of_contact<'a>(
        &'a self,
        before: &'a [f64],
        now: &Touching,
        contact: &SurfaceContact,
    ) -> Step<'a> {
        let pose = |it: &Touching| contact.rigid_body.map(|body| it.pose(body));
        Step {
            before,
            now: self.motions,
            rigid: [&self.last.touching, now].map(|it| pose(it).unwrap_or_default()),
            bonds: self.bonds,
        }
    }
}

/// Search for touching surfaces. Results of earlier searches only save time.
#[derive(Debug, Clone, Default)]
pub struct SurfaceSearch {
    problem: ContactProblem,
    searches: Vec<Search>,
    /// Displacements of the points of the surfaces, ascending.
    degrees_of_freedom: Vec<u32>,
    /// Largest motion of a surface in an iteration, m.
    farthest: f64,
    /// Largest coordinate without motion that gaps are computed from, m.
    coordinate: f64,
}

impl SurfaceSearch {
    /// Search for the contacts of a problem of a body with a layout, without faces of cracks.
    pub fn new(problem: &ContactProblem, layout: Layout) -> Self {
        let surfaces = || problem.contacts.iter().map(|it| &it.surfaces);
        let mut dofs = problem.degrees_of_freedom();
        dofs.retain(|&dof| !layout.component(dof as usize).is_rotation());
        let reach = surfaces()
            .map(|it| it.reach())
            .fold(f64::INFINITY, f64::min);
        let mut searches = vec![Search::default(); problem.contacts.len()];
        for (surfaces, search) in surfaces().zip(&mut searches) {
            surfaces.join(search, &mut std::iter::empty());
        }
        Self {
            searches,
            degrees_of_freedom: dofs,
            farthest: FARTHEST * reach,
            coordinate: surfaces().map(|it| it.coordinate()).fold(0.0, f64::max),
            problem: problem.clone(),
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.problem.is_empty()
    }

    pub(crate) fn problem(&self) -> &ContactProblem {
        &self.problem
    }

    /// Largest coordinate that gaps are computed from, with the largest displacement of a point (m) and of a rigid body, m; zero without
    /// contacts.
    pub(crate) fn coordinate(&self, displacement: f64, touching: &Touching) -> f64 {
        match self.coordinate {
            0.0 => 0.0,
            still => still.max(displacement).max(touching.largest_way()),
        }
    }

    /// Adds the faces of cracks across which bonds broke, by their numbers, to the surfaces that have such faces.
    pub fn join(&mut self, broken: impl Iterator<Item = u32> + Clone) {
        let contacts = self.problem.contacts.iter();
        for (contact, search) in contacts.zip(&mut self.searches) {
            contact.surfaces.join(search, &mut broken.clone());
        }
    }

    /// Contact between surfaces after a step, at a load factor, which is the time in a motion, and with these poses of free rigid bodies.
    ///
    /// Where nothing has moved since the last equilibrium, the contact is the same to the last bit.
    pub(crate) fn touching(
        &mut self,
        step: ContactStep<'_>,
        (load_factor, free): (f64, &[Pose]),
    ) -> Touching {
        let bodies = self.problem.rigid_bodies.iter().enumerate();
        let rigid = bodies.map(|(body, it)| it.motion.pose(load_factor, free.get(body)));
        let mut found = Touching {
            pairs: Vec::new(),
            rigid: rigid.collect(),
        };
        let last = step.last;
        let is_known = !last.touching.pairs.is_empty();
        if is_known && *last.motions == *step.motions && last.touching.rigid == found.rigid {
            return (*last.touching).clone();
        }
        let before = step.before();
        let contacts = self.problem.contacts.iter().zip(&mut self.searches);
        let pairs = contacts.enumerate().map(|(index, (contact, search))| {
            let of_contact = step.of_contact(&before, &found, contact);
            let then = last.touching.touches_of(index);
            PairContacts {
                touches: contact.surfaces.touches(search, of_contact, then),
                ..PairContacts::default()
            }
        });
        found.pairs = pairs.collect();
        found
    }

    /// Contact between surfaces after an explicit step to a time (s) and these poses of free rigid bodies; its forces never release energy.
    pub fn touching_in_time(&mut self, step: ContactStep<'_>, at: (f64, &[Pose])) -> Touching {
        let mut found = self.touching(step, at);
        let before = step.before();
        let unbounded = std::mem::take(&mut found.pairs);
        let contacts = self.problem.contacts.iter().zip(unbounded);
        let first = PairContacts::default();
        let pairs = contacts.enumerate().map(|(index, (contact, pair))| {
            let of_contact = step.of_contact(&before, &found, contact);
            let then = step.last.touching.pairs.get(index).unwrap_or(&first);
            then.after(&*contact.surfaces, of_contact, pair.touches)
        });
        found.pairs = pairs.collect();
        found
    }

    /// The first contact that a step missed, by its number, with the contact after it.
    pub(crate) fn missed(
        &self,
        step: ContactStep<'_>,
        touching: &Touching,
    ) -> Option<(usize, Missed)> {
        let before = step.before();
        let dofs = self.degrees_of_freedom.iter().map(|&dof| dof as usize);
        let of_points = dofs.map(|dof| step.motions[dof] - before[dof]);
        let farthest = of_points.fold(0.0, |largest: f64, it| largest.max(it.abs()));
        let contacts = self.problem.contacts.iter().enumerate();
        let mut missed = contacts.map(|(index, contact)| {
            let of_contact = step.of_contact(&before, touching, contact);
            let touches = touching.touches_of(index);
            Some((index, contact.missed(of_contact, farthest, touches)?))
        });
        missed.find_map(|it| it)
    }

    /// Part of a correction (n_degrees_of_freedom), and of free rigid bodies, by which surfaces move as far as they may in an iteration, at
    /// most 1.
    pub(crate) fn part_within_reach(&self, correction: &[f64], rigid: &[Vector]) -> f64 {
        let dofs = self.degrees_of_freedom.iter();
        let of_points = dofs.map(|&dof| correction[dof as usize].abs());
        let of_rigid = rigid.as_flattened().iter().map(|it| it.abs());
        let largest = of_points.chain(of_rigid);
        let largest = largest.fold(0.0, f64::max);
        if largest > self.farthest {
            self.farthest / largest
        } else {
            1.0
        }
    }
}
