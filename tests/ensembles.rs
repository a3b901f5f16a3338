//! Ensembles: samples against runs of their own, against the theory of the weakest link, and against the closed forms of their distributions.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;

use ligament::ensemble::{Ensemble, Sample};
use ligament::prelude::*;
use ligament::run::NoObserver;
use ligament_mesh::Numbering;
use ligament_model::failure::stretch::TENSION;
use ligament_model::scatter::{Distribution, Scatter, Scattered};
use ligament_post::statistics::WeibullFit;
use verification::bench::Bench;
use verification::numbers::relative_error;

/// A bar of 24 x 8 cells whose ends do not break.
const BAR: &str = r#"
lattice = { cells = [24, 8], spacing = 0.001, thickness = 0.01, set = { left = { left = 3 }, right = { right = 3 } } }
material = { young = 30e9, poisson = 0.2, tensile_strength = 3e6, fracture_energy = 20.0 }
model = { law = "mppd", horizon_factor = 3.0 }
support = [{ group = "left", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "right", displacement = { x = 1e-4 } }]
no_fail = [{ group = "left" }, { group = "right" }]
"#;

/// What a sample gives: all bits of its history and of its last state.
fn digest(outcome: &ligament_analysis::driver::Outcome) -> (Vec<[u64; 3]>, Vec<bool>, Vec<u64>) {
    let history = outcome.history.iter();
    let bits = |value: f64| value.to_bits();
    (
        history
            .map(|it| [it.displacement, it.reaction, it.stored_energy].map(bits))
            .collect(),
        outcome.state.intact.clone(),
        outcome
            .state
            .displacement
            .iter()
            .copied()
            .map(bits)
            .collect(),
    )
}

/// Sample k has the bits of the setup that is solved alone with its seed: along the exact path, in load steps with softening, of one random
/// property and of two, and with an
/// iterative solver, which shares no factor. The order in which samples are computed does not matter, nor what broke before.
#[test]
fn a_sample_is_the_run_of_its_seed() {
    let strength = "scatter = { of = \"strength\", modulus = 8.0, correlation_length = 0.004 }";
    let energy =
        "scatter = { of = \"fracture-energy\", distribution = \"lognormal\", deviation = 0.4 }";
    let event =
        "control = \"event\", stop = { load_fraction = 0.5 }, criterion = [{ kind = \"tension\" }]";
    let soft = "steps = 6, criterion = [{ kind = \"tension\", after = \"exponential\" }]";
    let both = "scatter = [{ of = \"strength\", modulus = 8.0, correlation_length = 0.004 }, { of = \"fracture-energy\", modulus = 9.0 }]";
    for (fracture, solver) in [
        (format!("fracture={{ {event}, {strength} }}"), ""),
        (format!("fracture={{ {soft}, {both} }}"), ""),
        (format!("fracture={{ {soft}, {energy} }}"), ""),
        (
            format!("fracture={{ {event}, {strength} }}"),
            "solver={ method = \"iterative\" }",
        ),
    ] {
        let settings = [fracture.as_str(), solver];
        let used = if solver.is_empty() { 1 } else { 2 };
        let bench = Bench::new(BAR, &settings[..used]);
        let setup = bench.model.setup.clone();
        let ensemble = Ensemble::new(bench.model, 11).unwrap();
        for number in [3, 0] {
            let sample = ensemble.sample(number).unwrap();
            assert_eq!(sample.seed, ensemble.seed_of(number));
            assert!(sample.path.outcome.broken_bonds > 0);
            let mut alone = setup.clone();
            alone.scatter[0].seed = Some(sample.seed);
            let alone = alone.solve(&mut NoObserver).unwrap();
            assert_eq!(digest(&sample.path.outcome), digest(&alone.outcome));
            assert_eq!(sample.path.outcome.first_break, alone.outcome.first_break);
        }
    }
}

/// Bars beside each other, so far apart that their strengths have nothing in common, and each so short that it has one strength.
fn bars(n: u32, modulus: f64) -> Setup {
    const COLUMNS: u32 = 6;
    const ROWS: u32 = 3;
    const SPACING: f64 = 1e-3;
    const DISTANCE: f64 = 4.0;
    let bar_constants = COLUMNS * ROWS;
    let position = |k: u32| {
        let (bar, column, row) = (k / bar_constants, k % COLUMNS, k / COLUMNS % ROWS);
        [
            SPACING * f64::from(column),
            DISTANCE * f64::from(bar) + SPACING * f64::from(row),
        ]
    };
    let all = || 0..n * bar_constants;
    let points = Points::new(
        all().map(position).collect(),
        vec![SPACING * SPACING; all().len()],
    );
    let points = points
        .unwrap()
        .with_group("left", all().filter(|k| k % COLUMNS == 0))
        .unwrap()
        .with_group("right", all().filter(|k| k % COLUMNS == COLUMNS - 1))
        .unwrap();
    let mut setup = Setup::new(points, Material::isotropic(30e9, 0.2), Law::MPPD);
    setup.supports = vec![Support::new("left", &[Component::X, Component::Y])];
    let pull = Displacement {
        x: Some(1e-5),
        ..Displacement::default()
    };
    setup.loads = vec![Load::new("right", Action::Displacement(pull))];
    setup.criteria = vec![Choice {
        limit: Some(1e-4),
        ..TENSION.into()
    }];
    let mut settings = event();
    settings.stop.bonds = Some(1);
    setup.analysis = Analysis::Event(settings);
    setup.scatter = vec![Scatter {
        of: Scattered::Strength,
        distribution: Distribution::Weibull { modulus },
        seed: None,
        correlation_length: 1.0,
    }];
    setup
}

