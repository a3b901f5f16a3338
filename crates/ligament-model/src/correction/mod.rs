//! Corrections of the bonds: a factor alpha for what of its ends a bond connects, and a factor Omega for what surfaces and
//! irregular meshes take from the families.
//!
//! | alpha | Omega |
//! |---|---|
//! | [`length`]: short bonds count more (NHPD eq. 7) | [`domain`]: iterated until energies are right (NHPD eqs 11 to 13) |
//! | [`partial_volume`]: cells that the horizon cuts (MPPD eq. 9) | [`surface`]: by the volumes of the families (MPPD) |
//! | none: 1 | [`patch`]: uniform strains are equilibria; another factor for shear and rotation |
//! | | none: 1 |

pub mod domain;
mod families;
pub mod length;
mod members;
pub mod partial_volume;
pub mod patch;
mod strain_mode;
pub mod surface;
mod sweep_order;
mod sweeps;

pub use domain::energy_ratios;
pub use strain_mode::StrainMode;
pub use sweeps::{StopRule, Sweeps};

use crate::bonds::retained::retained;

/// Factors of the bonds and how they were found.
#[derive(Debug, Clone, PartialEq)]
pub struct Correction {
    /// Length or partial-volume factors alpha, shape (n_bonds).
    pub length_factor: Vec<f64>,
    /// Domain-correction factors Omega, or the surface factors in their place, shape (n_bonds).
    pub domain_factor: Vec<f64>,
    /// Factors of the shear and rotational stiffness over Omega, shape (n_bonds); empty where all are 1.
    pub shear_ratio: Vec<f64>,
    /// Report on the iteration for the factors, where there was one.
    pub report: Option<CorrectionReport>,
}

/// Report on how a correction was found.
#[derive(Debug, Clone, PartialEq)]
pub enum CorrectionReport {
    /// The sweeps of the domain correction.
    Domain(DomainReport),
    /// The Newton steps of the patch correction.
    Patch(patch::Report),
}

impl CorrectionReport {
    /// The sweeps of the domain correction, if it was the one.
    pub fn domain(&self) -> Option<&DomainReport> {
        match self {
            Self::Domain(report) => Some(report),
            Self::Patch(_) => None,
        }
    }

    /// The Newton steps of the patch correction, if it was the one.
    pub fn patch(&self) -> Option<&patch::Report> {
        match self {
            Self::Domain(_) => None,
            Self::Patch(report) => Some(report),
        }
    }
}

/// Report on the sweeps of the domain correction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DomainReport {
    /// Sweeps done.
    pub sweeps: usize,
    /// Whether the stop rule was met within the limit.
    pub converged: bool,
    /// Sum over the bonds of |change of Omega| in the last sweep.
    pub last_change: f64,
    /// Largest |e_x/e - 1|, and along the other axes, over the points after the last sweep.
    pub largest_residual: f64,
}

impl Correction {
    /// Factors that are not iterated.
    pub fn fixed(length_factor: Vec<f64>, domain_factor: Vec<f64>) -> Self {
        Self {
            length_factor,
            domain_factor,
            shear_ratio: Vec::new(),
            report: None,
        }
    }

    /// The bonds for which `keep` (n_bonds) is true.
    pub fn retained(self, keep: &[bool]) -> Self {
        Self {
            length_factor: retained(self.length_factor, keep),
            domain_factor: retained(self.domain_factor, keep),
            shear_ratio: if self.shear_ratio.is_empty() {
                self.shear_ratio
            } else {
                retained(self.shear_ratio, keep)
            },
            report: self.report,
        }
    }

    /// What the patch correction leaves of the equations of each point, shape (n_points); empty without it.
    pub fn patch_residual(&self) -> &[f64] {
        let report = self.report.as_ref().and_then(CorrectionReport::patch);
        report.map_or(&[], |report| &report.residual)
    }

    /// Smallest and largest Omega.
    pub fn domain_factor_range(&self) -> (f64, f64) {
        self.domain_factor.iter().fold(
            (f64::INFINITY, f64::NEG_INFINITY),
            |(lower, upper), &omega| (lower.min(omega), upper.max(omega)),
        )
    }
}
