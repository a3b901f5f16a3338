//! Progress of a study: one line per run on stderr, and on a terminal the runs in progress.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use super::plan::Run;
use super::record::Status;
use super::report::unknown_names;
use super::study::Study;
use crate::quantities::Quantities;
use ligament_output::quantity::quantity;
use ligament_output::terminal::plain;
use ligament_run::progress::{ProgressMode, duration_text};

/// Display of the progress of a study.
pub(super) struct StudyProgress<'a> {
    study: &'a Study,
    mode: ProgressMode,
    bar: Option<ProgressBar>,
    /// Number of runs of this sweep.
    total: usize,
    ended: usize,
    failed: usize,
    /// Whether the names of results in the study were checked against a completed run.
    names_are_known: bool,
    begun: Instant,
    /// Descriptions of the runs in progress, by name.
    running: BTreeMap<String, String>,
}

impl<'a> StudyProgress<'a> {
    /// The progress of a sweep of `total` runs.
    pub(super) fn new(study: &'a Study, mode: ProgressMode, total: usize) -> Self {
        let bar = (mode == ProgressMode::Terminal && total > 0).then(|| {
            let bar = ProgressBar::new(total as u64);
            let template = "{pos}/{len} [{bar:24}] {elapsed} so far, {msg}";
            // The template is a constant, so the fallback is never seen.
            let style = ProgressStyle::with_template(template);
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar.enable_steady_tick(Duration::from_millis(200));
            bar
        });
        Self {
            study,
            mode,
            bar,
            total,
            ended: 0,
            failed: 0,
            names_are_known: false,
            begun: Instant::now(),
            running: BTreeMap::new(),
        }
    }

    /// Prints a line.
    pub(super) fn print(&self, line: &str) {
        let line = &*plain(line);
        match (&self.bar, self.mode) {
            (_, ProgressMode::Quiet) => {}
            (Some(bar), _) => bar.println(line),
            // A failure to write progress (a closed pipe) must not end the study.
            (None, _) => {
                // A single write keeps lines of several shards in one log intact.
                let _ = io::stderr()
                    .lock()
                    .write_all(format!("{line}\n").as_bytes());
            }
        }
    }

    /// Ends the display; returns the wall time and the number of failed runs.
    pub(super) fn finish(self) -> (Duration, usize) {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
        (self.begun.elapsed(), self.failed)
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
        if let Some(bar) = &self.bar {
            let words: Vec<&str> = self.running.values().map(String::as_str).collect();
            bar.set_message(format!("running: {}", plain(&words.join("; "))));
        }
    }

    /// Prints the end of a run.
    pub(super) fn ends(&mut self, run: &Run, status: &Status, time: Duration) {
        self.ended += 1;
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
        let width = self.total.to_string().len();
        self.print(&format!(
            "[{:>width$}/{}] {}: {what}",
            self.ended,
            self.total,
            run.words(self.study)
        ));
        if let Status::Done(results) = status
            && !self.names_are_known
        {
            self.names_are_known = true;
            // A misspelt result fails no run, but should be corrected before the sweep ends.
            for unknown in unknown_names(self.study, run, results) {
                self.print(&format!("warning: {unknown}"));
            }
        }
        if let Some(bar) = &self.bar {
            bar.set_position(self.ended as u64);
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
