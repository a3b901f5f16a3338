//! Motions that follow equilibria until the body loses its balance, and again when it is at rest.

use super::*;
use ligament::Message;
use ligament_analysis::history::BreakRecord;
use ligament_analysis::user_message::Place;
use ligament_analysis::{Amplitude, Shape};

/// Seconds in which the bar is drawn, 10^6 times as long as a wave takes through it.
const DURATION: f64 = 40.0;
const ROWS: usize = 40;
/// Steps of the motion between two rows, rounded up to a power of two by the scheme.
const STEPS: usize = 1 << 16;

/// Bar held at one end and drawn at the other to ten times the stretch at which its bonds fail, with a smaller section at its middle.
fn drawn(name: &str) -> Setup {
    let notch = |from: f64, to: f64| PreCrack {
        ends: Ends::Excluded,
        shape: match name {
            "plane" => CrackShape::Line(vec![[0.06, from], [0.06, to]]),
            _ => CrackShape::Polygon(vec![
                [0.03, from, -0.01],
                [0.03, to, -0.01],
                [0.03, to, 0.04],
                [0.03, from, 0.04],
            ]),
        },
    };
    let mut setup = match name {
        "plane" => plate(Law::NHPD),
        _ => block(Law::NHPD),
    };
    let length = if name == "plane" { 0.12 } else { 0.06 };
    setup.precracks = vec![notch(-0.01, 0.02)];
    let mut held = vec![Component::X, Component::Y];
    if name != "plane" {
        held.push(Component::Z);
    }
    setup.supports = vec![Support::new("first", &held)];
    let pull = Displacement {
        x: Some(10.0 * STRETCH * length),
        ..Displacement::default()
    };
    let mut load = Load::new("last", Action::Displacement(pull));
    load.amplitude = Some(Amplitude::pulse(Shape::Ramp, 0.0, DURATION));
    setup.loads = vec![load];
    setup.criteria = vec![STRENGTH.into()];
    setup
}

fn slowly(statics: Option<f64>) -> MotionSettings {
    let mut settings = implicit(DURATION, ROWS, STEPS, 0.05);
    // Half of the critical damping of the slowest waves, so that the halves come to rest.
    settings.damping.mass = 2e4;
    if let Some(share) = statics {
        settings.scheme = Scheme::Auto;
        settings.statics = share;
    }
    settings
}

fn posed(mut setup: Setup, settings: &MotionSettings) -> MotionProblem {
    setup.analysis = Analysis::Motion(settings.clone());
    let model = Model::build(setup, &mut ()).unwrap();
    let loading = Loading::new(&model).unwrap();
    let problem = loading.problem(&model);
    loading.motion(&problem).unwrap()
}

/// Messages, bonds that broke and states of a motion.
#[derive(Default)]
struct Course {
    messages: Vec<Message>,
    broken: Vec<BreakRecord>,
    states: States,
}

impl Observer for Course {
    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        match view.motion {
            Some(_) => self.states.step(record, view),
            None => Ok(()),
        }
    }

    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        self.broken.extend(records);
        Ok(())
    }

    fn message(&mut self, message: Message) -> Result<(), ObserverError> {
        self.messages.push(message);
        Ok(())
    }

    fn moment(&mut self, moment: &Moment<'_>) -> Result<Onward, ObserverError> {
        self.states.moment(moment)
    }
}

