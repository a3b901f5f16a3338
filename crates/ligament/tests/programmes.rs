//! Loads in stages: against one load factor, against fine steps, and from checkpoints.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use ligament::Loading;
use ligament::prelude::*;
use ligament::run::{follow, restore, resume};
use ligament::setup::{Control, Quantity};
use ligament_analysis::breakage::Breakage;
use ligament_analysis::breaking::BreakingOrder;
use ligament_analysis::driver::Outcome;
use ligament_analysis::history::{
    BreakRecord, Moment, ObserverError, Onward, StepRecord, Termination, View,
};
use ligament_analysis::probe::PointField;
use ligament_analysis::{Attempt, BondDeformation, Equilibrium, LoadCourse, State};
use ligament_model::failure::After;
use ligament_model::failure::softening::linear;

/// A plate of 12 by 12 cells of 10 mm with a hole, held at the left and at the bottom, pulled at the right and pressed from above.
fn plate(analysis: Analysis, stages: Vec<Stage>) -> Setup {
    let hole = Hole {
        name: None,
        shape: Shape::Circle {
            centre: [0.06, 0.06],
            radius: 0.016,
        },
    };
    let sets = [
        ("left", CellSet::Left(1)),
        ("right", CellSet::Right(1)),
        ("bottom", CellSet::Bottom(1)),
        ("top", CellSet::Top(1)),
    ];
    let sets = sets.map(|(name, set)| (name.to_owned(), set)).into();
    let body = LatticeBody::new([12, 12], [0.01; 2], [0.0; 2], &[hole], &sets).unwrap();
    let mut material = Material::isotropic(3e10, 0.2);
    material.tensile_strength = Some(3e6);
    material.density = Some(2400.0);
    let mut setup = Setup::new(body, material, Law::Nhpd);
    setup.supports = vec![
        Support::new("left", &[Component::X]),
        Support::new("bottom", &[Component::Y]),
    ];
    let pull = Displacement {
        x: Some(3e-5),
        ..Displacement::default()
    };
    setup.loads = vec![
        Load::new("right", Action::Displacement(pull)),
        Load::new("top", Action::Pressure(2e6)),
    ];
    setup.criteria = vec![STRENGTH.into()];
    setup.analysis = analysis;
    setup.stages = stages;
    setup
}

fn stage(name: &str, load: &str, course: Course, steps: Option<usize>) -> Stage {
    Stage {
        name: name.to_owned(),
        loads: vec![(load.to_owned(), course)],
        steps,
        control: None,
    }
}

/// The pressure first, then the pull.
fn preloaded(steps: Option<usize>) -> Vec<Stage> {
    vec![
        stage("press", "top", Course::to(1.0), steps.map(|_| 1)),
        stage("pull", "right", Course::to(1.0), steps),
    ]
}

fn one_by_one() -> Analysis {
    let mut settings = stepped(Vec::new());
    settings.rule.bonds_per_iteration = 1;
    Analysis::Stepped(settings)
}

/// Bonds that broke; and what a run told, with every digit, and its moments, where these are wanted.
#[derive(Default)]
struct Recorder {
    keeps_all: bool,
    lines: Vec<String>,
    breaks: Vec<BreakRecord>,
    moments: Vec<(usize, Vec<u8>)>,
}

impl Observer for Recorder {
    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        let lines = records.iter().filter(|_| self.keeps_all);
        self.lines.extend(lines.map(|it| format!("{it:?}")));
        self.breaks.extend(records);
        Ok(())
    }

    fn moment(&mut self, moment: &Moment<'_>) -> Result<Onward, ObserverError> {
        if self.keeps_all {
            self.moments.push((self.lines.len(), (moment.checkpoint)()));
        }
        Ok(Onward::Go)
    }

    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        if self.keeps_all {
            self.lines.push(format!("{record:?} {:?}", view.state));
        }
        Ok(())
    }
}

fn run(setup: Setup) -> (Outcome, Recorder) {
    let mut recorder = Recorder::default();
    let outcome = setup.solve(&mut recorder).unwrap().outcome;
    (outcome, recorder)
}

