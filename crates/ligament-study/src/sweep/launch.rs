//! Runs as separate processes, as many at once as cores and memory allow.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Read};
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use ligament_output::remove_if_there;
use ligament_run::end::leaves_results;
use ligament_run::memory;
use ligament_run::progress::ProgressMode;
use ligament_run::run::run as run_case;

use super::estimate::Estimates;
use super::plan::Run;
use super::progress::StudyProgress;
use super::record::{RecordedRun, Status};
use crate::run_table::folder::StudyFolder;

/// Number of final output lines of a failed run that its reason quotes.
const LAST_WORDS: usize = 4;

/// Resources for runs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Resources {
    /// Largest number of simultaneous runs.
    jobs: usize,
    /// Number of processors.
    cores: usize,
    /// Memory, bytes; `None` where unknown.
    bytes: Option<u64>,
    /// Whether the memory was given by the user.
    bytes_are_given: bool,
}

impl Resources {
    /// The available or given resources.
    pub(super) fn new(jobs: Option<usize>, gigabytes: Option<f64>) -> Self {
        let cores = thread::available_parallelism().map_or(1, NonZero::get);
        let given = gigabytes.map(|it| (1e9 * it) as u64);
        Self {
            jobs: jobs.unwrap_or(cores),
            cores,
            bytes: given.or_else(memory::available_memory),
            bytes_are_given: given.is_some(),
        }
    }

    /// Memory that is available at present, unless the user has given it.
    fn bytes_now(self) -> Option<u64> {
        match self.bytes_are_given {
            true => None,
            false => memory::available_memory(),
        }
    }

    /// Threads of a run when `left` runs have not ended.
    fn threads(self, left: usize) -> usize {
        (self.cores / left.min(self.jobs).max(1)).max(1)
    }

    /// The reason why a run that needs so much memory is not started.
    fn too_small_for(self, bytes: u64) -> String {
        let room = self.bytes.unwrap_or_default();
        let available = self.bytes_now().map_or(room, |now| now.min(room));
        let free = if self.bytes_are_given {
            ""
        } else {
            "free some, "
        };
        format!(
            "it needs {:.2} GB of memory, and {:.2} GB are available; {free}allow more by --memory, or run it on a larger machine by --shard",
            bytes as f64 / 1e9,
            available as f64 / 1e9
        )
    }
}

/// Index, end and duration of a run that has ended.
type EndedRun = (usize, EndOfRun, Duration);

/// End of a run.
enum EndOfRun {
    /// Exit status of its process.
    Exit(io::Result<ExitStatus>),
    /// Result of a run in this process.
    Done(anyhow::Result<()>),
}

/// A run in progress.
struct RunningProcess {
    index: usize,
    bytes: u64,
    /// Folder for its results.
    written: PathBuf,
    /// Standard input of the run, which is closed when this value is dropped or this process ends.
    _leash: Option<ChildStdin>,
}

/// Executes runs in their order, as many at once as resources allow, or one after the other in this process where no program is given; returns
/// the sum of their times.
///
/// # Errors
///
/// If the study's folder cannot be written. A failed run is not an error.
pub(super) fn all(
    runs: &[&Run],
    folder: &StudyFolder,
    (lock, program): (&Path, &[OsString]),
    room: Resources,
    progress: &mut StudyProgress<'_>,
) -> anyhow::Result<Duration> {
    let (sender, receiver) = channel();
    let mut launcher = Launcher {
        runs,
        folder,
        lock,
        room,
        program,
        progress,
        sender,
        receiver,
        running: Vec::new(),
        time: Duration::ZERO,
    };
    let mut estimates = Estimates::default();
    for (next, run) in runs.iter().enumerate() {
        // A case whose model cannot be built fails in its run, with the reason.
        let bytes = estimates.bytes(&run.case).unwrap_or(0);
        while launcher.running.len() >= room.jobs
            || !(launcher.running.is_empty() || launcher.fits(bytes))
        {
            launcher.wait()?;
        }
        match launcher.fits(bytes) {
            true => launcher.start(next, bytes)?,
            false => {
                let reason = room.too_small_for(bytes);
                launcher
                    .progress
                    .fails(run, folder, &reason, Duration::ZERO)?;
            }
        }
    }
    while !launcher.running.is_empty() {
        launcher.wait()?;
    }
    Ok(launcher.time)
}

