//! The program `ligament`: its commands and their reports, without computations.
//!
//! | module | holds |
//! |---|---|
//! | [`commands`] | a file for each command: its options, its help and its execution |
//! | [`check`] | report of `ligament check` on a case |
//! | [`cite`] | references as BibTeX |
//! | [`explain`] | report of `ligament explain` on the bonds of a stored run |
//! | [`inspect`] | report of `ligament inspect` on a mesh |
//! | [`program`] | from the arguments to the exit code |
//! | [`terminal`] | standard output and standard error |
//! | `build` | commit and compiler of the program |
//! | `lines` | lines of reports: names with values, aligned columns |
//! | `processes` | the processes of a run |
//! | `stop_signal` | signals that stop a run, files beyond a size limit |
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

mod build;
pub mod check;
pub mod cite;
pub mod commands;
pub mod explain;
pub mod inspect;
mod lines;
mod processes;
pub mod program;
mod stop_signal;
pub mod terminal;

pub use build::BUILD;
pub use commands::Cli;
