//! Energy release rate and stress intensity factors at tips of pre-cracks against handbooks, and openings of pre-cracks.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use ligament_analysis::Component;
use ligament_post::crack::openings;
use verification::bench::{Bench, error_of};

const YOUNG: f64 = 70e9;

/// Spacing of the lattices, m.
const SPACING: f64 = 1e-3;

/// Stress on the ends of the plates, Pa.
const STRESS: f64 = 1e6;

/// A plate of cells with a horizon of three spacings, drawn along y, and a pre-crack.
fn plate(cells: [usize; 2], corner: [f64; 2], crack: [[f64; 2]; 2]) -> String {
    format!(
        r#"
[lattice]
cells = {cells:?}
spacing = {SPACING}
corner = {corner:?}
thickness = 0.01
[lattice.set]
bottom = {{ bottom = 1 }}
top = {{ top = 1 }}
[material]
young = {YOUNG:?}
poisson = 0.2
[model]
law = "nhpd"
horizon_factor = 3.0
[correction]
surface = "patch"
[[precrack]]
points = {crack:?}
[[load]]
group = "top"
force_per_length = {{ y = {:?} }}
[[load]]
group = "bottom"
force_per_length = {{ y = {:?} }}
"#,
        0.01 * STRESS,
        -0.01 * STRESS
    )
}

/// Probes of J, K_I and K_II at a tip over rings of some radii.
fn probes(tip: [f64; 2], rings: &[[f64; 2]]) -> String {
    let mut text = String::new();
    for (number, radii) in rings.iter().enumerate() {
        for quantity in ["J", "K_I", "K_II"] {
            text += &format!(
                "[[probe]]\nname = \"{number}.{quantity} at {}\"\ntip = {tip:?}\nquantity = \"{quantity}\"\nradii = {radii:?}\n",
                tip[0]
            );
        }
    }
    text
}

/// J, K_I and K_II of the rings of a case.
fn solved(text: &str) -> Vec<[f64; 3]> {
    let run = Bench::new(text, &[]).solve();
    let probes = &run.last().probes;
    probes
        .chunks_exact(3)
        .map(|it| [it[0], it[1], it[2]])
        .collect()
}

/// A crack in the middle of a plate, a/h = 20, a/W = 0.4: K_I = sigma sqrt(pi a) F, F = (1 - 0.025 x^2 + 0.06 x^4) sqrt(sec(pi x/2)), x = a/W,
/// to 0.1 % (Tada 2000, section 2.1), and J = K_I^2/E, whatever the ring outside of two horizons from the tip. 2 % is what is asked
/// for at a/h = 20; rings agree to 0.5 %.
#[test]
fn a_central_crack_has_its_intensity_over_any_ring() {
    let (a, half_width) = (0.02_f64, 0.05);
    let crack = [[-a, 0.0], [a, 0.0]];
    let rings = [[6e-3, 12e-3], [9e-3, 15e-3], [6e-3, 18e-3]];
    let text = plate([100, 200], [-half_width, -0.1], crack);
    let x = a / half_width;
    let factor = (1.0 - 0.025 * x.powi(2) + 0.06 * x.powi(4)) / (0.5 * PI * x).cos().sqrt();
    let opening = STRESS * (PI * a).sqrt() * factor;
    let found = solved(&(text + &probes([a, 0.0], &rings) + &probes([-a, 0.0], &rings)));
    for [release, first, second] in &found {
        assert!((first / opening - 1.0).abs() < 0.02, "{first} {opening}");
        let expected = opening * opening / YOUNG;
        assert!(
            (release / expected - 1.0).abs() < 0.02,
            "{release} {expected}"
        );
        assert!(second.abs() < 1e-3 * opening, "{second}");
        assert!((release / found[0][0] - 1.0).abs() < 5e-3, "{found:?}");
        assert!((first / found[0][1] - 1.0).abs() < 5e-3, "{found:?}");
    }
}

