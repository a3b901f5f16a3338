//! Drivers: one file for each way to follow a loading.

mod dissipation;
pub mod elastic;
pub mod event;
mod outcome;
mod path;
mod recorder;
mod start;
pub mod stepped;

pub use outcome::{LoadPoint, Outcome, Rows};
pub use path::StopRules;

/// A problem: bonds, supports and loads, and what to read off.
#[derive(Clone, Copy)]
pub struct Problem<'a> {
    /// The bond system.
    pub system: &'a dyn ligament_model::Bonds,
    /// Failure criteria; an elastic analysis has none.
    pub criteria: &'a ligament_model::failure::Criteria,
    /// Supports and loads.
    pub boundary: &'a crate::boundary::Boundary,
    /// How the equations are solved.
    pub solver: crate::stiffness::SolverSettings,
    /// Probes.
    pub probes: &'a [crate::probe::Probe],
}
