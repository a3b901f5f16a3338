//! A run of a case: from the file to a folder with its results.
//!
//! | module | holds |
//! |---|---|
//! | [`run`] | the run of a case under loads, or of natural modes |
//! | [`resume`] | resuming a stopped run from its checkpoint |
//! | [`repeat`], `comparison` | repeating a run from its record, and comparing both bitwise |
//! | [`inputs`] | the inputs that determine the results of a run |
//! | [`provenance`], `origin` | the origin of results: program, processor, files |
//! | [`model`] | the discrete model of a case, with its stages timed and shown |
//! | [`loading`] | a body under loads, and the rule by which its results are written |
//! | [`end`] | the end of a run and its exit code |
//! | [`stability`] | advice about a model that is unstable |
//! | [`messages`] | the messages of a run as the user reads them |
//! | [`summary`] | `summary.json`, and the lines at the end of a run |
//! | `destination`, `checkpoints` | the result folder while results are written, and its checkpoints |
//! | `run_time_estimate` | the time that a long run takes, shown before it begins |
//! | [`run_observer`], [`progress`] | the observers that write results, and the display of progress |
//! | `processes` | the communication of processes |
//! | [`stages`], [`memory`], [`disk`] | time, memory and disk space that a run needs |
//! | `processors` | the number of processors that other programs leave free |
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

mod checkpoints;
mod comparison;
mod destination;
pub mod disk;
pub mod end;
pub mod inputs;
pub mod loading;
pub mod memory;
pub mod messages;
pub mod model;
mod origin;
mod processes;
mod processors;
pub mod progress;
pub mod provenance;
mod refinement;
pub mod repeat;
pub mod resume;
pub mod run;
pub mod run_observer;
mod run_time_estimate;
pub mod stability;
pub mod stages;
pub mod summary;
