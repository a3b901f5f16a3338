//! Possible contacts of a problem: surfaces and rigid bodies, the stiffness that contacts can have, and their resultants.

use std::sync::Arc;

use ligament_model::layout::Layout;
use ligament_model::surface::{Missed, Step, SurfacePair, Touch, Vector};
use ligament_model::tensor::{minus, norm};
use serde::{Deserialize, Serialize};

use super::rigid_body::{RigidBody, RigidMotion, add};

/// Contacts of a body and its rigid bodies. A copy shares the surfaces.
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
    /// A place where surfaces passed each other undetected in a step, given the contacts after it and the largest motion of a point along
    /// an axis (m).
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

    /// Degrees of freedom that the contacts may load, ascending.
    pub(super) fn degrees_of_freedom(&self) -> Vec<u32> {
        let surfaces = self.contacts.iter().map(|it| &it.surfaces);
        let mut dofs: Vec<u32> = surfaces.flat_map(|it| it.degrees_of_freedom()).collect();
        dofs.sort_unstable();
        dofs.dedup();
        dofs
    }

    /// Bound of the contribution of the contacts to the squared frequencies of a body with a layout.
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

/// Resultants of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct ContactReading {
    /// Pressing force on the first surface, N; against a rigid body, the force on the surface of the deformable body.
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

    /// Component of the whole force on the first surface along an axis, N.
    pub fn force(&self, axis: usize) -> f64 {
        self.normal_force[axis] + self.friction_force[axis]
    }
}

/// Bound of the contribution of contacts to the squared frequencies of a body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ContactStiffness {
    /// Diagonal matrix that bounds the stiffness of all contacts from above, shape (n_degrees_of_freedom), N/m and N m; empty without
    /// contacts. With the masses M_i the largest squared frequency of the body grows by at most max (this over M_i).
    pub at_degrees_of_freedom: Vec<f64>,
    /// Bound of the squared frequency of free rigid bodies, 1/s^2.
    pub squared_frequency: f64,
}
