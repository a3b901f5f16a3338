//! Motions between equilibria (`scheme = "auto"`) of a part that nothing resists before it meets another one.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament_analysis::driver::Outcome;
use verification::bench::solved;

/// Side of the cells, m.
const SIDE: f64 = 0.0123;
/// Duration, s.
const DURATION: f64 = 1e-3;

/// Block of 5 x 3 cells before one of 3 x 3 cells, whose far side is held, with a gap of a cell between them; in units of length, force and time.
fn blocks([length, force, time]: [f64; 3], load: &str) -> Outcome {
    let side = SIDE * length;
    let of =
        |value: f64, [l, f, t]: [i32; 3]| value * length.powi(l) * force.powi(f) * time.powi(t);
    let text = format!(
        r#"
analysis = "motion"
lattice = {{ cells = [9, 3], spacing = {side:?}, thickness = {thickness:?}, remove = [{{ rectangle = [[{from:?}, {low:?}], [{to:?}, {high:?}]] }}], set = {{ first = {{ left = 1 }}, last = {{ right = 1 }} }} }}
material = {{ young = {young:?}, poisson = 0.2, density = {density:?}, tensile_strength = {strength:?} }}
model = {{ law = "nhpd", horizon_factor = 2.0 }}
support = [{{ group = "last", displacement = {{ x = 0.0, y = 0.0 }} }}]
load = [{{ name = "push", group = "first", {load}, amplitude = {{ shape = "ramp", duration = {duration:?} }} }}]
contact = [{{}}]
motion = {{ duration = {duration:?}, rows = 8, scheme = "auto", step = {step:?} }}
fracture = {{ criterion = [{{ kind = "tension" }}] }}
"#,
        thickness = of(0.01, [1, 0, 0]),
        from = 5.0 * side,
        to = 6.0 * side,
        low = -side,
        high = 4.0 * side,
        young = of(1e10, [-2, 1, 0]),
        density = of(2500.0, [-4, 1, 2]),
        strength = of(2e6, [-2, 1, 0]),
        duration = of(DURATION, [0, 0, 1]),
        step = of(DURATION / 400.0, [0, 0, 1]),
    );
    solved(&text, &[]).outcome
}

/// Units of length, force and time, from 1e-5 to 4e2 times the first ones.
const UNITS: [[f64; 3]; 5] = [
    [1.0, 1.0, 1.0],
    [1e-3, 1.0, 1.7],
    [3.7, 1e-6, 1000.0],
    [1e-5, 1e4, 1e-2],
    [123.4, 77.0, 0.3],
];

/// A block that is led through half of the gap costs no work: it stays in equilibria, one from row to row, in any unit.
#[test]
fn a_part_that_is_led_stays_in_equilibria_in_any_unit() {
    for units in UNITS {
        let way = 0.5 * SIDE * units[0];
        let outcome = blocks(units, &format!("displacement = {{ x = {way:?} }}"));
        for row in &outcome.history {
            let motion = row.motion.unwrap();
            assert_eq!(motion.time_steps, row.step, "{units:?}");
            assert_eq!(motion.kinetic_energy, 0.0, "{units:?}");
        }
    }
}

/// A force F t/T on a block with the mass m that nothing resists gives it the velocity F t^2/(2 m T) from the start on, and not the displacement at
/// which the other block would resist it: the kinetic energy is F^2 t^4/(8 m T^2).
///
/// 1 % of it: what the waves of the ramp have, (transit/time)^2 = (30 us/500 us)^2 = 0.4 % at the row that is looked at, and less at the last.
#[test]
fn a_part_under_a_force_moves_in_any_unit() {
    let mass = 2500.0 * 0.01 * 15.0 * SIDE * SIDE;
    let force = 500.0;
    for units in UNITS {
        let given = force * units[1];
        let outcome = blocks(units, &format!("force = {{ x = {given:?} }}"));
        for row in &outcome.history[4..] {
            let time = row.load_factor / units[2];
            let expected = (force / DURATION).powi(2) * time.powi(4) / (8.0 * mass);
            let found = row.motion.unwrap().kinetic_energy / (units[0] * units[1]);
            println!("{units:?}, {time:.2e} s: {found:.6} J for {expected:.6} J");
            assert!((found / expected - 1.0).abs() < 0.01, "{found} {expected}");
            assert!(row.energy_error().abs() < 1e-9, "{units:?}");
        }
    }
}
