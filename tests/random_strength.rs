//! Strengths and fracture energies that vary at random: what limits, softening and specimens make of the factors.
//!
//! The distributions, the correlation and the random numbers are tested beside their code (`crates/ligament-model/src/scatter`).
#![allow(clippy::unwrap_used)]

use ligament_model::Numbering;
use ligament_model::failure::Criterion;
use ligament_model::scatter::{self, Distribution, Scatter, Scattered};
use verification::bench::Bench;
use verification::numbers::relative_error;

/// A bar of 24 x 8 cells whose ends do not break.
const BAR: &str = r#"
lattice = { cells = [24, 8], spacing = 0.001, thickness = 0.01, set = { left = { left = 3 }, right = { right = 3 } } }
material = { young = 30e9, poisson = 0.2, tensile_strength = 3e6, compressive_strength = 30e6, fracture_energy = 20.0 }
model = { law = "mppd", horizon_factor = 3.0 }
support = [{ group = "left", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "right", displacement = { x = 1e-4 } }]
no_fail = [{ group = "left" }, { group = "right" }]
fracture = { steps = 2 }
"#;

/// The bar with one criterion, and with random factors unless there are no words for them.
fn bar(criterion: &str, scatter: &str) -> Bench {
    match scatter {
        "" => with_scatter(criterion, &[]),
        _ => with_scatter(criterion, &[&format!("fracture.scatter={{ {scatter} }}")]),
    }
}

fn with_scatter(criterion: &str, scatter: &[&str]) -> Bench {
    let criterion = format!("fracture.criterion=[{{ {criterion} }}]");
    let settings = [&[criterion.as_str()], scatter].concat();
    Bench::new(BAR, &settings)
}

const STRENGTH: &str = "of = \"strength\", modulus = 8.0, seed = 5";
const ENERGY: &str =
    "of = \"fracture-energy\", distribution = \"normal\", deviation = 0.2, seed = 5";

/// Limits from strengths, and given ones, are multiplied by the factor f of the bond, those from energies by sqrt(f): a stretch goes with
/// the strength, and with the root of the energy. f is the mean of the ends. Rounding alone.
#[test]
fn limits_go_with_the_factor_of_what_they_come_from() {
    type Limit = fn(f64) -> f64;
    let cases: [(&str, &str, Limit); 9] = [
        ("kind = \"strength\"", STRENGTH, |f| f),
        ("kind = \"tension\"", STRENGTH, |f| f),
        ("kind = \"tension\", limit = 1e-4", STRENGTH, |f| f),
        ("kind = \"compression\"", STRENGTH, |f| f),
        ("kind = \"sliding\"", STRENGTH, |f| f),
        ("kind = \"frictional\"", STRENGTH, |f| f),
        ("kind = \"bond-energy\", limit = 1e-4", STRENGTH, |f| f),
        ("kind = \"critical-stretch\"", ENERGY, f64::sqrt),
        ("kind = \"bond-energy\"", ENERGY, f64::sqrt),
    ];
    for (criterion, scatter, share) in cases {
        let (sound, bench) = (bar(criterion, ""), bar(criterion, scatter));
        let (sound, found) = (sound.limits(), bench.limits());
        let factors = &bench.model.fixed.scatter[0].at_points;
        let ends = &bench.model.plane().bonds.ends;
        let mut finite = 0;
        for (bond, &[a, b]) in ends.iter().enumerate() {
            let factor = 0.5 * (factors[a as usize] + factors[b as usize]);
            if sound[bond].is_infinite() {
                assert!(found[bond].is_infinite(), "{criterion}");
                continue;
            }
            finite += 1;
            let known = sound[bond] * share(factor);
            assert!(
                relative_error(found[bond], known) < 1e-15,
                "{criterion}, bond {bond}"
            );
        }
        assert!(finite > 1000, "{criterion}");
    }
}

/// Energy of the whole life of a bond over its stiffness: the square of its limit times what the law takes of that.
fn life(criterion: &Criterion, bond: usize) -> f64 {
    criterion.limit[bond].powi(2) * criterion.after.total_dissipated(bond)
}