/// One stage in which a load goes to 1 is what happens without stages, to the last bit.
#[test]
fn one_stage_is_one_load_factor() {
    let alone = |analysis, stages| {
        let mut setup = plate(analysis, stages);
        setup.loads.truncate(1);
        run(setup)
    };
    let factors = (1..=20).map(|step| f64::from(step) / 20.0).collect();
    let (without, broken) = alone(Analysis::Stepped(stepped(factors)), Vec::new());
    let pull = vec![stage("pull", "right", Course::to(1.0), Some(20))];
    let (with, broken_in_stage) = alone(Analysis::Stepped(stepped(Vec::new())), pull);
    assert!(without.state.broken_bonds() > 20);
    assert_eq!(without.state, with.state);
    assert_eq!(broken.breaks, broken_in_stage.breaks);
    for (one, other) in without.history.iter().zip(&with.history) {
        assert_eq!(one.external_work.to_bits(), other.external_work.to_bits());
        assert_eq!(other.factors, [one.load_factor]);
    }
}

/// After a pressure that stays, fine steps break the first bonds of the exact path, in their order, at the load factors that they have just
/// passed; where the path snaps back the steps jump ahead.
#[test]
fn fine_steps_after_a_preload_follow_the_exact_path() {
    const STEPS: usize = 4000;
    let (exact, breaks) = run(plate(Analysis::Event(event()), preloaded(None)));
    let (fine, steps) = run(plate(one_by_one(), preloaded(Some(STEPS))));
    assert_eq!(exact.termination, Termination::FullLoad);
    assert_eq!(fine.termination, Termination::StepsDone);
    let records = &breaks.breaks;
    let falls = |place: &usize| records[*place].load_factor < records[*place - 1].load_factor;
    let ahead = (1..records.len()).find(falls).unwrap_or(records.len());
    assert!(ahead >= 2, "{ahead}");
    for (one, other) in records[..ahead].iter().zip(&steps.breaks) {
        assert_eq!(one.bond, other.bond);
        let behind = other.load_factor - one.load_factor;
        assert!(
            (-1e-12..=1.01 / STEPS as f64).contains(&behind),
            "{behind:e}"
        );
    }
    for record in exact.history.iter().chain(&fine.history) {
        assert!(record.energy_error().abs() < 1e-8, "{record:?}");
    }
    assert_eq!(exact.history.last().unwrap().factors, [1.0, 1.0]);
}

/// With the bonds that are left before each event, solutions at many load factors of the stage tell the largest at which all of them are
/// within their limits: the exact path breaks the next bonds there, between it and the next higher one, and those that reach their limits
/// at its load factor are the ones that it breaks.
#[test]
fn the_exact_path_after_a_preload_is_that_of_a_search() {
    const PARTS: u32 = 400;
    let setup = plate(Analysis::Event(event()), preloaded(None));
    let model = Model::build(setup, &mut ()).unwrap();
    let loading = Loading::new(&model.setup, &model.system).unwrap();
    let problem = loading.problem(&model.system, &model.criteria);
    let mut path = Recorder::default();
    follow(&problem, &model.setup.analysis, &mut path).unwrap();
    let first = problem.loads.course().unwrap();
    let pull = LoadCourse::new(first.programme.clone(), 1, &[0.0, 1.0]);
    let pull = problem.loads.in_course(pull).unwrap();
    let mut equilibrium = Equilibrium::new(&problem, 1e-4).unwrap();
    equilibrium.load_with(pull);
    let mut state = State::fresh(&*model.system);
    let mut breakage = equilibrium.break_bonds(&mut state, &[]);
    let ratios = |equilibrium: &mut Equilibrium, state: &mut State, breakage: &Breakage| {
        let attempt = equilibrium
            .balance(state, breakage, &mut Unobserved)
            .unwrap();
        let Attempt::Balanced(balanced) = attempt else {
            panic!("{attempt:?}");
        };
        let ratio = |(bond, deformation): (usize, &BondDeformation)| match state.intact[bond] {
            true => model.criteria.utilisation(bond, deformation),
            false => 0.0,
        };
        balanced
            .deformations
            .iter()
            .enumerate()
            .map(ratio)
            .collect::<Vec<f64>>()
    };
    let nothing = Breakage::default();
    let events: Vec<&[BreakRecord]> = path.breaks.chunk_by(|a, b| a.step == b.step).collect();
    let mut falls = 0;
    for (place, event) in events.iter().take(40).enumerate() {
        assert!(
            event.iter().all(|it| it.ratio < 1.0 + 1e-9),
            "a load was held"
        );
        state.load_factor = event[0].load_factor;
        let there = ratios(&mut equilibrium, &mut state, &breakage);
        let reached = (0..there.len()).filter(|&bond| there[bond] >= 1.0 - 1.1e-8);
        let bonds: Vec<u32> = event.iter().map(|it| it.bond).collect();
        assert_eq!(reached.map(|bond| bond as u32).collect::<Vec<u32>>(), bonds);
        let mut admissible = (0..=PARTS).rev().find(|part| {
            state.load_factor = f64::from(*part) / f64::from(PARTS);
            let ratios = ratios(&mut equilibrium, &mut state, &nothing);
            ratios.iter().all(|ratio| *ratio <= 1.0)
        });
        let share = event[0].load_factor * f64::from(PARTS);
        let found = admissible.take().map_or(-1.0, f64::from);
        assert!(
            found <= share && share <= found + 1.0,
            "event {place}: {share} {found}"
        );
        falls += usize::from(place > 0 && event[0].load_factor < events[place - 1][0].load_factor);
        breakage = equilibrium.break_bonds(&mut state, &bonds);
    }
    assert!(falls > 3, "{falls}");
}

