//! Faces of cracks that collide and rub.

use super::*;

/// A setup in motion with a pre-crack across its middle, whose faces close.
fn parted(name: &str, mut setup: Setup) -> Setup {
    let [width, height] = match name {
        "plane" => [0.12, 0.06],
        _ => [0.06, 0.04],
    };
    let (middle, from, to) = (0.5 * width, -0.01, height + 0.01);
    setup.precracks = vec![PreCrack {
        ends: Ends::Excluded,
        shape: match name {
            "plane" => CrackShape::Line(vec![[middle, from], [middle, to]]),
            _ => CrackShape::Polygon(vec![
                [middle, from, from],
                [middle, to, from],
                [middle, to, to],
                [middle, from, to],
            ]),
        },
    }];
    setup.closing = true;
    setup.analysis = Analysis::Motion(MotionSettings::new(1.0));
    setup.initial_velocities = vec![InitialVelocity {
        place: Place::Everywhere,
        velocity: [0.0; 3],
    }];
    setup
}

/// Velocities with which the halves of a body fly against each other and past each other.
fn against(model: &Model) -> Vec<f64> {
    let layout = model.system.to_bonds().layout;
    let n = layout.n_points as u32;
    let mut velocity = vec![0.0; layout.n_degrees_of_freedom()];
    for point in 0..n {
        for (component, size) in [(Component::X, 1.0), (Component::Y, 0.5)] {
            let dof = layout.degree_of_freedom(point, component).unwrap();
            velocity[dof] = if point < n / 2 { size } else { -size };
        }
    }
    velocity
}

/// Two halves of a bar, separated by a pre-crack whose faces close, fly against each other: without friction they keep their energy except
/// for the loss where pairs begin and end, and with friction some is dissipated.
///
/// Work and energies balance to 1e-9: the trapezoidal rule is exact; measured 2e-14. A hundredth of the energy: each pair closes and opens within
/// a time step, at some depth; measured 4e-3 and less.
#[test]
fn halves_of_a_bar_collide_and_rub() {
    for (name, setup) in [("plane", plate(Law::NHPD)), ("space", block(Law::NHPD))] {
        let mut setup = parted(name, setup);
        for friction in [0.0, 0.3] {
            setup.closing_friction = friction;
            let problem = motion_of(&setup, against);
            for settings in [settings(6e-5, 10), implicit(6e-5, 10, 10, 0.0)] {
                let (outcome, states) = followed(&problem, &settings);
                let last = outcome.history.last().unwrap().motion.unwrap();
                let taken = last.friction_energy / last.initial_energy;
                let balance = imbalance(&outcome);
                println!("{name}, friction {friction}: imbalance {balance:.1e}, taken {taken:.4}");
                assert!(outcome.history.iter().any(|it| it.closed_pairs > 0));
                assert!(balance < 1e-9, "{name}: {balance:.1e}");
                match friction > 0.0 {
                    true => assert!(taken > 0.02),
                    false => assert!(taken.abs() < 0.01),
                }
                assert_resumes(&problem, &settings, (&outcome, &states), &[5, 10]);
            }
        }
    }
}
