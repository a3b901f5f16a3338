//! A field in space with normal values and a correlation length.

use std::f64::consts::{PI, TAU};

use super::random::uniform;

/// Waves of a field. The correlation misses its formula by less than 1e-2.
const WAVES: usize = 1024;

/// Steps of the two coordinates of the directions of waves that follow each other, as parts of a turn and of the height of the sphere: 1/g
/// and 1/g^2 with g^3 = g + 1, which spread pairs of numbers evenly.
const STEPS: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];

/// Halvings in the search for a length of a given probability.
const HALVINGS: usize = 60;

/// A sum of plane waves in space with random phases: values at places have the mean 0, the variance 1 and the correlation exp(-(r/L)^2) at
/// the distance r, as in the [plane](super::gaussian).
///
/// The components of the wave vectors are normal with the deviation sqrt(2)/L, so that their lengths have the distribution of Maxwell;
/// they are taken at the middles of equally probable classes, the directions from an even sequence on the sphere with a random start.
#[derive(Debug, Clone)]
pub(super) struct RandomWavesInSpace {
    /// Wave vector, 1/m, and phase of each wave, shape (n_waves, 4).
    waves: Vec<[f64; 4]>,
}

impl RandomWavesInSpace {
    /// The waves of a seed for the correlation length L, m.
    pub(super) fn new(seed: u64, correlation_length: f64) -> Self {
        let starts = [0, 1].map(|place| uniform(seed, (WAVES + place) as u64));
        let deviation = std::f64::consts::SQRT_2 / correlation_length;
        let wave = |place: usize| {
            let number = deviation * maxwell((place as f64 + 0.5) / WAVES as f64);
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
                TAU * uniform(seed, place as u64),
            ]
        };
        Self {
            waves: (0..WAVES).map(wave).collect(),
        }
    }

    /// The value at a place, m.
    pub(super) fn at(&self, [x, y, z]: [f64; 3]) -> f64 {
        let waves = self.waves.iter();
        let sum: f64 = waves
            .map(|[k_x, k_y, k_z, phase]| libm::cos(k_x * x + k_y * y + k_z * z + phase))
            .sum();
        (2.0 / WAVES as f64).sqrt() * sum
    }
}

/// The length that a vector of three normal components of deviation 1 falls below with some probability:
/// P(x) = erf(x/sqrt(2)) - sqrt(2/pi) x exp(-x^2/2).
fn maxwell(probability: f64) -> f64 {
    let below = |x: f64| {
        libm::erf(x / std::f64::consts::SQRT_2) - (2.0 / PI).sqrt() * x * libm::exp(-0.5 * x * x)
    };
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
    #[test]
    fn the_correlation_of_the_waves_is_the_formula() {
        let length = 0.3;
        let places = [
            [0.0, 0.0, 0.0],
            [0.1, 0.0, 0.0],
            [0.05, -0.12, 0.07],
            [0.0, 0.2, -0.22],
            [-0.3, 0.3, 0.42],
        ];
        for seed in [0, 1, 99] {
            let waves = RandomWavesInSpace::new(seed, length).waves;
            for r in places {
                let cosines = waves
                    .iter()
                    .map(|k| (k[0] * r[0] + k[1] * r[1] + k[2] * r[2]).cos());
                let found = cosines.sum::<f64>() / WAVES as f64;
                let square: f64 = r.iter().map(|x| x * x).sum();
                let known = (-square / (length * length)).exp();
                assert!((found - known).abs() < 1e-2, "{r:?}: {found} {known}");
            }
        }
    }

    /// Mean and variance over 2,000 seeds at a place; four deviations of each.
    #[test]
    fn values_over_the_seeds_are_normal() {
        let n = 2000;
        let values: Vec<f64> = (0..n)
            .map(|seed| RandomWavesInSpace::new(seed, 0.3).at([0.7, -0.2, 0.4]))
            .collect();
        let moment = |power: i32| values.iter().map(|it| it.powi(power)).sum::<f64>() / n as f64;
        let root = (n as f64).sqrt();
        assert!(moment(1).abs() < 4.0 / root);
        assert!((moment(2) - 1.0).abs() < 4.0 * 2f64.sqrt() / root);
    }
}