/// A crack from the side of a plate, a/h = 20, a/W = 0.4: K_I = sigma sqrt(pi a) (1.122 - 0.231 x + 10.55 x^2 - 21.71 x^3 + 30.382 x^4), to
/// 0.5 % (Tada 2000, section 2.10).
#[test]
fn an_edge_crack_has_its_intensity() {
    let (a, width) = (0.02_f64, 0.05);
    let text = plate([50, 150], [0.0, -0.075], [[-0.01, 0.0], [a, 0.0]]);
    let x: f64 = a / width;
    let factor = 1.122 - 0.231 * x + 10.55 * x.powi(2) - 21.71 * x.powi(3) + 30.382 * x.powi(4);
    let expected = STRESS * (PI * a).sqrt() * factor;
    let found = solved(&(text + &probes([a, 0.0], &[[6e-3, 12e-3]])));
    let [release, first, second] = found[0];
    assert!((first / expected - 1.0).abs() < 0.02, "{first} {expected}");
    let by_intensity = (first * first + second * second) / YOUNG;
    assert!((release / by_intensity - 1.0).abs() < 0.02, "{release}");
}

/// A crack of a/h = 10 at 30 degrees to the sides of a square plate of 2W = 20 a: K_I = sigma sqrt(pi a) sin^2 F and K_II = sigma sqrt(pi a) sin
/// cos F of the angle to the load (Tada 2000, section 5.1) with F = 1.014 for the size of the plate (Isida 1971). Rows of
/// cells step across the crack, so that at a/h = 10 K_II is 2.5 % too large, and J 3.5 % more than both give.
#[test]
fn an_inclined_crack_opens_and_slides() {
    let (a, angle) = (0.01_f64, PI / 6.0);
    let tip = [a * angle.cos(), a * angle.sin()];
    let other = tip.map(|it| -it);
    let text = plate([200, 200], [-0.1, -0.1], [other, tip]);
    let rings = [[6e-3, 12e-3]];
    let whole = STRESS * (PI * a).sqrt() * 1.014;
    let expected = [angle.cos().powi(2), angle.cos() * angle.sin()].map(|it| it * whole);
    for [release, first, second] in solved(&(text + &probes(tip, &rings) + &probes(other, &rings)))
    {
        assert!(
            (first / expected[0] - 1.0).abs() < 0.015,
            "{first} {expected:?}"
        );
        assert!(
            (second / expected[1] - 1.0).abs() < 0.035,
            "{second} {expected:?}"
        );
        let by_intensities = (first * first + second * second) / YOUNG;
        assert!((release / by_intensities - 1.0).abs() < 0.04, "{release}");
    }
}

/// A double cantilever with arms of H = 20 spacings and a = 60: K_I = P a/(B H^(3/2)) (3.46 + 2.38 H/a) for forces P at the ends (Gross and
/// Srawley 1966). 2 % for K_I and, as its square, 4 % for J.
#[test]
fn a_double_cantilever_has_its_intensity() {
    let (arm, crack, force) = (0.02_f64, 0.06, 100.0);
    let text = format!(
        r#"
[lattice]
cells = [140, 40]
spacing = {SPACING}
corner = [0.0, -0.02]
thickness = 0.01
[material]
young = {YOUNG:?}
poisson = 0.2
[model]
law = "nhpd"
horizon_factor = 3.0
[correction]
surface = "patch"
[[precrack]]
points = [[-0.01, 0.0], [{crack}, 0.0]]
[[load]]
at = [0.0005, 0.0105]
force = {{ y = {force:?} }}
[[load]]
at = [0.0005, -0.0105]
force = {{ y = -{force:?} }}
"#
    );
    let expected = force * crack / (0.01 * arm.powf(1.5)) * (3.46 + 2.38 * arm / crack);
    let found = solved(&(text + &probes([crack, 0.0], &[[6e-3, 12e-3], [6e-3, 18e-3]])));
    for [release, first, second] in found {
        assert!((first / expected - 1.0).abs() < 0.02, "{first} {expected}");
        assert!(second.abs() < 1e-3 * expected, "{second}");
        let by_intensity = expected * expected / YOUNG;
        assert!((release / by_intensity - 1.0).abs() < 0.04, "{release}");
    }
}

