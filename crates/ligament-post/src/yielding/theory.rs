//! Worst bond of a criterion, among bonds in all directions.

use ligament_model::element::BondDeformation;
use ligament_model::failure::Measure;
use ligament_model::failure::hooke::StressAcross;

use super::PrincipalStretches;

/// Deformation of the bond with the largest measure, for a coefficient q, among bonds in all directions: the deformation in the worst of
/// the [directions](Measure::worst_directions), with positive sliding.
///
/// # Panics
///
/// Panics for a measure of the imaginary element's own strains, like [`Measure::worst_directions`].
pub fn critical_deformation(
    measure: Measure,
    coefficient: f64,
    strains: PrincipalStretches,
) -> BondDeformation {
    let (mean, deviator) = (strains.mean(), strains.deviator());
    let at = |cosine: f64| {
        let cosine = cosine.clamp(-1.0, 1.0);
        let shear = deviator * (1.0 - cosine * cosine).sqrt();
        BondDeformation::new([mean + deviator * cosine, shear, 0.0])
    };
    let value = |deformation: &BondDeformation| {
        measure.value(deformation, &[coefficient], StressAcross::default)
    };
    let [first, others @ ..] = measure.worst_directions(coefficient, mean, deviator);
    let finite = others.into_iter().filter(|cosine| cosine.is_finite());
    finite.map(at).fold(at(first), |worst, it| {
        if value(&it) > value(&worst) {
            it
        } else {
            worst
        }
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    const ALL: [Measure; 5] = [
        Measure::Tension,
        Measure::Compression,
        Measure::Sliding,
        Measure::Friction,
        Measure::Energy,
    ];

    /// Against 20,000 directions: nothing is larger, and the largest of them is as near as their distance of 1.6e-4
    /// rad allows, which is its square times the second derivative (below 4 s_d max(q, 1) on the smooth branches), or
    /// a slope where the energy has a kink at s = 0 (its root, at zero shear, only).
    #[test]
    fn no_direction_is_worse_than_the_critical_one() {
        for measure in ALL {
            for q in [-0.5, 0.0, 0.3, 1.0, 2.0, 5.0] {
                for (first, second) in [
                    (1.0, 0.0),
                    (1.0, -1.0),
                    (0.3, 1.0),
                    (-1.0, -0.2),
                    (0.4, -2.0),
                    (-3.0, 1.0),
                    (0.7, 0.7),
                ] {
                    let strains = PrincipalStretches::new(first, second);
                    let critical = critical_deformation(measure, q, strains);
                    let largest = measure.value(&critical, &[q], StressAcross::default);
                    let sampled = (0..20_000)
                        .map(|k| PI * f64::from(k) / 20_000.0)
                        .map(|x| strains.along([(2.0 * x).cos(), (2.0 * x).sin()]))
                        .map(|deformation| measure.value(&deformation, &[q], StressAcross::default))
                        .fold(f64::NEG_INFINITY, f64::max);
                    let place = format!("{measure:?} {q} {first} {second}: {sampled} {largest}");
                    assert!(sampled <= largest + 1e-14, "{place}");
                    assert!(sampled >= largest - 1e-6, "{place}");
                }
            }
        }
    }

    /// The slope bounds differences between neighbouring directions and is nearly reached by one of them.
    #[test]
    fn slopes_are_bounds() {
        let strains = PrincipalStretches::new(0.2, -1.3);
        let step = 1e-5;
        for (measure, reached) in ALL.into_iter().zip([true, true, true, true, false]) {
            let bound = measure.steepest_slope(2.0) * strains.deviator();
            let value = |x: f64| {
                let twice = [(2.0 * x).cos(), (2.0 * x).sin()];
                measure.value(&strains.along(twice), &[2.0], StressAcross::default)
            };
            let slope = |k: u32| {
                let x = f64::from(k) * PI / 5000.0;
                (value(x + step) - value(x)).abs() / step
            };
            let steepest = (0..5000).map(slope).fold(0.0, f64::max);
            assert!(
                steepest <= bound * (1.0 + 1e-9),
                "{measure:?} {steepest} {bound}"
            );
            assert!(
                !reached || steepest > 0.999 * bound,
                "{measure:?} {steepest} {bound}"
            );
        }
    }
}
