//! The Python package `ligament`: Python objects become a setup, and results of a run become arrays.
//!
//! A run works as on the command line, into a folder of results; a result reads that folder. Sections are the sections of a case
//! ([`ligament_case`]). The interface for Python users is in `python/ligament`, which calls this module.
//!
//! | module | holds |
//! |---|---|
//! | `document` | conversion of Python objects to sections of a case |
//! | `body` | bodies from arrays, as files that a case reads |
//! | `stepped_run` | a run that advances row by row |
//! | `case` | cases |
//! | `solution` | a run on a separate thread, with progress and Ctrl-C |
//! | `convergence` | intervals of convergence of a case, in a folder |
//! | `ensemble` | samples of a case whose strength varies at random, in a folder |
//! | `folder` | results of a run in their folder, as arrays and words |
//! | `arrays` | arrays that are moved and not copied |
//! | `drawing` | pictures in memory |
//! | `calibration` | the next trial value of a key |
//! | `errors` | exceptions with key, line and hint |

mod arrays;
mod body;
mod calibration;
mod case;
mod convergence;
mod document;
mod drawing;
mod ensemble;
mod errors;
mod folder;
mod solution;
mod stepped_run;

use std::ffi::OsString;
use std::process::ExitCode;

use ligament_cli::program;
use pyo3::prelude::*;

/// The module `ligament._native`.
#[pyo3::pymodule(name = "_native")]
mod native {
    #[pymodule_export]
    use crate::body::{write_mesh, write_points, write_samples};
    #[pymodule_export]
    use crate::calibration::{next_trial, numbers};
    #[pymodule_export]
    use crate::case::Case;
    #[pymodule_export]
    use crate::convergence::compute_convergence;
    #[pymodule_export]
    use crate::drawing::{PythonDrawing, draw_curves, draw_fields};
    #[pymodule_export]
    use crate::ensemble::compute_ensemble;
    #[pymodule_export]
    use crate::folder::{Folder, report};
    #[pymodule_export]
    use crate::solution::run;
    #[pymodule_export]
    use crate::stepped_run::SteppedRun;
    #[pymodule_export]
    use crate::{execute, schema};

    /// Version of the package.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}

/// The JSON schema of a case file, with its keys, their units and their defaults.
#[pyfunction]
fn schema() -> String {
    ligament_case::case::schema().to_string()
}

/// Executes the program with its arguments, its name first, and returns the exit code; `itself` is the command that calls it.
#[pyfunction]
fn execute(py: Python<'_>, arguments: Vec<OsString>, itself: Vec<OsString>) -> u8 {
    let ended = py.detach(|| program::execute(&arguments, &itself));
    let mut codes = 0..=u8::MAX;
    codes
        .find(|&code| ExitCode::from(code) == ended)
        .unwrap_or(1)
}
