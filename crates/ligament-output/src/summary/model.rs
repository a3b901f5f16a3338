//! The discrete model in numbers.

use serde::{Deserialize, Serialize};

use super::{Text, number};

/// The numbers of a model.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ModelSummary {
    /// Title of the case.
    pub title: String,
    /// Version of the program.
    pub version: Text,
    /// Law and corrections of the bonds, in words.
    pub formulation: String,
    /// Number of points.
    pub points: usize,
    /// Number of bonds, without those that pre-cracks cut.
    pub bonds: usize,
    /// Number of bonds that pre-cracks cut.
    pub cut_bonds: usize,
    /// Number of points whose bonds never break.
    pub no_fail_points: usize,
    /// Sum of the points' volumes, m^3.
    pub volume: f64,
    /// Smallest, mean and largest horizon, m.
    pub horizon: Spread,
    /// Smallest, mean and largest number of bonds of a point.
    pub family: Spread,
    /// The corrections of the bonds.
    pub correction: CorrectionSummary,
    /// The property that varies at random, where one does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scatter: Option<ScatterSummary>,
}

/// A property that varies at random.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ScatterSummary {
    /// The property.
    pub of: Text,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Factors of the points.
    pub factor: Spread,
    /// Standard deviation of the factors of the points over their mean.
    #[serde(deserialize_with = "number")]
    pub deviation: f64,
}

/// Range and mean of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Spread {
    /// Smallest.
    #[serde(deserialize_with = "number")]
    pub min: f64,
    /// Mean.
    #[serde(deserialize_with = "number")]
    pub mean: f64,
    /// Largest.
    #[serde(deserialize_with = "number")]
    pub max: f64,
}

/// The corrections, and how the domain correction went if it is the one.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct CorrectionSummary {
    /// The factor alpha.
    pub alpha: Text,
    /// The correction of surfaces.
    pub surface: Text,
    /// Sweeps.
    pub sweeps: Option<usize>,
    /// Whether it converged.
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
    /// Newton steps of the patch correction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub newton_steps: Option<usize>,
    /// Root mean square of what the patch correction leaves of its equations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left: Option<f64>,
    /// Energy ratios over the points: in the plane for uniaxial x, uniaxial y, biaxial and shear strain.
    pub energy_ratios: Vec<Spread>,
}

impl Spread {
    /// Smallest, mean and largest of some values.
    pub fn over(values: impl Iterator<Item = f64> + Clone) -> Self {
        let count = values.clone().count().max(1) as f64;
        Self {
            min: values.clone().fold(f64::INFINITY, f64::min),
            mean: values.clone().sum::<f64>() / count,
            max: values.fold(f64::NEG_INFINITY, f64::max),
        }
    }
}
