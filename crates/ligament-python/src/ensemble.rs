//! Samples of a case whose strength or fracture energy varies at random, into a folder.

use std::io;
use std::path::PathBuf;

use ligament_run::progress::ProgressMode;
use ligament_study::ensemble::{Request, Settings, Task, ensemble};
use pyo3::prelude::*;

use crate::case::Case;
use crate::errors::Failure;
use crate::solution::run_watched;

/// Computes the samples of a case that a folder lacks: `wanted` are the number of samples, the seed, and the number of displacements of their
/// curves. Returns whether Ctrl-C stopped it.
#[pyfunction]
pub(crate) fn compute_ensemble(
    py: Python<'_>,
    case: &Bound<'_, Case>,
    wanted: (u64, u64, usize),
    folder: PathBuf,
) -> PyResult<bool> {
    let file = &case.get().file;
    let (samples, seed, points) = wanted;
    let (done, stopped) = run_watched(py, None, |_steps, stop| {
        let request = Request {
            case: file,
            samples,
            seed,
            points,
            displacement: None,
            out: &folder,
            is_stopped: &|| stop.has_requests(1),
            task: Task::Run(Settings {
                shard: None,
                jobs: None,
                force: false,
                progress: ProgressMode::Quiet,
            }),
        };
        ensemble(&request, &mut io::sink()).map_err(Failure::from)
    })?;
    done.map_err(|failure| failure.exception(py))?;
    Ok(stopped)
}
