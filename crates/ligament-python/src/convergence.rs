//! Intervals of convergence of a case, in a folder.

use std::ffi::OsString;
use std::io;
use std::path::PathBuf;

use ligament_run::progress::ProgressMode;
use ligament_study::converge::{MeshSource, Request, converge};
use ligament_study::sweep::{Settings, Task};
use pyo3::prelude::*;

use crate::case::Case;
use crate::errors::Failure;

/// Options of [`compute_convergence`], by the names of its keyword arguments in Python.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Options {
    of: Vec<String>,
    geometry: Option<PathBuf>,
    numbers: Vec<(String, f64)>,
    split: bool,
    families: bool,
    fixed_horizon: bool,
    jobs: Option<usize>,
    gmsh: PathBuf,
}

/// Runs a case at two sizes of its points into a folder; `program` is the command that runs the program `ligament`.
#[pyfunction]
pub(crate) fn compute_convergence(
    py: Python<'_>,
    case: &Bound<'_, Case>,
    folder: PathBuf,
    options: Options,
    program: Vec<OsString>,
) -> PyResult<()> {
    let file = &case.get().file;
    let request = Request {
        case: file,
        out: Some(folder),
        source: MeshSource {
            geometry: options.geometry,
            numbers: options.numbers,
            size: None,
            split: options.split,
            gmsh: options.gmsh.clone(),
        },
        results: options.of,
        families: options.families,
        fixed_horizon: options.fixed_horizon,
        task: Task::Run(Settings {
            shard: None,
            jobs: options.jobs,
            memory: None,
            force: false,
            gmsh: options.gmsh,
            progress: ProgressMode::Quiet,
            program,
        }),
    };
    let done = py.detach(|| converge(&request, &mut io::sink()).map_err(Failure::from));
    done.map(|_| ()).map_err(|failure| failure.exception(py))
}