/// With softening by the fracture energy a bond takes that energy whatever its strength, and f times that where the energy varies.
#[test]
fn softening_keeps_the_fracture_energy_of_each_bond() {
    let criterion = "kind = \"tension\", after = \"exponential\"";
    let sound = bar(criterion, "");
    let sound = &sound.model.criteria.list[0];
    for (scatter, power) in [(STRENGTH, 0), (ENERGY, 1)] {
        let bench = bar(criterion, scatter);
        let found = &bench.model.criteria.list[0];
        let factors = &bench.model.fixed.scatter[0];
        for (bond, &ends) in bench.model.plane().bonds.ends.iter().enumerate() {
            if sound.limit[bond].is_finite() {
                let known = life(sound, bond) * factors.of_bond(ends).powi(power);
                let error = relative_error(life(found, bond), known);
                assert!(error < 1e-13, "{scatter}, bond {bond}: {error:e}");
            }
        }
    }
}

/// With both properties at once each limit has the factor of the strength, and each whole life that of the energy. The strength has the
/// factors that it has alone, and so has the energy with a seed of its own; without one its factors are others, but the same ones again.
#[test]
fn strength_and_fracture_energy_vary_at_once() {
    let criterion = "kind = \"tension\", after = \"exponential\"";
    let alone = [STRENGTH, ENERGY].map(|it| bar(criterion, it).model.fixed.scatter[0].clone());
    let sound = bar(criterion, "");
    let sound = &sound.model.criteria.list[0];
    let without_seed = ENERGY.replace(", seed = 5", "");
    let both = |energy: &str| {
        let list = format!("fracture.scatter=[{{ {STRENGTH} }}, {{ {energy} }}]");
        with_scatter(criterion, &[&list])
    };
    for (energy, is_own) in [(ENERGY, true), (&without_seed, false)] {
        let bench = both(energy);
        let [of_strength, of_energy] = &bench.model.fixed.scatter[..] else {
            panic!("{energy}")
        };
        assert_eq!(of_strength, &alone[0]);
        assert_eq!(of_energy == &alone[1], is_own, "{energy}");
        assert_eq!(of_energy, &both(energy).model.fixed.scatter[1]);
        let found = &bench.model.criteria.list[0];
        for (bond, &ends) in bench.model.plane().bonds.ends.iter().enumerate() {
            if sound.limit[bond].is_finite() {
                let limit = sound.limit[bond] * of_strength.of_bond(ends);
                assert!(relative_error(found.limit[bond], limit) < 1e-15, "{bond}");
                let known = life(sound, bond) * of_energy.of_bond(ends);
                let error = relative_error(life(found, bond), known);
                assert!(error < 1e-13, "{energy}, bond {bond}: {error:e}");
            }
        }
    }
}

/// A second property whose seed follows from the first one's is independent of it: the correlation of 20,000 pairs is below four of its
/// standard deviations, and that of two properties with one seed is 1.
#[test]
fn two_properties_are_independent() {
    let positions = vec![[0.0, 0.0]; 20_000];
    let property = |of, seed| Scatter {
        of,
        distribution: Distribution::Normal { deviation: 0.1 },
        seed,
        correlation_length: 0.0,
    };
    let correlation = |seed| {
        let strength = property(Scattered::Strength, Some(3));
        let energy = property(Scattered::FractureEnergy, seed);
        let found = scatter::factors(&[strength, energy], &positions, &Numbering::default());
        let pairs = found[0].at_points.iter().zip(&found[1].at_points);
        let products = pairs.map(|(one, other)| (one - 1.0) * (other - 1.0));
        products.sum::<f64>() / positions.len() as f64 / 0.01
    };
    let bound = 4.0 / (positions.len() as f64).sqrt();
    assert!(correlation(None).abs() < bound);
    // Four deviations sqrt(2/n) of the variance itself.
    assert!((correlation(Some(3)) - 1.0).abs() < 2f64.sqrt() * bound);
}

/// Load at which the first bond of the bar breaks.
fn strength(scatter: &str) -> f64 {
    let scatter = format!("fracture.scatter={{ {scatter} }}");
    let event =
        "fracture={ control=\"event\", stop={ bonds=1 }, criterion=[{ kind=\"tension\" }] }";
    let settings = [event, scatter.as_str()];
    let used = if scatter.len() < 24 { 1 } else { 2 };
    let run = Bench::new(BAR, &settings[..used]).break_up();
    run.breaks[0].reaction
}

