//! Atomic writes of whole files.

use std::fs::{self, File};
use std::io::{self, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;

use crate::Error;

/// Name of a file that marks a folder, such as a temporary one, whose files need not survive a failure of the machine: they are not synced.
pub(crate) const UNSYNCED_MARKER: &str = ".passing";

/// Writes a file to `path` with a function, and moves the previous file to `older`; both are synced to disk when this returns.
///
/// At any moment at least one of the two files is complete.
///
/// # Errors
///
/// If the file cannot be written or renamed.
pub(crate) fn rotate_file(
    path: &Path,
    older: &Path,
    write: impl FnOnce(&mut File) -> io::Result<()>,
) -> Result<(), Error> {
    let rotate = || {
        let temporary = temporary_path(path)?;
        let moved = write_synced(&temporary, write).and_then(|()| {
            if path.exists() {
                fs::rename(path, older)?;
            }
            fs::rename(&temporary, path)?;
            sync_folder(path)
        });
        if moved.is_err() {
            let _ = fs::remove_file(&temporary);
        }
        moved
    };
    rotate().map_err(Error::system("write", path))
}

/// Removes a file, if it exists.
///
/// # Errors
///
/// If the file cannot be removed.
pub(crate) fn remove_file(path: &Path) -> Result<(), Error> {
    remove_if_there(path).map_err(Error::system("remove", path))
}

/// Removes a file, if it exists, with the system's error for callers with error types of their own.
///
/// # Errors
///
/// If the file cannot be removed.
pub fn remove_if_there(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Syncs the folder of a file to disk, on systems where that is possible and needed.
fn sync_folder(path: &Path) -> io::Result<()> {
    #[cfg(unix)]
    if let Some(folder) = path.parent().filter(|it| !it.as_os_str().is_empty()) {
        File::open(folder)?.sync_all()?;
    }
    #[cfg(not(unix))]
    let _ = path;
    Ok(())
}

/// Reads the text of a file.
///
/// # Errors
///
/// If the file cannot be read.
pub fn read_text(path: &Path) -> Result<String, Error> {
    let text = read_bytes(path).and_then(|bytes| {
        String::from_utf8(bytes)
            .map_err(|_| io::Error::new(io::ErrorKind::InvalidData, "it is no text"))
    });
    text.map_err(Error::system("read", path))
}

/// Reads a value from a file in JSON.
///
/// # Errors
///
/// If the file cannot be read, or its content is not such a value.
pub fn read_json<T: DeserializeOwned>(path: &Path) -> Result<T, Error> {
    serde_json::from_str(&read_text(path)?).map_err(|error| Error::Unreadable {
        path: path.to_owned(),
        reason: error.to_string(),
    })
}

/// Reads the bytes of a file.
pub(crate) fn read_bytes(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open_regular(path)?.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Opens a file; refuses a pipe or a device, which may never end.
pub(crate) fn open_regular(path: &Path) -> io::Result<File> {
    let kind = fs::metadata(path)?.file_type();
    match kind.is_file() || kind.is_dir() {
        true => File::open(path),
        false => Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "it is a pipe or a device",
        )),
    }
}

/// Renames a file or folder.
///
/// # Errors
///
/// If the system refuses.
pub fn rename(from: &Path, to: &Path) -> Result<(), Error> {
    fs::rename(from, to).map_err(Error::system("move", from))
}

/// Writes a temporary file beside `path` with a function, and renames it to `path`.
pub(crate) fn replace_regular(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let temporary = temporary_path(path)?;
    let write = |file: &mut File| {
        let mut buffered = BufWriter::new(file);
        write(&mut buffered)?;
        buffered.flush()
    };
    let written = write_synced(&temporary, write).and_then(|()| fs::rename(&temporary, path));
    if written.is_err() {
        // The first failure is the one to report; the temporary file may not even exist.
        let _ = fs::remove_file(&temporary);
    }
    written
}

fn write_synced(path: &Path, write: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<()> {
    // A leftover of a killed process with the same number; the target of a link in its place is never written.
    remove_if_there(path)?;
    let mut file = File::create_new(path)?;
    write(&mut file)?;
    // Full quotas and remote disks may report a failed write only here, before the rename.
    match path.with_file_name(UNSYNCED_MARKER).exists() {
        true => Ok(()),
        false => file.sync_all(),
    }
}

/// A hidden sibling of `path` that matches no pattern for result files and differs between processes.
fn temporary_path(path: &Path) -> io::Result<PathBuf> {
    let name = path.file_name().ok_or_else(|| {
        io::Error::new(
            io::ErrorKind::InvalidInput,
            "the path does not end in a file name",
        )
    })?;
    let mut hidden = std::ffi::OsString::from(".");
    hidden.push(name);
    hidden.push(format!(".{}.partial", process_number()));
    Ok(path.with_file_name(hidden))
}

/// Number of this process; 0 in WebAssembly, where processes have none.
pub(crate) fn process_number() -> u32 {
    match cfg!(target_family = "wasm") {
        true => 0,
        false => std::process::id(),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::replace_file;

    fn names_in(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn replaces_the_whole_file_and_leaves_no_temporary() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        replace_file(&path, b"a longer first text").unwrap();
        replace_file(&path, b"second").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert_eq!(names_in(folder.path()), ["a.txt"]);
    }

    #[test]
    fn a_folder_in_the_place_leaves_no_temporary() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("taken");
        fs::create_dir(&path).unwrap();
        let error = replace_file(&path, b"text").unwrap_err();
        assert!(matches!(error, Error::NoPlaceForFile(p, _) if p == path));
        assert_eq!(names_in(folder.path()), ["taken"]);
    }

    #[test]
    fn a_missing_folder_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("missing/a.txt");
        let error = replace_file(&path, b"text").unwrap_err();
        assert_eq!(
            error.to_string(),
            format!("cannot write {}", path.display())
        );
    }

    #[test]
    fn a_reader_sees_the_old_or_the_new_text() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        let texts = [vec![b'x'; 300_000], vec![b'y'; 200_000]];
        replace_file(&path, &texts[0]).unwrap();
        std::thread::scope(|scope| {
            let writer = scope.spawn(|| {
                for i in 0..20 {
                    replace_file(&path, &texts[i % 2]).unwrap();
                }
            });
            while !writer.is_finished() {
                let seen = fs::read(&path).unwrap();
                assert!(texts.contains(&seen), "a reader saw a half-written file");
            }
        });
    }
}
