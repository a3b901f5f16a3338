//! Drivers: one file for each way to follow a loading.

mod course;
mod dissipation;
pub mod elastic;
mod ends;
pub mod event;
mod outcome;
mod overlap;
mod parts;
mod path;
mod recorder;
mod start;
pub mod stepped;

pub use crate::problem::Problem;
pub use course::Restored;
pub use outcome::{LoadPoint, Outcome, Rows};
pub use path::StopRules;
