//! Fixtures of the verification tests: meshes, benches and small mathematics.
//!
//! The tests lie beside this folder, one file for each question: do the numbers agree with an independent calculation
//! (`reference_values`), does the method keep what it must keep (`discretisation`, `lattice`, `symmetry`, `equilibrium`,
//! `breaking`, `connectivity`, `exact_path`), does it meet closed forms (`physics`, `loads`, `pressure`, `lame`, `exact_path`) and the
//! values of the papers (`published`), are the crates arranged as they should be (`architecture`, inside: `structure`) and are the cases in order
//! (`cases`).
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

pub mod bench;
pub mod cylinders;
pub mod impact;
pub mod meshes;
pub mod modal;
pub mod numbers;
pub mod problems;
pub mod recorder;
pub mod solid_run;
pub mod solids;
pub mod stresses;
pub mod table;
pub mod threads_as_ranks;
pub mod trusses;

use std::path::PathBuf;

/// The folder of the whole repository.
pub fn repository() -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    folder.parent().unwrap().to_owned()
}
