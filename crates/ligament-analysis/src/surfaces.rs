//! Contact between surfaces in equilibria: where they touch in a state, the forces there, and what they resist.
//!
//! The law is that of a motion ([`ligament_model::surface`]) at the present positions. The last equilibrium takes the place of the last time
//! step: friction and the depth of contacts that began with an overlap follow from it.

use std::borrow::Cow;

use ligament_model::held::{HeldMotion, held_motions};
use ligament_model::layout::Layout;
use ligament_model::surface::{Bonded, Missed, Pose, Search, Step, Touch, Vector};
use ligament_model::sweep::BondSweep;
use ligament_model::tensor::{dot, minus, norm};

use crate::motion::contact::{
    ContactProblem, ContactReading, RigidBody, RigidMotion, RigidState, SurfaceContact,
};
use crate::resisting::{ACROSS, Resisting};
use crate::serial;

/// Share of the length of a facet by which surfaces move in an iteration at most: deeper overlaps than a facet is long are not seen.
const FARTHEST: f64 = 0.25;

/// Share of the elastic stiffness that a sliding contact is taken to have across its way.
const SLIDING: f64 = 0.5;

/// Rounding by which friction at its limit falls short of it.
const ROUNDING: f64 = 1e-10;

/// Contact between surfaces in a state.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Touching {
    /// Integration points in contact, of each contact in the order of their numbers.
    pub touches: Vec<Vec<Touch>>,
    /// Displacement of each rigid body, m.
    pub rigid: Vec<Vector>,
}

serial!(Touching { touches, rigid });

impl Touching {
    /// Stored energy, J.
    pub fn energy(&self) -> f64 {
        let touches = self.touches.iter().flatten();
        touches.map(Touch::energy).fold(0.0, |sum, it| sum + it)
    }

    /// Largest work of the forces that a depth (m) causes where surfaces press, or at one place of a stiffness (N/m) that may just touch, on
    /// points with the largest displacement (m), or on rigid bodies, J.
    pub(crate) fn largest_work(&self, depth: f64, displacement: f64, stiffness: f64) -> f64 {
        let pressed = self.touches.iter().flatten().filter(|it| it.depth() > 0.0);
        let pressed: f64 = pressed.map(|it| it.stiffness).sum();
        pressed.max(stiffness) * depth * displacement.max(self.largest_way())
    }

    /// Largest displacement of a rigid body, m.
    fn largest_way(&self) -> f64 {
        self.rigid.iter().map(|it| norm(*it)).fold(0.0, f64::max)
    }

    /// Place of the rigid body of a contact.
    fn pose(&self, contact: &SurfaceContact) -> Pose {
        let body = contact.rigid_body.and_then(|it| self.rigid.get(it));
        Pose {
            displacement: body.copied().unwrap_or_default(),
            ..Pose::default()
        }
    }

    /// Resultants of each contact of a problem; none before the first equilibrium.
    pub(crate) fn readings(&self, problem: &ContactProblem) -> Vec<ContactReading> {
        let touches = |contact: usize| self.touches.get(contact).map_or(&[][..], |it| it);
        let contacts = 0..problem.contacts.len();
        contacts
            .map(|it| ContactReading::new(touches(it)))
            .collect()
    }

    /// States of the rigid bodies of a problem, at rest.
    pub(crate) fn rigid_states(&self, problem: &ContactProblem) -> Vec<RigidState> {
        let forces = self.on_rigid_bodies(problem).into_iter().enumerate();
        let state = |(body, force)| RigidState {
            displacement: self.rigid.get(body).copied().unwrap_or_default(),
            force,
            ..RigidState::default()
        };
        forces.map(state).collect()
    }

    /// Forces of the contacts on the points of a body, shape (n), N and N m.
    pub(crate) fn forces(&self, problem: &ContactProblem, n: usize) -> Vec<f64> {
        let mut forces = vec![0.0; n];
        for (contact, touches) in problem.contacts.iter().zip(&self.touches) {
            contact.surfaces.add_forces(touches, &mut forces);
        }
        forces
    }

