//! Distributions of a factor with the mean 1.

use std::f64::consts::SQRT_2;

use crate::case_type::Range;

/// Number of standard deviations beyond which factors of the normal distribution are cut off: one value in 16,000.
const CUT: f64 = 4.0;

/// Distribution of a factor with the mean 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Distribution {
    /// Two-parameter Weibull distribution (Weibull 1951): the probability of less than f is 1 - exp(-(f Gamma(1 + 1/m))^m).
    Weibull {
        /// Weibull modulus m: 5 scatters by 23 %, 12 by 10 %, 25 by 5 %.
        modulus: f64,
    },
    /// Normal distribution, cut off at four standard deviations.
    Normal {
        /// Standard deviation over the mean.
        deviation: f64,
    },
    /// Lognormal distribution: ln f is normal with the variance s^2 = ln(1 + c^2) and the mean -s^2/2 (Aitchison and Brown 1957).
    Lognormal {
        /// Standard deviation c over the mean.
        deviation: f64,
    },
}

impl Distribution {
    /// Range of a Weibull modulus.
    pub const MODULUS: Range<'static> = Range::new(&[("minimum", 1.0), ("maximum", 1e4)]);

    /// Range of the standard deviation of a lognormal distribution over the mean.
    pub const DEVIATION: Range<'static> =
        Range::new(&[("exclusiveMinimum", 0.0), ("maximum", 10.0)]);

    /// Range of the standard deviation of a normal distribution over the mean, in which no factor is negative.
    pub const NORMAL: Range<'static> = Range {
        bounds: &[("exclusiveMinimum", 0.0), ("exclusiveMaximum", 1.0 / CUT)],
        words: "greater than 0 and less than 0.25, so that no strength is negative",
    };

    /// Factor with the same exceedance probability as a standard normal number.
    pub fn factor(&self, normal: f64) -> f64 {
        match *self {
            Self::Weibull { modulus } => {
                // Negative logarithm of the exceedance probability, from the smaller of both tails.
                let tail = 0.5 * libm::erfc(normal.abs() / SQRT_2);
                let exponent = if normal < 0.0 {
                    -libm::log1p(-tail)
                } else {
                    -libm::log(tail)
                };
                libm::pow(exponent, 1.0 / modulus) / libm::tgamma(1.0 + 1.0 / modulus)
            }
            Self::Normal { deviation } => 1.0 + deviation * normal.clamp(-CUT, CUT),
            Self::Lognormal { deviation } => {
                let variance = libm::log1p(deviation * deviation);
                libm::exp(variance.sqrt() * normal - 0.5 * variance)
            }
        }
    }

    /// Standard deviation over the mean.
    pub fn deviation(&self) -> f64 {
        match *self {
            Self::Weibull { modulus } => {
                let first = libm::tgamma(1.0 + 1.0 / modulus);
                let second = libm::tgamma(1.0 + 2.0 / modulus);
                (second / (first * first) - 1.0).sqrt()
            }
            Self::Normal { deviation } | Self::Lognormal { deviation } => deviation,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean and variance over the normal density by Simpson's rule between -8.5 and 8.5. Cutting the normal off lowers its variance by
    /// 1e-4 (2 integral_4^inf (z^2 - 16) phi dz = 6e-5).
    #[test]
    fn the_mean_is_one_and_the_deviation_that_of_the_distribution() {
        let all = [3.0, 5.0, 12.0, 25.0].map(|modulus| Distribution::Weibull { modulus });
        let normal = Distribution::Normal { deviation: 0.1 };
        let lognormal = [0.1, 0.5].map(|deviation| Distribution::Lognormal { deviation });
        for distribution in all.into_iter().chain([normal]).chain(lognormal) {
            let moment = |power: i32| {
                let steps = 20_000;
                let width = 17.0 / f64::from(steps);
                let density = |z: f64| (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt();
                let value = |k: i32| {
                    let z = -8.5 + f64::from(k) * width;
                    distribution.factor(z).powi(power) * density(z)
                };
                let weight = |k: i32| match k {
                    0 => 1.0,
                    k if k == steps => 1.0,
                    k if k % 2 == 1 => 4.0,
                    _ => 2.0,
                };
                (0..=steps).map(|k| weight(k) * value(k)).sum::<f64>() * width / 3.0
            };
            let (mean, second) = (moment(1), moment(2));
            assert!((mean - 1.0).abs() < 1e-9, "{distribution:?}: {mean}");
            let deviation = (second - mean * mean).sqrt();
            let error = deviation / distribution.deviation() - 1.0;
            assert!(error.abs() < 1e-4, "{distribution:?}: {error:e}");
        }
    }

    /// The probability of less than f in closed form is that of the normal number, in both tails.
    #[test]
    fn the_probability_of_less_is_that_of_weibull() {
        let modulus = 12.0;
        let weibull = Distribution::Weibull { modulus };
        for normal in [-5.0, -2.0, -0.3, 0.0, 0.4, 2.0, 4.0] {
            let scaled = weibull.factor(normal) * libm::tgamma(1.0 + 1.0 / modulus);
            let less = -(-scaled.powf(modulus)).exp_m1();
            let known = 0.5 * libm::erfc(-normal / SQRT_2);
            assert!(
                (less / known - 1.0).abs() < 1e-12,
                "{normal}: {less:e} {known:e}"
            );
        }
        // Tails keep their digits: no strength is zero.
        assert!(weibull.factor(-8.6) > 0.0 && weibull.factor(8.6).is_finite());
    }
}
