//! Paths of the cases, the meshes and the measured curves.

use std::path::{Path, PathBuf};

/// Path of the repository in which the program was built, which has the cases, meshes and curves.
pub(super) fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Folder of the table and of the measured curves.
pub(super) fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("experiments")
}
