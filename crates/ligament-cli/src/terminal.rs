//! Standard output and standard error, with control characters of foreign texts shown, not sent.

use std::io::{self, Stderr, Stdout, Write};
use std::path::Path;

use ligament_output::is_standard_output;
use ligament_output::terminal::EscapedWriter;

/// Standard output.
pub fn stdout() -> EscapedWriter<Stdout> {
    EscapedWriter::new(io::stdout())
}

/// Standard error.
pub fn stderr() -> EscapedWriter<Stderr> {
    EscapedWriter::new(io::stderr())
}

/// Standard output for messages, or standard error where the written file is standard output itself.
pub fn for_messages(file: &Path) -> Box<dyn Write> {
    match is_standard_output(file) {
        true => Box::new(stderr()),
        false => Box::new(stdout()),
    }
}
