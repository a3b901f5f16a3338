//! The program `ligament`: its commands, and what they tell people. Nothing here computes.
//!
//! | module | holds |
//! |---|---|
//! | [`commands`] | a file for each command: its options, its help and what it calls |
//! | [`check`] | what `ligament check` tells of a case |
//! | [`explain`] | what `ligament explain` tells of the bonds of a stored run |
//! | [`inspect`] | what `ligament inspect` tells of a mesh |
//! | [`program`] | from the arguments to the exit code |
//! | [`terminal`] | where the program speaks to people |
//! | `build` | the commit and the compiler that the program is from |
//! | `lines` | lines of reports: names with what they are, aligned columns |
//! | `ranks` | the processes that a run is one of |
//! | `stop_signal` | the wish that a run stop, files beyond a limit |
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

mod build;
pub mod check;
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
