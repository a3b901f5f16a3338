//! The folder of a study: its marker, its subfolders, and its locks.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

use ligament_output::Error;
use ligament_output::folder::{Kind, ResultFolder, refuse_link};

/// Number of checks of a folder that another shard may be marking, and the pause between them.
const LOOKS: usize = 20;
const PAUSE: Duration = Duration::from_millis(50);

/// Name of the lock of a whole study, whatever its kind.
const WHOLE: &str = "sweep";

/// The folder of a study.
#[derive(Debug, Clone)]
pub struct StudyFolder {
    path: PathBuf,
    /// File that marks a folder of this kind of study.
    marker: &'static str,
}

/// Error of the folder of a study.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// The folder is in use.
    #[error(
        "another study works on {} ({what}); wait for its end, or give this one its own folder by --out", folder.display()
    )]
    Busy {
        /// Folder of the study.
        folder: PathBuf,
        /// Description of the study that uses the folder.
        what: String,
    },
    /// The folder is not of a study.
    #[error("{} is no folder of a study (no {marker} in it): run the study first, or name its folders by --from", folder.display())]
    NoStudy {
        /// Folder of the study.
        folder: PathBuf,
        /// Name of the missing marker file.
        marker: &'static str,
    },
    /// A file of the folder cannot be used.
    #[error(transparent)]
    File(#[from] Error),
}

/// A part of the runs: those whose index, from 0, is `number - 1` modulo `count`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Number of the shard, from 1.
    pub number: usize,
    /// Number of shards.
    pub count: usize,
}

impl Shard {
    /// Whether a shard, or the whole study without one, contains the run with an index, from 0.
    pub(crate) fn contains(shard: Option<Self>, index: usize) -> bool {
        shard.is_none_or(|it| index % it.count == it.number - 1)
    }

    /// Name of the files of a shard, or of the whole study without one.
    pub(crate) fn file_name(shard: Option<Self>, whole: &str) -> String {
        match shard {
            None => whole.to_owned(),
            Some(Self { number, count }) => format!("shard-{number}-of-{count}"),
        }
    }
}

/// Locks for running a study, or a shard of it, in a folder; released at the end of this process.
#[derive(Debug)]
pub struct StudyLocks {
    _locks: Vec<File>,
    /// Lock file of the runs, which each run locks until it ends.
    pub runs: PathBuf,
}

impl StudyFolder {
    /// The folder at a path, existing or not, of a study whose folders have a file of this name.
    pub(crate) fn with_marker(marker: &'static str, path: impl Into<PathBuf>) -> Self {
        let path = path.into();
        Self { path, marker }
    }

    /// The folders with runs to collect: those that are named, or else the study's own.
    ///
    /// # Errors
    ///
    /// If one is not marked as the folder of such a study.
    pub(crate) fn folders_to_collect(
        marker: &'static str,
        own: &Path,
        named: &[PathBuf],
    ) -> Result<Vec<Self>, FolderError> {
        let own = [own.to_owned()];
        let paths = if named.is_empty() { &own } else { named };
        let marked = |path: &PathBuf| match Self::with_marker(marker, path) {
            folder if folder.is_marked() => Ok(folder),
            Self { path, marker } => Err(FolderError::NoStudy {
                folder: path,
                marker,
            }),
        };
        paths.iter().map(marked).collect()
    }

    /// Creates the folder with the text of its marker, or opens an earlier one, with the given subfolders and the subfolder of the locks.
    ///
    /// # Errors
    ///
    /// If the path is something else, or cannot be written.
    pub(crate) fn create_or_open(self, marker: &str, subfolders: &[&str]) -> anyhow::Result<Self> {
        for look in 0.. {
            if self.is_marked() {
                break;
            }
            match ResultFolder::create_of_kind(&self.path, Kind::with_marker(self.marker), false) {
                Ok(new) => {
                    new.write(self.marker, marker)?;
                    break;
                }
                // Another shard may have created the folder without marking it yet.
                Err(_) if look < LOOKS && self.is_fresh() => thread::sleep(PAUSE),
                Err(error) => return Err(error.into()),
            }
        }
        for name in subfolders.iter().chain(&["locks"]) {
            let path = self.path.join(name);
            refuse_link(&path)?;
            fs::create_dir_all(&path).map_err(Error::system("create", &path))?;
        }
        Ok(self)
    }