/// Up to the first breakage the motion has the displacements of load steps; a bond breaks in the step of the motion in which it reaches its
/// limit, at a time that linear elasticity predicts; the bar snaps, comes to rest and snaps again. Where it is at rest it stores half the force
/// times the displacement (Clapeyron).
///
/// 1e-10 of the displacement: both solve the same equations to a residual of 1e-10. 1e-9 of the energies: the trapezoidal rule is exact.
#[test]
fn a_bar_follows_equilibria_until_it_snaps() {
    for name in ["plane", "space"] {
        let settings = slowly(Some(MotionSettings::new(1.0).statics));
        let problem = posed(drawn(name), &settings);
        let mut course = Course::default();
        let outcome = motion::run(&problem, &settings, &mut course).unwrap();
        let history = &outcome.history;
        assert_eq!(
            outcome.termination,
            Termination::TimeReached { time: DURATION }
        );
        assert!(
            imbalance(&outcome) < 1e-9,
            "{name}: {}",
            imbalance(&outcome)
        );

        let whole = history.iter().rposition(|it| it.broken_bonds == 0).unwrap();
        let mut of_steps = drawn(name);
        of_steps.loads[0].amplitude = None;
        let factors: Vec<f64> = (1..=whole).map(|row| row as f64 / ROWS as f64).collect();
        of_steps.analysis = Analysis::Stepped(setup::stepped(factors));
        let statics = of_steps.solve(&mut NoObserver).unwrap().outcome;
        let expected = &statics.state.displacement;
        let found = &course.states.rows[whole].1;
        let size = largest(expected.iter().map(|it| it.abs()));
        let apart = largest(expected.iter().zip(found).map(|(a, b)| (a - b).abs()));
        assert!(apart < 1e-10 * size, "{name}: {apart:e} of {size:e}");
        assert_eq!(history[whole].motion.unwrap().time_steps, whole);

        let limit = history[whole].load_factor / history[whole].largest_ratio;
        let first = course.broken[0].load_factor;
        let step = DURATION / (ROWS * STEPS) as f64;
        assert!(
            first >= limit && first < limit + 2.0 * step,
            "{name}: {first} {limit}"
        );

        let of = |kind: &str| course.messages.iter().filter(|it| it.kind == kind).count();
        let [starts, rests] = ["lost-balance", "at-rest"].map(of);
        assert!(starts > 0 && starts == rests, "{:?}", course.messages);
        let last = history.last().unwrap();
        let motion = last.motion.unwrap();
        assert_eq!(motion.kinetic_energy, 0.0, "{name}");
        let at_rest = history
            .iter()
            .filter(|it| it.motion.unwrap().kinetic_energy == 0.0);
        for it in at_rest {
            let half = 0.5 * it.reaction * it.displacement;
            let apart = (it.stored_energy - half).abs();
            // The rounding of the work is left where the bar has parted.
            assert!(
                apart <= 1e-9 * half + 1e-12 * last.external_work,
                "{name}, row {}: {apart:e} of {half:e}",
                it.step
            );
        }
        assert!(motion.damping_energy > 0.0 && last.dissipated_energy > 0.0);
        println!(
            "{name}: {} steps, {} bonds, damping {:.3} of the work, first at {:.2e} steps",
            motion.time_steps,
            last.broken_bonds,
            motion.damping_energy / last.external_work,
            (first - limit) / step
        );
    }
}

/// A motion with equilibria has the same bits with two threads, and from a checkpoint before and after the bar has snapped.
#[test]
fn a_motion_with_equilibria_goes_on_with_its_bits() {
    let settings = slowly(Some(MotionSettings::new(1.0).statics));
    let problem = posed(drawn("plane"), &settings);
    let (outcome, states) = followed(&problem, &settings);
    let two = on_threads(Some(2), || followed(&problem, &settings)).unwrap();
    assert_eq!(two.0.history, outcome.history);
    assert_resumes(&problem, &settings, (&outcome, &states), &[1, 8, 12, 39]);
}

/// A load that jumps at time zero does twice the work that a body at rest can store: the body moves from the start, and rests in the end with
/// the displacements of the load.
#[test]
fn a_load_that_jumps_sets_the_body_in_motion() {
    let mut setup = drawn("plane");
    setup.criteria.clear();
    setup.loads = vec![Load::new("last", Action::Force([1e3, 0.0, 0.0]))];
    let mut settings = implicit(2e-3, 10, 500, 0.05);
    settings.damping.mass = 2e4;
    settings.scheme = Scheme::Auto;
    let problem = posed(setup, &settings);
    let mut course = Course::default();
    let outcome = motion::run(&problem, &settings, &mut course).unwrap();
    let told = course.messages.first().unwrap();
    assert_eq!(
        (&*told.kind, told.place),
        ("lost-balance", Place::Time(0.0))
    );
    let last = outcome.history.last().unwrap();
    assert_eq!(last.motion.unwrap().kinetic_energy, 0.0);
    let half = 0.5 * last.external_work;
    assert!((last.stored_energy / half - 1.0).abs() < 1e-9);
    assert!(imbalance(&outcome) < 1e-9);
}
