//! Places that a command writes to, as the command line has them.

use std::path::{Path, PathBuf};

use clap::builder::{PathBufValueParser, TypedValueParser};

/// What stands for standard output, as with many programs.
const STANDARD_OUTPUT: &str = "-";

/// A file to write.
pub(super) fn file() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().map(|path| match path == Path::new(STANDARD_OUTPUT) {
        true => PathBuf::from("/dev/stdout"),
        false => path,
    })
}

/// A folder to write.
pub fn folder() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| match path == Path::new(STANDARD_OUTPUT) {
        true => Err("the results are a folder, which standard output cannot take: name one"),
        false => Ok(path),
    })
}
