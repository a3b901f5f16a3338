//! Critical time step of explicit integration.

use crate::unknowns::Component;

/// Largest stable step and what limits it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CriticalStep {
    /// Largest stable time step, s.
    pub step: f64,
    /// Largest eigenfrequency omega, rad/s.
    pub frequency: f64,
    /// Point at which the eigenmode of the largest frequency has the most kinetic energy.
    pub point: u32,
    /// Component of that point with the most kinetic energy.
    pub component: Component,
    /// Share of the rotations in the kinetic energy of that mode.
    pub of_rotations: f64,
}
