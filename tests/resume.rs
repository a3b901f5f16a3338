//! Runs that were stopped and go on from a checkpoint, against runs that never stopped: to the last bit.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::time::Duration;

use ligament::{Error, Message, run};
use ligament_analysis::checkpoint::CheckpointError;
use ligament_analysis::costs::Costs;
use ligament_analysis::driver::Outcome;
use ligament_analysis::history::{
    BreakRecord, Moment, Observer, ObserverError, Onward, StepRecord, View,
};
use ligament_analysis::serial::Damaged;
use ligament_analysis::{SetupError, Termination};
use rayon::ThreadPoolBuilder;
use verification::bench::Bench;
use verification::numbers::Random;
use verification::problems::{DISK, SQUARE};

/// Keeps all that a run tells, as lines with every digit, and its moments.
#[derive(Default)]
struct Recorder {
    lines: Vec<String>,
    /// Checkpoints with the number of lines before them.
    moments: Vec<(usize, Vec<u8>)>,
    /// Of how many moments one is kept; 0: none.
    every: usize,
    /// The moment at which the run is stopped.
    stop_at: Option<usize>,
    n_moments: usize,
    /// Looks at the events alone that this divides; 0: at all.
    looks_every: usize,
}

impl Observer for Recorder {
    fn iteration(
        &mut self,
        iteration: usize,
        residual: f64,
        energy: f64,
    ) -> Result<(), ObserverError> {
        self.lines
            .push(format!("iteration {iteration} {residual:?} {energy:?}"));
        Ok(())
    }

    fn round(
        &mut self,
        step: usize,
        round: usize,
        load_factor: f64,
        broken: usize,
    ) -> Result<(), ObserverError> {
        self.lines
            .push(format!("round {step} {round} {load_factor:?} {broken}"));
        Ok(())
    }

    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        let lines = records.iter().map(|record| format!("{record:?}"));
        self.lines.extend(lines);
        Ok(())
    }

    fn message(&mut self, message: Message) -> Result<(), ObserverError> {
        self.lines.push(format!("{message:?}"));
        Ok(())
    }

    fn moment(&mut self, moment: &Moment<'_>) -> Result<Onward, ObserverError> {
        let number = self.n_moments;
        self.n_moments += 1;
        let is_stop = self.stop_at == Some(number);
        if is_stop || (self.every > 0 && number.is_multiple_of(self.every)) {
            let checkpoint = moment.bytes();
            self.moments.push((self.lines.len(), checkpoint));
        }
        Ok(if is_stop { Onward::Stop } else { Onward::Go })
    }

    fn looks(&self, step: usize) -> bool {
        self.looks_every == 0 || step.is_multiple_of(self.looks_every)
    }

    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        let deformations = &view.balanced.deformations;
        let is_last = view.is_last;
        self.lines.push(if view.is_whole {
            format!("{record:?} {:?} {deformations:?} {is_last}", view.state)
        } else {
            format!("{record:?} {:?} {is_last}", view.state.intact)
        });
        Ok(())
    }
}

/// An outcome in words, with every digit and without times.
fn words(mut outcome: Outcome) -> String {
    outcome.costs = Costs {
        analysis: Duration::ZERO,
        assembly: Duration::ZERO,
        factorisation: Duration::ZERO,
        change: Duration::ZERO,
        backward: Duration::ZERO,
        solve: Duration::ZERO,
        bonds: Duration::ZERO,
        connectivity: Duration::ZERO,
        ..outcome.costs
    };
    format!("{outcome:?}")
}

fn on_threads<T: Send>(count: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = ThreadPoolBuilder::new().num_threads(count).build().unwrap();
    pool.install(work)
}

/// Runs a bench once without a break, and on from one of `every` so many of its moments: what is told from there on, and the
/// outcome, are the same. Gives the number of runs that went on.
fn assert_resumes(name: &str, bench: &Bench, every: usize) -> usize {
    assert_resumes_looking(name, bench, every, 0)
}