/// A correlation length far beyond the body makes the whole specimen as strong as its one factor, which is the factor of the distribution at
/// any place: the bar's load is that of a sound one times it. The field varies by 4e-4 over the bar of 24 mm at L = 100 m.
#[test]
fn a_specimen_within_one_correlation_length_has_one_strength() {
    let sound = strength("");
    for seed in [1, 2, 3, 4] {
        let distribution = Distribution::Weibull { modulus: 10.0 };
        let scatter = Scatter {
            of: Scattered::Strength,
            distribution,
            seed: Some(seed),
            correlation_length: 100.0,
        };
        let factor = scatter
            .factors(&[[0.012, 0.004]], &Numbering::default())
            .at_points[0];
        let words =
            format!("of = \"strength\", modulus = 10.0, seed = {seed}, correlation_length = 100.0");
        let found = strength(&words) / sound;
        assert!(
            relative_error(found, factor) < 1e-3,
            "{seed}: {found} {factor}"
        );
    }
}

/// Factors of 20,000 points that go each for itself: mean, deviation and the share of weak ones by the closed forms, within four deviations
/// of each; neighbours have nothing in common.
#[test]
fn points_each_for_themselves_have_the_distribution() {
    let positions = vec![[0.0, 0.0]; 20_000];
    let distribution = Distribution::Weibull { modulus: 12.0 };
    let scatter = Scatter {
        of: Scattered::Strength,
        distribution,
        seed: Some(42),
        correlation_length: 0.0,
    };
    let factors = scatter.factors(&positions, &Numbering::default()).at_points;
    let (n, deviation) = (factors.len() as f64, distribution.deviation());
    let mean = factors.iter().sum::<f64>() / n;
    assert!((mean - 1.0).abs() < 4.0 * deviation / n.sqrt(), "{mean}");
    let variance = factors.iter().map(|it| (it - mean).powi(2)).sum::<f64>() / n;
    // The kurtosis of this distribution is 3.77, so that the variance of the variance is 2.77 s^4/n.
    let error = variance / deviation.powi(2) - 1.0;
    assert!(error.abs() < 4.0 * (2.77 / n).sqrt(), "{error:e}");
    let weak = factors.iter().filter(|it| **it < 0.7).count() as f64 / n;
    // Gamma(1 + 1/12) = 0.95829: 1 - exp(-(0.7 Gamma)^12).
    let known = -(-(0.7f64 * 0.958_285_7).powi(12)).exp_m1();
    assert!(
        (weak - known).abs() < 4.0 * (known / n).sqrt(),
        "{weak} {known}"
    );
    let lag = factors.windows(2).map(|it| (it[0] - mean) * (it[1] - mean));
    let correlation = lag.sum::<f64>() / n / variance;
    assert!(correlation.abs() < 4.0 / n.sqrt(), "{correlation}");
}

/// Bits of some factors, as they were on the machine on which they were first made: they do not depend on machine, threads or the other
/// points, and must not change, or stored cases would be of other specimens. A calculation with NumPy and SciPy has the same to 1e-15.
#[test]
fn factors_are_the_same_everywhere() {
    let of = |correlation_length, distribution| Scatter {
        of: Scattered::Strength,
        distribution,
        seed: Some(2024),
        correlation_length,
    };
    let places = [[0.0, 0.0], [0.013, -0.2], [1.5, 2.5]];
    let weibull = Distribution::Weibull { modulus: 12.0 };
    let normal = Distribution::Normal { deviation: 0.1 };
    let found = [of(0.0, weibull), of(0.01, weibull), of(0.01, normal)].map(|it| {
        it.factors(&places, &Numbering::default())
            .at_points
            .iter()
            .map(|it| it.to_bits())
            .collect::<Vec<_>>()
    });
    let known: [[u64; 3]; 3] = [
        [0x3ff150d005dfa4f2, 0x3ff1c1a7517f681d, 0x3fee7509d52144e0],
        [0x3ff1f4ab234041ef, 0x3ff23d9e371acfbc, 0x3ff1127759187a5d],
        [0x3ff221c4e40a97a3, 0x3ff28ca40998dc9a, 0x3ff0f9e7303ce233],
    ];
    assert_eq!(found, known.map(|it| it.to_vec()), "{found:#x?}");
}
