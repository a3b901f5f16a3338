//! Energy release rate and stress intensity factors at the tips of growing cracks against a handbook.
#![allow(clippy::unwrap_used)]

use verification::bench::Bench;

const YOUNG: f64 = 70e9;

/// Fracture energy, J/m^2.
const FRACTURE_ENERGY: f64 = 20.0;

/// Thickness, height of an arm, and length of the crack at first, m.
const CANTILEVER: [f64; 3] = [0.01, 0.02, 0.03];

/// A double cantilever with arms of H = 20 spacings whose ends are pulled apart: the crack grows along its middle.
fn double_cantilever(bonds: usize) -> String {
    let mut text = format!(
        r#"
[lattice]
cells = [140, 40]
spacing = 1e-3
corner = [0.0, -0.02]
thickness = 0.01
[material]
young = {YOUNG:?}
poisson = 0.2
fracture_energy = {FRACTURE_ENERGY:?}
[model]
law = "nhpd"
horizon_factor = 3.0
[correction]
surface = "patch"
[[precrack]]
points = [[-0.01, 0.0], [0.03, 0.0]]
[[support]]
at = [0.0005, -0.0105]
displacement = {{ x = 0.0, y = 0.0 }}
[[support]]
at = [0.0005, 0.0105]
displacement = {{ x = 0.0 }}
[[load]]
at = [0.0005, 0.0105]
displacement = {{ y = 1e-3 }}
[fracture]
control = "event"
stop = {{ bonds = {bonds} }}
[[fracture.criterion]]
kind = "bond-energy"
[[no_fail]]
box = [[-1.0, -1.0], [0.01, 1.0]]
"#
    );
    for quantity in ["J", "K_I", "K_II", "advance"] {
        text += &format!(
            "[[probe]]\nname = \"{quantity}\"\ntip = [0.03, 0.0]\nquantity = \"{quantity}\"\nradii = [6e-3, 12e-3]\ngrowing = true\n"
        );
    }
    text
}

/// While the crack of a double cantilever grows by half of its length, K_I = P a/(B H^(3/2)) (3.46 + 2.38 H/a) (Gross and Srawley 1966) for the
/// load P and the present length a, and J = K_I^2/E: 3 % for J, and 5 % for K_I, which depends on the place of the tip, found to one spacing. Bonds break from J = G_c
/// on; a lattice holds the crack until its next bonds break, up to 1.4 G_c.
#[test]
fn the_ring_follows_a_growing_crack() {
    let bench = Bench::new(&double_cantilever(250), &[]);
    let run = bench.break_up();
    let [thickness, arm, first] = CANTILEVER;
    let mut smallest = f64::INFINITY;
    let mut longest = 0.0_f64;
    for step in run.outcome.history.iter().filter(|it| it.load_factor > 0.0) {
        let [release, opening, sliding, advance] = step.probes[..] else {
            panic!("four probes");
        };
        let length = first + advance;
        let shape = 3.46 + 2.38 * arm / length;
        let expected = step.reaction.abs() * length / (thickness * arm.powf(1.5)) * shape;
        let by_load = expected * expected / YOUNG;
        assert!(
            (release / by_load - 1.0).abs() < 0.03,
            "{advance} {release} {by_load}"
        );
        assert!(
            (opening / expected - 1.0).abs() < 0.05,
            "{advance} {opening} {expected}"
        );
        assert!(sliding.abs() < 0.02 * expected, "{advance} {sliding}");
        assert!(release < 1.4 * FRACTURE_ENERGY, "{advance} {release}");
        longest = longest.max(advance);
        if advance > 0.002 {
            smallest = f64::min(smallest, release);
        }
    }
    assert!(
        (smallest / FRACTURE_ENERGY - 1.0).abs() < 0.05,
        "{smallest}"
    );
    assert!(longest > 0.4 * first, "{longest}");
}