/// Through cycles of a load, with bonds that break at every new turn, work is stored and released energy to 1e-8, and at zero load an
/// unbroken body has given its work back.
#[test]
fn energies_balance_through_cycles() {
    let turns = [0.2, -0.2, 0.6, -0.6, 1.0, -1.0, 0.0];
    for analysis in [
        Analysis::Stepped(stepped(Vec::new())),
        Analysis::Event(event()),
    ] {
        let is_stepped = matches!(analysis, Analysis::Stepped(_));
        let mut setup = plate(
            analysis,
            vec![
                stage("press", "top", Course::to(0.5), is_stepped.then_some(2)),
                stage(
                    "cycles",
                    "right",
                    Course::through(&turns),
                    is_stepped.then_some(140),
                ),
            ],
        );
        setup.curve = Some("right".to_owned());
        let (outcome, recorder) = run(setup);
        let largest = outcome.history.iter().map(|it| it.external_work.abs());
        let largest = largest.fold(0.0, f64::max);
        assert!(recorder.breaks.len() > 20, "{}", recorder.breaks.len());
        for record in &outcome.history {
            assert!(record.missing_energy().abs() < 1e-8 * largest, "{record:?}");
        }
        let last = outcome.history.last().unwrap();
        assert_eq!(last.factors, [0.0, 0.5]);
        assert!(last.displacement == 0.0);
    }
}

/// From every moment of a run in stages it goes on to the same bits.
#[test]
fn runs_in_stages_go_on_to_the_same_bits() {
    let there_and_back = |steps: Option<usize>| {
        let mut stages = preloaded(steps);
        let turns = Course::through(&[0.2, 1.0]);
        stages.push(stage("turn", "right", turns, steps));
        let control = Control {
            quantity: Quantity::Probes(vec![("opening".to_owned(), 0.5)]),
            to: 3e-5,
        };
        stages.extend(steps.map(|_| Stage {
            control: Some(control),
            ..stage("open", "right", Course::to(1.5), steps)
        }));
        stages
    };
    for (analysis, steps) in [
        (Analysis::Stepped(stepped(Vec::new())), Some(12)),
        (Analysis::Event(event()), None),
    ] {
        let mut setup = plate(analysis.clone(), there_and_back(steps));
        setup.probes = vec![Probe {
            name: "opening".to_owned(),
            reading: Reading::Between {
                positions: [[0.025, 0.055], [0.095, 0.055]],
                component: Component::X,
            },
        }];
        let model = Model::build(setup, &mut ()).unwrap();
        let loading = Loading::new(&model.setup, &model.system).unwrap();
        let problem = loading.problem(&model.system, &model.criteria);
        let mut whole = Recorder {
            keeps_all: true,
            ..Recorder::default()
        };
        let outcome = follow(&problem, &analysis, &mut whole).unwrap();
        assert!(whole.moments.len() > 20);
        for (from, checkpoint) in &whole.moments {
            let restored = restore(&problem, &analysis, checkpoint).unwrap();
            let mut rest = Recorder {
                keeps_all: true,
                ..Recorder::default()
            };
            let again = resume(&analysis, restored, &mut rest).unwrap();
            assert!(rest.lines == whole.lines[*from..], "moment {from}");
            assert_eq!(again.state, outcome.state);
            assert_eq!(again.termination, outcome.termination);
        }
    }
}

