//! The interval of convergence of a result, from runs at two sizes of the points.
//!
//! The order of convergence is not estimated, because the scatter of meshes is as large as the change from one size to the other; it is
//! bounded. With the means a and b of the runs at the coarse and the fine size, whose ratio is r, and n runs each,
//!
//! e = (b - a)/(r - 1), g = 1/(r - 1), w^2 = (2 s)^2 ((1 + g)^2/n_b + g^2/n_a) + (0.002 b)^2,
//!
//! the limit lies in [b + min(e, -e/4) - w, b + max(e, -e/4) + w]: where the trend leads, with an order of 1 at least, or by a quarter of the
//! step the other way. s is the standard deviation of both sizes together.

use serde::Serialize;

/// Multiple of the standard deviation on either side of a mean: s of two pairs of runs has two degrees of freedom, so that this is no quantile of
/// the normal distribution.
pub const DEVIATIONS: f64 = 2.0;

/// Share of the step from one size to the other by which the limit may lie against the trend.
pub const AGAINST_TREND: f64 = 0.25;

/// Error of the program that no refinement removes, relative to the value.
pub const FLOOR: f64 = 0.002;

/// Error that no refinement removes for meshes made by splitting cells, whose families of bonds repeat each other, relative to the value.
pub const FLOOR_OF_SPLIT: f64 = 0.005;

/// Largest change from the coarse to the fine size, relative to the fine value, with which both are taken for the same problem.
pub const LARGEST_CHANGE: f64 = 0.15;

/// Largest standard deviation of runs of one size, relative to the fine value.
pub const LARGEST_SCATTER: f64 = 0.10;

/// Values of a result in the runs of the fine and the coarse size.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Samples {
    /// Values at h, shape (n).
    pub fine: Vec<f64>,
    /// Values at 2h, shape (n).
    pub coarse: Vec<f64>,
}

/// Interval of convergence of a result.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Interval {
    /// Lower end.
    pub lower: f64,
    /// Upper end.
    pub upper: f64,
    /// Mean at h.
    pub fine: f64,
    /// Mean at 2h.
    pub coarse: f64,
    /// Standard deviation of the runs of one size; none where each size has one run.
    pub deviation: Option<f64>,
    /// Half-width by the scatter of the runs and the floor alone.
    pub by_scatter: f64,
}

/// Reason why a result has no interval.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// A size has no value.
    #[error("not every run has it")]
    Missing,
    /// The value changes too much from one size to the other.
    #[error(
        "it changes by {:.0} % from 2h to h, more than {:.0} %: the coarse body is another problem; halve h",
        100.0 * share, 100.0 * LARGEST_CHANGE
    )]
    Change {
        /// Change relative to the fine value.
        share: f64,
    },
    /// The runs of one size scatter too much.
    #[error(
        "runs of one size scatter by {:.0} %, more than {:.0} %; halve h",
        100.0 * share, 100.0 * LARGEST_SCATTER
    )]
    Scatter {
        /// Standard deviation relative to the fine value.
        share: f64,
    },
}

impl Samples {
    /// The interval of convergence, for a ratio r > 1 of the sizes and a relative `floor` of the half-width.
    ///
    /// # Errors
    ///
    /// If a size has no run, or the runs differ too much.
    pub fn interval(&self, ratio: f64, floor: f64) -> Result<Interval, Refusal> {
        let [Some(fine), Some(coarse)] = [&self.fine, &self.coarse].map(|it| mean(it)) else {
            return Err(Refusal::Missing);
        };
        let share = |of: f64| if of == 0.0 { 0.0 } else { of / fine.abs() };
        let deviation = self.deviation(fine, coarse);
        let change = share((fine - coarse).abs());
        if change > LARGEST_CHANGE {
            return Err(Refusal::Change { share: change });
        }
        let scatter = share(deviation.unwrap_or(0.0));
        if scatter > LARGEST_SCATTER {
            return Err(Refusal::Scatter { share: scatter });
        }
        let beyond = 1.0 / (ratio - 1.0);
        let step = beyond * (fine - coarse);
        let [n_fine, n_coarse] = [&self.fine, &self.coarse].map(|it| it.len() as f64);
        let of_means = (1.0 + beyond).powi(2) / n_fine + beyond.powi(2) / n_coarse;
        let of_runs = DEVIATIONS * deviation.unwrap_or(0.0) * of_means.sqrt();
        let by_scatter = of_runs.hypot(floor * fine);
        let against = -AGAINST_TREND * step;
        Ok(Interval {
            lower: fine + step.min(against) - by_scatter,
            upper: fine + step.max(against) + by_scatter,
            fine,
            coarse,
            deviation,
            by_scatter,
        })
    }

    /// Standard deviation of the runs about the means of their sizes, of both sizes together.
    fn deviation(&self, fine: f64, coarse: f64) -> Option<f64> {
        let squares = |values: &[f64], mean: f64| -> f64 {
            values.iter().map(|value| (value - mean).powi(2)).sum()
        };
        let freedom = (self.fine.len() + self.coarse.len()).checked_sub(2)?;
        let sum = squares(&self.fine, fine) + squares(&self.coarse, coarse);
        (freedom > 0).then(|| (sum / freedom as f64).sqrt())
    }
}

fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(fine: &[f64], coarse: &[f64]) -> Samples {
        Samples {
            fine: fine.to_vec(),
            coarse: coarse.to_vec(),
        }
    }

    #[test]
    fn the_interval_is_that_of_the_rule() {
        // By hand: b = 100, a = 96, r = 2: e = 4, g = 1; s^2 = (2 + 2)/2 = 2, w^2 = 4 * 2 (4/2 + 1/2) + .04 = 20.04.
        let interval = samples(&[99.0, 101.0], &[95.0, 97.0])
            .interval(2.0, FLOOR)
            .unwrap();
        let half = 20.04_f64.sqrt();
        // Rounding of sums of numbers of about 100.
        assert!((interval.lower - (99.0 - half)).abs() < 1e-12);
        assert!((interval.upper - (104.0 + half)).abs() < 1e-12);
        assert_eq!(interval.deviation, Some(2.0_f64.sqrt()));
    }

    #[test]
    fn it_lies_where_the_trend_leads() {
        let rising = samples(&[100.0], &[90.0]).interval(2.0, 0.0).unwrap();
        assert_eq!([rising.lower, rising.upper], [97.5, 110.0]);
        assert_eq!(rising.deviation, None);
        let falling = samples(&[100.0], &[110.0]).interval(3.0, 0.0).unwrap();
        assert_eq!([falling.lower, falling.upper], [95.0, 101.25]);
    }

    #[test]
    fn runs_that_differ_too_much_have_none() {
        let change = samples(&[100.0; 2], &[116.0; 2]).interval(2.0, FLOOR);
        assert_eq!(change, Err(Refusal::Change { share: 0.16 }));
        let scatter = samples(&[90.0, 110.0], &[90.0, 110.0]).interval(2.0, FLOOR);
        assert!(matches!(scatter, Err(Refusal::Scatter { share }) if share > 0.14));
        assert_eq!(
            samples(&[1.0], &[]).interval(2.0, FLOOR),
            Err(Refusal::Missing)
        );
    }
}
