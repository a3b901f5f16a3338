//! A field in the plane with normal values and a correlation length.

use std::f64::consts::TAU;

use super::random::uniform;

/// Waves of a field. The correlation misses its formula by less than 5e-3, the fourth moment of the values that of the normal distribution by
/// 3/(2 n).
const WAVES: usize = 512;

/// Share of a turn between the directions of two waves that follow each other: the golden section spreads them evenly.
const GOLDEN_SECTION: f64 = 0.618_033_988_749_894_9;

/// A sum of plane waves with random phases: values at places have the mean 0, the variance 1 and the correlation exp(-(r/L)^2) at the
/// distance r.
///
/// z(x) = sqrt(2/n) sum_j cos(k_j . x + phi_j) (Shinozuka and Jan 1972), with phases phi_j that are uniform over a turn. That correlation is
/// the Fourier transform of the density of wave vectors k whose components are normal with the deviation sqrt(2)/L; their lengths are
/// taken at the middles of n equally probable classes, their directions at the golden section with a random start.
#[derive(Debug, Clone)]
pub(super) struct RandomWaves {
    /// Wave vector, 1/m, and phase of each wave, shape (n_waves, 3).
    waves: Vec<[f64; 3]>,
}

impl RandomWaves {
    /// The waves of a seed for the correlation length L, m.
    pub(super) fn new(seed: u64, correlation_length: f64) -> Self {
        let start = uniform(seed, WAVES as u64);
        let wave = |place: usize| {
            let below = (place as f64 + 0.5) / WAVES as f64;
            let number = 2.0 / correlation_length * (-libm::log1p(-below)).sqrt();
            let direction = TAU * (start + GOLDEN_SECTION * place as f64);
            let phase = TAU * uniform(seed, place as u64);
            [
                number * libm::cos(direction),
                number * libm::sin(direction),
                phase,
            ]
        };
        Self {
            waves: (0..WAVES).map(wave).collect(),
        }
    }

    /// The value at a place, m.
    pub(super) fn at(&self, [x, y]: [f64; 2]) -> f64 {
        let waves = self.waves.iter();
        let sum: f64 = waves
            .map(|[k_x, k_y, phase]| libm::cos(k_x * x + k_y * y + phase))
            .sum();
        (2.0 / WAVES as f64).sqrt() * sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Over all phases the correlation is the mean of cos(k . r) over the waves: the formula, to what the classes of waves miss.
    #[test]
    fn the_correlation_of_the_waves_is_the_formula() {
        let length = 0.3;
        for seed in [0, 1, 99] {
            let waves = RandomWaves::new(seed, length).waves;
            for (distance, angle) in [(0.0, 0.0), (0.1, 0.0), (0.15, 1.0), (0.3, 2.2), (0.6, 0.7)] {
                let r = [distance * f64::cos(angle), distance * f64::sin(angle)];
                let cosines = waves.iter().map(|k| (k[0] * r[0] + k[1] * r[1]).cos());
                let found = cosines.sum::<f64>() / WAVES as f64;
                let known = (-(distance / length) * (distance / length)).exp();
                assert!(
                    (found - known).abs() < 5e-3,
                    "{distance} {angle}: {found} {known}"
                );
            }
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
}