    /// Whether the folder is marked as the folder of a study.
    pub fn is_marked(&self) -> bool {
        self.path.join(self.marker).is_file()
    }

    /// Whether the folder has no files except files of a shard that is marking it.
    fn is_fresh(&self) -> bool {
        let marker = self.marker;
        let hidden = format!(".{marker}.");
        let mut names = file_names(&self.path).unwrap_or_default().into_iter();
        names.all(|name| name == marker || name == ".lock" || name.starts_with(&hidden))
    }

    /// Path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Locks the study, or a shard of it, for this process, and waits until runs left by a killed sweep have ended.
    ///
    /// # Errors
    ///
    /// If another process has locked it, or a file cannot be locked.
    pub fn claim(&self, shard: Option<Shard>) -> Result<StudyLocks, FolderError> {
        let mut locks = vec![self.lock(WHOLE, shard.is_some())?];
        let name = Shard::file_name(shard, WHOLE);
        match shard {
            None => self.remove_unfinished(),
            Some(Shard { count, .. }) => {
                self.other_counts_are_free(count)?;
                locks.push(self.lock(&name, false)?);
            }
        }
        let runs = self.lock_path(&format!("{name}-runs"));
        let file = open_lock(&runs)?;
        file.lock().map_err(Error::system("lock", &runs))?;
        Ok(StudyLocks {
            _locks: locks,
            runs,
        })
    }

    /// Removes unfinished records of a killed sweep; no other process writes records.
    fn remove_unfinished(&self) {
        let records = self.path.join("records");
        for name in file_names(&records).unwrap_or_default() {
            if name.starts_with('.') && name.ends_with(".partial") {
                // A file that remains is harmless.
                let _ = fs::remove_file(records.join(name));
            }
        }
    }

    /// Fails if shards of another count, which may share runs with these, are in progress.
    fn other_counts_are_free(&self, count: usize) -> Result<(), FolderError> {
        let folder = self.path.join("locks");
        let names = file_names(&folder).map_err(Error::system("list", &folder))?;
        for name in names.iter().filter_map(|name| name.strip_suffix(".lock")) {
            let is_shard = name.starts_with("shard-") && !name.ends_with("-runs");
            if is_shard && !name.ends_with(&format!("-of-{count}")) {
                self.lock(name, true)?;
            }
        }
        Ok(())
    }

    fn lock(&self, name: &str, shared: bool) -> Result<File, FolderError> {
        let path = self.lock_path(name);
        let file = open_lock(&path)?;
        let locked = if shared {
            file.try_lock_shared()
        } else {
            file.try_lock()
        };
        match locked {
            Ok(()) => Ok(file),
            Err(TryLockError::WouldBlock) => Err(FolderError::Busy {
                folder: self.path.clone(),
                what: match name {
                    WHOLE => "the whole study".to_owned(),
                    shard => shard.replace('-', " "),
                },
            }),
            Err(TryLockError::Error(source)) => Err(Error::system("lock", &path)(source).into()),
        }
    }

    fn lock_path(&self, name: &str) -> PathBuf {
        self.path.join("locks").join(format!("{name}.lock"))
    }
}

fn open_lock(path: &Path) -> Result<File, Error> {
    refuse_link(path)?;
    let opened = File::options().create(true).append(true).open(path);
    opened.map_err(Error::system("open", path))
}

/// Names of the files and folders in a folder.
fn file_names(folder: &Path) -> io::Result<Vec<String>> {
    let entries = fs::read_dir(folder)?.flatten();
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    Ok(names.collect())
}
