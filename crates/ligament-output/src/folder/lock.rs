//! Exclusive lock of a folder for writing.

use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use super::kind::LOCK;
use crate::Error;
use crate::atomic::process_number;
use crate::remedy::{PathKind, Remedy, Resolution};

/// A lock on a folder, which is released with this value or at the end of the process.
///
/// The lock is the system's on an open file, so that a killed process leaves none; the file has the number of the process. On file systems
/// without locks there is no lock.
#[derive(Debug)]
pub(super) struct FolderLock {
    path: PathBuf,
    _file: File,
}

impl FolderLock {
    /// Locks an existing folder.
    ///
    /// # Errors
    ///
    /// If another process has the lock, or the folder cannot be written.
    pub(super) fn take(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(LOCK);
        loop {
            let options = File::options()
                .read(true)
                .write(true)
                .create(true)
                .truncate(false)
                .open(&path);
            let mut file = options.map_err(Error::system("write", &path))?;
            match file.try_lock() {
                Err(TryLockError::WouldBlock) => return Err(busy_error(folder, &mut file)),
                Err(TryLockError::Error(error)) if !is_unsupported(&error) => {
                    return Err(Error::system("lock", &path)(error));
                }
                // The previous process with the lock may have removed the file since it was opened.
                _ if !is_in_place(&file, &path) => {}
                _ => {
                    let process = format!("{}\n", process_number());
                    let written = file
                        .set_len(0)
                        .and_then(|()| file.write_all(process.as_bytes()));
                    written.map_err(Error::system("write", &path))?;
                    return Ok(Self { path, _file: file });
                }
            }
        }
    }

    /// Fails if another process has the lock on a folder; changes nothing.
    pub(super) fn check(folder: &Path) -> Result<(), Error> {
        let Ok(mut file) = File::open(folder.join(LOCK)) else {
            return Ok(());
        };
        match file.try_lock_shared() {
            Err(TryLockError::WouldBlock) => Err(busy_error(folder, &mut file)),
            _ => Ok(()),
        }
    }

    /// Sets the path of the lock after its folder was renamed.
    pub(super) fn set_folder(&mut self, folder: &Path) {
        self.path = folder.join(LOCK);
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        // A remaining file is harmless: only its lock counts.
        let _ = fs::remove_file(&self.path);
    }
}

fn is_unsupported(error: &io::Error) -> bool {
    error.kind() == io::ErrorKind::Unsupported
}

fn busy_error(folder: &Path, file: &mut File) -> Error {
    let mut process = String::new();
    // A process that has just taken the lock may not have written its number yet.
    let _ = file.take(20).read_to_string(&mut process);
    Error::Busy {
        path: folder.to_path_buf(),
        process: process.trim().parse().ok(),
        remedy: Remedy::OtherPath(PathKind::Folder, Some(Resolution::Wait)),
    }
}

#[cfg(unix)]
fn is_in_place(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |it: fs::Metadata| (it.dev(), it.ino());
    let [open, there] = [file.metadata(), fs::metadata(path)].map(|it| it.map(identity).ok());
    open == there
}

/// Whether an open file is still at its path: always on systems that do not remove open files.
#[cfg(not(unix))]
fn is_in_place(_: &File, _: &Path) -> bool {
    true
}
