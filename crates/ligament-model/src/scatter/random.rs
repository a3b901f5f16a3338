//! Random numbers by their index in a sequence.
//!
//! SplitMix64 (Steele 2014, with the constants of variant 13 by Stafford): number k of the sequence of a seed is the mixed bits of seed + (k
//! + 1) times the odd integer nearest to 2^64 over the golden ratio. Each number is computed independently of the others.

/// Increment of the states.
const GAMMA: u64 = 0x9E37_79B9_7F4A_7C15;

/// Number `place` of the sequence of a seed.
pub(super) fn bits(seed: u64, place: u64) -> u64 {
    let mut z = seed.wrapping_add(GAMMA.wrapping_mul(place.wrapping_add(1)));
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// Number `place` of a seed, uniform between 0 and 1: an odd multiple of 2^-54, which excludes both ends.
pub fn uniform(seed: u64, place: u64) -> f64 {
    const STEP: f64 = 1.0 / (1u64 << 53) as f64;
    ((bits(seed, place) >> 11) as f64 + 0.5) * STEP
}

/// Number `place` of a seed with the standard normal distribution, by the transform of Box and Muller.
pub(super) fn normal(seed: u64, place: u64) -> f64 {
    let [u, v] = [2 * place, 2 * place + 1].map(|it| uniform(seed, it));
    (-2.0 * libm::log(u)).sqrt() * libm::cos(std::f64::consts::TAU * v)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// First numbers of the sequence of the seed 1234567 as the reference implementation in C gives them.
    #[test]
    fn numbers_are_those_of_the_reference_implementation() {
        let found: Vec<u64> = (0..5).map(|place| bits(1_234_567, place)).collect();
        let known = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
            4_593_380_528_125_082_431,
            16_408_922_859_458_223_821,
        ];
        assert_eq!(found, known);
    }

    /// Moments of 100,000 numbers; four deviations of each from its expected value: variance 1/n of the mean, 2/n of the variance.
    #[test]
    fn normal_numbers_have_their_moments() {
        let n = 100_000;
        let numbers: Vec<f64> = (0..n).map(|place| normal(7, place)).collect();
        let moment = |power: i32| numbers.iter().map(|it| it.powi(power)).sum::<f64>() / n as f64;
        let root = (n as f64).sqrt();
        assert!(moment(1).abs() < 4.0 / root);
        assert!((moment(2) - 1.0).abs() < 4.0 * 2f64.sqrt() / root);
        // The variance of the fourth power is 96.
        assert!((moment(4) - 3.0).abs() < 4.0 * 96f64.sqrt() / root);
    }
}
