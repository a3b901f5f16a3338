//! Where the program speaks to people: control characters of others' texts are shown, not sent.

use std::io::{self, Stderr, Stdout, Write};
use std::path::Path;

use ligament_output::is_standard_output;
use ligament_output::terminal::Plain;

/// Standard output.
pub fn stdout() -> Plain<Stdout> {
    Plain::new(io::stdout())
}

/// Standard error.
pub fn stderr() -> Plain<Stderr> {
    Plain::new(io::stderr())
}

/// Standard output, or standard error where a file that is written is standard output itself: words would spoil it.
pub fn beside(file: &Path) -> Box<dyn Write> {
    match is_standard_output(file) {
        true => Box::new(stderr()),
        false => Box::new(stdout()),
    }
}
