//! Weibull's distribution with two parameters, fitted to strengths by maximum likelihood.

use std::f64::consts::PI;

use thiserror::Error;

/// Euler's constant.
const EULER: f64 = 0.577_215_664_901_532_9;

/// Number of doublings and of halvings in the search for a modulus.
const STEPS: usize = 200;

/// Reason why strengths have no Weibull modulus.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum NoFit {
    /// Fewer than two strengths.
    #[error("a Weibull modulus needs two strengths or more")]
    TooFew,
    /// Equal strengths, or strengths that are not positive and finite.
    #[error("a Weibull modulus needs positive strengths that differ")]
    Unfit,
}

/// Weibull's distribution F(x) = 1 - exp(-(x/x_0)^m) (Weibull 1951) with the largest likelihood for some strengths.
///
/// The logarithms of modulus and scale have the covariances of the estimate for many samples, as the information of Fisher gives them (Thoman
/// 1969): for few samples the modulus is too large in the mean, by a share of 1.4/n.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WeibullFit {
    /// Modulus m.
    pub modulus: f64,
    /// Scale x_0, which a share 1/e of the samples exceeds, in the unit of the strengths.
    pub scale: f64,
    /// Number of strengths.
    pub n_samples: usize,
}

impl WeibullFit {
    /// The fit to strengths (n); sums are in their order.
    ///
    /// # Errors
    ///
    /// If there are fewer than two strengths, they are all equal, or one is not positive and finite.
    pub fn through(strengths: &[f64]) -> Result<Self, NoFit> {
        if strengths.len() < 2 {
            return Err(NoFit::TooFew);
        }
        let is_strength = |it: &f64| *it > 0.0 && it.is_finite();
        let largest = strengths.iter().copied().fold(0.0, f64::max);
        if !strengths.iter().all(is_strength) || strengths.iter().all(|it| *it == largest) {
            return Err(NoFit::Unfit);
        }
        // Logarithms of the strengths over the largest, so that no power overflows.
        let logarithms: Vec<f64> = strengths.iter().map(|it| (it / largest).ln()).collect();
        let modulus = modulus(&logarithms);
        let mean = logarithms
            .iter()
            .map(|it| (modulus * it).exp())
            .sum::<f64>();
        let mean = mean / strengths.len() as f64;
        Ok(Self {
            modulus,
            scale: largest * mean.powf(1.0 / modulus),
            n_samples: strengths.len(),
        })
    }

    /// Strength that a share `probability` of the specimens does not reach, between 0 and 1.
    pub fn quantile(&self, probability: f64) -> f64 {
        self.scale * (-(-probability).ln_1p()).powf(1.0 / self.modulus)
    }

    /// Bounds of the modulus `deviations` standard deviations of its logarithm away, such as 1.645 for 90 %.
    pub fn modulus_within(&self, deviations: f64) -> [f64; 2] {
        let [_, of_modulus, _] = variances();
        let off = deviations * (of_modulus / self.n_samples as f64).sqrt();
        [-off, off].map(|it| self.modulus * it.exp())
    }

    /// Bounds of the scale `deviations` standard deviations of its logarithm away.
    pub fn scale_within(&self, deviations: f64) -> [f64; 2] {
        self.strength_bounds(0.0, deviations)
    }

    /// Bounds of the [`quantile`](Self::quantile) `deviations` standard deviations of its logarithm away.
    pub fn quantile_within(&self, probability: f64, deviations: f64) -> [f64; 2] {
        self.strength_bounds((-(-probability).ln_1p()).ln(), deviations)
    }

    /// Bounds of the strength at w = ln(-ln(1 - F)): ln x = ln x_0 + w/m has the variance (var_0 + w^2 var_m + 2 w cov)/(n m^2).
    fn strength_bounds(&self, w: f64, deviations: f64) -> [f64; 2] {
        let [of_scale, of_modulus, both] = variances();
        let variance = of_scale + w * w * of_modulus + 2.0 * w * both;
        let off = deviations * (variance / self.n_samples as f64).sqrt() / self.modulus;
        let middle = self.scale * (w / self.modulus).exp();
        [-off, off].map(|it| middle * it.exp())
    }
}

