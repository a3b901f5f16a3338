//! Free vibration in a mode, with and without damping.

use super::*;

/// A setup with its first layer held, its lowest elastic mode and its frequency; none where rotations have no inertia.
fn vibrating(name: &str, setup: &Setup) -> Option<(Setup, Vec<f64>, f64)> {
    let mut held = setup.clone();
    let is_solid = name.ends_with("space");
    held.supports = vec![match is_solid {
        true => Support::new("first", &Component::IN_SPACE[..3]),
        false => Support::new("first", &[Component::X, Component::Y]),
    }];
    let model = Model::build(held.clone(), &mut ()).unwrap();
    let vibration = Vibration::new(&model).unwrap();
    let analysis =
        ModalAnalysis::new(&vibration.problem(&model), ModalSettings::default()).unwrap();
    if analysis.rotations() == Rotations::Massless {
        return None;
    }
    let found = analysis.find().unwrap();
    let mode = found.modes.iter().find(|it| it.kind == ModeKind::Elastic);
    let mode = mode.unwrap();
    Some((held, mode.shape.clone(), 2.0 * PI * mode.frequency()))
}

/// Largest difference of the displacements of a motion from factors of time on a shape, over the amplitude.
fn difference(states: &States, shape: &[f64], amplitude: f64, factor: impl Fn(f64) -> f64) -> f64 {
    let size = amplitude * largest(shape.iter().map(|it| it.abs()));
    let of_rows = states.rows.iter().flat_map(|(time, displacement, _)| {
        let factor = factor(*time);
        let both = displacement.iter().zip(shape);
        both.map(move |(found, shape)| (found - factor * shape).abs() / size)
    });
    largest(of_rows)
}

/// A body that starts in a natural mode with the velocity v_0 is at time n dt where central differences put an oscillator: u_n = v_0 dt
/// sin(n w dt)/sin(w dt), with sin(w dt/2) = omega dt/2, and where the trapezoidal rule does: u_n = v_0/omega sin(n w dt), with tan(w dt/2) = omega
/// dt/2 (Hughes, The Finite Element Method, section 9.1).
///
/// 1e-8 of the amplitude: the residuals of the mode and of the equilibria, 1e-10, which add up over the steps; measured 3e-14 and 2e-10.
#[test]
fn every_law_vibrates_in_its_modes() {
    for (name, setup) in every_law() {
        let Some((held, shape, omega)) = vibrating(&name, &setup) else {
            println!("{name}: rotations without inertia");
            continue;
        };
        let problem = motion_of(&held, |_| shape.clone());
        let duration = 1.3 * 2.0 * PI / omega;
        let (outcome, states) = followed(&problem, &settings(duration, 13));
        let steps = outcome.history.last().unwrap().motion.unwrap().time_steps;
        let step = duration / steps as f64;
        let discrete = 2.0 / step * (0.5 * omega * step).asin();
        let explicit = difference(&states, &shape, 1.0 / omega, |time| {
            step * (discrete * time).sin() / (discrete * step).sin()
        });
        assert_eq!(
            outcome.termination,
            Termination::TimeReached { time: duration }
        );

        let (whole, states) = followed(&problem, &implicit(duration, 13, 3, 0.0));
        let step = duration / 39.0;
        let discrete = 2.0 / step * (0.5 * omega * step).atan();
        let of_rule = difference(&states, &shape, 1.0 / omega, |time| {
            (discrete * time).sin() / omega
        });
        println!(
            "{name}: {steps} steps, errors {explicit:.1e}, {of_rule:.1e}, energies {:.1e}, {:.1e}",
            imbalance(&outcome),
            imbalance(&whole)
        );
        assert!(explicit < 1e-8, "{name}: {explicit:.1e}");
        assert!(imbalance(&outcome) < 1e-10, "{name}");
        if problem.problem.system.element.has_energy() {
            assert!(of_rule < 1e-8, "{name}: {of_rule:.1e}");
            assert!(imbalance(&whole) < 1e-8, "{name}");
        }
    }
}

/// Damping in proportion to mass and stiffness lets a mode decay as an oscillator with xi = (alpha/omega + beta omega)/2, dashpots take what
/// the ledger lacks, and the dissipation of the implicit scheme is counted.
///
/// 5e-3 of the amplitude: explicit damping by stiffness is half a step late, of which a period has 80 in space (measured 2.7e-3 there, 4e-4
/// elsewhere); energies balance to 1e-8, the residuals of equilibria.
#[test]
fn damped_modes_decay() {
    for (name, setup) in [
        ("nhpd plane", plate(Law::NHPD)),
        ("nhpd space", block(Law::NHPD)),
    ] {
        let (held, shape, omega) = vibrating(name, &setup).unwrap();
        let mut problem = motion_of(&held, |_| shape.clone());
        let duration = 2.0 * PI / omega;
        let damping = Damping {
            mass: 0.1 * omega,
            stiffness: 0.05 / omega,
        };
        let xi = 0.5 * (0.1 + 0.05);
        let own = omega * (1.0_f64 - xi * xi).sqrt();
        let decayed = |time: f64| (-xi * omega * time).exp() * (own * time).sin() / own;
        let of_schemes = [
            settings(duration, 10),
            implicit(duration, 10, 30, 0.0),
            implicit(duration, 10, 30, 0.2),
        ];
        for (scheme, undamped) in of_schemes.into_iter().enumerate() {
            let settings = MotionSettings {
                damping,
                ..undamped
            };
            let (outcome, states) = followed(&problem, &settings);
            let error = difference(&states, &shape, 1.0 / omega, decayed);
            println!(
                "{name}: scheme {scheme}, error {error:.1e}, energies {:.1e}",
                imbalance(&outcome)
            );
            assert!(error < 5e-3, "{name}, scheme {scheme}: {error:.1e}");
            assert!(
                imbalance(&outcome) < 1e-8,
                "{name}, scheme {scheme}: {:.1e}",
                imbalance(&outcome)
            );
            assert!(
                outcome.history[10].motion.unwrap().damping_energy
                    > 0.1 * outcome.history[0].motion.unwrap().initial_energy
            );
        }
        let n = problem.problem.system.layout.n_points as u32;
        const DAMPING: [[f64; 3]; 3] =
            [[900.0, 200.0, 0.0], [200.0, 600.0, 0.0], [0.0, 0.0, 500.0]];
        let dashpot = |point: u32| Dashpot::new(point, |row, column| DAMPING[row][column]);
        problem.dashpots = (n / 2..n).map(dashpot).collect();
        for settings in of_schemes_with_dashpots(duration) {
            let (outcome, _) = followed(&problem, &settings);
            println!("{name}: dashpots, energies {:.1e}", imbalance(&outcome));
            assert!(imbalance(&outcome) < 1e-8, "{name}");
            assert!(
                outcome.history[10].motion.unwrap().damping_energy
                    > 0.01 * outcome.history[0].motion.unwrap().initial_energy
            );
        }
    }
}

