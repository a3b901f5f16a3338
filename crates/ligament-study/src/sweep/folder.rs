//! The folder of a study: paths of runs, records, logs and meshes, and locks.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

use ligament_output::folder::{Kind, ResultFolder, refuse_link};
use serde_json::json;

use super::error::StudyError;
use super::plan::Run;
use super::study::Study;

/// File that marks the folder of a study.
pub const MARKER: &str = "sweep.json";

/// Number of checks of a folder that another shard may be marking, and the pause between them.
const LOOKS: usize = 20;
const PAUSE: Duration = Duration::from_millis(50);

/// The folder of a study.
#[derive(Debug, Clone)]
pub struct StudyFolder {
    path: PathBuf,
    /// File that marks a folder of this kind of study.
    marker: &'static str,
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
    /// Whether the shard contains the run with an index, from 0.
    pub fn contains(self, index: usize) -> bool {
        index % self.count == self.number - 1
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
    /// The folder of a sweep at a path, existing or not.
    pub fn at(path: impl Into<PathBuf>) -> Self {
        Self::marked_by(MARKER, path)
    }

    /// The folder at a path, existing or not, of a study whose folders have a file of this name.
    pub(crate) fn marked_by(marker: &'static str, path: impl Into<PathBuf>) -> Self {
        let path = path.into();
        Self { path, marker }
    }

    /// Creates the folder, or opens that of an earlier sweep.
    ///
    /// # Errors
    ///
    /// If the path is something else, or cannot be written.
    pub fn open(path: &Path, study: &Study) -> anyhow::Result<Self> {
        let folder = Self::at(path);
        refuse_link(&folder.meshes())?;
        let marker = json!({
            "study": study.source.path.to_string_lossy(),
            "title": study.title,
            "version": env!("CARGO_PKG_VERSION"),
        });
        folder.opened(&format!("{marker:#}\n"), &["runs", "records", "logs"])
    }

    /// Creates the folder with the text of its marker, or opens an earlier one, with subfolders and that of the locks.
    ///
    /// # Errors
    ///
    /// If the path is something else, or cannot be written.
    pub(crate) fn opened(self, marker: &str, subfolders: &[&str]) -> anyhow::Result<Self> {
        for look in 0.. {
            if self.is_marked() {
                break;
            }
            match ResultFolder::create_marked(&self.path, Kind::marked(self.marker), false) {
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
            fs::create_dir_all(&path).map_err(|source| file_error("create", &path, source))?;
        }
        Ok(self)
    }

    /// Whether the folder is marked as the folder of a study.
    pub fn is_marked(&self) -> bool {
        self.path.join(self.marker).is_file()
    }

    /// Whether the folder has no files but those of a shard that is marking it.
    fn is_fresh(&self) -> bool {
        let marker = self.marker;
        let hidden = format!(".{marker}.");
        let entries = fs::read_dir(&self.path).into_iter().flatten().flatten();
        let mut names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
        names.all(|name| name == marker || name == ".lock" || name.starts_with(&hidden))
    }

    /// Path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Folder of the results of a run.
    pub fn run(&self, run: &Run) -> PathBuf {
        self.path.join("runs").join(&run.name)
    }

    /// File of the record of a run.
    pub(super) fn record(&self, run: &Run) -> PathBuf {
        self.path.join("records").join(format!("{}.json", run.name))
    }

    /// Folder of unfinished new results of a run that has earlier ones.
    pub(super) fn new_run(&self, run: &Run) -> PathBuf {
        self.path.join("runs").join(format!("{}~new", run.name))
    }

    /// File of the record of new results of a run that has earlier ones.
    pub(super) fn new_record(&self, run: &Run) -> PathBuf {
        self.path
            .join("records")
            .join(format!("{}~new.json", run.name))
    }

    /// File of the output of a run.
    pub(super) fn log(&self, run: &Run) -> PathBuf {
        self.path.join("logs").join(format!("{}.log", run.name))
    }

    /// Folder of the meshes that are made for the study.
    pub fn meshes(&self) -> PathBuf {
        self.path.join("meshes")
    }

    /// Locks the study, or a shard of it, for this process, and waits until runs left by a killed sweep have ended.
    ///
    /// # Errors
    ///
    /// If another process has locked it, or a file cannot be locked.
    pub fn claim(&self, shard: Option<Shard>) -> Result<StudyLocks, StudyError> {
        let mut locks = vec![self.lock("sweep", shard.is_some())?];
        if shard.is_none() {
            self.remove_unfinished();
        }
        let name = match shard {
            None => "sweep".to_owned(),
            Some(Shard { number, count }) => {
                self.other_counts_are_free(count)?;
                let name = format!("shard-{number}-of-{count}");
                locks.push(self.lock(&name, false)?);
                name
            }
        };
        let runs = self.lock_path(&format!("{name}-runs"));
        let file = open_lock(&runs)?;
        file.lock()
            .map_err(|source| file_error("lock", &runs, source))?;
        Ok(StudyLocks {
            _locks: locks,
            runs,
        })
    }

    /// Removes unfinished records of a killed sweep; no other process writes records.
    fn remove_unfinished(&self) {
        let entries = fs::read_dir(self.path.join("records"));
        for entry in entries.into_iter().flatten().flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            if name.starts_with('.') && name.ends_with(".partial") {
                // A file that remains is harmless.
                let _ = fs::remove_file(entry.path());
            }
        }
    }

    /// Fails if shards of another count, which may share runs with these, are in progress.
    fn other_counts_are_free(&self, count: usize) -> Result<(), StudyError> {
        let folder = self.path.join("locks");
        let entries =
            fs::read_dir(&folder).map_err(|source| file_error("list", &folder, source))?;
        for entry in entries.flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            let Some(name) = name.strip_suffix(".lock") else {
                continue;
            };
            let is_shard = name.starts_with("shard-") && !name.ends_with("-runs");
            if is_shard && !name.ends_with(&format!("-of-{count}")) {
                self.lock(name, true)?;
            }
        }
        Ok(())
    }

    fn lock(&self, name: &str, shared: bool) -> Result<File, StudyError> {
        let path = self.lock_path(name);
        let file = open_lock(&path)?;
        let locked = if shared {
            file.try_lock_shared()
        } else {
            file.try_lock()
        };
        match locked {
            Ok(()) => Ok(file),
            Err(TryLockError::WouldBlock) => Err(StudyError::Busy {
                folder: self.path.clone(),
                what: match name {
                    "sweep" => "the whole study".to_owned(),
                    shard => shard.replace('-', " "),
                },
            }),
            Err(TryLockError::Error(source)) => Err(file_error("lock", &path, source)),
        }
    }

    fn lock_path(&self, name: &str) -> PathBuf {
        self.path.join("locks").join(format!("{name}.lock"))
    }
}

fn open_lock(path: &Path) -> Result<File, StudyError> {
    refuse_link(path)?;
    let opened = File::options().create(true).append(true).open(path);
    opened.map_err(|source| file_error("open", path, source))
}

/// The error of a file of the folder.
fn file_error(action: &'static str, path: &Path, source: io::Error) -> StudyError {
    StudyError::File {
        action,
        path: path.to_owned(),
        source,
    }
}
