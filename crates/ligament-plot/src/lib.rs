//! Pictures of stored results and plots of numbers, as SVG, PNG, PDF and GIF.
//!
//! | module | draws |
//! |---|---|
//! | [`picture`] | fields, cracks, modes and histories from folders of results |
//! | [`plots`] | curves, polar diagrams and scatter, of numbers given in memory |
//! | [`drawing`] | paths and text that make up all pictures and plots, as files of each kind |
//! | [`stored_loading`] | nothing: reads the loading of a stored run |
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

pub mod drawing;
pub mod picture;
pub mod plots;
pub mod stored_loading;
