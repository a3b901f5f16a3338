//! Random fields with normal values and a correlation length.

use std::f64::consts::{PI, SQRT_2, TAU};

use super::random::uniform;
use crate::tensor::dot;

/// Number of waves of a field in the plane. The error of the correlation is less than 5e-3, that of the fourth moment of the values 3/(2 n).
const WAVES_IN_PLANE: usize = 512;

/// Number of waves of a field in space. The error of the correlation is less than 1e-2.
const WAVES_IN_SPACE: usize = 1024;

/// Fraction of a turn between the directions of successive waves in the plane: the golden section spreads them evenly.
const GOLDEN_SECTION: f64 = 0.618_033_988_749_894_9;

/// Increments of the two coordinates of the directions of successive waves in space, as fractions of a turn and of the height of the sphere:
/// 1/g and 1/g^2 with g^3 = g + 1, which spread pairs of numbers evenly.
const STEPS: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];

/// Number of bisections in the search for a length of a given probability.
const HALVINGS: usize = 60;

/// A sum of plane waves with random phases: its values have the mean 0, the variance 1 and the correlation exp(-(r/L)^2) at the distance r.
///
/// z(x) = sqrt(2/n) sum_j cos(k_j . x + phi_j) (Shinozuka and Jan 1972), with phases phi_j that are uniform over a turn. The correlation is
/// the Fourier transform of the density of wave vectors k with normal components of standard deviation sqrt(2)/L. Their lengths have the
/// distribution of Rayleigh, in space that of Maxwell, and are taken at the middles of n equally probable classes; their directions are an
/// even sequence with a random start.
#[derive(Debug, Clone)]
pub(super) struct RandomWaves<const D: usize> {
    /// Wave vector, 1/m, and phase of each wave, shape (n_waves).
    waves: Vec<([f64; D], f64)>,
}

impl<const D: usize> RandomWaves<D> {
    /// The waves of a seed for the correlation length L, m.
    pub(super) fn new(seed: u64, correlation_length: f64) -> Self {
        let vectors = if D == 2 {
            vectors_in_plane(seed, correlation_length)
        } else {
            vectors_in_space(seed, correlation_length)
        };
        let phases = (0..).map(|place| TAU * uniform(seed, place));
        let in_dimensions = |vector: [f64; 3]| std::array::from_fn(|axis| vector[axis]);
        Self {
            waves: vectors.into_iter().map(in_dimensions).zip(phases).collect(),
        }
    }

    /// Value at a position, m.
    pub(super) fn at(&self, place: [f64; D]) -> f64 {
        let waves = self.waves.iter();
        let sum: f64 = waves
            .map(|(k, phase)| libm::cos(dot(*k, place) + phase))
            .sum();
        (2.0 / self.waves.len() as f64).sqrt() * sum
    }
}

/// Wave vectors in the plane, 1/m.
fn vectors_in_plane(seed: u64, correlation_length: f64) -> Vec<[f64; 3]> {
    let start = uniform(seed, WAVES_IN_PLANE as u64);
    let vector = |place: usize| {
        let below = (place as f64 + 0.5) / WAVES_IN_PLANE as f64;
        let number = 2.0 / correlation_length * (-libm::log1p(-below)).sqrt();
        let direction = TAU * (start + GOLDEN_SECTION * place as f64);
        [
            number * libm::cos(direction),
            number * libm::sin(direction),
            0.0,
        ]
    };
    (0..WAVES_IN_PLANE).map(vector).collect()
}

/// Wave vectors in space, 1/m.
fn vectors_in_space(seed: u64, correlation_length: f64) -> Vec<[f64; 3]> {
    let starts = [0, 1].map(|place| uniform(seed, (WAVES_IN_SPACE + place) as u64));
    let deviation = SQRT_2 / correlation_length;
    let vector = |place: usize| {
        let number = deviation * maxwell((place as f64 + 0.5) / WAVES_IN_SPACE as f64);
        let [around, height] = [0, 1].map(|k| {
            let moved = starts[k] + STEPS[k] * place as f64;
            moved - moved.floor()
        });
        let z = 1.0 - 2.0 * height;
        let across = (1.0 - z * z).max(0.0).sqrt();
        let angle = TAU * around;
        [
            number * across * libm::cos(angle),
            number * across * libm::sin(angle),
            number * z,
        ]
    };
    (0..WAVES_IN_SPACE).map(vector).collect()
}

