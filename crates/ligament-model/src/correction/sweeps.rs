//! Sweeps of a correction over the families of all points, until the factors Omega converge.

use super::{Correction, CorrectionReport, DomainReport};

/// Condition at which the sweeps end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StopRule {
    /// Sum over the bonds of |change of Omega| below a limit (the paper's rule, stricter for larger meshes).
    Sum(f64),
    /// Mean over the bonds of |change of Omega| below a limit (independent of the size).
    Mean(f64),
}

/// Stop rule and limit of the sweeps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sweeps {
    /// Condition at which the sweeps end.
    pub stop: StopRule,
    /// Largest number of sweeps, after which the iteration ends with the factors reached.
    pub limit: usize,
}

/// Families of all points with factors Omega that sweeps improve.
pub(crate) trait SweptFamilies {
    /// Does one sweep and returns the sum over the bonds of |change of Omega|.
    fn sweep(&mut self) -> f64;

    /// Number of the bonds of the whole body.
    fn n_bonds(&self) -> usize;

    /// Largest |etil/e - 1| of a point along an axis.
    fn largest_residual(&self) -> f64;

    /// Factor Omega of every bond, shape (n_bonds).
    fn into_domain_factors(self) -> Vec<f64>;
}

impl Sweeps {
    /// The correction with length factors alpha (n_bonds) and the factors Omega from sweeps over the families.
    pub(crate) fn correct(
        self,
        mut families: impl SweptFamilies,
        length_factor: Vec<f64>,
    ) -> Correction {
        let tolerance = match self.stop {
            StopRule::Sum(tolerance) => tolerance,
            StopRule::Mean(tolerance) => tolerance * families.n_bonds() as f64,
        };
        let mut last_change = f64::INFINITY;
        let mut done = 0;
        while last_change >= tolerance && done < self.limit {
            last_change = families.sweep();
            done += 1;
        }
        let report = DomainReport {
            sweeps: done,
            converged: last_change < tolerance,
            last_change,
            largest_residual: families.largest_residual(),
        };
        Correction {
            report: Some(CorrectionReport::Domain(report)),
            ..Correction::fixed(length_factor, families.into_domain_factors())
        }
    }
}
