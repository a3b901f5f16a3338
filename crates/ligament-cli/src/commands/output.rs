//! Output paths on the command line.

use std::path::{Path, PathBuf};

use clap::builder::{PathBufValueParser, TypedValueParser};

/// Path that stands for standard output, as in many programs.
const STANDARD_OUTPUT: &str = "-";

/// Parser of the path of a file to write.
pub(super) fn file() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().map(|path| match path == Path::new(STANDARD_OUTPUT) {
        true => PathBuf::from("/dev/stdout"),
        false => path,
    })
}

/// Parser of the path of a folder to write.
pub fn folder() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| match path == Path::new(STANDARD_OUTPUT) {
        true => Err("the results are a folder, which standard output cannot take: name one"),
        false => Ok(path),
    })
}
