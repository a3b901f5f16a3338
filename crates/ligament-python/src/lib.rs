//! The Python package `ligament`: Python objects become a setup, and results of a run become arrays.
//!
//! A run works as on the command line, into a folder of results; a result reads that folder. Sections are the sections of a case
//! ([`ligament_case`]). The interface for Python users is in `python/ligament`, which calls this module.
//!
//! | module | holds |
//! |---|---|
//! | `document` | conversion of Python objects to sections of a case |
//! | `body` | bodies from arrays, as files that a case reads |
//! | `by_hand` | a run that advances row by row |
//! | `case` | cases |
//! | `keys` | the keys of a case |
//! | `solution` | a run on a separate thread, with progress and Ctrl-C |
//! | `ensemble` | samples of a case whose strength varies at random, in a folder |
//! | `folder` | results of a run in their folder, as arrays and words |
//! | `arrays` | arrays that are moved and not copied |
//! | `drawing` | pictures in memory |
//! | `calibration` | the next trial value of a key |
//! | `errors` | exceptions with key, line and hint |
//! | `program` | the command line |

mod arrays;
mod body;
mod by_hand;
mod calibration;
mod case;
mod document;
mod drawing;
mod ensemble;
mod errors;
mod folder;
mod keys;
mod program;
mod solution;

/// The module `ligament._native`.
#[pyo3::pymodule(name = "_native")]
mod native {
    #[pymodule_export]
    use crate::body::{write_mesh, write_points, write_samples};
    #[pymodule_export]
    use crate::by_hand::Rows;
    #[pymodule_export]
    use crate::calibration::{next_trial, numbers};
    #[pymodule_export]
    use crate::case::Case;
    #[pymodule_export]
    use crate::drawing::{Drawn, draw_curves, draw_fields};
    #[pymodule_export]
    use crate::ensemble::compute_ensemble;
    #[pymodule_export]
    use crate::folder::{Folder, report};
    #[pymodule_export]
    use crate::keys::schema;
    #[pymodule_export]
    use crate::program::execute;
    #[pymodule_export]
    use crate::solution::run;

    /// Version of the package.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