/// An elastic body has a solution at the end of each part, and there all is a sum of what the loads do alone.
#[test]
fn elastic_answers_are_sums_over_the_loads() {
    let elastic = || Analysis::default();
    let reaction = |stages| {
        let (outcome, _) = run(plate(elastic(), stages));
        let of_record = |it: &StepRecord| it.reaction;
        outcome.history.iter().map(of_record).collect::<Vec<_>>()
    };
    let turns = Course::through(&[1.0, 0.5]);
    let both = reaction(vec![
        stage("press", "top", Course::to(1.0), None),
        stage("pull", "right", turns, None),
    ]);
    let pull = reaction(vec![stage("pull", "right", Course::to(1.0), None)]);
    let press = reaction(vec![stage("press", "top", Course::to(1.0), None)]);
    assert_eq!(both.len(), 4);
    let close =
        |one: f64, other: f64| assert!((one - other).abs() < 1e-9 * pull[1], "{one} {other}");
    close(both[1], press[1]);
    close(both[2], press[1] + pull[1]);
    close(both[3], press[1] + 0.5 * pull[1]);
}

/// The weight of a body under an acceleration is its mass times it: here 144 cells less those of the hole, 1 m thick.
#[test]
fn an_acceleration_acts_on_the_masses() {
    let mut setup = plate(Analysis::default(), Vec::new());
    let mut gravity = Load::new(Place::Everywhere, Action::Acceleration([0.0, -9.81]));
    gravity.name = "gravity".to_owned();
    setup.loads = vec![gravity];
    let (outcome, _) = run(setup);
    let cells = outcome.state.displacement.len() / 3;
    let weight = 2400.0 * 9.81 * 1e-4 * cells as f64;
    let found = outcome.history[1].reaction;
    assert!((found - weight).abs() < 1e-9 * weight, "{found} {weight}");
}

#[test]
fn stages_that_make_no_sense_say_so() {
    let error = |change: &dyn Fn(&mut Setup)| {
        let mut setup = plate(Analysis::Stepped(stepped(Vec::new())), preloaded(Some(4)));
        change(&mut setup);
        setup.solve(&mut Unobserved).unwrap_err().to_string()
    };
    assert_eq!(
        error(&|setup| setup.stages[1].loads[0].0 = "rihgt".to_owned()),
        "stages[1].loads: no load is called `rihgt`; did you mean `right`? there are: `right`, `top`"
    );
    assert_eq!(
        error(&|setup| setup.curve = Some("rigth".to_owned())),
        "curve: no load is called `rigth`; did you mean `right`? there are: `right`, `top`"
    );
    assert_eq!(
        error(&|setup| setup.stages[1].loads.clear()),
        "stages[1].loads: nothing changes in this stage: name a load with the factor that it goes to"
    );
    assert_eq!(
        error(&|setup| setup.stages[0].steps = None),
        "stages[0].steps: load steps are taken, and this stage has none: give it a number"
    );
    let twice = error(&|setup| setup.analysis = Analysis::Stepped(stepped(vec![1.0])));
    assert!(
        twice.starts_with("analysis.load_factors: the load steps are those of the stages"),
        "{twice}"
    );
    let idle = error(&|setup| setup.analysis = Analysis::Event(event()));
    assert!(
        idle.starts_with("stages[0].steps: only load steps have a number"),
        "{idle}"
    );
    let order = error(&|setup| {
        setup.stages[1].loads[0].1 = Course {
            points: vec![[0.5, 1.0], [0.4, 0.0]],
        };
    });
    assert!(
        order.starts_with("stages[1].loads: must be shares of the stage that grow"),
        "{order}"
    );
    let control = |probe: &str| Control {
        quantity: Quantity::Probes(vec![(probe.to_owned(), 1.0)]),
        to: 1e-5,
    };
    assert_eq!(
        error(&|setup| setup.stages[1].control = Some(control("mouth"))),
        "stages[1].control: no probe is called `mouth`"
    );
    let of_damage = error(&|setup| {
        setup.stages[1].control = Some(control("mouth"));
        setup.probes = vec![Probe {
            name: "mouth".to_owned(),
            reading: Reading::At {
                position: [0.055, 0.005],
                field: PointField::Damage,
            },
        }];
    });
    assert!(
        of_damage.contains("`mouth` reads no motion of points"),
        "{of_damage}"
    );
    let both = error(&|setup| {
        let Action::Displacement(pull) = setup.loads[0].action else {
            unreachable!();
        };
        let mut again = Load::new("right", Action::Displacement(pull));
        again.name = "again".to_owned();
        setup.loads.push(again);
    });
    assert!(both.contains("is moved by load `right` as well"), "{both}");
}

