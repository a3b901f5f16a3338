//! The right to write to a folder, which one process at a time has.

use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use super::kind::LOCK;
use crate::Error;

/// A lock on a folder, which ends with this value or this process, however that ends.
///
/// The lock is the system's on an open file, so that none is left of a process that was killed; the file names the process.
/// Where a file system knows no locks there is none.
#[derive(Debug)]
pub(super) struct Lock {
    path: PathBuf,
    _file: File,
}

impl Lock {
    /// Takes the lock on a folder that is there.
    ///
    /// # Errors
    ///
    /// If another process has it, or the folder cannot be written.
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
                Err(TryLockError::WouldBlock) => return Err(busy(folder, &mut file)),
                Err(TryLockError::Error(error)) if !is_unknown(&error) => {
                    return Err(Error::system("lock", &path)(error));
                }
                // One who had it before may have removed the file since it was opened.
                _ if !is_in_place(&file, &path) => {}
                _ => {
                    let process = format!("{}\n", std::process::id());
                    let written = file
                        .set_len(0)
                        .and_then(|()| file.write_all(process.as_bytes()));
                    written.map_err(Error::system("write", &path))?;
                    return Ok(Self { path, _file: file });
                }
            }
        }
    }

    /// Fails where another process has the lock on a folder, and changes nothing.
    pub(super) fn check(folder: &Path) -> Result<(), Error> {
        let Ok(mut file) = File::open(folder.join(LOCK)) else {
            return Ok(());
        };
        match file.try_lock_shared() {
            Err(TryLockError::WouldBlock) => Err(busy(folder, &mut file)),
            _ => Ok(()),
        }
    }

    /// Goes on with a lock whose folder was renamed.
    pub(super) fn moved_to(&mut self, folder: &Path) {
        self.path = folder.join(LOCK);
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // A file that stays does no harm: only its lock counts.
        let _ = fs::remove_file(&self.path);
    }
}

fn is_unknown(error: &io::Error) -> bool {
    error.kind() == io::ErrorKind::Unsupported
}

fn busy(folder: &Path, file: &mut File) -> Error {
    let mut process = String::new();
    // A process that has just taken the lock may not have written its number yet.
    let _ = file.take(20).read_to_string(&mut process);
    Error::Busy {
        path: folder.to_path_buf(),
        process: process.trim().parse().ok(),
    }
}

#[cfg(unix)]
fn is_in_place(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |it: fs::Metadata| (it.dev(), it.ino());
    let [open, there] = [file.metadata(), fs::metadata(path)].map(|it| it.map(identity).ok());
    open == there
}

/// Systems without inodes do not remove a file that is open.
#[cfg(not(unix))]
fn is_in_place(_: &File, _: &Path) -> bool {
    true
}