/// Checks a run as [`assert_resumes`] does that looks at some events alone.
fn assert_resumes_looking(name: &str, bench: &Bench, every: usize, looks_every: usize) -> usize {
    let analysis = &bench.model.setup.analysis;
    let problem = bench.problem();
    let mut whole = Recorder {
        every,
        looks_every,
        ..Recorder::default()
    };
    let outcome = on_threads(1, || run::follow(&problem, analysis, &mut whole).unwrap());
    let broken = outcome.state.broken_bonds();
    let dissipated: f64 = outcome.state.dissipated.iter().sum();
    let changes = outcome.costs.changes;
    let expected = words(outcome);
    let mut largest = 0;
    for (number, (from, checkpoint)) in whole.moments.iter().enumerate() {
        let threads = 1 + number % 2;
        largest = largest.max(checkpoint.len());
        let mut rest = Recorder {
            looks_every,
            ..Recorder::default()
        };
        let outcome = on_threads(threads, || {
            let restored = run::restore(&problem, analysis, &mut checkpoint.as_slice()).unwrap();
            restored.resume(&mut rest).unwrap()
        });
        let place = format!("{name}, moment {}", number * every);
        let differs = (rest.lines.iter().zip(&whole.lines[*from..])).position(|(a, b)| a != b);
        assert_eq!(differs, None, "{place}: {}", whole.lines.len() - from);
        assert_eq!(rest.lines.len(), whole.lines.len() - from, "{place}");
        assert!(words(outcome) == expected, "{place}: the outcome differs");
    }
    let resumed = whole.moments.len();
    println!(
        "{name}: {broken} bonds broken, {changes} changes, resumed from {resumed} of {} moments, largest checkpoint {largest} bytes",
        whole.n_moments
    );
    assert!(dissipated > 0.0 && resumed > 2, "{name}");
    resumed
}

/// The disk, until so many bonds broke.
fn disk(settings: &[&str]) -> Bench {
    let stop = ["fracture.stop.bonds=60", COARSE];
    let settings: Vec<&str> = stop.iter().chain(settings).copied().collect();
    Bench::new(DISK, &settings)
}

const EVENT: &str = "fracture={ control = \"event\", stop = { bonds = 60 } }";

/// The disk of the reference: 324 points, 3717 bonds.
const COARSE: &str = "mesh.file=reference/disk.msh";

/// Parts of the body are those of a dissection.
const DISSECTION: &str = "solver.ordering=nested-dissection";

/// Springs and beams, definite and indefinite, with the factor changed in place, made anew now and then, and always.
#[test]
fn the_exact_path_goes_on_to_the_same_bits() {
    for law in ["nhpd", "bbpd", "pds", "mppd"] {
        let law_setting = format!("model.law={law}");
        let mut settings = vec![EVENT, COARSE, &law_setting];
        if law == "bbpd" {
            settings.push("material.poisson=0.333333333333333333");
        }
        if law == "mppd" {
            settings.push("model.rotational_stiffness=quarter");
        }
        assert_resumes(law, &Bench::new(DISK, &settings), 9);
    }
    let more: [&[&str]; 5] = [
        &["solver.rebuild_every=17"],
        &["solver.update=refactor"],
        &[
            "solver.factorisation=ldlt",
            "solver.ordering=nested-dissection",
        ],
        &["material.poisson=0.4"],
        &["material.poisson=0.4", "model.poisson=bonds"],
    ];
    for more in more {
        let settings: Vec<&str> = [&[EVENT, COARSE], more].concat();
        assert_resumes(&more.join(", "), &Bench::new(DISK, &settings), 7);
    }
}

/// Parts of the body are left behind between the events that are looked at, and moments lie at those. With a factor that is made anew in
/// between, and with points that come loose.
#[test]
fn the_exact_path_with_parts_left_behind_goes_on_to_the_same_bits() {
    let disk = [EVENT, COARSE, DISSECTION];
    assert_resumes_looking("left behind", &Bench::new(DISK, &disk), 1, 7);
    let cells = [EVENT, COARSE, DISSECTION, "material.poisson=0.4"];
    assert_resumes_looking("left behind, cells", &Bench::new(DISK, &cells), 1, 7);
    let anew = [EVENT, COARSE, DISSECTION, "solver.rebuild_every=17"];
    assert_resumes_looking("left behind, anew", &Bench::new(DISK, &anew), 1, 9);
    let square = ["fracture={ control = \"event\" }", DISSECTION];
    assert_resumes_looking("left behind, square", &Bench::new(SQUARE, &square), 1, 11);
}

