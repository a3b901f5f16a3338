//! The Python package `ligament`: Python objects become a setup, and results of a run become arrays.
//!
//! The steps are those of the library, [`Setup`](ligament::Setup) to [`Model`](ligament::Model) to its outcome, in memory; sections are
//! those of a case ([`ligament_case`]). The interface for Python users is in `python/ligament`, which calls this module.
//!
//! | module | holds |
//! |---|---|
//! | `document` | conversion of Python objects to sections of a case |
//! | `body` | bodies from arrays |
//! | `case` | cases |
//! | `solution` | a run on a separate thread, with progress and Ctrl-C |
//! | `collector` | the observer that collects history, breakages and fields |
//! | `run` | results of a run, as arrays |
//! | `modes` | natural modes, as arrays |
//! | `table`, `arrays` | tables that grow by rows, arrays that are moved and not copied |
//! | `drawing` | pictures of results in memory |
//! | `calibration` | the next trial value of a key |
//! | `errors` | exceptions with key, line and hint |
//! | `program` | the command line |

mod arrays;
mod body;
mod calibration;
mod case;
mod collector;
mod document;
mod drawing;
mod errors;
mod in_file;
mod modes;
mod program;
mod run;
mod solution;
mod table;

/// The module `ligament._native`.
#[pyo3::pymodule(name = "_native")]
mod native {
    #[pymodule_export]
    use crate::body::Body;
    #[pymodule_export]
    use crate::calibration::{next_trial, numbers};
    #[pymodule_export]
    use crate::case::Case;
    #[pymodule_export]
    use crate::drawing::{Drawn, draw_curves};
    #[pymodule_export]
    use crate::modes::modes;
    #[pymodule_export]
    use crate::program::execute;
    #[pymodule_export]
    use crate::run::{Run, component_names, run};

    /// Version of the package.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