/// Variances of ln x_0 and of 1/m, and their covariance, times n m^2: the inverse of Fisher's information of ln x, which has the
/// distribution of the smallest extreme.
fn variances() -> [f64; 3] {
    let sixth = PI * PI / 6.0;
    let rest = 1.0 - EULER;
    [1.0 + rest * rest / sixth, 1.0 / sixth, -rest / sixth]
}

/// The root m of sum x^m ln x / sum x^m - 1/m - mean(ln x) = 0, which rises with m, by bisection; for logarithms up to 0, shape (n).
fn modulus(logarithms: &[f64]) -> f64 {
    let mean = logarithms.iter().sum::<f64>() / logarithms.len() as f64;
    let excess = |m: f64| {
        let weights = || logarithms.iter().map(|it| (m * it).exp());
        let products = weights().zip(logarithms).map(|(weight, it)| weight * it);
        products.sum::<f64>() / weights().sum::<f64>() - 1.0 / m - mean
    };
    let (mut low, mut high) = (1.0, 1.0);
    for _ in 0..STEPS {
        if excess(low) > 0.0 {
            low *= 0.5;
        }
        if excess(high) < 0.0 {
            high *= 2.0;
        }
    }
    for _ in 0..STEPS {
        let middle = 0.5 * (low + high);
        if excess(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// Probability (i - 0.3)/(n + 0.4) at which strength `rank` of n in ascending order, from 1, is plotted: nearly the median of its
/// distribution (Benard and Bos-Levenbach 1953).
pub fn plotting_position(rank: usize, n: usize) -> f64 {
    (rank as f64 - 0.3) / (n as f64 + 0.4)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
mod tests {
    use super::*;

    /// Strengths at equally probable quantiles of a known distribution: the error of a fit of 4,000 comes from the tails that the sums
    /// miss, of the order ln(n)/n.
    #[test]
    fn quantiles_of_a_distribution_give_it_back() {
        let known = WeibullFit {
            modulus: 7.0,
            scale: 3e6,
            n_samples: 4000,
        };
        let n = known.n_samples;
        let strengths: Vec<f64> = (0..n)
            .map(|it| known.quantile((it as f64 + 0.5) / n as f64))
            .collect();
        let fit = WeibullFit::through(&strengths).unwrap();
        assert!((fit.modulus / known.modulus - 1.0).abs() < 2e-3, "{fit:?}");
        assert!((fit.scale / known.scale - 1.0).abs() < 1e-4, "{fit:?}");
    }

    /// Two strengths e^-1 and e (a modulus of a half of the distance of their logarithms): the likelihood equation for logarithms -a and
    /// a is tanh(m a) = 1/(m a), whose root is m a = 1.199678640257734.
    #[test]
    fn two_strengths_have_the_modulus_of_the_closed_form() {
        let strengths = [-1.0f64, 1.0].map(f64::exp);
        let fit = WeibullFit::through(&strengths).unwrap();
        assert!(
            (fit.modulus - 1.199_678_640_257_734).abs() < 1e-12,
            "{fit:?}"
        );
        // x_0^m is the mean of x^m, here cosh(m).
        let scale = fit.modulus.cosh().powf(1.0 / fit.modulus);
        assert!((fit.scale / scale - 1.0).abs() < 1e-14);
    }

    /// Variances of Thoman, Bain and Antle: 1.109 and 0.608 over n, and the covariance 0.257.
    #[test]
    fn variances_are_those_of_the_literature() {
        let [of_scale, of_modulus, both] = variances();
        assert!((of_scale - 1.1087).abs() < 1e-4);
        assert!((of_modulus - 0.6079).abs() < 1e-4);
        assert!((both + 0.2570).abs() < 1e-4);
    }

    #[test]
    fn strengths_without_a_modulus_are_refused() {
        assert_eq!(WeibullFit::through(&[1.0]), Err(NoFit::TooFew));
        for unfit in [[2.0, 2.0], [0.0, 1.0], [-1.0, 1.0], [f64::NAN, 1.0]] {
            assert_eq!(WeibullFit::through(&unfit), Err(NoFit::Unfit), "{unfit:?}");
        }
    }
}
