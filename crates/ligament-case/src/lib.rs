//! The program: case files, command line and the pipeline from mesh to results
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

pub mod body;
pub mod calibrate;
pub mod case;
pub mod check;
pub mod cli;
pub mod explain;
pub mod failure;
pub mod formulation;
pub mod gauges;
pub mod inputs;
pub mod inspect;
pub mod line_fit;
pub mod memory;
pub mod mesh_command;
pub mod model;
mod modes;
pub mod progress;
pub mod quantities;
pub mod resolve;
pub mod run;
pub mod solve;
pub mod stages;
pub mod starter;
pub mod summary;
pub mod sweep;
pub mod verify;
pub mod warnings;
pub mod watch;
pub mod yielding;
