//! Runs that were stopped and go on from a checkpoint, against runs that never stopped: to the last bit.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::time::Duration;

use ligament::run;
use ligament_analysis::costs::Costs;
use ligament_analysis::driver::Outcome;
use ligament_analysis::history::{
    BreakRecord, Moment, Notice, Observer, ObserverError, Onward, StepRecord, View,
};
use rayon::ThreadPoolBuilder;
use verification::bench::Bench;
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

    fn notice(&mut self, notice: &Notice) -> Result<(), ObserverError> {
        self.lines.push(format!("{notice:?}"));
        Ok(())
    }

    fn moment(&mut self, moment: &Moment<'_>) -> Result<Onward, ObserverError> {
        let number = self.n_moments;
        self.n_moments += 1;
        let is_stop = self.stop_at == Some(number);
        if is_stop || (self.every > 0 && number.is_multiple_of(self.every)) {
            let checkpoint = (moment.checkpoint)();
            self.moments.push((self.lines.len(), checkpoint));
        }
        Ok(if is_stop { Onward::Stop } else { Onward::Go })
    }

    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        let deformations = &view.balanced.deformations;
        self.lines.push(format!(
            "{record:?} {:?} {deformations:?} {}",
            view.state, view.is_last
        ));
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
    let analysis = &bench.model.setup.analysis;
    let problem = bench.problem();
    let mut whole = Recorder {
        every,
        ..Recorder::default()
    };
    let outcome = on_threads(1, || run::follow(&problem, analysis, &mut whole).unwrap());
    let broken = outcome.state.broken_bonds();
    let changes = outcome.costs.changes;
    let expected = words(outcome);
    let mut largest = 0;
    for (number, (from, checkpoint)) in whole.moments.iter().enumerate() {
        let threads = 1 + number % 2;
        largest = largest.max(checkpoint.len());
        let mut rest = Recorder::default();
        let outcome = on_threads(threads, || {
            let restored = run::restore(&problem, analysis, checkpoint).unwrap();
            run::resume(&problem, analysis, restored, &mut rest).unwrap()
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
    assert!(broken > 0 && resumed > 2, "{name}");
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
    let more: [&[&str]; 4] = [
        &["solver.rebuild_every=17"],
        &["solver.update=refactor"],
        &[
            "solver.factorisation=ldlt",
            "solver.ordering=nested-dissection",
        ],
        &["material.poisson=0.4"],
    ];
    for more in more {
        let settings: Vec<&str> = [&[EVENT, COARSE], more].concat();
        assert_resumes(&more.join(", "), &Bench::new(DISK, &settings), 7);
    }
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
}
