//! Progress of a sweep: one line per run on stderr, and on a terminal the runs in progress.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use super::plan::Run;
use super::record::{RecordedRun, Status};
use super::report::unknown_names;
use super::study::Study;
use crate::quantities::Quantities;
use crate::run_table::folder::StudyFolder;
use crate::run_table::progress::ProgressDisplay;
use ligament_output::quantity::quantity;
use ligament_run::progress::{ProgressMode, duration_text};

/// Display of the progress of a sweep.
pub(super) struct StudyProgress<'a> {
    study: &'a Study,
    display: ProgressDisplay,
    failed: usize,
    /// Whether the names of results in the study were checked against a completed run.
    names_are_known: bool,
    start: Instant,
    /// Descriptions of the runs in progress, by name.
    running: BTreeMap<String, String>,
}

impl<'a> StudyProgress<'a> {
    /// The progress of a sweep of `total` runs.
    pub(super) fn new(study: &'a Study, mode: ProgressMode, total: usize) -> Self {
        let template = "{pos}/{len} [{bar:24}] {elapsed} so far, {msg}";
        Self {
            study,
            display: ProgressDisplay::new(mode, total, template),
            failed: 0,
            names_are_known: false,
            start: Instant::now(),
            running: BTreeMap::new(),
        }
    }

    /// Prints a line above the progress bar.
    pub(super) fn print(&self, line: &str) {
        self.display.print(line);
    }

    /// Ends the display; returns the wall time and the number of failed runs.
    pub(super) fn finish(self) -> (Duration, usize) {
        self.display.finish();
        (self.start.elapsed(), self.failed)
    }

    /// Shows the start of a run on a number of threads.
    pub(super) fn begins(&mut self, run: &Run, threads: usize) {
        let mut words = run.words(self.study);
        if threads > 1 {
            words += &format!(" ({threads} threads)");
        }
        self.running.insert(run.name.clone(), words);
        self.show_running();
    }

    fn show_running(&self) {
        let words: Vec<&str> = self.running.values().map(String::as_str).collect();
        self.display.show(&format!("running: {}", words.join("; ")));
    }

    /// Records and prints that a run failed, with the reason.
    pub(super) fn fails(
        &mut self,
        run: &Run,
        folder: &StudyFolder,
        reason: &str,
        time: Duration,
    ) -> anyhow::Result<()> {
        RecordedRun::in_folder(run, folder).record(Some(reason))?;
        self.ends(run, &Status::Failed(reason.to_owned()), time);
        Ok(())
    }

    /// Prints the end of a run.
    pub(super) fn ends(&mut self, run: &Run, status: &Status, time: Duration) {
        self.display.count();
        self.running.remove(&run.name);
        let what = match status {
            Status::Done(results) => format!("{}, {}", outcome(results), seconds(time)),
            Status::Failed(reason) => {
                self.failed += 1;
                format!("failed: {reason}")
            }
            // A run that has ended has no such status.
            Status::Missing | Status::Changed(_) => "no results".to_owned(),
        };
        let ProgressDisplay { total, ended, .. } = self.display;
        let width = total.to_string().len();
        let words = run.words(self.study);
        self.print(&format!("[{ended:>width$}/{total}] {words}: {what}"));
        if let Status::Done(results) = status
            && !self.names_are_known
        {
            self.names_are_known = true;
            // A misspelt result fails no run, but should be corrected before the sweep ends.
            for unknown in unknown_names(self.study, run, results) {
                self.print(&format!("warning: {unknown}"));
            }
        }
        self.show_running();
    }
}

/// Short description of a run's result.
fn outcome(results: &Quantities) -> String {
    let number = |name: &str| results.number(name).ok();
    let word = |name: &str| {
        results
            .get(name)
            .and_then(|it| it.as_str())
            .unwrap_or_default()
    };
    let mut parts = Vec::new();
    if let Some(peak) = number("first_peak.reaction").or_else(|| number("peak.reaction")) {
        parts.push(format!("peak {}", quantity(peak, word("units.force"))));
    }
    if let Some(broken) = number("broken_bonds") {
        parts.push(format!("{broken} bonds broken"));
    }
    if let Some(rigid) = number("rigid_motions")
        && let Some(frequency) = number(&format!("modes.{rigid}.frequency"))
    {
        parts.push(format!("first frequency {}", quantity(frequency, "Hz")));
    }
    let end = word("termination_message");
    if !end.is_empty() {
        parts.push(end.to_owned());
    }
    parts.join(", ")
}

/// Text of a duration, with tenths of seconds below one minute.
pub(super) fn seconds(time: Duration) -> String {
    if time < Duration::from_secs(60) {
        return format!("{:.1} s", time.as_secs_f64());
    }
    duration_text(time)
}
