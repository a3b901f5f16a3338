//! The program: case files, command line and the pipeline from mesh to results
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

pub mod body;
pub mod case;
pub mod failure;
pub mod formulation;
pub mod gauges;
pub mod memory;
pub mod mesh_file;
pub mod model;
mod modes;
pub mod progress;
pub mod resolve;
pub mod run;
pub mod solve;
pub mod stages;
pub mod starter;
pub mod summary;
pub mod warnings;
pub mod watch;
