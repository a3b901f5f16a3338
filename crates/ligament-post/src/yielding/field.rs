//! Anisotropy of every family of a body.

use ligament_model::failure::Criteria;
use ligament_model::parallel;
use ligament_model::system::BondSystem;

use super::{Family, PrincipalStretches, WorstOrientation};

/// First yield of the family of a point under a strain: the effect of the directions and limits of its bonds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FamilyYield {
    /// Worst orientation of the strain, with its error.
    pub worst: WorstOrientation,
    /// Load factor of the strain at first yield in theory, 1/U_th: the load factor in the orientation that yields first.
    pub least_load: f64,
}

/// First yield of the family of each point (n_points) under the strain `strains` of the point; `None` where no bond yields.
pub fn families(
    system: &BondSystem,
    criteria: &Criteria,
    strains: impl Fn(u32) -> PrincipalStretches + Sync,
) -> Vec<Option<FamilyYield>> {
    let of_point = |point: u32| {
        let (family, strains) = (Family::at_point(system, criteria, point), strains(point));
        Some(FamilyYield {
            worst: family.worst(strains)?,
            least_load: 1.0 / family.theoretical_utilisation(strains),
        })
    };
    parallel::values(system.cloud.len(), None, |point| of_point(point as u32))
}

/// Mean over some points of the error at one orientation of the strain (rad), for a body whose strain has that orientation everywhere.
/// `None` where no bond yields at any of them.
pub fn mean_error(
    system: &BondSystem,
    criteria: &Criteria,
    strains: PrincipalStretches,
    points: &[u32],
    orientation: f64,
) -> Option<f64> {
    let errors = parallel::flat_map(points.len(), |place| {
        Family::at_point(system, criteria, points[place]).error(strains, orientation)
    });
    let count = errors.len();
    (count > 0).then(|| errors.iter().sum::<f64>() / count as f64)
}

/// Mean, percentiles and the largest of some values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Distribution {
    /// Number of values.
    pub count: usize,
    /// Mean of the values.
    pub mean: f64,
    /// Percentile of 5 %.
    pub percentile_5: f64,
    /// Percentile of 95 %.
    pub percentile_95: f64,
    /// Largest value.
    pub worst: f64,
}

impl Distribution {
    /// The distribution of values in any order; `None` without values. Percentiles are linear between the values, the first at 0 and the
    /// last at 100 %.
    pub fn from_values(mut values: Vec<f64>) -> Option<Self> {
        values.sort_by(f64::total_cmp);
        let (&worst, count) = (values.last()?, values.len());
        let at = |share: f64| {
            let place = share * (count - 1) as f64;
            let (below, part) = (place.floor(), place.fract());
            let low = values[below as usize];
            let high = values[(below as usize + 1).min(count - 1)];
            if part > 0.0 {
                low + part * (high - low)
            } else {
                low
            }
        };
        Some(Self {
            count,
            mean: values.iter().sum::<f64>() / count as f64,
            percentile_5: at(0.05),
            percentile_95: at(0.95),
            worst,
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_distribution_by_hand() {
        let values = (0..=100).rev().map(f64::from).collect();
        let found = Distribution::from_values(values).unwrap();
        let expected = Distribution {
            count: 101,
            mean: 50.0,
            percentile_5: 5.0,
            percentile_95: 95.0,
            worst: 100.0,
        };
        assert_eq!(found, expected);
        assert_eq!(Distribution::from_values(Vec::new()), None);
        let pair = Distribution::from_values(vec![1.0, 3.0]).unwrap();
        assert!(
            (pair.percentile_5 - 1.1).abs() < 1e-15,
            "linear between values"
        );
        let open = Distribution::from_values(vec![1.0, f64::INFINITY]).unwrap();
        assert_eq!(open.worst, f64::INFINITY);
    }
}