/// A force on all of the volume acts within the ring too: with it J and K_I are the same over rings of different size, to 1 %. Without the work of
/// the forces they would differ by some per cent.
#[test]
fn forces_within_the_ring_count() {
    let a = 0.03;
    let text = plate([60, 60], [0.0, -0.03], [[-0.01, 0.0], [a, 0.0]]);
    let forces = "[[support]]\nbox = [[0.055, -0.03], [0.06, 0.03]]\ndisplacement = { x = 0.0, y = 0.0 }\n\
        [[load]]\nname = \"pull\"\nbox = [[0.0, 0.0], [0.055, 0.03]]\nbody_force = { y = 1e8 }\n\
        [[load]]\nname = \"push\"\nbox = [[0.0, -0.03], [0.055, 0.0]]\nbody_force = { y = -1e8 }\n";
    let rings = [[6e-3, 12e-3], [9e-3, 24e-3]];
    let found = solved(&(text + forces + &probes([a, 0.0], &rings)));
    for quantity in 0..2 {
        let [small, large] = [0, 1].map(|ring: usize| found[ring][quantity]);
        assert!((large / small - 1.0).abs() < 0.01, "{found:?}");
    }
}

/// What the integral around a tip does not hold for is refused with what to do about it.
#[test]
fn tips_are_refused_where_nothing_can_be_read() {
    let text = plate([40, 40], [-0.02, -0.02], [[-0.01, 0.0], [0.01, 0.0]]);
    let at = |tip, radii| text.clone() + &probes(tip, &[radii]);
    let refused = [
        (at([0.01, 0.0], [3e-3, 19e-3]), "leaves the body"),
        (at([0.01, 0.0], [3e-3, 25e-3]), "the pre-crack is shorter"),
        (at([0.015, 0.0], [3e-3, 6e-3]), "no pre-crack ends at"),
        (at([0.01, 0.0], [6e-3, 3e-3]), "larger outer one"),
        (
            at([0.01, 0.0], [3e-3, 6e-3]) + "[[temperature]]\nchange = 10.0\n",
            "without strains by temperature",
        ),
        (
            at([0.01, 0.0], [3e-3, 6e-3])
                + "[[precrack]]\npoints = [[0.012, -0.01], [0.012, 0.01]]\n",
            "another pre-crack",
        ),
    ];
    for (case, expected) in refused {
        let error = error_of(
            &case.replace("poisson = 0.2", "poisson = 0.2\nthermal_expansion = 1e-5"),
            &[],
        );
        assert!(error.contains(expected), "{error}");
    }
}

/// The central crack of a/h = 20 in a plate of a/W = 0.4 opens as an ellipse with 4 sigma a V/E in its middle, V = 1.111 for the width (Tada 2000, section 2.1): to 1.5 % of that from four spacings off the tips on, to 4 % nearer.
#[test]
fn a_central_crack_opens_as_an_ellipse() {
    let a: f64 = 0.02;
    let text = plate([100, 200], [-0.05, -0.1], [[-a, 0.0], [a, 0.0]]);
    let bench = Bench::new(&text, &[]);
    let run = bench.solve();
    let layout = bench.model.plane().topology().layout;
    let moved = |point: u32| {
        [Component::X, Component::Y].map(|axis| layout.value(point, axis, run.displacement()))
    };
    let points = bench.positions();
    let displacements: Vec<[f64; 2]> = (0..points.len() as u32).map(moved).collect();
    let x: f64 = 0.4;
    // V = -0.071 - 0.535 x + 0.169 x^2 + 0.020 x^3 - 1.071/x ln(1 - x).
    let width =
        -0.071 - 0.535 * x + 0.169 * x.powi(2) + 0.02 * x.powi(3) - 1.071 / x * (1.0 - x).ln();
    let middle = 4.0 * STRESS * a / YOUNG * width;
    let found = openings([points, &displacements], [[a, 0.0], [-a, 0.0]], 41, 3e-3);
    for it in &found[1..40] {
        let expected = middle * (1.0 - (it.place[0] / a).powi(2)).sqrt();
        let [opening, sliding] = it.jump.unwrap();
        let near = it.along.min(2.0 * a - it.along) < 3.5e-3;
        let allowed = if near { 0.04 } else { 0.015 } * middle;
        assert!((opening - expected).abs() < allowed, "{it:?} {expected}");
        assert!(sliding.abs() < 1e-3 * middle, "{it:?}");
    }
}
