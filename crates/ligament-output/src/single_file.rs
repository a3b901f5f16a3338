//! Single files at places that people name, as that of `ligament plot --out`.
//!
//! A file that is there gives way only where its user says so. What is no file, as a pipe, a device or `/dev/stdout`, is written to
//! and stays what it is; a link is neither replaced nor followed to a file.

use std::fs::{self, File, FileType, OpenOptions};
use std::io::{self, Write};
use std::path::Path;

use crate::Error;
use crate::atomic::replace_regular;

/// What is at the place of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Occupant {
    /// Nothing.
    Nothing,
    /// A file.
    File,
    /// Something that takes bytes and keeps none: a pipe, a device, or an open file of this process.
    Stream,
}

/// Fails where [`write_file`] would because of what is at the place, and writes nothing: for a command to ask before its work begins.
///
/// # Errors
///
/// If a file is there and may not be replaced, or something that can be neither replaced nor written to.
pub fn check_file(path: &Path, replace: bool) -> Result<(), Error> {
    match occupant(path)? {
        Occupant::File if !replace => Err(Error::FileExists(path.to_path_buf())),
        _ => Ok(()),
    }
}

/// Writes `contents` to `path`: as a whole file, which takes the place of an earlier one only with `replace`, or into the pipe or
/// device that is there.
///
/// # Errors
///
/// As [`check_file`], or if the system refuses.
pub fn write_file(path: &Path, contents: &[u8], replace: bool) -> Result<(), Error> {
    check_file(path, replace)?;
    replace_file(path, contents)
}

/// Writes `contents` to `path`, replacing the file that is there; into a pipe or a device they are written.
///
/// A file's contents go to a temporary file in the same folder (a rename works only within one file system), which then takes the
/// name `path`. On failure `path` is as before and the temporary file is removed.
///
/// # Errors
///
/// If a link to a file or a folder is in the place, or it cannot be written.
pub fn replace_file(path: &Path, contents: &[u8]) -> Result<(), Error> {
    let written = match occupant(path)? {
        Occupant::Stream => write_stream(path, contents),
        Occupant::Nothing | Occupant::File => replace_regular(path, contents),
    };
    written.map_err(Error::system("write", path))
}

/// Whether what is written to a place goes elsewhere than to a file: into a pipe, a device or an open file of this process.
pub fn is_stream(path: &Path) -> bool {
    matches!(occupant(path), Ok(Occupant::Stream))
}

/// Whether a place is the standard output of this process.
pub fn is_standard_output(path: &Path) -> bool {
    descriptor(path) == Some(1)
}

fn occupant(path: &Path) -> Result<Occupant, Error> {
    if descriptor(path).is_some() {
        return Ok(Occupant::Stream);
    }
    // What else is the matter, as a folder that is missing, the system tells when the file is written.
    let Ok(found) = fs::symlink_metadata(path) else {
        return Ok(Occupant::Nothing);
    };
    let kind = found.file_type();
    // A link to a device, as many in /dev are, or to a pipe leads to nothing that could be lost.
    let target = fs::metadata(path).map(|it| it.file_type());
    match target {
        Ok(target) if is_pipe_or_device(target) => Ok(Occupant::Stream),
        _ if kind.is_symlink() => Err(Error::Link(path.to_path_buf())),
        _ if kind.is_file() => Ok(Occupant::File),
        _ => Err(Error::NoPlaceForFile(path.to_path_buf())),
    }
}

#[cfg(unix)]
fn is_pipe_or_device(kind: FileType) -> bool {
    use std::os::unix::fs::FileTypeExt;
    // Not a disk, which a page of results would make unreadable.
    kind.is_fifo() || kind.is_char_device()
}

#[cfg(not(unix))]
fn is_pipe_or_device(_: FileType) -> bool {
    false
}

/// The number of the open file of this process that a path such as `/dev/stdout` or `/dev/fd/3` names.
///
/// Such a path is a link to whatever the shell has opened, which may be a file.
#[cfg(unix)]
fn descriptor(path: &Path) -> Option<u32> {
    match path.to_str()? {
        "/dev/stdout" => return Some(1),
        "/dev/stderr" => return Some(2),
        _ => {}
    }
    let number = path.file_name()?.to_str()?.parse().ok()?;
    let [folder, own] = [path.parent()?, Path::new("/dev/fd")].map(|it| it.canonicalize().ok());
    (folder.is_some() && folder == own && fs::symlink_metadata(path).is_ok()).then_some(number)
}

#[cfg(not(unix))]
fn descriptor(_: &Path) -> Option<u32> {
    None
}

fn write_stream(path: &Path, contents: &[u8]) -> io::Result<()> {
    match descriptor(path) {
        // Opened a second time, a file would be written from its beginning by both.
        Some(1) => {
            let mut stdout = io::stdout().lock();
            stdout.write_all(contents)?;
            stdout.flush()
        }
        Some(2) => io::stderr().lock().write_all(contents),
        _ => opened(path)?.write_all(contents),
    }
}

/// A pipe waits here for its reader.
fn opened(path: &Path) -> io::Result<File> {
    OpenOptions::new().append(true).open(path)
}
