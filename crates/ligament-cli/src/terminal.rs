//! Where the program speaks to people: control characters of others' texts are shown, not sent.

use std::io::{self, Stderr, Stdout};

use ligament_output::terminal::Plain;

/// Standard output.
pub fn stdout() -> Plain<Stdout> {
    Plain::new(io::stdout())
}

/// Standard error.
pub fn stderr() -> Plain<Stderr> {
    Plain::new(io::stderr())
}
