//! Loads that follow a probe: against prescribed displacements, past peaks and through snap-backs, and with faces that close.

use super::*;

/// The plate, pulled at one point by a force or by a displacement, with bonds that cannot break around it.
fn pulled_at_a_point(action: Action, control: Option<Control>, criterion: Choice) -> Setup {
    let mut setup = plate(Analysis::Stepped(stepped(Vec::new())), Vec::new());
    let mut load = Load::new(Place::At([0.115, 0.065, 0.0]), action);
    load.name = "hook".to_owned();
    setup.loads[0] = load;
    setup.no_fail = vec![Place::Box([[0.085, 0.0, 0.0], [0.12, 0.12, 0.0]])];
    setup.supports = vec![Support::new("left", &[Component::X, Component::Y])];
    setup.criteria = vec![criterion];
    setup.probes = vec![Probe {
        name: "hook".to_owned(),
        reading: Reading::At {
            position: [0.115, 0.065, 0.0],
            field: PointField::named("displacement.x").unwrap(),
        },
    }];
    setup.stages = vec![Stage {
        control,
        ..stage("pull", "hook", Course::to(1.0), Some(60))
    }];
    setup.curve = Some("hook".to_owned());
    setup
}

fn brittle() -> Choice {
    STRENGTH.into()
}

fn softening() -> Choice {
    Choice::from(STRENGTH).with_softening(linear::LAW, Some(10.0))
}

/// A force on a point that follows the displacement of that point is the reaction to that displacement: both go through the same states,
/// past the peak, brittle or softening. 1e-3 of the largest force where bonds soften: just past the
/// peak cracks may grow at one end or another, and different iterates lead to slightly different cracks.
#[test]
fn a_force_that_follows_its_displacement_is_its_reaction() {
    const END: f64 = 6e-5;
    for (name, criterion, tolerance) in [
        ("brittle", brittle(), 1e-8),
        ("softening", softening(), 1e-3),
    ] {
        let moved = Displacement {
            x: Some(END),
            ..Displacement::default()
        };
        let (given, _) = run(pulled_at_a_point(
            Action::Displacement(moved),
            None,
            criterion.clone(),
        ));
        let control = Control {
            quantity: Quantity::Probes(vec![("hook".to_owned(), 1.0)]),
            to: END,
        };
        let force = Action::Force([1e5, 0.0, 0.0]);
        let (followed, _) = run(pulled_at_a_point(force, Some(control), criterion));
        assert_eq!(given.history.len(), 61);
        assert!(given.state.broken_bonds() >= 3, "{name}");
        let reactions = given.history.iter().map(|it| it.reaction);
        let largest = reactions.fold(0.0, f64::max);
        assert!(
            given.history[60].reaction < 0.95 * largest,
            "{name} is past its peak"
        );
        for (one, other) in given.history.iter().zip(&followed.history) {
            assert!(
                (one.displacement - other.displacement).abs() <= 1e-9 * END,
                "{name}"
            );
            let difference = (one.reaction - other.reaction).abs() / largest;
            assert!(
                difference < tolerance,
                "{name}, step {}: {difference:e}",
                one.step
            );
            assert_eq!(other.factors, [other.load_factor, 0.0]);
            let error = other.missing_energy().abs();
            let allowed = if name == "brittle" { 1e-8 } else { 1e-5 };
            assert!(
                error <= allowed * other.external_work,
                "{name}, step {}: {error:e}",
                other.step
            );
        }
    }
}

