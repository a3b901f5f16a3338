//! Peridynamics in memory: a typed setup in, a broken body out.
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

pub mod suggestion;
pub mod units;
