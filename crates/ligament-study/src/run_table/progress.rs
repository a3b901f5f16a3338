//! Progress of a study on stderr: a bar on a terminal, lines in a log, nothing when quiet.

use std::io::{self, Write};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use ligament_output::terminal::plain;
use ligament_run::progress::ProgressMode;

/// Number of progress lines in a log, one after each tenth of the runs.
const TENTHS: usize = 10;

/// Display of the number of runs that have ended.
pub(crate) struct ProgressDisplay {
    mode: ProgressMode,
    bar: Option<ProgressBar>,
    /// Number of runs to be executed.
    pub(crate) total: usize,
    /// Number of runs that have ended.
    pub(crate) ended: usize,
}

impl ProgressDisplay {
    /// The display of `total` runs, with the template of its bar.
    pub(crate) fn new(mode: ProgressMode, total: usize, template: &str) -> Self {
        let bar = (mode == ProgressMode::Terminal && total > 0).then(|| {
            let bar = ProgressBar::new(total as u64);
            // The template is a constant, so the fallback is never seen.
            let style = ProgressStyle::with_template(template);
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar.enable_steady_tick(Duration::from_millis(200));
            bar
        });
        Self {
            mode,
            bar,
            total,
            ended: 0,
        }
    }

    /// Prints a line above the progress bar.
    pub(crate) fn print(&self, line: &str) {
        let line = &*plain(line);
        match (&self.bar, self.mode) {
            (_, ProgressMode::Quiet) => {}
            (Some(bar), _) => bar.println(line),
            (None, _) => {
                // A single write keeps lines of several shards in one log intact. A failure (a closed pipe) must not end the study.
                let line = format!("{line}\n");
                let _ = io::stderr().lock().write_all(line.as_bytes());
            }
        }
    }

    /// Counts a run that has ended.
    pub(crate) fn count(&mut self) {
        self.ended += 1;
        if let Some(bar) = &self.bar {
            bar.set_position(self.ended as u64);
        }
    }

    /// Prints the number of ended runs, which are called `noun`, after each tenth of them in a log.
    pub(crate) fn print_tenth(&self, noun: &str) {
        let (ended, total) = (self.ended, self.total);
        let tenth = |ended: usize| TENTHS * ended / total.max(1);
        if self.mode == ProgressMode::Log && tenth(ended) > tenth(ended.saturating_sub(1)) {
            self.print(&format!("{ended} of {total} {noun}"));
        }
    }

    /// Shows a message beside the progress bar.
    pub(crate) fn show(&self, message: &str) {
        if let Some(bar) = &self.bar {
            bar.set_message(plain(message).into_owned());
        }
    }

    /// Ends the display.
    pub(crate) fn finish(self) {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
    }
}
