//! What this program was built from, as its build script found it.

use std::borrow::Cow;

use ligament_output::summary::{Build, Text};

/// The build of this program.
pub const BUILD: Build = Build {
    commit: known(env!("LIGAMENT_COMMIT")),
    uncommitted_changes: match env!("LIGAMENT_UNCOMMITTED").as_bytes() {
        b"true" => Some(true),
        b"false" => Some(false),
        _ => None,
    },
    profile: known(env!("LIGAMENT_PROFILE")),
    target: known(env!("LIGAMENT_TARGET")),
    compiler: known(env!("LIGAMENT_COMPILER")),
};

/// Version and commit, in words.
pub(crate) const VERSION: &str = env!("LIGAMENT_VERSION");

/// What is not empty.
const fn known(text: &'static str) -> Option<Text> {
    if text.is_empty() {
        None
    } else {
        Some(Cow::Borrowed(text))
    }
}
