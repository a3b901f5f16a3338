//! Peridynamics in memory: a typed setup in, a broken body out.
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

pub mod body;
pub mod error;
pub mod formulation;
pub mod loading;
pub mod model;
pub mod run;
pub mod setup;
pub mod stage;
pub mod suggestion;
pub mod units;
pub mod warning;

pub use body::Body;
pub use error::{Error, Fault, Field, SetupError};
pub use loading::{Loading, Vibration};
pub use model::Model;
pub use setup::Setup;
pub use warning::Warning;
