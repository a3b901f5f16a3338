//! The program: case files, command line and the pipeline from mesh to results
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

pub mod case;
pub mod gauges;
pub mod memory;
pub mod mesh_file;
pub mod model;
mod modes;
pub mod progress;
pub mod run;
pub mod setup;
pub mod stages;
pub mod starter;
pub mod summary;
mod temperature_table;
pub mod watch;
