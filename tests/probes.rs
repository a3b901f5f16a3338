//! Probes read their places, between points too, and never across a crack that is there from the start.
#![allow(clippy::unwrap_used)]

use ligament_analysis::probe::Reading;
use verification::bench::Bench;
use verification::numbers::relative_error;

/// Plate 0.2 x 0.1 m, 2 cm thick, of 1543 irregular points.
const PLATE: &str = r#"
mesh = { file = "../meshes/plate.msh", thickness = 0.02 }
material = { young = 15e9, poisson = 0.21 }
model = { law = "nhpd", horizon_factor = 3.0 }
"#;

/// A bar of 80 irregular points under uniform strain by the patch correction: a gauge between any two places reads the strain times their
/// distance, a probe its share of the motion, on the sides of the body too. 4e-3 is what the correction leaves on so few points; the points
/// nearest to the places are 6 to 10 % off.
#[test]
fn probes_read_their_places() {
    let (length, end) = (0.2, 1e-5);
    let gauges = [
        [[0.031, 0.047], [0.117, 0.047]],
        [[0.013, 0.0], [0.163, 0.0]],
        [[0.0, 0.02], [0.2, 0.08]],
    ];
    let mut text = "
mesh = { file = \"../meshes/plate-coarse.msh\", thickness = 0.02 }
material = { young = 15e9, poisson = 0.21 }
model = { law = \"nhpd\", horizon_factor = 3.0 }
correction = { surface = \"patch\" }
support = [{ group = \"left\", displacement = { x = 0.0 } }, { group = \"corner\", displacement = { y = 0.0 } }]
load = [{ group = \"right\", displacement = { x = 1e-5 } }]
"
    .to_owned();
    for (number, [first, second]) in gauges.iter().enumerate() {
        text += &format!(
            "[[probe]]\nname = \"gauge-{number}\"\nbetween = [{first:?}, {second:?}]\ncomponent = \"x\"\n"
        );
    }
    text += "[[probe]]\nname = \"across\"\nat = [0.0911, 0.0333]\nfield = \"displacement.x\"\n";
    let bench = Bench::new(&text, &[]);
    let run = bench.solve();
    let expected = gauges.map(|[first, second]| (second[0] - first[0]) * end / length);
    let expected = expected.into_iter().chain([0.0911 * end / length]);
    for (found, expected) in run.last().probes.iter().zip(expected) {
        assert!(
            relative_error(*found, expected) < 4e-3,
            "{found:e} for {expected:e}"
        );
    }
    // What a probe is of the motions of all points is what it reads: openings that are controlled go by it.
    let layout = bench.model.plane().topology().layout;
    for (probe, found) in bench.problem().probes.iter().zip(&run.last().probes) {
        let weights = probe.reading.weights(layout).unwrap();
        let sum: f64 = weights
            .iter()
            .map(|(dof, weight)| weight * run.displacement()[*dof as usize])
            .sum();
        assert!(relative_error(sum, *found) < 1e-12);
    }
}

/// Places on both sides of a pre-crack are read at points of their own sides, and one of its mouth opens by what the two sides differ.
#[test]
fn probes_do_not_reach_across_pre_cracks() {
    let text = format!(
        "{PLATE}{}",
        "support = [{ group = \"left\", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = \"right\", displacement = { x = 1e-5 } }]
precrack = [{ points = [[0.1, -0.01], [0.1, 0.05]] }]
probe = [{ name = \"mouth\", between = [[0.0999, 0.02], [0.1001, 0.02]], component = \"x\" }]
"
    );
    let bench = Bench::new(&text, &[]);
    let problem = bench.problem();
    let Reading::RelativeDisplacement { places, .. } = &problem.probes[0].reading else {
        panic!("another reading")
    };
    for (place, side) in places.iter().zip([-1.0, 1.0]) {
        let [(point, share)] = place[..] else {
            panic!("{place:?}")
        };
        let x = bench.positions()[point as usize][0];
        assert!(
            share == 1.0 && side * (x - 0.1) > 0.0,
            "{x} at the side {side}"
        );
    }
    assert!(bench.solve().last().probes[0] > 1e-6);
}

/// A bar under the uniform strain 1e-3 along x by the patch correction: means over a side and over the whole bar are its strains and its
/// stress, the forces on its sides are the columns of the history, and that on the whole bar is zero. 1e-2 is what the correction leaves on a bar of 80
/// points at single sides.
#[test]
fn means_over_groups_are_those_of_a_uniform_strain() {
    let mut text = "
mesh = { file = \"../meshes/plate-coarse.msh\", thickness = 0.02 }
material = { young = 15e9, poisson = 0.21 }
model = { law = \"nhpd\", horizon_factor = 3.0 }
correction = { surface = \"patch\" }
support = [{ group = \"left\", displacement = { x = 0.0 } }, { group = \"corner\", displacement = { y = 0.0 } }]
load = [{ group = \"right\", displacement = { x = 2e-4 } }]
"
    .to_owned();
    let means = [
        ("top", "strain.xx", 1e-3),
        ("plate", "strain.xx", 1e-3),
        ("plate", "strain.yy", -0.21e-3),
        ("plate", "stress.xx", 15e6),
        ("right", "displacement.x", 2e-4),
        ("plate", "displacement.x", 1e-4),
    ];
    for (number, (group, field, _)) in means.iter().enumerate() {
        text +=
            &format!("[[probe]]\nname = \"{number}\"\ngroup = \"{group}\"\nfield = \"{field}\"\n");
    }
    for group in ["right", "left", "plate"] {
        text += &format!("[[probe]]\nname = \"{group}\"\ngroup = \"{group}\"\ncomponent = \"x\"\n");
    }
    let run = Bench::new(&text, &[]).solve();
    let last = run.last();
    for ((group, field, expected), found) in means.iter().zip(&last.probes) {
        let error = relative_error(*found, *expected);
        assert!(
            error < 1e-2,
            "{field} of {group}: {found:e} for {expected:e}"
        );
    }
    let [right, left, whole] = last.probes[means.len()..] else {
        panic!("{:?}", last.probes)
    };
    assert!(relative_error(right, last.reaction) < 1e-12);
    assert!(relative_error(-left, last.reaction) < 1e-8);
    assert!(whole.abs() < 1e-8 * right);
}
