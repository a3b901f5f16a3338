//! Runs as separate processes, as many at once as cores and memory allow.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Read};
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use ligament_output::remove_if_there;
use ligament_run::end::leaves_results;
use ligament_run::memory;

use super::estimate::Estimates;
use super::folder::StudyFolder;
use super::plan::Run;
use super::progress::StudyProgress;
use super::record::{self, Status};

/// Number of last lines of a failed run's output in its reason.
const LAST_WORDS: usize = 4;

/// Resources for runs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Room {
    /// Largest number of simultaneous runs.
    pub(super) jobs: usize,
    /// Number of processors.
    pub(super) cores: usize,
    /// Memory, bytes; `None` where unknown.
    pub(super) bytes: Option<u64>,
    /// Whether the memory was given by the user.
    pub(super) bytes_are_given: bool,
}

impl Room {
    /// The available or given resources.
    pub(super) fn new(jobs: Option<usize>, gigabytes: Option<f64>) -> Self {
        let cores = thread::available_parallelism().map_or(1, NonZero::get);
        Self {
            jobs: jobs.unwrap_or(cores),
            cores,
            bytes: gigabytes
                .map(|it| (1e9 * it) as u64)
                .or_else(memory::available),
            bytes_are_given: gigabytes.is_some(),
        }
    }

    /// Threads of a run when `left` runs have not ended.
    fn threads(self, left: usize) -> usize {
        (self.cores / left.min(self.jobs).max(1)).max(1)
    }
}

/// A run that has ended: its index, exit status and duration.
struct Ended {
    index: usize,
    status: io::Result<ExitStatus>,
    time: Duration,
}

/// A run in progress.
struct Running {
    index: usize,
    bytes: u64,
    /// Folder for its results.
    place: PathBuf,
    /// Standard input of the run, which is closed when this value is dropped or this process ends.
    _leash: Option<std::process::ChildStdin>,
}

/// Executes runs in their order, as many at once as resources allow; returns the sum of their times.
///
/// # Errors
///
/// If the study's folder cannot be written. A failed run is not an error.
pub(super) fn all(
    runs: &[&Run],
    folder: &StudyFolder,
    (lock, program): (&Path, &[OsString]),
    room: Room,
    progress: &mut StudyProgress<'_>,
) -> anyhow::Result<Duration> {
    let (sender, receiver) = channel();
    let mut launcher = Launcher {
        runs,
        folder,
        lock,
        room,
        program,
        sender,
        receiver,
        estimates: Estimates::default(),
        running: Vec::new(),
        time: Duration::ZERO,
    };
    for (next, run) in runs.iter().enumerate() {
        let bytes = launcher.wait_for_room(next, progress)?;
        match launcher.start(next, bytes, progress) {
            Ok(()) => {}
            Err(Refusal::Run(reason)) => {
                record::fail(run, folder, &reason)?;
                progress.ends(run, &Status::Failed(reason), Duration::ZERO);
            }
            Err(Refusal::Folder(error)) => return Err(error),
        }
    }
    while !launcher.running.is_empty() {
        launcher.wait(progress)?;
    }
    Ok(launcher.time)
}

/// Reason why a run was not started.
enum Refusal {
    /// Reason of this run.
    Run(String),
    /// Error of the folder, which affects all runs.
    Folder(anyhow::Error),
}

struct Launcher<'a> {
    runs: &'a [&'a Run],
    folder: &'a StudyFolder,
    lock: &'a Path,
    room: Room,
    program: &'a [OsString],
    sender: Sender<Ended>,
    receiver: Receiver<Ended>,
    estimates: Estimates,
    running: Vec<Running>,
    time: Duration,
}

