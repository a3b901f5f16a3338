//! Summary of the discrete model.

use ligament_model::subdomain::Subdomain;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::{Text, number};

/// Summary of a model.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct ModelSummary {
    /// Title of the case.
    pub title: String,
    /// Version of the program.
    pub version: Text,
    /// What is computed, in which space.
    pub analysis: String,
    /// Description of the law and the corrections of the bonds.
    pub formulation: String,
    /// Number of points.
    pub points: usize,
    /// Number of bonds, without those that pre-cracks cut.
    pub bonds: usize,
    /// Number of bonds that pre-cracks cut.
    pub cut_bonds: usize,
    /// Number of points of the far field, which have no bonds.
    #[serde(skip_serializing_if = "is_zero")]
    pub far_points: usize,
    /// Number of points whose bonds never break.
    pub no_fail_points: usize,
    /// Sum of the points' volumes, m^3.
    pub volume: f64,
    /// Smallest, mean and largest horizon, m.
    pub horizon: Spread,
    /// Smallest, mean and largest number of bonds of a point.
    pub family: Spread,
    /// Corrections of the bonds.
    pub correction: CorrectionSummary,
    /// Property that varies at random; none without scatter.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scatter: Option<ScatterSummary>,
}

/// Whether a count is zero.
fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// A property that varies at random.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ScatterSummary {
    /// Name of the property.
    pub of: Text,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Factors of the points.
    pub factor: Spread,
    /// Standard deviation of the factors of the points over their mean.
    #[serde(deserialize_with = "number")]
    pub deviation: f64,
    /// Other properties that vary beside it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub beside: Vec<ScatterSummary>,
}

/// Range and mean of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct Spread {
    /// Smallest value.
    #[serde(deserialize_with = "number")]
    pub min: f64,
    /// Mean value.
    #[serde(deserialize_with = "number")]
    pub mean: f64,
    /// Largest value.
    #[serde(deserialize_with = "number")]
    pub max: f64,
}

/// The corrections, and the convergence of an iterated correction.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct CorrectionSummary {
    /// Kind of the factor alpha.
    pub alpha: Text,
    /// Kind of the correction of surfaces.
    pub surface: Text,
    /// Number of sweeps of the domain correction.
    pub sweeps: Option<usize>,
    /// Whether the iteration converged.
    pub converged: Option<bool>,
    /// Sum over the bonds of |change of Omega| in the last sweep.
    pub last_change: Option<f64>,
    /// Smallest Omega.
    #[serde(deserialize_with = "number")]
    pub factor_min: f64,
    /// Largest Omega.
    #[serde(deserialize_with = "number")]
    pub factor_max: f64,
    /// Largest |energy ratio - 1| of a point under uniaxial strain along x or y.
    pub largest_residual: Option<f64>,
    /// Number of Newton steps of the patch correction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub newton_steps: Option<usize>,
    /// Root mean square residual of the patch correction's equations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left: Option<f64>,
    /// Energy ratios over the points: in the plane for uniaxial x, uniaxial y, biaxial and shear strain.
    pub energy_ratios: Vec<Spread>,
}

impl Spread {
    /// Smallest, mean and largest value.
    pub fn over(values: impl Iterator<Item = f64> + Clone) -> Self {
        let count = values.clone().count().max(1) as f64;
        Self {
            min: values.clone().fold(f64::INFINITY, f64::min),
            mean: values.clone().sum::<f64>() / count,
            max: values.fold(f64::NEG_INFINITY, f64::max),
        }
    }

    /// Smallest, mean and largest of the values at the points (n_points) of a body, over all processes; collective.
    pub fn over_points(subdomain: &Subdomain, values: &[f64]) -> Self {
        let owned = subdomain.owned().map(|point| values[point as usize]);
        let here = Self::over(owned.clone());
        let mut ends = [-here.min, here.max];
        subdomain.all_reduce_max(&mut ends);
        Self {
            min: -ends[0],
            mean: subdomain.sum(owned.sum()) / subdomain.n_all().max(1) as f64,
            max: ends[1],
        }
    }
}