/// The plate with a pre-crack from below, pressed at a point, pulled and pressed again, with faces that close.
fn pressed_and_pulled(
    action: Action,
    turns: [f64; 3],
    is_controlled: bool,
    criterion: Choice,
) -> Setup {
    let mut setup = pulled_at_a_point(action, None, criterion);
    setup.closing = true;
    setup.precracks = vec![PreCrack::along(vec![[0.03, -0.001], [0.03, 0.081]])];
    let turn = |(place, to): (usize, &f64)| {
        let control = Control {
            quantity: Quantity::Probes(vec![("hook".to_owned(), 1.0)]),
            to: *to,
        };
        // Under control the factor gives only the direction of the load.
        let factor = if is_controlled {
            1.0 + place as f64
        } else {
            *to / 1e-5
        };
        Stage {
            control: is_controlled.then_some(control),
            ..stage(
                &format!("turn-{place}"),
                "hook",
                Course::to(factor),
                Some(20),
            )
        }
    };
    setup.stages = turns.iter().enumerate().map(turn).collect();
    setup
}

/// Faces close where a point is pressed, open where it is pulled, and close again; the force that follows the displacement of the point is the
/// reaction to that displacement, brittle and softening, and energies balance to 1e-8. 1e-3 of the largest force where bonds soften, as
/// without faces that close.
#[test]
fn a_force_that_follows_its_displacement_closes_cracks() {
    const TURNS: [f64; 3] = [-2e-5, 6e-5, -2e-5];
    for (name, criterion, tolerance) in [
        ("brittle", brittle(), 1e-8),
        ("softening", softening(), 1e-3),
    ] {
        let moved = Displacement {
            x: Some(1e-5),
            ..Displacement::default()
        };
        let moved = Action::Displacement(moved);
        let (given, _) = run(pressed_and_pulled(moved, TURNS, false, criterion.clone()));
        let force = Action::Force([1e5, 0.0, 0.0]);
        let (followed, _) = run(pressed_and_pulled(force, TURNS, true, criterion));
        assert_eq!(given.history.len(), 61, "{name}: {}", given.termination);
        let dissipated = given.history[60].dissipated_energy;
        assert!(
            dissipated > 0.05 * given.history[40].external_work,
            "{name}"
        );
        assert!(given.history[20].closed_pairs > 50 && given.history[40].closed_pairs == 0);
        assert!(given.history[60].closed_pairs > 50, "{name}");
        let largest = given.history.iter().map(|it| it.reaction.abs());
        let largest = largest.fold(0.0, f64::max);
        let work = given.history.iter().map(|it| it.external_work.abs());
        let work = work.fold(0.0, f64::max);
        assert_eq!(
            followed.history.len(),
            61,
            "{name}: {}",
            followed.termination
        );
        for (one, other) in given.history.iter().zip(&followed.history) {
            let difference = (one.reaction - other.reaction).abs() / largest;
            assert!(
                difference < tolerance,
                "{name}, step {}: {difference:e}",
                one.step
            );
            for record in [one, other] {
                let error = record.missing_energy().abs();
                assert!(
                    error < 1e-7 * work,
                    "{name}, step {}: {:e}",
                    one.step,
                    error / work
                );
            }
        }
    }
}

/// A constant pressure keeps a crack closed until the pull is larger: the next stage begins with the faces that a stage leaves closed, and
/// stages of one load equal its list of factors, to the rounding of the factors.
#[test]
fn faces_close_in_stages() {
    let cycles = [-0.5, 1.0, -0.5];
    let cracked = |analysis, stages| {
        let mut setup = plate(analysis, stages);
        setup.closing = true;
        setup.precracks = vec![PreCrack::along(vec![[0.03, -0.001], [0.03, 0.081]])];
        setup
    };
    let mut before = 0.0;
    let mut factors = Vec::new();
    let mut stages = Vec::new();
    for (place, to) in cycles.into_iter().enumerate() {
        factors.extend((1..=8).map(|step| before + f64::from(step) / 8.0 * (to - before)));
        stages.push(stage(
            &format!("turn-{place}"),
            "right",
            Course::to(to),
            Some(8),
        ));
        before = to;
    }
    let mut alone = cracked(Analysis::Stepped(stepped(factors)), Vec::new());
    let mut staged = cracked(Analysis::Stepped(stepped(Vec::new())), stages);
    alone.loads.truncate(1);
    staged.loads.truncate(1);
    let ((one, _), (other, _)) = (run(alone), run(staged));
    assert!(one.state.broken_bonds() > 3);
    let largest = one.history.iter().map(|it| it.reaction.abs());
    let largest = largest.fold(0.0, f64::max);
    for (one, other) in one.history.iter().zip(&other.history) {
        assert!((one.reaction - other.reaction).abs() < 1e-12 * largest);
        assert_eq!(one.closed_pairs, other.closed_pairs);
    }
    assert!(one.history[8].closed_pairs > 50 && one.history[16].closed_pairs == 0);
    let both = cracked(Analysis::Stepped(stepped(Vec::new())), preloaded(Some(8)));
    let (both, _) = run(both);
    let work = both.history.iter().map(|it| it.external_work.abs());
    let work = work.fold(0.0, f64::max);
    for record in &both.history {
        assert!(record.missing_energy().abs() < 1e-8 * work, "{record:?}");
    }
    let refused = cracked(Analysis::Event(event()), preloaded(None));
    let refused = refused.solve(&mut NoObserver).unwrap_err().to_string();
    assert!(
        refused.starts_with("closing: with a part of the load that stays"),
        "{refused}"
    );
}

