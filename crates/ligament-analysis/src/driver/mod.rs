//! Drivers, one file for each way to follow a load program.

mod beginning;
mod breaks;
mod course;
mod dissipation;
pub mod elastic;
mod ends;
pub mod event;
pub mod motion;
mod outcome;
mod parts;
mod path;
mod prediction;
mod prepared;
mod recorder;
mod remarks;
mod start;
pub mod stepped;
mod stop;

pub use crate::problem::Problem;
pub use course::Restored;
pub use outcome::{LoadPoint, Outcome, Rows};
pub use prediction::{FirstFailure, Prediction, StepOfFailure};
pub use prepared::Prepared;
pub use start::stability_of;
pub use stop::StopRules;
