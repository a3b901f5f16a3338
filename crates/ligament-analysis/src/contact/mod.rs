//! Contact: faces of cracks that close, with their friction, and surfaces that meet each other or rigid bodies.
//!
//! A `ContactSearch` finds the contacts of a state, in equilibria, along the exact path and in the steps of a motion alike, and stores
//! friction and contact in the state where a step is accepted.

mod energy_bound;
pub(crate) mod faces;
mod friction;
mod problem;
pub(crate) mod resisting;
mod rigid_body;
mod search;
mod steps;
mod surfaces;

pub use energy_bound::{Drag, PairContacts};
pub use friction::Friction;
pub use problem::{ContactProblem, ContactReading, ContactStiffness, SurfaceContact};
pub use rigid_body::{RigidBody, RigidMotion, RigidRates, RigidState, RigidSurface};
pub use steps::{SurfaceEnergy, SurfaceWork};
pub use surfaces::{ContactStep, LastTouching, SurfaceSearch, Touching};

pub(crate) use rigid_body::add;
pub(crate) use search::{ContactSearch, Contacts};
