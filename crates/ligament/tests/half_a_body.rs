//! Half of a symmetric body on rollers against the whole of it.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use ligament::prelude::*;
use ligament_analysis::driver::Outcome;

/// A plate of 2 mm cells with a hole at x = 0, from `left` to x = 40 mm, pulled along y on the exact path.
fn plate(columns: u32, left: f64) -> Setup {
    let hole = Hole {
        name: None,
        shape: Shape::Circle {
            centre: [0.0, 0.06],
            radius: 0.012,
        },
    };
    let sets = [
        ("left", CellSet::left(1)),
        ("bottom", CellSet::bottom(2)),
        ("top", CellSet::top(2)),
    ];
    let sets = sets.map(|(name, set)| (name.to_owned(), set)).into();
    let body = LatticeBody::new([columns, 60], [0.002; 2], [left, 0.0], &[hole], &sets).unwrap();
    let mut material = Material::isotropic(3e10, 0.2);
    material.tensile_strength = Some(3e6);
    let mut setup = Setup::new(body, material, Law::NHPD);
    let pull = Displacement {
        y: Some(2e-5),
        ..Displacement::default()
    };
    setup.loads = vec![Load::new("top", Action::Displacement(pull))];
    setup.supports = vec![Support::new("bottom", &[Component::Y])];
    setup.no_fail = ["bottom", "top"]
        .map(|it| Place::Group(it.to_owned()))
        .into();
    setup.criteria = vec![STRENGTH.into()];
    setup.analysis = Analysis::Event(event());
    setup
}

fn peak(outcome: &Outcome) -> f64 {
    let reactions = outcome.history.iter().map(|it| it.reaction);
    reactions.fold(0.0, f64::max)
}

/// Rollers on the edge of symmetry replace the other half: stiffness and peak agree to half a percent, because the bonds across the edge
/// are missing and are corrected only as at a free edge; the same bonds break on the way through the ligament, each once instead of twice.
#[test]
fn rollers_stand_for_the_other_half() {
    let mut whole = plate(40, -0.04);
    let mut at = Support::new("bottom", &[Component::X]);
    at.place = Place::At([0.001, 0.001, 0.0]);
    whole.supports.push(at);
    let mut half = plate(20, 0.0);
    half.supports.push(Support::new("left", &[Component::X]));
    let [whole, half] = [whole, half].map(|it| it.solve(&mut NoObserver).unwrap().outcome);
    let stiffness = 2.0 * half.elastic_stiffness / whole.elastic_stiffness - 1.0;
    let strength = 2.0 * peak(&half) / peak(&whole) - 1.0;
    assert!(stiffness.abs() < 5e-3, "{stiffness:e}");
    assert!(strength.abs() < 1e-2, "{strength:e}");
    let broken = [&whole, &half].map(|it| it.state.broken_bonds());
    assert!(broken[1] > 50);
    assert_eq!(broken[0], 2 * broken[1], "{stiffness:e} {strength:e}");
}
