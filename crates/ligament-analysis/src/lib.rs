//! Equations and algorithms: unknowns, assembly, equilibrium and the drivers that follow a loading.
//!
//! A [`LoadProgram`] and a bond system form a [`Problem`]. [`driver::elastic`] solves it once, [`driver::stepped`] follows the load
//! program in load steps while bonds break in ordered groups, and [`driver::event`] follows the exact equilibrium path from
//! breakage to breakage. [`modal`] finds the natural modes of a body fixed by [`Supports`]. Results are passed to an [`Observer`]
//! during the run; the end of a run is a [`Termination`], never an error.
//! The crate reads and writes no files and prints nothing.

pub mod assembly;
pub mod balanced;
pub mod bond_numbers;
pub mod breakage;
pub mod breaking;
pub mod checkpoint;
pub mod connectivity;
pub mod contact;
pub mod costs;
pub mod critical_step;
pub mod distributed_matrix;
pub mod driver;
pub mod energy_release;
pub mod equilibrium;
pub mod error;
pub mod fields;
pub mod first_bonds;
pub mod gauges;
mod halo;
pub mod history;
pub mod internal;
mod lagging;
pub mod largest_utilisation;
pub mod lists_of_all;
pub mod load_program;
pub mod material_stress;
pub mod messages;
pub mod modal;
pub mod motion;
pub mod probe;
pub mod problem;
pub mod refinement_pass;
pub mod restraints;
pub mod result_fields;
pub mod serial;
pub mod softened;
pub mod softening;
pub mod solver;
pub mod state;
pub mod stiffness;
pub mod supports;
mod tangent;
pub mod termination;
pub mod unbalanced;
pub mod unknowns;
pub mod user_message;
mod vectors;

pub use balanced::{Attempt, Balanced};
pub use equilibrium::Equilibrium;
pub use error::SetupError;
pub use history::{Observer, ObserverError, Termination};
pub use ligament_model::element::{BondDeformation, ElementKind};
pub use ligament_model::{Bonds, interface};
pub use load_program::{
    Amplitude, BoundaryError, Control, ControlKind, LoadCourse, LoadInTime, LoadProgram,
    LoadsInTime, MotionControl, Part, PartControl, Programme, ProportionalLoading, Shape,
    StagedLoading, Timed,
};
pub use probe::Probe;
pub use problem::Problem;
pub use restraints::{Restraint, Restraints};
pub use solver::SolverSettings;
pub use state::State;
pub use supports::Supports;
pub use unbalanced::Unbalanced;
pub use unknowns::{Component, Layout, Unknowns};
pub use user_message::Message;
