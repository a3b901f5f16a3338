//! Single output files at paths of the user, such as the file of `ligament plot --out`.
//!
//! An existing file is replaced only with the user's consent. Pipes, devices and `/dev/stdout` are written to; a link is neither replaced
//! nor followed to a file.

use std::fs::{self, File, FileType, OpenOptions};
use std::io::{self, Write};
use std::path::Path;

use crate::Error;
use crate::atomic::replace_regular;
use crate::remedy::{PathKind, Remedy, Resolution};

/// Kind of the object at the path of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PathContent {
    /// The path does not exist.
    Nothing,
    /// A regular file.
    File,
    /// A pipe, a device, or an open file of this process.
    Stream,
}

/// Fails as [`write_file`] would for the path, without writing: a check before the work of a command.
///
/// # Errors
///
/// If a file exists and may not be replaced, or the path can be neither replaced nor written to.
pub fn check_file(path: &Path, replace: bool) -> Result<(), Error> {
    match path_content(path)? {
        PathContent::File if !replace => {
            let remedy = Remedy::OtherPath(PathKind::File, Some(Resolution::Replace));
            Err(Error::FileExists(path.to_path_buf(), remedy))
        }
        _ => Ok(()),
    }
}

/// Writes `contents` to `path`: as a whole file, which replaces an earlier one only with `replace`, or into an existing pipe or device.
///
/// # Errors
///
/// As for [`check_file`], or if the system refuses.
pub fn write_file(path: &Path, contents: &[u8], replace: bool) -> Result<(), Error> {
    check_file(path, replace)?;
    replace_file(path, contents)
}

/// Writes `contents` to `path`, replacing an existing file, or into an existing pipe or device.
///
/// Contents of a file are written to a temporary file in the same folder (a rename works only within one file system), which is renamed to
/// `path`. On failure `path` is unchanged and the temporary file is removed.
///
/// # Errors
///
/// If the path is a link to a file or a folder, or cannot be written.
pub fn replace_file(path: &Path, contents: &[u8]) -> Result<(), Error> {
    replace_file_with(path, |out| out.write_all(contents))
}

/// Writes a file with a function, as [`replace_file`] writes contents.
///
/// # Errors
///
/// As for [`replace_file`], or if the function fails.
pub(crate) fn replace_file_with(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Error> {
    let written = match path_content(path)? {
        PathContent::Stream => write_stream(path, write),
        PathContent::Nothing | PathContent::File => replace_regular(path, write),
    };
    written.map_err(Error::system("write", path))
}

/// Whether a path is a pipe, a device or an open file of this process.
pub fn is_stream(path: &Path) -> bool {
    matches!(path_content(path), Ok(PathContent::Stream))
}

/// Whether a path is the standard output of this process.
pub fn is_standard_output(path: &Path) -> bool {
    descriptor(path) == Some(1)
}

fn path_content(path: &Path) -> Result<PathContent, Error> {
    if descriptor(path).is_some() {
        return Ok(PathContent::Stream);
    }
    // Other errors, such as a missing folder, are reported when the file is written.
    let Ok(found) = fs::symlink_metadata(path) else {
        return Ok(PathContent::Nothing);
    };
    let kind = found.file_type();
    // Writing through a link to a pipe or a device, such as many in /dev, destroys nothing.
    let target = fs::metadata(path).map(|it| it.file_type());
    match target {
        Ok(target) if is_pipe_or_device(target) => Ok(PathContent::Stream),
        _ if kind.is_symlink() => Err(Error::Link(path.to_path_buf())),
        _ if kind.is_file() => Ok(PathContent::File),
        _ => {
            let remedy = Remedy::OtherPath(PathKind::File, None);
            Err(Error::NoPlaceForFile(path.to_path_buf(), remedy))
        }
    }
}

#[cfg(unix)]
fn is_pipe_or_device(kind: FileType) -> bool {
    use std::os::unix::fs::FileTypeExt;
    // Disks, which writing would destroy, are excluded.
    kind.is_fifo() || kind.is_char_device()
}

#[cfg(not(unix))]
fn is_pipe_or_device(_: FileType) -> bool {
    false
}

/// Number of the open file of this process with a path such as `/dev/stdout` or `/dev/fd/3`.
///
/// Such a path is a link to an object opened by the shell, which may be a file.
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

fn write_stream(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    match descriptor(path) {
        // A file opened a second time would be overwritten from its beginning.
        Some(1) => {
            let mut stdout = io::stdout().lock();
            write(&mut stdout)?;
            stdout.flush()
        }
        Some(2) => write(&mut io::stderr().lock()),
        _ => write(&mut open_stream(path)?),
    }
}

/// Opens a stream for appending; a pipe blocks until it has a reader.
fn open_stream(path: &Path) -> io::Result<File> {
    OpenOptions::new().append(true).open(path)
}