#[test]
fn load_steps_go_on_to_the_same_bits() {
    for settings in [
        &["model.law=nhpd"][..],
        &["model.law=bbpd", "material.poisson=0.333333333333333333"],
        &["fracture.bonds_per_iteration=1", "solver.rebuild_every=17"],
        &["fracture.refine_first_break=3", "fracture.order=ratio"],
    ] {
        assert_resumes(&settings.join(", "), &disk(settings), 5);
    }
    // Up to a body in parts, with points that come loose and are held.
    assert_resumes("square", &Bench::new(SQUARE, &[]), 11);
    // Parts of the body are left behind within a step of more rounds than may pass before the whole body is solved.
    let behind = [
        COARSE,
        DISSECTION,
        "fracture.bonds_per_iteration=1",
        "fracture.stop.bonds=250",
    ];
    assert_resumes("left behind", &Bench::new(DISK, &behind), 1);
}

/// Conjugate gradients, whose preconditioner is of bonds that broke since: along both ways, to parts that come loose, with bonds that
/// soften and faces that close.
#[test]
fn conjugate_gradients_go_on_to_the_same_bits() {
    const CG: &str = "solver.method=iterative";
    assert_resumes("cg, exact path", &Bench::new(DISK, &[EVENT, COARSE, CG]), 9);
    assert_resumes("cg, load steps", &disk(&[CG]), 5);
    assert_resumes("cg, square", &Bench::new(SQUARE, &[CG]), 11);
    let soft = "fracture={ steps = 20, criterion = [{ kind = \"strength\", after = \"exponential\" }], stop = { bonds = 60 } }";
    assert_resumes(
        "cg, soft",
        &disk(&[CG, soft, "material.fracture_energy=200.0"]),
        5,
    );
    assert_resumes("cg, closing", &disk(&[CG, "model.closing=true"]), 9);
}

/// A lattice plate with a notch, which is pulled, or cooled between clamps.
const PLATE: &str = r#"
lattice = { cells = [12, 12], spacing = 0.002, set = { bottom = { bottom = 1 }, top = { top = 1 }, left = { left = 1 } } }
material = { young = 30e9, poisson = 0.3, fracture_energy = 100.0, tensile_strength = 3e6, thermal_expansion = 1e-5 }
model = { law = "mppd", horizon_factor = 3.0 }
precrack = [{ points = [[-0.001, 0.0121], [0.0081, 0.0121]] }]
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "top", displacement = { y = 1e-5 } }]
fracture = { steps = 40, stop = { load_fraction = 0.3 } }
probe = [{ name = "side", at = [0.0, 0.012], field = "displacement.x" }]
"#;

fn plate(settings: &[&str]) -> Bench {
    Bench::new(PLATE, settings)
}

/// Imaginary elements, whose bonds lean on others, and an orthotropic law with a temperature as the load.
#[test]
fn other_elements_and_loads_go_on_to_the_same_bits() {
    const MBB: [&str; 4] = [
        "load.0.displacement.y=4e-5",
        "model.law=mbb-pd",
        "fracture.stop.bonds=60",
        "fracture.criterion=[{ kind = \"mixed-mode\" }]",
    ];
    assert_resumes("mbb-pd", &plate(&MBB), 4);
    let exact = [
        MBB[0],
        MBB[1],
        "fracture={ control = \"event\", stop = { bonds = 60 } }",
    ];
    assert_resumes("mbb-pd, exact path", &plate(&exact), 4);
    let cooled = [
        "load=[]",
        "support=[{ group = \"bottom\", displacement = { x = 0.0, y = 0.0 } }, { group = \"top\", displacement = { x = 0.0, y = 0.0 } }]",
        "temperature=[{ change = -60.0 }]",
    ];
    assert_resumes("cooled", &plate(&cooled), 4);
    let forced = [
        "load=[{ group = \"top\", force = { y = 4e4 } }]",
        "fracture.stop={ bonds = 60 }",
    ];
    assert_resumes("under a force", &plate(&forced), 4);
    let closing = [
        "model.closing=true",
        "load.0.displacement.y=4e-5",
        "fracture={ steps = [0.5, 0.8, 1.0, 0.5, 0.0, -0.1, -0.5, 0.2, 1.0, -0.2] }",
    ];
    assert_resumes("with faces that close", &plate(&closing), 4);
}

