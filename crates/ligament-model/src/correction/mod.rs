//! Corrections of the bonds: the length factor alpha and the iterative domain correction Omega.

pub mod domain;
mod families;
pub mod length;

pub use domain::{StopRule, Sweeps, energy_ratios};

use crate::bonds::retained;

/// Factors of the bonds and how they were found.
#[derive(Debug, Clone, PartialEq)]
pub struct Correction {
    /// Length factors alpha, shape (n_bonds).
    pub length_factor: Vec<f64>,
    /// Domain-correction factors Omega, shape (n_bonds).
    pub domain_factor: Vec<f64>,
    /// How the iteration for Omega went.
    pub report: CorrectionReport,
}

/// How the domain correction went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CorrectionReport {
    /// Sweeps done.
    pub sweeps: usize,
    /// Whether the stop rule was met within the limit.
    pub converged: bool,
    /// Sum over the bonds of |change of Omega| in the last sweep.
    pub last_change: f64,
    /// Largest |e_x/e - 1| and |e_y/e - 1| over the points after the last sweep.
    pub largest_residual: f64,
}

impl Correction {
    /// The bonds for which `keep` (n_bonds) is true.
    pub fn retained(self, keep: &[bool]) -> Self {
        Self {
            length_factor: retained(self.length_factor, keep),
            domain_factor: retained(self.domain_factor, keep),
            report: self.report,
        }
    }

    /// Smallest and largest Omega.
    pub fn domain_factor_range(&self) -> (f64, f64) {
        self.domain_factor.iter().fold(
            (f64::INFINITY, f64::NEG_INFINITY),
            |(lower, upper), &omega| (lower.min(omega), upper.max(omega)),
        )
    }
}