    /// Force of the contacts on each rigid body, N.
    pub fn on_rigid_bodies(&self, problem: &ContactProblem) -> Vec<Vector> {
        let mut forces = vec![Vector::default(); problem.rigid_bodies.len()];
        for (contact, touches) in problem.contacts.iter().zip(&self.touches) {
            let Some(body) = contact.rigid_body else {
                continue;
            };
            for touch in touches.iter().filter(|it| it.depth() > 0.0) {
                forces[body] = minus(forces[body], touch.force());
            }
        }
        forces
    }

    /// Adds the internal forces that keep the points in place against the contacts to those of the bonds.
    pub(crate) fn add_to(&self, swept: &mut BondSweep, problem: &ContactProblem, layout: Layout) {
        swept.internal.on_rigid_bodies = self.on_rigid_bodies(problem);
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

    /// What the contacts resist, in the order of the keys, behind those of the faces of cracks.
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

    /// What each contact resists where it is closed, its gap (m), and the change of the gap by a rigid body with the load factor (m); open
    /// ones as well where surfaces list them. In the order of the keys.
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
        let contacts = (1_u64..).zip(problem.contacts.iter().zip(&self.touches));
        contacts.flat_map(|(number, (contact, touches))| {
            let touches = touches.iter();
            touches.map(move |it| ((number << 32) | u64::from(it.place), contact, it))
        })
    }
}

/// What a contact with a number resists along its normal.
fn across(number: u64, contact: &SurfaceContact, touch: &Touch) -> Resisting {
    Resisting {
        key: (number, ACROSS),
        way: touch.normal,
        stiffness: touch.stiffness,
        row: contact.surfaces.row(touch, touch.normal),
    }
}

/// What the friction of a contact with a number resists of a motion.
fn along(number: u64, contact: &SurfaceContact, touch: &Touch, held: HeldMotion) -> Resisting {
    Resisting {
        key: (number, held.number),
        way: held.way,
        stiffness: held.share * touch.stiffness,
        row: contact.surfaces.row(touch, held.way),
    }
}

/// Share of the elastic stiffness that friction holds: 1 where the contact sticks.
fn share_held(touch: &Touch, friction: f64) -> f64 {
    let limit = friction * touch.depth();
    if norm(touch.slip) < (1.0 - ROUNDING) * limit {
        1.0
    } else {
        SLIDING
    }
}

/// Contact between surfaces in the last equilibrium; empty before the first.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LastTouching {
    touching: Touching,
    /// Motions of all points, shape (n_degrees_of_freedom).
    motions: Vec<f64>,
}

impl LastTouching {
    /// Contact that was stored with a state, of which the motions of all points (n_degrees_of_freedom) are; empty without contacts.
    pub(crate) fn restored(touching: Touching, motions: &[f64]) -> Self {
        match touching.touches.is_empty() {
            true => Self::default(),
            false => Self::new(touching, motions),
        }
    }

    /// Contact in an equilibrium with the motions of all points (n_degrees_of_freedom).
    pub(crate) fn new(touching: Touching, motions: &[f64]) -> Self {
        Self {
            touching,
            motions: motions.to_vec(),
        }
    }

    /// The contact.
    pub fn touching(&self) -> &Touching {
        &self.touching
    }

    /// Motions of all points, shape (n); before the first equilibrium nothing has moved.
    fn motions_of(&self, n: usize) -> Cow<'_, [f64]> {
        match self.motions.is_empty() {
            true => Cow::Owned(vec![0.0; n]),
            false => Cow::Borrowed(&self.motions),
        }
    }

    /// Whether it can be that of a problem.
    pub(crate) fn fits(&self, problem: &ContactProblem) -> bool {
        let Touching { touches, rigid } = &self.touching;
        touches.is_empty()
            || (touches.len() == problem.contacts.len()
                && rigid.len() == problem.rigid_bodies.len()
                && (problem.contacts.iter().zip(touches))
                    .all(|(contact, touches)| contact.surfaces.can_have(touches)))
    }
}