/// The plate, pulled at one point by a force or by a displacement, with bonds that cannot break around it.
fn pulled_at_a_point(action: Action, control: Option<Control>, criterion: Choice) -> Setup {
    let mut setup = plate(Analysis::Stepped(stepped(Vec::new())), Vec::new());
    let mut load = Load::new(Place::At([0.115, 0.065]), action);
    load.name = "hook".to_owned();
    setup.loads[0] = load;
    setup.no_fail = vec![Place::Box([[0.085, 0.0], [0.12, 0.12]])];
    setup.supports = vec![Support::new("left", &[Component::X, Component::Y])];
    setup.criteria = vec![criterion];
    setup.probes = vec![Probe {
        name: "hook".to_owned(),
        reading: Reading::At {
            position: [0.115, 0.065],
            field: PointField::Motion(Component::X),
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
    let mut choice: Choice = STRENGTH.into();
    choice.after = After {
        law: linear::LAW,
        parameter: Some(10.0),
    };
    choice
}

/// A force on a point that follows the displacement of that point is the reaction to that displacement: both go through the same states,
/// past the peak, brittle or softening. 1e-3 of the largest force where bonds soften: just past the
/// peak cracks may go on at one end or another, to which iterates of another kind come a little differently.
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
            criterion,
        ));
        let control = Control {
            quantity: Quantity::Probes(vec![("hook".to_owned(), 1.0)]),
            to: END,
        };
        let force = Action::Force([1e5, 0.0]);
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
    setup.precracks = vec![PreCrack {
        points: vec![[0.03, -0.001], [0.03, 0.081]],
        ends: Ends::Excluded,
    }];
    let turn = |(place, to): (usize, &f64)| {
        let control = Control {
            quantity: Quantity::Probes(vec![("hook".to_owned(), 1.0)]),
            to: *to,
        };
        // Under control the factor says no more than which way the load goes.
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
        let force = Action::Force([1e5, 0.0]);
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

/// A pressure that stays keeps a crack closed until the pull is larger: what a stage leaves closed is what the next one begins with, and
/// stages of one load are its list of factors, to the rounding of the factors.
#[test]
fn faces_close_in_stages() {
    let cycles = [-0.5, 1.0, -0.5];
    let cracked = |analysis, stages| {
        let mut setup = plate(analysis, stages);
        setup.closing = true;
        setup.precracks = vec![PreCrack {
            points: vec![[0.03, -0.001], [0.03, 0.081]],
            ends: Ends::Excluded,
        }];
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
    let refused = refused.solve(&mut Unobserved).unwrap_err().to_string();
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
        setup.loads = vec![Load::new("right", Action::Force([1e6, 0.0]))];
        setup.precracks = vec![PreCrack {
            points: vec![[0.03, -0.001], [0.03, 0.051]],
            ends: Ends::Excluded,
        }];
        setup.probes = vec![Probe {
            name: "mouth".to_owned(),
            reading: Reading::Between {
                positions: [[0.025, 0.005], [0.035, 0.005]],
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
    // With the same bonds the body is linear in the one force: its states are those of the line that leads to the next event.
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
