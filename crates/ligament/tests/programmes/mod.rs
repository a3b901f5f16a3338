//! Loads in stages: against one load factor, against fine steps, and from checkpoints.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use ligament::Loading;
use ligament::prelude::*;
use ligament::run::{follow, restore};
use ligament::setup::{Control, Quantity};
use ligament_analysis::breakage::Breakage;
use ligament_analysis::breaking::BreakingOrder;
use ligament_analysis::driver::Outcome;
use ligament_analysis::history::{
    BreakRecord, Moment, ObserverError, Onward, StepRecord, Termination, View,
};
use ligament_analysis::probe::PointField;
use ligament_analysis::{Attempt, BondDeformation, Equilibrium, LoadCourse, State};
use ligament_model::failure::softening::linear;

mod control;
mod dissipated_energy;

#[test]
fn factors_follow_straight_lines() {
    let cycle = Course::through(&[1.0, -1.0]);
    assert_eq!(cycle.points, [[0.5, 1.0], [1.0, -1.0]]);
    let at = |share: f64| cycle.at(share, 0.5);
    assert_eq!(
        [0.0, 0.25, 0.5, 0.75, 1.0].map(at),
        [0.5, 0.75, 1.0, 0.0, -1.0]
    );
    let table = Course {
        points: vec![[0.25, 2.0]],
    };
    assert_eq!(
        [0.125, 0.25, 1.0].map(|share| table.at(share, 0.0)),
        [1.0, 2.0, 2.0]
    );
}

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
        ("left", CellSet::left(1)),
        ("right", CellSet::right(1)),
        ("bottom", CellSet::bottom(1)),
        ("top", CellSet::top(1)),
    ];
    let sets = sets.map(|(name, set)| (name.to_owned(), set)).into();
    let body = LatticeBody::new([12, 12], [0.01; 2], [0.0; 2], &[hole], &sets).unwrap();
    let mut material = Material::isotropic(3e10, 0.2);
    material.tensile_strength = Some(3e6);
    material.density = Some(2400.0);
    let mut setup = Setup::new(body, material, Law::NHPD);
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

/// Bonds that broke; and, if wanted, the messages of a run with every digit, and its restart points.
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
            self.moments.push((self.lines.len(), moment.bytes()));
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

/// Follows a run, continues it from each of its restart points with the same bits, and returns the number of restart points.
fn goes_on_from_every_moment(setup: Setup, analysis: &Analysis) -> usize {
    let recorder = || Recorder {
        keeps_all: true,
        ..Recorder::default()
    };
    let model = Model::build(setup, &mut ()).unwrap();
    let loading = Loading::new(&model).unwrap();
    let problem = loading.problem(&model);
    let mut whole = recorder();
    let outcome = follow(&problem, analysis, &mut whole).unwrap();
    for (from, checkpoint) in &whole.moments {
        let restored = restore(&problem, analysis, &mut checkpoint.as_slice()).unwrap();
        let mut rest = recorder();
        let again = restored.resume(&mut rest).unwrap();
        assert!(rest.lines == whole.lines[*from..], "moment {from}");
        assert_eq!(again.state, outcome.state);
        assert_eq!(again.termination, outcome.termination);
    }
    whole.moments.len()
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

/// With the bonds that are left before each event, solutions at many load factors of the stage show the largest one at which all bonds are
/// within their limits: the exact path breaks the next bonds there, between this factor and the next higher one, and breaks just the bonds
/// that reach their limits at its load factor.
#[test]
fn the_exact_path_after_a_preload_is_that_of_a_search() {
    const PARTS: u32 = 400;
    let setup = plate(Analysis::Event(event()), preloaded(None));
    let model = Model::build(setup, &mut ()).unwrap();
    let loading = Loading::new(&model).unwrap();
    let problem = loading.problem(&model);
    let mut path = Recorder::default();
    follow(&problem, &model.setup.analysis, &mut path).unwrap();
    let first = problem.loads.course().unwrap();
    let pull = LoadCourse::new(first.programme.clone(), 1, &[0.0, 1.0]);
    let pull = problem.loads.in_course(pull).unwrap();
    let mut equilibrium = Equilibrium::new(&problem, 1e-4).unwrap();
    equilibrium.load_with(pull);
    let mut state = State::fresh(&**model.plane());
    let mut breakage = equilibrium.break_bonds(&mut state, &[]);
    let ratios = |equilibrium: &mut Equilibrium, state: &mut State, breakage: &Breakage| {
        let attempt = equilibrium
            .balance(state, breakage, &mut NoObserver)
            .unwrap();
        let Attempt::Balanced(balanced) = attempt else {
            panic!("{attempt:?}");
        };
        let ratio = |(bond, deformation): (usize, &BondDeformation)| match state.intact[bond] {
            true => model
                .criteria
                .without_state()
                .utilisation(bond, deformation),
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

/// Through cycles of a load, with bonds that break at every new reversal, work equals stored and released energy to 1e-8, and at zero load
/// an unbroken body has returned its work.
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

/// A run in stages continues with the same bits from each of its restart points.
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
                positions: [[0.025, 0.055, 0.0], [0.095, 0.055, 0.0]],
                component: Component::X,
            },
        }];
        assert!(goes_on_from_every_moment(setup, &analysis) > 20);
    }
}

/// An elastic body has a solution at the end of each part, which is the sum of the solutions for the single loads.
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
    let mut gravity = Load::new(Place::Everywhere, Action::Acceleration([0.0, -9.81, 0.0]));
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
        setup.solve(&mut NoObserver).unwrap_err().to_string()
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
                position: [0.055, 0.005, 0.0],
                field: PointField::named("damage").unwrap(),
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