/// Laws of bonds with a direction of the material, bars with conical weights, and beams: with load steps and along the exact path.
#[test]
fn laws_with_directions_and_beams_go_on_to_the_same_bits() {
    const ORTHOTROPIC: &str = "material={ young_1 = 30e9, young_2 = 12e9, poisson_12 = 0.25, shear_modulus = 6e9, angle = 30.0 }";
    const THIRD: &str = "material.poisson=0.333333333333333333";
    const STRETCH: &str = ", criterion = [{ kind = \"tension\", limit = 1e-4 }]";
    for (law, material, criterion) in [
        ("orthotropic", ORTHOTROPIC, STRETCH),
        ("bbpd-conical", THIRD, ""),
        ("mppd-beam", "material.poisson=0.25", ""),
    ] {
        let law = format!("model.law={law}");
        let fracture =
            |how: &str| format!("fracture={{ {how}, stop = {{ bonds = 60 }}{criterion} }}");
        let (stepped, event) = (fracture("steps = 40"), fracture("control = \"event\""));
        let settings = [&law, material, "load.0.displacement.y=4e-5", &stepped];
        assert_resumes(&law, &plate(&settings), 4);
        let exact = [&law, material, &event];
        assert_resumes(&format!("{law}, exact path"), &plate(&exact), 4);
    }
}

/// Far enough for bonds to soften.
const FURTHER: &str = "load.0.displacement.y=2e-4";

/// Bonds that soften by each law, two criteria at once, and a body that is loaded, unloaded and loaded again.
#[test]
fn softening_goes_on_to_the_same_bits() {
    for after in ["bilinear", "exponential"] {
        let criterion = format!(
            "fracture.criterion=[{{ kind = \"bond-energy\", limit = 1e-4, after = \"{after}\" }}]"
        );
        assert_resumes(after, &plate(&[&criterion, FURTHER]), 3);
    }
    let two = [
        "fracture.criterion=[{ kind = \"bond-energy\", limit = 1e-4, after = \"bilinear\" }, { kind = \"strength\" }]",
        "fracture.steps=[0.2, 0.4, 0.6, 0.3, 0.1, 0.3, 0.6, 0.7, 0.8, 0.9, 1.0]",
        "solver.rebuild_every=30",
        "load.0.displacement.y=6e-5",
    ];
    assert_resumes("two criteria, unloaded in between", &plate(&two), 3);
}

/// Criteria of stress: along the exact path, in load steps, and with bonds that began to soften by tension and by shear.
#[test]
fn criteria_of_stress_go_on_to_the_same_bits() {
    const PATCH: &str = "correction.surface=patch";
    let exact = "fracture={ control = \"event\", criterion = [{ kind = \"bond-rankine\" }], stop = { bonds = 60 } }";
    assert_resumes("bond-rankine, exact path", &plate(&[PATCH, exact]), 4);
    for kind in ["rankine", "mohr-coulomb"] {
        let criterion = format!("fracture.criterion=[{{ kind = \"{kind}\", after = \"linear\" }}]");
        let settings = [
            PATCH,
            &criterion,
            "material.compressive_strength=30e6",
            FURTHER,
        ];
        assert_resumes(kind, &plate(&settings), 3);
    }
}

/// A run that goes on from the moment where a rule ended it is one with the later rule from the start.
#[test]
fn a_run_that_a_rule_ended_can_be_prolonged() {
    for (short, long) in [
        (
            ["fracture.stop={ bonds = 12 }"].as_slice(),
            ["fracture.stop={ bonds = 45 }"].as_slice(),
        ),
        (
            &["fracture.steps=[0.2, 0.25, 0.27]"],
            &["fracture.steps=[0.2, 0.25, 0.27, 0.3, 0.25, 0.35]"],
        ),
        // Ended while it was unloaded, and loaded again: what it carries in between is no end.
        (
            &["fracture.steps=[0.2, 0.27, 0.05]"],
            &["fracture.steps=[0.2, 0.27, 0.05, 0.07, 0.35]"],
        ),
        (
            &["fracture={ control = \"event\", stop = { displacement = 2.5e-6 } }"],
            &["fracture={ control = \"event\", stop = { bonds = 45 } }"],
        ),
    ] {
        let (short, long) = (plate(short), plate(long));
        let mut last = LastMoment::default();
        let ended = run::follow(&short.problem(), &short.model.setup.analysis, &mut last).unwrap();
        assert!(ended.termination.is_by_rule(), "{}", ended.termination);
        let (problem, analysis) = (long.problem(), &long.model.setup.analysis);
        let restored = run::restore(&problem, analysis, &mut last.0.as_slice()).unwrap();
        let prolonged = restored.resume(&mut Recorder::default()).unwrap();
        let whole = run::follow(&problem, analysis, &mut Recorder::default()).unwrap();
        assert!(prolonged.state.broken_bonds() > ended.state.broken_bonds());
        assert_eq!(words(prolonged), words(whole));
    }
}

