//! Waves in bars and plates against d'Alembert's solution.
#![allow(clippy::unwrap_used)]

use std::f64::consts::TAU;

use ligament::run::NoObserver;
use ligament_analysis::driver::Outcome;
use ligament_analysis::history::StepRecord;
use ligament_case::case::CaseFile;
use verification::repository;

/// Period of the pulse of the case, s.
const PERIOD: f64 = 10e-6;

/// Amplitude of the pulse, m/s.
const SPEED: f64 = 2.0;

/// Speed of waves in a thin bar, sqrt(E/rho), m/s.
const BAR: f64 = 5172.2;

fn run(settings: &[&str]) -> Outcome {
    let path = repository().join("cases/wave-bar/case.toml");
    let settings: Vec<String> = settings.iter().map(|&it| it.to_owned()).collect();
    let case = CaseFile::load(&path, &settings).unwrap();
    let setup = case.setup(&mut ()).unwrap();
    setup.solve(&mut NoObserver).unwrap().outcome
}

/// Time at which a probe has its largest value before a time, and the value.
fn peak(history: &[StepRecord], probe: usize, before: f64) -> [f64; 2] {
    let rows = history.iter().filter(|row| row.load_factor < before);
    let values = rows.map(|row| [row.load_factor, row.probes[probe]]);
    values.fold([0.0; 2], |most, it| if it[1] > most[1] { it } else { most })
}

/// Time at which the velocity at a probe falls through zero after its largest value before a time, between rows by a straight line.
fn turn(history: &[StepRecord], probe: usize, before: f64) -> f64 {
    let [from, _] = peak(history, probe, before);
    let pairs = history.windows(2).filter(|it| it[0].load_factor >= from);
    let mut values =
        pairs.map(|it| [&it[0], &it[1]].map(|row| [row.load_factor, row.probes[probe]]));
    let falls = values.find(|[one, other]| one[1] > 0.0 && other[1] <= 0.0);
    let [[start, high], [end, low]] = falls.unwrap();
    start + (end - start) * high / (high - low)
}

/// The middle of the pulse runs with the speed of a bar from the quarter to the middle and to the end: long waves have that of the modulus,
/// which the patch correction makes exact. The pulse begins with a kink, whose short waves add some
/// per cent to its largest values. At the free end points move twice as fast.
#[test]
fn a_pulse_runs_along_a_bar_and_is_doubled_at_its_free_end() {
    let outcome = run(&["motion.rows=1600"]);
    let history = &outcome.history;
    let [quarter, middle, end] = [0, 1, 2].map(|probe| turn(history, probe, 45e-6));
    for (speed, tolerance) in [
        // Ripples of the kinks move the turns by some tenths of a spacing, a hundredth of this way.
        (0.05 / (middle - quarter), 6e-3),
        // The last points have fewer bonds than those within.
        (0.09975 / (end - middle), 1e-2),
    ] {
        assert!((speed / BAR - 1.0_f64).abs() < tolerance, "{speed}");
    }
    let [middle, end] = [1, 2].map(|probe| peak(history, probe, 45e-6)[1]);
    assert!((middle / SPEED - 1.0).abs() < 0.03, "{middle}");
    assert!((end / (2.0 * SPEED) - 1.0).abs() < 0.05, "{end}");
    // Work of the end: rho A v^2 c T/2, half kinetic and half stored.
    let expected = 7850.0 * 4e-6 * SPEED.powi(2) * BAR * PERIOD / 2.0;
    let last = history.last().unwrap();
    assert!(
        (last.external_work / expected - 1.0).abs() < 2e-3,
        "{}",
        last.external_work
    );
    assert!(last.energy_error().abs() < 1e-10, "{}", last.energy_error());
    // After a pulse with the mean zero the end is where it began.
    assert!(last.displacement.abs() < 1e-12 * SPEED * PERIOD / TAU);
}

/// The impedance of a quiet edge is rho c_P, that of a thin bar rho c: of the pulse (c_P - c)/(c_P + c) comes back, 1.6 % for nu = 1/4, and of
/// its energy the square.
#[test]
fn a_quiet_edge_lets_a_pulse_out() {
    let outcome = run(&["quiet=[{group=\"right\"}]"]);
    let work = outcome.history.last().unwrap().external_work;
    let last = outcome.history.last().unwrap();
    let motion = last.motion.unwrap();
    let rest = (motion.kinetic_energy + last.stored_energy) / work;
    assert!(rest < 1e-3, "{rest}");
    assert!(last.energy_error().abs() < 1e-8, "{}", last.energy_error());
}