/// Loads at the first breakage of samples over that of the body without random factors.
fn strengths(n_bars: u32, modulus: f64, n_samples: u64) -> Vec<f64> {
    let model = Model::build(bars(n_bars, modulus), &mut ()).unwrap();
    let ensemble = Ensemble::new(model, 5).unwrap();
    let sound = ensemble.sound().unwrap().first[0].reaction;
    let mut found = BTreeMap::new();
    let numbers: Vec<u64> = (0..n_samples).collect();
    let add = |sample: Sample| {
        found.insert(sample.number, sample.path.first[0].reaction / sound);
        Ok::<_, Error>(())
    };
    ensemble.for_each(&numbers, [2, 1], add).unwrap();
    assert_eq!(found.len() as u64, n_samples);
    found.into_values().collect()
}

/// The weakest of n links with Weibull strengths has a Weibull strength of the same modulus and of the mean n^(-1/m) (Weibull 1951). Links
/// are 4 correlation lengths apart (exp(-16) = 1e-7), and vary by less than 1 % of a deviation inside. Four standard deviations of the mean
/// of K samples, Gamma(1 + 2/m)/Gamma(1 + 1/m)^2 - 1 of its square over K, and of the fitted modulus, 0.78/sqrt(K).
#[test]
fn the_weakest_link_is_that_of_weibull() {
    let (modulus, n_samples) = (6.0, 500);
    let deviation = Distribution::Weibull { modulus }.deviation();
    let root = (n_samples as f64).sqrt();
    for n_bars in [1, 8] {
        let strengths = strengths(n_bars, modulus, n_samples);
        let mean = strengths.iter().sum::<f64>() / n_samples as f64;
        let known = f64::from(n_bars).powf(-1.0 / modulus);
        assert!(
            relative_error(mean, known) < 4.0 * deviation / root,
            "{n_bars}: {mean} {known}"
        );
        let fit = WeibullFit::through(&strengths).unwrap();
        assert!(
            relative_error(fit.modulus, modulus) < 4.0 * 0.78 / root,
            "{n_bars}: {fit:?}"
        );
        let [low, high] = fit.modulus_within(4.0);
        assert!(low < modulus && modulus < high);
    }
}

/// Lognormal factors exp(s z - s^2/2) of normal numbers z with the correlation r have the correlation (exp(s^2 r) - 1)/(exp(s^2) - 1), and
/// ln f has the mean -s^2/2 and the deviation s with s^2 = ln(1 + c^2) (Aitchison and Brown 1957). Over 4,000 seeds, four deviations of each
/// estimate; the correlation of heavy tails within 0.06, four deviations of a product of two factors of this distribution with kurtosis 5.
#[test]
fn lognormal_fields_have_their_correlation() {
    let (deviation, length, n) = (0.3, 0.02, 4000);
    let at = |seed: u64| {
        let scatter = Scatter {
            of: Scattered::FractureEnergy,
            distribution: Distribution::Lognormal { deviation },
            seed: Some(ligament_model::scatter::seed_of_sample(1, seed)),
            correlation_length: length,
        };
        let places = [[0.1, 0.2], [0.1 + 0.6 * length, 0.2 - 0.5 * length]];
        let factors = scatter.factors(&places, &Numbering::default()).at_points;
        [factors[0], factors[1]]
    };
    let pairs: Vec<[f64; 2]> = (0..n).map(at).collect();
    let mean = |of: &dyn Fn(&[f64; 2]) -> f64| pairs.iter().map(of).sum::<f64>() / n as f64;
    let variance = (1.0 + deviation * deviation).ln();
    let root = (n as f64).sqrt();
    let of_log = mean(&|it| it[0].ln());
    assert!((of_log + 0.5 * variance).abs() < 4.0 * variance.sqrt() / root);
    let spread = mean(&|it| (it[0].ln() - of_log).powi(2));
    assert!(relative_error(spread, variance) < 4.0 * 2f64.sqrt() / root);
    assert!((mean(&|it| it[1]) - 1.0).abs() < 4.0 * deviation / root);
    let product = mean(&|it| (it[0] - 1.0) * (it[1] - 1.0));
    let found = product / (deviation * deviation);
    let normal = (-(0.6f64 * 0.6 + 0.5 * 0.5)).exp();
    let known = (variance * normal).exp_m1() / variance.exp_m1();
    assert!((found - known).abs() < 0.06 + 1e-3, "{found} {known}");
}

/// What an ensemble cannot be made of is told with its field.
#[test]
fn what_has_no_samples_is_refused() {
    let scatter = "scatter = { of = \"strength\", modulus = 8.0 }";
    for (fracture, words) in [
        (
            "fracture={ control = \"event\", criterion = [{ kind = \"tension\" }] }".to_owned(),
            "varies at random",
        ),
        (
            format!(
                "fracture={{ steps = 2, stop = {{ wall_time = 9.0 }}, criterion = [{{ kind = \"tension\" }}], {scatter} }}"
            ),
            "time that they take",
        ),
    ] {
        let bench = Bench::new(BAR, &[&fracture]);
        let error = Ensemble::new(bench.model, 1).err().unwrap().to_string();
        assert!(error.contains(words), "{error}");
    }
}
