//! A run on a separate thread, for progress and Ctrl-C.

use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

use ligament::run::{follow, on_threads};
use ligament::system::AnySystem;
use ligament::{Loading, Model, Setup};
use ligament_analysis::ProportionalLoading;
use ligament_analysis::driver::Outcome;
use ligament_case::case::CaseFile;

use ligament_model::{BodyGrid, BondSystem, ConstantFields};
use ligament_run::loading::write_rule;
use ligament_run::memory;
use ligament_run::provenance::of_inputs;
use ligament_run::stages::Stages;
use ligament_run::summary::{self, Noted};
use pyo3::prelude::*;

use crate::case::Case;
use crate::collector::{Collector, Kept, Progress, Stop};
use crate::errors::Failure;

/// Time between two checks for a signal.
const LOOK: Duration = Duration::from_millis(50);

/// Results of a run in memory.
pub(crate) struct Solved {
    pub(crate) fixed: ConstantFields,
    pub(crate) arrays: SystemArrays,
    /// Thickness of the body, m; 1 for a solid.
    pub(crate) thickness: f64,
    pub(crate) grid: BodyGrid,
    pub(crate) outcome: Outcome,
    pub(crate) kept: Kept,
    /// Summary of the run, as in `summary.json`.
    pub(crate) summary: String,
}

/// Arrays over the points and bonds of a system.
pub(crate) struct SystemArrays {
    pub(crate) volumes: Vec<f64>,
    pub(crate) spacing: Vec<f64>,
    pub(crate) ends: Vec<[u32; 2]>,
    pub(crate) length: Vec<f64>,
    pub(crate) horizon: Vec<f64>,
    pub(crate) weight: Vec<f64>,
}

impl SystemArrays {
    /// The arrays of a system that is no longer needed.
    fn new<const D: usize>(system: BondSystem<D>) -> Self {
        Self {
            volumes: system.cloud.volumes,
            spacing: system.cloud.spacing,
            ends: system.bonds.ends,
            length: system.bonds.length,
            horizon: system.bonds.horizon,
            weight: system.weight,
        }
    }
}

/// Runs `work` on a separate thread without Python's global lock, calls `report` for its progress, and checks for signals; returns the
/// result of the work and whether it was stopped.
///
/// # Errors
///
/// If `report` fails; the work is then stopped.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    report: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(Sender<Progress>, &Stop) -> T + Send,
) -> PyResult<(T, bool)> {
    let (sender, receiver) = channel();
    let stop = Stop::default();
    let stop = &stop;
    let report = report.map(|it| it.clone().unbind());
    let (done, watched) = py.detach(move || {
        thread::scope(|scope| {
            let worker = scope.spawn(move || work(sender, stop));
            let watched = watch(&receiver, report.as_ref(), stop);
            let done = worker.join();
            (done, watched)
        })
    });
    let done = done.unwrap_or_else(|panic| std::panic::resume_unwind(panic));
    match watched {
        Err(error) if error.is_instance_of::<pyo3::exceptions::PyKeyboardInterrupt>(py) => {
            Ok((done, true))
        }
        Err(error) => Err(error),
        Ok(()) => Ok((done, false)),
    }
}

/// Reports progress until the work has ended; returns the first signal or failure, which stops the work.
fn watch(receiver: &Receiver<Progress>, report: Option<&Py<PyAny>>, stop: &Stop) -> PyResult<()> {
    let mut ended = Ok(());
    loop {
        let told = receiver.recv_timeout(LOOK);
        if matches!(told, Err(RecvTimeoutError::Disconnected)) {
            return ended;
        }
        let looked = Python::attach(|py| {
            py.check_signals()?;
            if let (Ok(progress), Some(report), false) = (told, report, stop.asked(1)) {
                let Progress {
                    step,
                    load_factor,
                    displacement,
                    reaction,
                    broken_bonds,
                } = progress;
                report.call1(
                    py,
                    (step, load_factor, displacement, reaction, broken_bonds),
                )?;
            }
            Ok(())
        });
        if looked.is_err() {
            stop.ask();
            ended = ended.and(looked);
        }
    }
}

/// Builds the model of a case and runs its analysis.
pub(crate) fn solve(
    case: &Case,
    progress: Sender<Progress>,
    stop: &Stop,
) -> Result<Solved, Failure> {
    let file = &case.file;
    let setup = case.setup()?;
    let solved = on_threads(setup.threads, || solve_here(file, setup, progress, stop));
    solved.map_err(|error| Failure::Other(error.into()))?
}

fn solve_here(
    case: &CaseFile,
    setup: Setup,
    progress: Sender<Progress>,
    stop: &Stop,
) -> Result<Solved, Failure> {
    let mut stages = Stages::default();
    memory::foresee_model(case, &setup).map_err(|it| Failure::Other(it.into()))?;
    let rule = write_rule(case, &setup.analysis);
    let model = stages.time("model", || Model::build(setup, &mut ()));
    let model = model.map_err(|it| Failure::setup(case, it))?;
    let loading = Loading::new(&model);
    let mut loading = loading.map_err(|it| Failure::setup(case, it))?;
    loading.solver.memory = memory::for_factor(case, &*model.system);
    let problem = loading.problem(&model);
    memory::foresee_equations(case, &*model.system, &problem)?;
    if stop.asked(1) {
        return Err(Failure::Stopped);
    }
    let grid = model.body().grid();
    let body = (&grid, model.system.ends());
    let mut collector = Collector::new(&problem, body, rule, progress, stop);
    let outcome = stages.time("solution", || {
        follow(&problem, &model.setup.analysis, &mut collector)
    });
    let kept = collector.kept;
    let outcome = match outcome {
        Err(_) if stop.asked(2) => return Err(Failure::Stopped),
        other => other.map_err(|it| Failure::computing(case, it))?,
    };
    let summary = summary(
        case,
        (&model, &loading.boundary),
        (&outcome, &kept),
        &stages,
    )?;
    let thickness = model.setup.thickness();
    drop(problem);
    drop(loading);
    let Model { system, fixed, .. } = model;
    // The model is no longer shared, so that its arrays can be taken.
    let arrays = match system {
        AnySystem::Plane(system) => system.into_parts().map(SystemArrays::new),
        AnySystem::Solid(system) => system.into_parts().map(SystemArrays::new),
    };
    let shared = || Failure::Other(anyhow::anyhow!("the points and bonds are still in use"));
    Ok(Solved {
        fixed,
        arrays: arrays.ok_or_else(shared)?,
        thickness,
        grid,
        outcome,
        kept,
        summary,
    })
}

/// Summary of a run, as in `summary.json`.
fn summary(
    case: &CaseFile,
    (model, boundary): (&Model, &ProportionalLoading),
    (outcome, kept): (&Outcome, &Kept),
    stages: &Stages,
) -> Result<String, Failure> {
    let provenance = of_inputs(ligament_cli::BUILD, Vec::new());
    let noted = Noted {
        provenance,
        notices: kept.notices.clone(),
        first: kept.first,
        stages: stages.done().to_vec(),
    };
    let summary = summary::summary(case, model, boundary, outcome, noted);
    serde_json::to_string(&summary).map_err(|error| Failure::Other(error.into()))
}
