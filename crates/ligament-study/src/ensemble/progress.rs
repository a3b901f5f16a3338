//! Progress of an ensemble on stderr: a bar on a terminal, lines in a log, nothing when quiet.

use std::io::{self, Write};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use ligament_run::progress::ProgressMode;

/// Number of lines of a log.
const LINES: usize = 10;

/// Display of the number of samples that have ended.
pub(super) struct SampleProgress {
    mode: ProgressMode,
    bar: Option<ProgressBar>,
    total: usize,
    ended: usize,
}

impl SampleProgress {
    /// The progress of `total` samples.
    pub(super) fn new(mode: ProgressMode, total: usize) -> Self {
        let bar = (mode == ProgressMode::Terminal).then(|| {
            let bar = ProgressBar::new(total as u64);
            let template = "{pos}/{len} samples [{bar:24}] {elapsed} so far, {eta} to go";
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

    /// Shows that another sample has ended.
    pub(super) fn ended(&mut self) {
        self.ended += 1;
        if let Some(bar) = &self.bar {
            bar.set_position(self.ended as u64);
        }
        let tenth = |ended: usize| LINES * ended / self.total.max(1);
        if self.mode == ProgressMode::Log && tenth(self.ended) > tenth(self.ended - 1) {
            let line = format!("{} of {} samples\n", self.ended, self.total);
            // A failure to write progress (a closed pipe) must not end the ensemble.
            let _ = io::stderr().lock().write_all(line.as_bytes());
        }
    }

    /// Ends the display.
    pub(super) fn finish(self) {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
    }
}
