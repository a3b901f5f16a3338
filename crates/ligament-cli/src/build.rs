//! The build of this program, determined by its build script.

use std::borrow::Cow;

use ligament_output::summary::{Build, Text};

/// The build of this program.
pub const BUILD: Build = Build {
    commit: nonempty(env!("LIGAMENT_COMMIT")),
    uncommitted_changes: match env!("LIGAMENT_UNCOMMITTED").as_bytes() {
        b"true" => Some(true),
        b"false" => Some(false),
        _ => None,
    },
    profile: nonempty(env!("LIGAMENT_PROFILE")),
    target: nonempty(env!("LIGAMENT_TARGET")),
    compiler: nonempty(env!("LIGAMENT_COMPILER")),
};

/// Text of version and commit.
pub(crate) const VERSION: &str = env!("LIGAMENT_VERSION");

/// The text, or `None` if it is empty.
const fn nonempty(text: &'static str) -> Option<Text> {
    if text.is_empty() {
        None
    } else {
        Some(Cow::Borrowed(text))
    }
}
