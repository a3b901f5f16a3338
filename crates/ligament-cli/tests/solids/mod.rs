//! Solids on the command line: the output of `inspect`, `new` and the other commands, and wrong inputs.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs;
use std::path::{Path, PathBuf};

mod block;
mod commands;
mod inspected;
mod starters;
mod wrong_inputs;

use crate::support::{ligament_in, stderr, stdout};
use block::Block;

fn meshes() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../meshes/solids")
}

/// A folder with a mesh `block.msh`.
fn folder_with(block: &Block) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("block.msh"), block.text()).unwrap();
    folder
}

/// Messages of the program, and whether it succeeded, in a folder with a case.
fn with_case(folder: &Path, case: &str, arguments: &[&str]) -> (bool, String) {
    fs::write(folder.join("case.toml"), case).unwrap();
    let output = ligament_in(folder, arguments);
    (
        output.status.success(),
        stdout(&output) + "\n" + &stderr(&output),
    )
}
