//! A run on a separate thread, for progress and Ctrl-C.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

use ligament_case::case::CaseFile;
use ligament_cli::BUILD;
use ligament_run::end::StoppedBeforeSolution;
use ligament_run::progress::{ProgressMode, StepLine};
use ligament_run::run::Request;
use pyo3::prelude::*;

use crate::case::Case;
use crate::errors::Failure;

/// Time between two checks for a signal.
const LOOK: Duration = Duration::from_millis(50);

/// Number of the user's requests to stop: the first ends the run at the next state, the second immediately.
#[derive(Debug, Default)]
pub(crate) struct StopRequests(AtomicU8);

impl StopRequests {
    /// Adds a request to stop.
    fn add_request(&self) {
        self.0.fetch_add(1, Ordering::Relaxed);
    }

    /// Whether there were at least `times` requests.
    pub(crate) fn has_requests(&self, times: u8) -> bool {
        self.0.load(Ordering::Relaxed) >= times
    }
}

/// Runs a case into a folder, where results of an earlier run are replaced if `replace` is set; calls `report` with step, load factor,
/// displacement, force and number of broken bonds after each step. Returns whether Ctrl-C stopped the run.
#[pyfunction]
pub(crate) fn run(
    py: Python<'_>,
    case: &Bound<'_, Case>,
    folder: PathBuf,
    replace: bool,
    report: Option<&Bound<'_, PyAny>>,
) -> PyResult<bool> {
    let file = &case.get().file;
    let work = |steps, stop: &StopRequests| solve(file, (&folder, replace), steps, stop);
    let (solved, stopped) = run_watched(py, report, work)?;
    solved.map_err(|failure| failure.exception(py))?;
    Ok(stopped)
}

fn solve(
    file: &CaseFile,
    (folder, replace): (&Path, bool),
    steps: Sender<StepLine>,
    stop: &StopRequests,
) -> Result<(), Failure> {
    let request = Request {
        force: replace,
        is_stopped: &|| stop.has_requests(1),
        is_aborted: &|| stop.has_requests(2),
        keeps_inputs: true,
        steps: Some(steps),
        ..Request::new(file, folder, BUILD)
    };
    match request.run(ProgressMode::Quiet) {
        Err(_) if stop.has_requests(2) => Err(Failure::Stopped),
        Err(error) if error.is::<StoppedBeforeSolution>() => Err(Failure::Stopped),
        other => Ok(other.map(|_| ())?),
    }
}

/// Runs `work` on a separate thread without Python's global lock, calls `report` for its progress, and checks for signals; returns the
/// result of the work and whether it was stopped.
///
/// # Errors
///
/// If `report` fails; the work is then stopped.
pub(crate) fn run_watched<T: Send>(
    py: Python<'_>,
    report: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(Sender<StepLine>, &StopRequests) -> T + Send,
) -> PyResult<(T, bool)> {
    let (sender, receiver) = channel();
    let stop = StopRequests::default();
    let stop = &stop;
    let report = report.map(|it| it.clone().unbind());
    let (done, watched) = py.detach(move || {
        thread::scope(|scope| {
            let worker = scope.spawn(move || work(sender, stop));
            let watched = report_progress(&receiver, report.as_ref(), stop);
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
fn report_progress(
    receiver: &Receiver<StepLine>,
    report: Option<&Py<PyAny>>,
    stop: &StopRequests,
) -> PyResult<()> {
    let mut ended = Ok(());
    loop {
        let told = receiver.recv_timeout(LOOK);
        if matches!(told, Err(RecvTimeoutError::Disconnected)) {
            return ended;
        }
        let looked = Python::attach(|py| {
            py.check_signals()?;
            if let (Ok(line), Some(report), false) = (told, report, stop.has_requests(1)) {
                let [displacement, force] = [line.displacement, line.load];
                let [displacement, force] = [displacement, force].map(|it| it.unwrap_or(f64::NAN));
                let (step, factor, broken) = (line.step, line.load_factor, line.broken_bonds);
                report.call1(py, (step, factor, displacement, force, broken))?;
            }
            Ok(())
        });
        if looked.is_err() {
            stop.add_request();
            ended = ended.and(looked);
        }
    }
}
