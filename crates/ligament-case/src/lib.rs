//! A case: a text in TOML that becomes the setup of a body.
//!
//! | module | holds |
//! |---|---|
//! | [`case`] | sections, keys, faults with line and column, the schema, overrides by `--set` |
//! | [`setup`] | the typed setup of a case, and its errors at the responsible keys |
//! | [`input_file`] | the reader of the user's files |
//! | [`mesh_file`] | the reader of a case's mesh |
//! | [`point_table`] | tables of values at positions, and of bodies of points |
//! | [`starter`] | commented starter cases |
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

pub mod case;
pub mod input_file;
pub mod mesh_file;
pub mod point_table;
pub mod setup;
pub mod starter;