struct Launcher<'a, 'b> {
    runs: &'a [&'a Run],
    folder: &'a StudyFolder,
    lock: &'a Path,
    room: Resources,
    program: &'a [OsString],
    progress: &'a mut StudyProgress<'b>,
    sender: Sender<EndedRun>,
    receiver: Receiver<EndedRun>,
    running: Vec<RunningProcess>,
    time: Duration,
}

impl Launcher<'_, '_> {
    /// Whether the memory suffices beside the estimates of the runs in progress and, unless given by the user, is available at present.
    fn fits(&self, bytes: u64) -> bool {
        let of_running: u64 = self.running.iter().map(|it| it.bytes).sum();
        let by_estimates = self
            .room
            .bytes
            .is_none_or(|room| of_running + bytes <= room);
        by_estimates && self.room.bytes_now().is_none_or(|now| bytes <= now)
    }

    fn start(&mut self, index: usize, bytes: u64) -> anyhow::Result<()> {
        let run = self.runs[index];
        let written = RecordedRun::in_folder(run, self.folder).begin()?;
        let threads = self
            .room
            .threads(self.running.len() + self.runs.len() - index);
        let start = Instant::now();
        if self.program.is_empty() {
            let done = run_case(&run.case, &written, true, ProgressMode::Quiet).map(|_| ());
            self.running.push(RunningProcess {
                index,
                bytes,
                written,
                _leash: None,
            });
            let ended = (index, EndOfRun::Done(done), start.elapsed());
            return Ok(self.sender.send(ended)?);
        }
        let mut child = self.spawn(run, &written, threads)?;
        self.progress.begins(run, threads);
        self.running.push(RunningProcess {
            index,
            bytes,
            written,
            _leash: child.stdin.take(),
        });
        let sender = self.sender.clone();
        // A closed channel has no receiver.
        thread::spawn(move || {
            let exit = child.wait();
            sender.send((index, EndOfRun::Exit(exit), start.elapsed()))
        });
        Ok(())
    }

    fn spawn(&self, run: &Run, place: &Path, threads: usize) -> io::Result<Child> {
        let log = self.log(run);
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

    /// File of the output of a run.
    fn log(&self, run: &Run) -> PathBuf {
        let name = format!("{}.log", run.name);
        self.folder.path().join("logs").join(name)
    }

    /// Waits for a run to end.
    fn wait(&mut self) -> anyhow::Result<()> {
        // The launcher has a sender itself, so the channel is never closed.
        let (index, end, time) = self.receiver.recv()?;
        let place = self.running.iter().position(|it| it.index == index);
        let ended = place.map(|place| self.running.remove(place));
        self.time += time;
        let run = self.runs[index];
        // A run that ended during breakage or without equilibrium also has results, which include its end.
        let failed = match end {
            EndOfRun::Exit(exit) => {
                let exit = exit?;
                (!leaves_results(exit.code())).then(|| self.last_words(run, exit))
            }
            EndOfRun::Done(done) => done.err().map(|error| format!("{error:#}")),
        };
        if let Some(reason) = failed {
            return self.progress.fails(run, self.folder, &reason, time);
        }
        let recorded = RecordedRun::in_folder(run, self.folder);
        if let Some(RunningProcess { written, .. }) = ended {
            recorded.complete(&written)?;
        }
        let status = match recorded.status() {
            Status::Missing | Status::Changed(_) => {
                Status::Failed("it ended without an error, but wrote no summary.json".to_owned())
            }
            status => status,
        };
        self.progress.ends(run, &status, time);
        Ok(())
    }

    /// The reason why a run failed: its error, or its last line and its exit status.
    fn last_words(&self, run: &Run, exit: ExitStatus) -> String {
        // If there is no log, only the exit status is known.
        let log = fs::read(self.log(run)).unwrap_or_default();
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
                let last_line = last
                    .iter()
                    .map(|line| format!("; {line}"))
                    .collect::<String>();
                format!("it ended by {exit}{last_line}")
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