/// A plate with a pre-crack from below that a force pulls apart: where the opening of its mouth controls the force, bonds break in the
/// order of the exact path as long as its opening grows, at the same forces, and the force and the displacement that it works on fall
/// together: the load snaps back.
#[test]
fn the_opening_of_a_crack_leads_through_a_snap_back() {
    let cracked = |analysis: Analysis, stage: Stage| {
        let mut setup = plate(analysis, vec![stage]);
        setup.loads = vec![Load::new("right", Action::Force([1e6, 0.0, 0.0]))];
        setup.precracks = vec![PreCrack::along(vec![[0.03, -0.001], [0.03, 0.051]])];
        setup.probes = vec![Probe {
            name: "mouth".to_owned(),
            reading: Reading::Between {
                positions: [[0.025, 0.005, 0.0], [0.035, 0.005, 0.0]],
                component: Component::X,
            },
        }];
        setup
    };
    let pull = |steps| stage("pull", "right", Course::to(1.0), steps);
    let (exact, path) = run(cracked(Analysis::Event(event()), pull(None)));
    let control = Control {
        quantity: Quantity::Probes(vec![("mouth".to_owned(), 1.0)]),
        to: 6e-5,
    };
    let mut settings = stepped(Vec::new());
    settings.rule.bonds_per_iteration = 1;
    settings.rule.order = BreakingOrder::Ratio;
    let steps = Stage {
        control: Some(control),
        ..pull(Some(600))
    };
    let (followed, breaks) = run(cracked(Analysis::Stepped(settings), steps));
    assert_eq!(exact.termination, Termination::Collapsed);
    assert_eq!(followed.termination, Termination::StepsDone);
    let order = |records: &[BreakRecord]| records.iter().map(|it| it.bond).collect::<Vec<u32>>();
    let broken = order(&breaks.breaks);
    assert!(broken.len() > 60, "{}", broken.len());
    assert_eq!(broken, order(&path.breaks[..broken.len()]));
    // With the same bonds the body is linear in the one force: its states lie on the line that leads to the next event.
    for record in &followed.history[1..] {
        let on_path = exact.history.iter().rev();
        let mut on_path = on_path.filter(|it| it.broken_bonds == record.broken_bonds);
        let compliance = |it: &StepRecord| it.probes[0] / it.reaction;
        if let Some(event) = on_path.next() {
            let difference = compliance(record) / compliance(event) - 1.0;
            assert!(
                difference.abs() < 1e-8,
                "step {}: {difference:e}",
                record.step
            );
            assert!(record.reaction <= event.reaction * (1.0 + 1e-8));
        }
    }
    let both_fall = |pair: &[StepRecord]| {
        pair[1].reaction < pair[0].reaction && pair[1].displacement < pair[0].displacement
    };
    assert!(followed.history.windows(2).any(both_fall));
}