impl Launcher<'_> {
    /// Waits until the next run fits beside the runs in progress, or none is in progress; returns its memory, bytes.
    fn wait_for_room(
        &mut self,
        next: usize,
        progress: &mut StudyProgress<'_>,
    ) -> anyhow::Result<u64> {
        // A case whose model cannot be built fails in its run, with the reason.
        let bytes = self.estimates.bytes(&self.runs[next].case).unwrap_or(0);
        while self.running.len() >= self.room.jobs
            || (!self.running.is_empty() && !self.fits(bytes))
        {
            self.wait(progress)?;
        }
        Ok(bytes)
    }

    /// Whether the memory suffices beside the estimates of the runs in progress and, unless given by the user, is available at present.
    fn fits(&self, bytes: u64) -> bool {
        let taken: u64 = self.running.iter().map(|it| it.bytes).sum();
        let by_estimates = self.room.bytes.is_none_or(|room| taken + bytes <= room);
        let now = if self.room.bytes_are_given {
            None
        } else {
            memory::available()
        };
        by_estimates && now.is_none_or(|now| bytes <= now)
    }

    fn start(
        &mut self,
        next: usize,
        bytes: u64,
        progress: &mut StudyProgress<'_>,
    ) -> Result<(), Refusal> {
        let run = self.runs[next];
        if !self.fits(bytes) {
            return Err(Refusal::Run(self.too_large(bytes)));
        }
        let place = record::begin(run, self.folder).map_err(Refusal::Folder)?;
        let left = self.running.len() + self.runs.len() - next;
        let threads = self.room.threads(left);
        let begun = Instant::now();
        let mut child = self
            .spawn(run, &place, threads)
            .map_err(|error| Refusal::Folder(error.into()))?;
        progress.begins(run, threads);
        self.running.push(Running {
            index: next,
            bytes,
            place,
            _leash: child.stdin.take(),
        });
        let sender = self.sender.clone();
        thread::spawn(move || {
            let status = child.wait();
            // A closed channel has no receiver.
            let _ = sender.send(Ended {
                index: next,
                status,
                time: begun.elapsed(),
            });
        });
        Ok(())
    }

    fn spawn(&self, run: &Run, place: &Path, threads: usize) -> io::Result<Child> {
        let log = self.folder.log(run);
        // The log is a new file, never the target of a link.
        remove_if_there(&log)?;
        let log = File::create_new(log)?;
        let (program, leading) = (self.program.split_first())
            .ok_or_else(|| io::Error::other("the command that calls this program is empty"))?;
        let mut command = Command::new(program);
        command.args(leading);
        command.args(["run", "--force", "--quiet"]);
        command.arg(format!("--threads={threads}"));
        if let (true, Some(bytes)) = (self.room.bytes_are_given, self.room.bytes) {
            command.arg(format!("--set=solver.memory={:?}", bytes as f64 / 1e9));
        }
        for setting in &run.overrides {
            command.arg(format!("--set={setting}"));
        }
        command
            .arg(option("--out", place))
            .arg(option("--leash", self.lock));
        // After `--` a path may begin with a hyphen.
        command.arg("--").arg(&run.case.source.path);
        command
            .stdin(Stdio::piped())
            .stdout(log.try_clone()?)
            .stderr(log);
        command.spawn()
    }

    /// Waits for a run to end.
    fn wait(&mut self, progress: &mut StudyProgress<'_>) -> anyhow::Result<()> {
        // The launcher has a sender itself, so the channel is never closed.
        let Ok(Ended {
            index,
            status,
            time,
        }) = self.receiver.recv()
        else {
            return Ok(());
        };
        let place = self.running.iter().position(|it| it.index == index);
        let ended = place.map(|place| self.running.remove(place));
        self.time += time;
        let run = self.runs[index];
        let exit = status?;
        // A run that ended during breakage or without equilibrium also has results, which include its end.
        let has_results = leaves_results(exit.code());
        if !has_results {
            let reason = self.last_words(run, exit);
            record::fail(run, self.folder, &reason)?;
            progress.ends(run, &Status::Failed(reason), time);
            return Ok(());
        }
        if let Some(Running { place, .. }) = ended {
            record::complete(run, self.folder, &place)?;
        }
        let status = match Status::in_folder(run, self.folder) {
            Status::Missing | Status::Changed(_) => {
                Status::Failed("it ended without an error, but wrote no summary.json".to_owned())
            }
            status => status,
        };
        progress.ends(run, &status, time);
        Ok(())
    }

    fn too_large(&self, bytes: u64) -> String {
        let gigabytes = |bytes: u64| bytes as f64 / 1e9;
        let room = self.room.bytes.unwrap_or_default();
        let now = memory::available().map_or(room, |now| now.min(room));
        let (what, advice) = if self.room.bytes_are_given {
            (room, "allow more by --memory")
        } else {
            (now, "free some, allow more by --memory")
        };
        format!(
            "it needs {:.2} GB of memory, and {:.2} GB are available; {advice}, or run it on a larger machine by --shard",
            gigabytes(bytes),
            gigabytes(what)
        )
    }

    /// The reason why a run failed: its error, or its last line and its exit status.
    fn last_words(&self, run: &Run, exit: ExitStatus) -> String {
        // If there is no log, only the exit status is known.
        let log = fs::read(self.folder.log(run)).unwrap_or_default();
        let text = String::from_utf8_lossy(&log);
        let lines: Vec<&str> = text
            .lines()
            .map(str::trim)
            .filter(|line| !line.is_empty())
            .collect();
        let from = lines.iter().rposition(|line| line.starts_with("error: "));
        match from {
            Some(from) => {
                let words = lines[from..].join("; ");
                words.trim_start_matches("error: ").to_owned()
            }
            None => {
                let last = &lines[lines.len().saturating_sub(LAST_WORDS)..];
                let said = last
                    .iter()
                    .map(|line| format!("; {line}"))
                    .collect::<String>();
                format!("it ended by {exit}{said}")
            }
        }
    }
}

/// An option `name=path`, for paths that may begin with a hyphen.
fn option(name: &str, path: &Path) -> OsString {
    let mut option = OsString::from(name);
    option.push("=");
    option.push(path);
    option
}

/// Ties this process to its parent: locks a file until the process ends, and ends the process when standard input, a pipe from the parent,
/// is closed.
///
/// # Errors
///
/// If the lock cannot be taken.
pub fn bind_to_parent(lock: &Path) -> io::Result<()> {
    let file = File::options().create(true).append(true).open(lock)?;
    file.lock_shared()?;
    thread::spawn(move || {
        let _held = file;
        let mut byte = [0];
        while matches!(io::stdin().read(&mut byte), Ok(1..)) {}
        // No process reads this exit code; unfinished results lack their summary.
        std::process::exit(1);
    });
    Ok(())
}
