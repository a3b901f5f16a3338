//! Equations and algorithms: unknowns, assembly, equilibrium and the drivers that follow a loading.
//!
//! A [`Boundary`] on a bond system makes a problem; [`driver::elastic`] solves it once, [`driver::stepped`] follows the
//! loading while bonds break, one ordered handful after another, and [`driver::event`] the exact equilibrium path from
//! breakage to breakage. [`modal`] finds the natural modes of a body that [`Supports`] hold. What happens on the way goes to an
//! [`Observer`]; how it ended is a [`Termination`], never an error.
//! No files and no printing here.

pub mod assembly;
pub mod boundary;
pub mod breakage;
pub mod breaking;
pub mod connectivity;
pub mod dissection;
pub mod driver;
pub mod equilibrium;
pub mod fields;
pub mod gauges;
pub mod history;
pub mod internal;
pub mod modal;
pub mod probe;
pub mod softening;
pub mod state;
pub mod stiffness;
pub mod supports;
pub mod unknowns;

pub use boundary::{Boundary, BoundaryError, Control, ControlKind};
pub use equilibrium::{Equilibrium, SetupError};
pub use history::{Observer, ObserverError, Termination};
pub use ligament_model::element::{BondDeformation, ElementKind};
pub use ligament_model::{Bonds, interface};
pub use probe::Probe;
pub use state::State;
pub use stiffness::SolverSettings;
pub use supports::Supports;
pub use unknowns::{COMPONENTS, Component, Unknowns};