fn of_schemes_with_dashpots(duration: f64) -> [MotionSettings; 2] {
    [settings(duration, 10), implicit(duration, 10, 30, 0.0)]
}

/// Bonds that resist shear with a negative stiffness make the body unstable at Poisson's ratios near 1/2: its motion grows, and the run
/// reports it.
#[test]
fn a_motion_that_grows_without_cause_ends() {
    let mut setup = plate(Law::PDS.with(PoissonForm::Bonds));
    setup.materials[0].material = Material {
        density: Some(DENSITY),
        ..Material::isotropic(YOUNG, 0.49)
    };
    setup.section = Section::Plane {
        state: Plane::Strain,
        thickness: 1.0,
    };
    let problem = motion_of(&setup, |model| {
        wavy(model.system.to_bonds().layout.n_degrees_of_freedom())
    });
    let (outcome, _) = followed(&problem, &settings(2e-3, 20));
    println!("{:?}", outcome.termination);
    assert!(matches!(
        outcome.termination,
        Termination::EnergyGrew { .. }
    ));
    assert!(outcome.history.len() < 20);
}

/// A free body in translation loses exp(-2 alpha t) of its energy to damping by mass, as long as a step can follow it; a step of 2/alpha or
/// more, in which the scheme would reverse its velocity, is refused by both schemes.
///
/// The decay to alpha t (alpha dt)^2/6: (1 - a)/(1 + a) = exp(-2 a - 2 a^3/3 - ...) with a = alpha dt/2.
#[test]
fn damping_by_mass_decays_or_is_refused() {
    let n_components = 3;
    let problem = motion_of(&plate(Law::NHPD), |model| {
        let n = model.system.to_bonds().layout.n_degrees_of_freedom();
        let along_x = |dof: usize| f64::from(u8::from(dof.is_multiple_of(n_components)));
        (0..n).map(along_x).collect()
    });
    let step = 0.5 * critical_step(&problem, &settings(1.0, 1)).unwrap().step;
    let (rows, steps) = (2, 40);
    let duration = (rows * steps) as f64 * step;
    let of_schemes = [
        MotionSettings {
            step: Some(1.000_001 * step),
            ..settings(duration, rows)
        },
        implicit(duration, rows, steps, 0.0),
    ];
    for mut settings in of_schemes {
        settings.damping.mass = 0.2 / step;
        let history = followed(&problem, &settings).0.history;
        let energy = |row: usize| history[row].motion.unwrap().kinetic_energy;
        let decayed = (energy(2) / energy(1)).ln();
        let expected = -2.0 * settings.damping.mass * 0.5 * duration;
        assert!(
            (decayed / expected - 1.0).abs() < 0.2 * 0.2 / 10.0,
            "{decayed} {expected}"
        );
        for times in [2.0, 20.0] {
            settings.damping.mass = times / step;
            let refused = motion::run(&problem, &settings, &mut NoObserver);
            let words = refused.err().map(|it| it.to_string()).unwrap_or_default();
            assert!(words.contains("2/damping.mass"), "{words}");
        }
    }
}

/// A velocity whose square is not finite ends the motion at its first state, with a message.
#[test]
fn velocities_beyond_all_numbers_end_a_motion() {
    for settings in [settings(1e-3, 10), implicit(1e-3, 10, 5, 0.0)] {
        let problem = motion_of(&plate(Law::NHPD), |model| {
            vec![1e300; model.system.to_bonds().layout.n_degrees_of_freedom()]
        });
        let (outcome, _) = followed(&problem, &settings);
        assert!(matches!(
            outcome.termination,
            Termination::EnergyGrew { .. }
        ));
        assert_eq!(outcome.history.len(), 1);
        let words = outcome.termination.to_string();
        assert!(words.contains("are not numbers"), "{words}");
    }
}

/// An excessive number of steps is refused before the motion begins.
#[test]
fn steps_without_end_are_refused() {
    let problem = motion_of(&plate(Law::NHPD), |model| {
        wavy(model.system.to_bonds().layout.n_degrees_of_freedom())
    });
    for duration in [1e9, 1e300] {
        for settings in [settings(duration, 10), implicit(duration, 10, 1 << 50, 0.0)] {
            let refused = motion::run(&problem, &settings, &mut NoObserver);
            let words = refused.err().map(|it| it.to_string()).unwrap_or_default();
            assert!(words.contains("time steps"), "{words}");
        }
    }
}
