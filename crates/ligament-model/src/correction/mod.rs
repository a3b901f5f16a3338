//! Corrections of the bonds: a factor alpha from the length of a bond, and a factor Omega for families that surfaces or irregular meshes
//! make incomplete or uneven.
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

pub use strain_mode::StrainMode;
pub use sweeps::{StopRule, Sweeps};

use crate::bonds::retained::retained;

/// Factors of the bonds, with the report of their computation.
#[derive(Debug, Clone, PartialEq)]
pub struct Correction {
    /// Length or partial-volume factors alpha, shape (n_bonds).
    pub length_factor: Vec<f64>,
    /// Domain-correction factors Omega, or surface factors instead, shape (n_bonds).
    pub domain_factor: Vec<f64>,
    /// Ratio of the factors of the shear and rotational stiffness to Omega, shape (n_bonds); empty where all are 1.
    pub shear_ratio: Vec<f64>,
    /// Report of the iteration for the factors; none for factors without iteration.
    pub report: Option<CorrectionReport>,
}

/// Report of the computation of a correction.
#[derive(Debug, Clone, PartialEq)]
pub enum CorrectionReport {
    /// Report of the sweeps of the domain correction.
    Domain(DomainReport),
    /// Report of the Newton steps of the patch correction.
    Patch(patch::Report),
}

impl CorrectionReport {
    /// Report of the sweeps, if the correction is the domain correction.
    pub fn domain(&self) -> Option<&DomainReport> {
        match self {
            Self::Domain(report) => Some(report),
            Self::Patch(_) => None,
        }
    }

    /// Report of the Newton steps, if the correction is the patch correction.
    pub fn patch(&self) -> Option<&patch::Report> {
        match self {
            Self::Domain(_) => None,
            Self::Patch(report) => Some(report),
        }
    }
}

/// Report of the sweeps of the domain correction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DomainReport {
    /// Number of sweeps.
    pub sweeps: usize,
    /// Whether the stop rule was satisfied within the limit.
    pub converged: bool,
    /// Sum over the bonds of |change of Omega| in the last sweep.
    pub last_change: f64,
    /// Largest |e_x/e - 1|, and along the other axes, over the points after the last sweep.
    pub largest_residual: f64,
}

impl Correction {
    /// The correction of factors without iteration.
    pub fn fixed(length_factor: Vec<f64>, domain_factor: Vec<f64>) -> Self {
        Self {
            length_factor,
            domain_factor,
            shear_ratio: Vec::new(),
            report: None,
        }
    }

    /// The correction of the bonds for which `keep` (n_bonds) is true.
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

    /// Residual of the equations of the patch correction at each point, shape (n_points); empty without it.
    pub fn patch_residual(&self) -> &[f64] {
        let report = self.report.as_ref().and_then(CorrectionReport::patch);
        report.map_or(&[], |report| &report.residual)
    }

    /// Smallest and largest factor Omega.
    pub fn domain_factor_range(&self) -> (f64, f64) {
        self.domain_factor.iter().fold(
            (f64::INFINITY, f64::NEG_INFINITY),
            |(lower, upper), &omega| (lower.min(omega), upper.max(omega)),
        )
    }
}
