//! A body that is its own mirror image moves, and breaks, like one.

use ligament::prelude::*;
use verification::numbers::{Random, largest, short};

use super::answer::Answer;
use super::image::Image;
use super::invariance::{ROUNDING, analysis, criteria};
use super::specimen::Specimen;

/// The bottom is held and the top moved.
fn moved(specimen: &Specimen, [x, y]: [f64; 2]) -> Setup {
    let mut setup = specimen.free(&Image::SAME);
    let far = specimen.strain * specimen.size()[1];
    setup.supports = vec![Support::new("bottom", &Component::ALL)];
    setup.loads = vec![Load::new(
        "top",
        Action::Displacement(Displacement {
            x: Some(far * x),
            y: Some(far * y),
            ..Displacement::default()
        }),
    )];
    setup
}

/// Loads that are their own mirror images give such displacements; loads and their mirror images give displacements and theirs.
#[test]
fn symmetric_bodies_move_symmetrically() {
    for (seed, law) in (501..).zip(Law::ALL.repeat(6)) {
        let (specimen, mirror) = Specimen::new(law, &mut Random(seed)).doubled();
        let pressed = |direction: [f64; 2]| {
            let mut setup = moved(&specimen, direction);
            let pressure = Action::Pressure(specimen.young * specimen.strain);
            setup.loads.push(Load::new("right", pressure));
            setup.temperatures = vec![Temperature {
                place: Place::Everywhere,
                change: TemperatureChange::Uniform(0.5 * specimen.strain / 1e-5),
            }];
            // In a lattice, the right side is that of one half.
            setup
                .loads
                .truncate(if law.row.needs_lattice { 1 } else { 2 });
            Answer::new(setup)
        };
        let straight = pressed([0.0, 1.0]);
        let [right, left] = [[0.4, 1.0], [-0.4, 1.0]].map(pressed);
        for (one, other) in [(&straight, &straight), (&right, &left)] {
            let deviations = one.deviations(other, &mirror);
            assert!(
                largest(deviations) < ROUNDING,
                "{}, seed {seed}: {}",
                law.name(),
                short(&deviations)
            );
        }
        assert!(largest(right.deviations(&right, &mirror)) > 1e-3);
    }
}

/// Mirrored bonds reach their limits at once but for rounding. One bond is asked for at a time, and the tie rule takes its image
/// with it: every round of breaking is its own mirror image. Without the rule rounding would choose a side.
#[test]
fn symmetric_bodies_break_symmetrically() {
    for (seed, law) in (601..).zip(Law::ALL.repeat(6)) {
        let (specimen, mirror) = Specimen::new(law, &mut Random(seed)).doubled();
        let mut setup = moved(&specimen, [0.0, 4.0]);
        setup.no_fail = ["bottom", "top"].map(Place::from).into();
        setup.criteria = criteria(&specimen, seed as usize / 3);
        setup.analysis = analysis(seed as usize, Some(40));
        let answer = Answer::new(setup);
        let (n_broken, n_rounds) = (answer.n_broken(), answer.rounds.len());
        let name = law.name();
        println!("{name}, seed {seed}: {n_broken} bonds broke in {n_rounds} rounds");
        assert!(n_broken > 10 && n_rounds < n_broken, "{name}, seed {seed}");
        assert!(answer.broke_like(&answer, &mirror), "{name}, seed {seed}");
    }
}
