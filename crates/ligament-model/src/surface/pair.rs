//! Surfaces that may come into contact, without their coordinates.

use std::fmt::Debug;

use serde::{Deserialize, Serialize};

use super::cells::Bonded;
use super::search::Search;
use super::touch::{Touch, Vector};

/// Motions and bonds in a time step, for contact.
#[derive(Debug, Clone, Copy)]
pub struct Step<'a> {
    /// Motions before the step, shape (n_degrees_of_freedom), m and rad.
    pub before: &'a [f64],
    /// Motions after the step, shape (n_degrees_of_freedom), m and rad.
    pub now: &'a [f64],
    /// Pose of the rigid body before and after the step.
    pub rigid: [Pose; 2],
    /// Bonds after the step.
    pub bonds: Bonded<'a>,
}

/// Displacement of a rigid body and its rotation about its middle.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Pose {
    /// Displacement, m.
    pub displacement: Vector,
    /// Angles about the axes since time zero, rad: in the plane that about z; in space they turn nothing but a sphere.
    pub rotation: Vector,
}

/// A penetration of surfaces without contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Missed {
    /// Point of the body at the penetration.
    pub point: u32,
    /// Relative motion of the surfaces in the step, m.
    pub way: f64,
    /// Relative motion in a step up to which no contact is missed, m.
    pub seen: f64,
}

/// Surfaces that may come into contact, without their coordinates.
pub trait SurfacePair: Debug + Send + Sync {
    /// Adds the faces that bonds crossed which have broken, and before the first step the outline and the faces along pre-cracks.
    fn join(&self, search: &mut Search, broken: &mut dyn Iterator<Item = u32>);

    /// Integration points in contact after a step, ascending, from the contacts before it. The result does not depend on the number of threads.
    fn touches(&self, search: &mut Search, step: Step<'_>, before: &[Touch]) -> Vec<Touch>;

    /// Adds the forces and moments of contacts on the points of the body, shape (n_degrees_of_freedom), N and N m; in the order of the
    /// contacts.
    fn add_forces(&self, touches: &[Touch], forces: &mut [f64]) {
        for touch in touches.iter().filter(|it| it.depth() > 0.0) {
            self.add_force(touch, touch.force(), forces);
        }
    }

    /// Adds a force (N) on the integration point of a contact, and its opposite on what the point meets, to the forces and moments on the points
    /// of the body, shape (n_degrees_of_freedom), N and N m.
    fn add_force(&self, touch: &Touch, force: Vector, forces: &mut [f64]);

    /// Motion of the integration point of a contact in a step relative to its partner, m.
    fn way(&self, touch: &Touch, step: Step<'_>) -> Vector;

    /// Degrees of freedom and coefficients c of a motion of a contact along a direction d: d . (u - u_met) = c . u with the motions u and u_met of
    /// the two surfaces there; by degree of freedom, ascending.
    fn row(&self, touch: &Touch, direction: Vector) -> Vec<(usize, f64)>;

    /// Whether gaps are linear in the motions, and the contacts of a step contain all integration points that may ever touch.
    fn is_linear(&self) -> bool {
        false
    }

    /// Whether faces of cracks belong to the surfaces.
    fn has_faces_of_cracks(&self) -> bool {
        false
    }

    /// Coefficient of Coulomb's friction.
    fn friction(&self) -> f64;

    /// Length of the longest edge of a facet, m: a deeper overlap is not seen.
    fn reach(&self) -> f64;

    /// Largest undeformed coordinate in the differences of gaps, m: their rounding is relative to it.
    fn coordinate(&self) -> f64;

    /// Relative motion of the surfaces in a step up to which no contact is missed, m; zero where the motion since the undeformed body counts instead.
    fn way_seen(&self) -> f64;

    /// A penetration of the surfaces in a step that is none of the contacts after it.
    fn missed(&self, step: Step<'_>, touches: &[Touch]) -> Option<Missed>;

    /// Whether contacts, as of a checkpoint, have existing numbers of integration points and facets in ascending order.
    fn can_have(&self, touches: &[Touch]) -> bool;

    /// Degrees of freedom that the contact may load, ascending.
    fn degrees_of_freedom(&self) -> Vec<u32>;

    /// Adds a diagonal matrix above the stiffness that the contact can have, shape (n_degrees_of_freedom), N/m and N m: K + this matrix
    /// bounds the frequencies of the body with its contact.
    fn add_bound(&self, sums: &mut [f64]);

    /// Sum of the stiffnesses of all integration points, N/m: what a free rigid body can feel, at most; and the largest square of the arm of a
    /// force on it, m^2.
    fn on_rigid_body(&self) -> [f64; 2];
}
