//! Drivers, one file for each way to follow a load program.

mod breaks;
mod checkpoint;
mod delayed_updates;
pub mod elastic;
mod energies;
mod equations;
pub mod event;
pub mod motion;
mod prediction;
mod prepared;
mod record;
mod run;
mod run_messages;
mod start;
pub mod stepped;
mod way;

pub use crate::breakage::Breakage;
pub use crate::problem::Problem;
pub use checkpoint::Restored;
pub use prediction::{FirstFailure, Prediction, StepOfFailure};
pub use prepared::Prepared;
pub use record::StepCounters;
pub use run::Run;
pub use start::stability_of;
pub use way::{LoadPoint, Outcome, Rows, Stop, StopRules, Way};