/// Finds where surfaces touch. What was found before only saves time.
#[derive(Debug, Clone, Default)]
pub(crate) struct Surfaces {
    problem: ContactProblem,
    searches: Vec<Search>,
    /// Displacements of the points of the surfaces, ascending.
    degrees_of_freedom: Vec<u32>,
    /// Largest motion of a surface in an iteration, m.
    farthest: f64,
    /// Largest coordinate without motion that gaps are computed from, m.
    coordinate: f64,
}

impl Surfaces {
    pub(crate) fn new(problem: &ContactProblem, layout: Layout) -> Self {
        let surfaces = || problem.contacts.iter().map(|it| &it.surfaces);
        let dofs = surfaces().flat_map(|it| it.degrees_of_freedom());
        let is_displacement = |dof: &u32| !layout.component(*dof as usize).is_rotation();
        let mut dofs: Vec<u32> = dofs.filter(is_displacement).collect();
        dofs.sort_unstable();
        dofs.dedup();
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

    /// Where surfaces touch at motions of all points (n_degrees_of_freedom), a load factor, which is the time in a motion, and displacements of
    /// free rigid bodies.
    ///
    /// Where nothing has moved since the last equilibrium, the contact has its bits.
    pub(crate) fn touching(
        &mut self,
        (last, bonds): (&LastTouching, Bonded<'_>),
        motions: &[f64],
        (load_factor, free): (f64, &[Vector]),
    ) -> Touching {
        let bodies = self.problem.rigid_bodies.iter().enumerate();
        let place = |(body, it): (usize, &RigidBody)| match it.motion {
            RigidMotion::Prescribed { .. } => it.motion.displacement(load_factor),
            RigidMotion::Free { .. } => free.get(body).copied().unwrap_or_default(),
        };
        let rigid: Vec<Vector> = bodies.map(place).collect();
        if last.motions == motions && last.touching.rigid == rigid {
            return last.touching.clone();
        }
        let before = last.motions_of(motions.len());
        let mut found = Touching {
            touches: Vec::new(),
            rigid,
        };
        let contacts = self.problem.contacts.iter().zip(&mut self.searches);
        let touches = contacts.enumerate().map(|(index, (contact, search))| {
            let step = Step {
                before: &before,
                now: motions,
                rigid: [&last.touching, &found].map(|it| it.pose(contact)),
                bonds,
            };
            let then = last.touching.touches.get(index).map_or(&[][..], |it| it);
            contact.surfaces.touches(search, step, then)
        });
        found.touches = touches.collect();
        found
    }

    /// The first contact that a step from the last equilibrium to another one, with motions of all points (n_degrees_of_freedom), missed, by its
    /// number.
    pub(crate) fn missed(
        &self,
        (last, bonds): (&LastTouching, Bonded<'_>),
        (motions, touching): (&[f64], &Touching),
    ) -> Option<(usize, Missed)> {
        let before = last.motions_of(motions.len());
        let dofs = self.degrees_of_freedom.iter().map(|&dof| dof as usize);
        let of_points = dofs.map(|dof| motions[dof] - before[dof]);
        let farthest = of_points.fold(0.0, |largest: f64, it| largest.max(it.abs()));
        let contacts = self.problem.contacts.iter().zip(&touching.touches);
        contacts
            .enumerate()
            .find_map(|(index, (contact, touches))| {
                let step = Step {
                    before: &before,
                    now: motions,
                    rigid: [&last.touching, touching].map(|it| it.pose(contact)),
                    bonds,
                };
                Some((index, contact.missed(step, farthest, touches)?))
            })
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

/// Energies of contact between surfaces along equilibria.
#[derive(Debug, Clone, Default)]
pub(crate) struct SurfaceEnergy {
    last: Touching,
    motions: Vec<f64>,
}

/// Energies of a step, J.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct SurfaceWork {
    /// Energy stored at the end of the step.
    pub(crate) stored: f64,
    /// Energy that friction and the begin and end of contacts took.
    pub(crate) dissipated: f64,
    /// Work of what moves rigid bodies.
    pub(crate) driving: f64,
    /// What the trapezoidal rule takes too much for the work, because contacts begin and end without force on the way.
    pub(crate) excess: f64,
}

impl SurfaceEnergy {
    /// Energies from an equilibrium on.
    pub(crate) fn at(touching: &Touching, motions: &[f64]) -> Self {
        Self {
            last: touching.clone(),
            motions: motions.to_vec(),
        }
    }

    /// Moves to the next equilibrium with the motions of all points (n_degrees_of_freedom), with works by the trapezoidal rule.
    pub(crate) fn follow(
        &mut self,
        problem: &ContactProblem,
        touching: &Touching,
        motions: &[f64],
    ) -> SurfaceWork {
        if problem.is_empty() {
            return SurfaceWork::default();
        }
        self.motions.resize(motions.len(), 0.0);
        let n = motions.len();
        let [before, now] = [&self.last, touching].map(|it| it.forces(problem, n));
        let mut on_body = 0.0;
        for dof in (0..n).filter(|&dof| before[dof] != 0.0 || now[dof] != 0.0) {
            on_body += 0.5 * (before[dof] + now[dof]) * (motions[dof] - self.motions[dof]);
        }
        let forces = [&self.last, touching].map(|it| it.on_rigid_bodies(problem));
        let (mut on_driven, mut on_free) = (0.0, 0.0);
        for (body, place) in touching.rigid.iter().enumerate() {
            let then = self.last.rigid.get(body).copied().unwrap_or_default();
            let way = minus(*place, then);
            let sum = match problem.rigid_bodies[body].motion {
                RigidMotion::Prescribed { .. } => &mut on_driven,
                RigidMotion::Free { .. } => &mut on_free,
            };
            *sum += 0.5 * (dot(forces[0][body], way) + dot(forces[1][body], way));
        }
        let excess = self.excess(problem, touching, motions);
        let stored = touching.energy();
        let dissipated = -(on_body + on_driven + on_free) - (stored - self.last.energy());
        *self = Self::at(touching, motions);
        SurfaceWork {
            stored,
            dissipated,
            driving: -on_driven,
            excess,
        }
    }

    /// Sum of 1/2 N (a - d) over the contacts that began, with the pressing force N, the approach a of the surfaces along the normal and the
    /// depth d that it explains, less that of those that ended.
    fn excess(&self, problem: &ContactProblem, touching: &Touching, motions: &[f64]) -> f64 {
        let way: Vec<f64> = motions
            .iter()
            .zip(&self.motions)
            .map(|(now, then)| now - then)
            .collect();
        let mut sum = 0.0;
        for (index, contact) in problem.contacts.iter().enumerate() {
            let body = contact.rigid_body;
            let place =
                |all: &[Vector]| body.and_then(|it| all.get(it)).copied().unwrap_or_default();
            let carried = minus(place(&touching.rigid), place(&self.last.rigid));
            let of = |it: &Touching| it.touches.get(index).cloned().unwrap_or_default();
            let (before, now) = (of(&self.last), of(touching));
            for (one, other, sign) in [(&now, &before, 1.0), (&before, &now, -1.0)] {
                for it in only_in(one, other) {
                    let row = contact.surfaces.row(it, it.normal);
                    let moved: f64 = row.iter().map(|(dof, factor)| factor * way[*dof]).sum();
                    let approach = sign * (dot(carried, it.normal) - moved);
                    let force = it.stiffness * it.depth();
                    sum += sign * 0.5 * force * (approach - it.depth());
                }
            }
        }
        sum
    }
}

/// Pressed contacts of a list whose integration points are not pressed in another one; both are in the order of their numbers.
fn only_in<'a>(touches: &'a [Touch], others: &'a [Touch]) -> impl Iterator<Item = &'a Touch> {
    let pressed = touches.iter().filter(|it| it.depth() > 0.0);
    pressed.filter(|it| {
        let place = others.binary_search_by_key(&it.place, |other| other.place);
        !place.is_ok_and(|place| others[place].depth() > 0.0)
    })
}
