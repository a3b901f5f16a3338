//! Straight lines by least squares.

/// A straight line y = slope x + intercept, fitted to points of equal weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineFit {
    /// Rise of y over x.
    pub slope: f64,
    /// Value at x = 0.
    pub intercept: f64,
    /// Standard error of the slope, from the scatter of the points; `None` for two points.
    pub slope_error: Option<f64>,
    /// Standard error of the intercept; `None` for two points.
    pub intercept_error: Option<f64>,
    /// Share of the variance of y that the line explains; 1 where y does not vary.
    pub r_squared: f64,
    /// Number of points.
    pub points: usize,
}

/// Error of points that determine no line.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum FitError {
    /// Fewer than two points.
    #[error("a line takes two points or more, there {}", if *.0 == 1 { "is one" } else { "are none" })]
    TooFew(usize),
    /// All points have the same x.
    #[error("a line takes points at two places or more, all are at x = {0}")]
    OnePlace(f64),
    /// A coordinate is not finite.
    #[error("a point has a coordinate that is no finite number")]
    NotFinite,
}

impl LineFit {
    /// The line with the least sum of squared distances along y to the points, shape (n, 2).
    ///
    /// The standard errors are s/sqrt(S_xx) of the slope and s sqrt(1/n + mean(x)^2/S_xx) of the intercept, with S_xx = sum (x - mean x)^2
    /// and the residual variance s^2 = sum r^2/(n - 2).
    ///
    /// # Errors
    ///
    /// If there are not two points at different x, or a coordinate is not finite.
    pub fn through(points: &[[f64; 2]]) -> Result<Self, FitError> {
        if points.iter().flatten().any(|value| !value.is_finite()) {
            return Err(FitError::NotFinite);
        }
        let [first, _, ..] = points else {
            return Err(FitError::TooFew(points.len()));
        };
        if points.iter().all(|point| point[0] == first[0]) {
            return Err(FitError::OnePlace(first[0]));
        }
        let n = points.len() as f64;
        let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / n;
        let [mean_x, mean_y] = [mean(0), mean(1)];
        // Sums of products of the distances from the means, which lose no digits to a large mean.
        let sum = |a: usize, b: usize| -> f64 {
            let centre = [mean_x, mean_y];
            let product = |point: &[f64; 2]| (point[a] - centre[a]) * (point[b] - centre[b]);
            points.iter().map(product).sum()
        };
        let (s_xx, s_xy, s_yy) = (sum(0, 0), sum(0, 1), sum(1, 1));
        let slope = s_xy / s_xx;
        let residual = |[x, y]: &[f64; 2]| (y - mean_y) - slope * (x - mean_x);
        let squares: f64 = points.iter().map(|point| residual(point).powi(2)).sum();
        let deviation = (points.len() > 2).then(|| (squares / (n - 2.0)).sqrt());
        Ok(Self {
            slope,
            intercept: mean_y - slope * mean_x,
            slope_error: deviation.map(|s| s / s_xx.sqrt()),
            intercept_error: deviation.map(|s| s * (1.0 / n + mean_x * mean_x / s_xx).sqrt()),
            r_squared: if s_yy > 0.0 {
                1.0 - squares / s_yy
            } else {
                1.0
            },
            points: points.len(),
        })
    }

    /// The line's y at x.
    pub fn at(&self, x: f64) -> f64 {
        self.slope * x + self.intercept
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Anscombe's first set (The American Statistician 27, 1973): y = 3.00 + 0.500 x, standard errors 1.125 and 0.118, R^2 0.667, all
    /// as printed to three digits; the digits below are from R's `lm`.
    #[test]
    fn a_published_set_has_its_published_line() {
        let x = [10.0, 8.0, 13.0, 9.0, 11.0, 14.0, 6.0, 4.0, 12.0, 7.0, 5.0];
        let y = [
            8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68,
        ];
        let points: Vec<[f64; 2]> = x.into_iter().zip(y).map(|(x, y)| [x, y]).collect();
        let fit = LineFit::through(&points).unwrap();
        // Half a unit of the last digit given.
        let near = |value: f64, known: f64, digit: f64| (value - known).abs() <= 0.5 * digit;
        assert!(near(fit.slope, 0.5001, 1e-4), "{fit:?}");
        assert!(near(fit.intercept, 3.0001, 1e-4), "{fit:?}");
        assert!(near(fit.slope_error.unwrap(), 0.1179, 1e-4), "{fit:?}");
        assert!(near(fit.intercept_error.unwrap(), 1.1247, 1e-4), "{fit:?}");
        assert!(near(fit.r_squared, 0.6665, 1e-4), "{fit:?}");
        assert_eq!(fit.points, 11);
    }

    /// Three points in closed form, the same far from the origin: y = 0, 1, 1 at x = c, c + 1, c + 2 has the slope 1/2, the
    /// residuals -1/6, 1/3, -1/6, s^2 = 1/6 and S_xx = 2.
    #[test]
    fn three_points_have_their_closed_form() {
        for c in [0.0, 1e6] {
            let fit = LineFit::through(&[[c, 0.0], [c + 1.0, 1.0], [c + 2.0, 1.0]]).unwrap();
            // Means of numbers of size 1e6 have a rounding error of 1e-10.
            assert!((fit.slope - 0.5).abs() < 1e-9, "{fit:?}");
            assert!((fit.at(c + 1.0) - 2.0 / 3.0).abs() < 1e-9, "{fit:?}");
            let error = (1.0f64 / 12.0).sqrt();
            assert!((fit.slope_error.unwrap() - error).abs() < 1e-9, "{fit:?}");
            assert!((fit.r_squared - 0.75).abs() < 1e-9, "{fit:?}");
            let intercept_error = (1.0f64 / 6.0 * (1.0 / 3.0 + (c + 1.0).powi(2) / 2.0)).sqrt();
            let relative = fit.intercept_error.unwrap() / intercept_error - 1.0;
            assert!(relative.abs() < 1e-9, "{fit:?}");
        }
    }

    #[test]
    fn two_points_leave_no_scatter() {
        let fit = LineFit::through(&[[1.0, 2.0], [3.0, 8.0]]).unwrap();
        assert_eq!((fit.slope, fit.intercept), (3.0, -1.0));
        assert_eq!((fit.slope_error, fit.intercept_error), (None, None));
        assert_eq!(
            LineFit::through(&[[0.0, 2.0], [1.0, 2.0]])
                .unwrap()
                .r_squared,
            1.0
        );
    }

    #[test]
    fn points_without_a_line_are_told() {
        assert_eq!(LineFit::through(&[]), Err(FitError::TooFew(0)));
        assert_eq!(LineFit::through(&[[1.0, 2.0]]), Err(FitError::TooFew(1)));
        let upright = LineFit::through(&[[1.0, 2.0], [1.0, 3.0]]);
        assert_eq!(upright, Err(FitError::OnePlace(1.0)));
        let lost = LineFit::through(&[[1.0, f64::NAN], [2.0, 3.0]]);
        assert_eq!(lost, Err(FitError::NotFinite));
    }
}