/// Length below which a vector of three standard normal components falls with a given probability P(x) = erf(x/sqrt(2)) - sqrt(2/pi) x
/// exp(-x^2/2).
fn maxwell(probability: f64) -> f64 {
    let below = |x: f64| libm::erf(x / SQRT_2) - (2.0 / PI).sqrt() * x * libm::exp(-0.5 * x * x);
    let (mut low, mut high) = (0.0, 10.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if below(middle) < probability {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Over all phases the correlation is the mean of cos(k . r) over the waves: the formula, to what classes and directions miss.
    fn check_correlation<const D: usize>(r: [f64; D], largest_error: f64) {
        let length = 0.3;
        for seed in [0, 1, 99] {
            let waves = RandomWaves::<D>::new(seed, length).waves;
            let cosines = waves.iter().map(|(k, _)| dot(*k, r).cos());
            let found = cosines.sum::<f64>() / waves.len() as f64;
            let known = (-dot(r, r) / (length * length)).exp();
            assert!(
                (found - known).abs() < largest_error,
                "{r:?}: {found} {known}"
            );
        }
    }

    #[test]
    fn the_correlation_of_the_waves_is_the_formula() {
        for (distance, angle) in [(0.0, 0.0), (0.1, 0.0), (0.15, 1.0), (0.3, 2.2), (0.6, 0.7)] {
            let r = [distance * f64::cos(angle), distance * f64::sin(angle)];
            check_correlation(r, 5e-3);
        }
        for r in [
            [0.0, 0.0, 0.0],
            [0.1, 0.0, 0.0],
            [0.05, -0.12, 0.07],
            [0.0, 0.2, -0.22],
            [-0.3, 0.3, 0.42],
        ] {
            check_correlation(r, 1e-2);
        }
    }

    /// Mean, variance, fourth moment and correlation over 4,000 seeds at two places; four deviations of each.
    #[test]
    fn values_over_the_seeds_are_normal_with_the_correlation() {
        let (length, n) = (0.3, 4000);
        let places = [[0.7, -0.2], [0.7 + 0.3, -0.2]];
        let pairs: Vec<[f64; 2]> = (0..n)
            .map(|seed| {
                let waves = RandomWaves::new(seed, length);
                places.map(|place| waves.at(place))
            })
            .collect();
        let mean =
            |value: &dyn Fn(&[f64; 2]) -> f64| pairs.iter().map(value).sum::<f64>() / n as f64;
        let root = (n as f64).sqrt();
        assert!(mean(&|it| it[0]).abs() < 4.0 / root);
        assert!((mean(&|it| it[0] * it[0]) - 1.0).abs() < 4.0 * 2f64.sqrt() / root);
        assert!((mean(&|it| it[1].powi(4)) - 3.0).abs() < 4.0 * 96f64.sqrt() / root);
        let correlation = mean(&|it| it[0] * it[1]);
        let known = (-1f64).exp();
        // The variance of the product of two normal numbers is 1 + rho^2.
        let deviation = (1.0 + known * known).sqrt() / root;
        assert!(
            (correlation - known).abs() < 4.0 * deviation,
            "{correlation}"
        );
    }

    /// Mean and variance over 2,000 seeds at a place; four deviations of each.
    #[test]
    fn values_in_space_are_normal_over_the_seeds() {
        let n = 2000;
        let values: Vec<f64> = (0..n)
            .map(|seed| RandomWaves::new(seed, 0.3).at([0.7, -0.2, 0.4]))
            .collect();
        let moment = |power: i32| values.iter().map(|it| it.powi(power)).sum::<f64>() / n as f64;
        let root = (n as f64).sqrt();
        assert!(moment(1).abs() < 4.0 / root);
        assert!((moment(2) - 1.0).abs() < 4.0 * 2f64.sqrt() / root);
    }
}