/// Keeps the checkpoint of the moment in which the run ended.
#[derive(Default)]
struct LastMoment(Vec<u8>);

impl Observer for LastMoment {
    fn moment(&mut self, moment: &Moment<'_>) -> Result<Onward, ObserverError> {
        if moment.end.is_some() {
            self.0 = moment.bytes();
        }
        Ok(Onward::Go)
    }

    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        Ok(())
    }
}

/// A run that an observer stops tells so, shows its last state, and goes on to the same bits.
#[test]
fn an_observer_stops_a_run() {
    let bench = plate(&[]);
    let (problem, analysis) = (bench.problem(), &bench.model.setup.analysis);
    let whole = run::follow(&problem, analysis, &mut Recorder::default()).unwrap();
    let mut stopped = Recorder {
        stop_at: Some(20),
        ..Recorder::default()
    };
    let outcome = run::follow(&problem, analysis, &mut stopped).unwrap();
    assert_eq!(outcome.termination, Termination::Stopped);
    assert_eq!(outcome.termination.name(), "stopped");
    assert!(
        stopped.lines.last().unwrap().ends_with("true"),
        "the last state is told as the last"
    );
    let restored = run::restore(&problem, analysis, &mut stopped.moments[0].1.as_slice()).unwrap();
    let outcome = restored.resume(&mut Recorder::default()).unwrap();
    assert_eq!(words(outcome), words(whole));
}

/// The reason why a bench refuses a checkpoint.
fn refusal(bench: &Bench, mut checkpoint: &[u8]) -> CheckpointError {
    let restored = run::restore(
        &bench.problem(),
        &bench.model.setup.analysis,
        &mut checkpoint,
    );
    match restored.err() {
        Some(Error::Equations(SetupError::Checkpoint(reason))) => reason,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_checkpoint_of_another_run_is_refused() {
    let bench = plate(&["fracture.stop={ bonds = 12 }"]);
    let mut last = LastMoment::default();
    run::follow(&bench.problem(), &bench.model.setup.analysis, &mut last).unwrap();
    let checkpoint = last.0;
    let other = |settings: &[&str]| refusal(&plate(settings), &checkpoint);
    assert_eq!(
        other(&["lattice.cells=[12, 13]"]),
        CheckpointError::OtherModel
    );
    assert_eq!(
        other(&["fracture={ control = \"event\" }"]),
        CheckpointError::OtherDriver
    );
    assert_eq!(
        other(&["fracture.steps=[0.025, 0.06, 1.0]"]),
        CheckpointError::OtherLoading { step: 2, was: 0.05 }
    );
    // The same numbers of everything, and another stiffness.
    assert_eq!(
        other(&["material.young=31e9"]),
        CheckpointError::OtherArithmetic
    );
    let soft =
        "fracture.criterion=[{ kind = \"bond-energy\", limit = 1e-4, after = \"bilinear\" }]";
    assert_eq!(other(&[soft]), CheckpointError::OtherModel);
}

/// Bytes cut anywhere are refused, and changed ones too unless nothing hangs on them: without a panic and without much memory.
#[test]
fn a_damaged_checkpoint_is_refused() {
    let bench = plate(&["fracture.stop={ bonds = 12 }"]);
    let mut last = LastMoment::default();
    run::follow(&bench.problem(), &bench.model.setup.analysis, &mut last).unwrap();
    let whole = last.0;
    for cut in 0..60 {
        let end = cut * whole.len() / 60;
        assert_eq!(
            refusal(&bench, &whole[..end]),
            CheckpointError::Damaged(Damaged),
            "{end} of {} bytes",
            whole.len()
        );
    }
    let mut random = Random(7);
    let mut n_refused = 0;
    for _ in 0..300 {
        let mut changed = whole.clone();
        let place = ((random.uniform() + 1.0) / 2.0 * changed.len() as f64) as usize;
        changed[place] = ((random.uniform() + 1.0) * 128.0) as u8;
        let restored = run::restore(
            &bench.problem(),
            &bench.model.setup.analysis,
            &mut changed.as_slice(),
        );
        n_refused += usize::from(restored.is_err());
    }
    println!("{n_refused} of 300 changed checkpoints refused");
    assert!(n_refused > 30);
}
