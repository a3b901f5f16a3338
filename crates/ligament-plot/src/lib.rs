//! Pictures of stored results and plots of numbers, as SVG and PNG. It changes when something is to look otherwise.
//!
//! | module | draws |
//! |---|---|
//! | [`picture`] | fields, cracks, modes and histories from folders of results |
//! | [`plots`] | curves, polar diagrams and scatter, of numbers given in memory |
//! | [`stored_loading`] | nothing: what the loading of a stored run was like |
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

pub mod picture;
pub mod plots;
pub mod stored_loading;
