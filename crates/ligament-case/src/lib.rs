//! A case: a text in TOML that becomes the setup of a body. It changes when a case is to say something else.
//!
//! | module | holds |
//! |---|---|
//! | [`case`] | sections, keys, faults with line and column, the schema, changes by `--set` |
//! | [`setup`] | the typed setup of a case, and its errors at the keys that they come from |
//! | [`input_file`] | files that a user names, read |
//! | [`mesh_file`] | the reader of the mesh that a case names |
//! | [`starter`] | a commented case to begin with |
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

pub mod case;
pub mod input_file;
pub mod mesh_file;
pub mod setup;
pub mod starter;
mod temperature_table;
