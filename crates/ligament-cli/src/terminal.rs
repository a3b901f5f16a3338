//! Standard output and standard error, with control characters of foreign texts shown, not sent.

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

/// Standard output for messages, or standard error where the written file is standard output itself.
pub fn beside(file: &Path) -> Box<dyn Write> {
    match is_standard_output(file) {
        true => Box::new(stderr()),
        false => Box::new(stdout()),
    }
}
