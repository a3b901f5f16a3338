//! A run of a case: from the file to a folder with its results. It changes when a run is to do, tell or write something else.
//!
//! | module | holds |
//! |---|---|
//! | [`run`] | the route of loads, and of natural modes |
//! | [`resume`] | going on with a run that was stopped, from its checkpoint |
//! | [`repeat`] | repeating a run from its record, and comparing both to the last bit |
//! | [`inputs`] | what decides about the results of a run |
//! | [`provenance`] | what results came from: program, processor, files |
//! | [`model`] | the discrete model of a case, its stages timed and shown |
//! | [`loading`] | a body under loads, and by which rule its results are written |
//! | [`end`] | how a run ended, as its exit code tells |
//! | [`summary`] | `summary.json`, and the lines at the end of a run |
//! | [`watch`], [`progress`] | the observer that writes results, and how far the run is |
//! | `processes`, `pieces` | what processes exchange, and what those beside rank 0 write |
//! | [`stages`], [`memory`], [`disk`] | time, memory and room on a disk that a run takes |
//! | `processors` | threads that other programs leave a processor to |
//! | [`gauges`] | rigid motions that nothing holds, in words |
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

mod checkpoints;
mod comparison;
mod destination;
pub mod disk;
pub mod end;
pub mod gauges;
pub mod inputs;
pub mod loading;
pub mod memory;
pub mod model;
mod modes;
pub mod notices;
mod pieces;
mod processes;
mod processors;
pub mod progress;
pub mod provenance;
pub mod repeat;
pub mod resume;
pub mod run;
pub mod stages;
pub mod summary;
pub mod watch;
