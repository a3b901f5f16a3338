//! Progress of a run on stderr: a bar on a terminal, lines in a log, nothing when quiet.

use std::fmt::Write as _;
use std::io::{self, IsTerminal, Write};
use std::sync::mpsc::Sender;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use ligament::units::Units;
use ligament_analysis::distributed_matrix::Communicator;
use ligament_output::quantity::quantity;
use ligament_output::terminal::plain;

/// Shortest time between two logged steps, unless [`LOG_SHARE`] is reached.
const LOG_PAUSE: Duration = Duration::from_secs(2);

/// Share of all steps after which a step is logged in any case.
const LOG_SHARE: f64 = 0.1;

/// Display of progress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProgressMode {
    /// A redrawn bar on a terminal.
    Terminal,
    /// Lines in a log.
    Log,
    /// No display of progress.
    Quiet,
}

impl ProgressMode {
    /// The mode that suits standard error.
    pub fn detect(quiet: bool) -> Self {
        match (quiet, io::stderr().is_terminal()) {
            (true, _) => Self::Quiet,
            (false, true) => Self::Terminal,
            (false, false) => Self::Log,
        }
    }
}

/// State of the run in or at the end of a load step.
#[derive(Debug, Clone, PartialEq)]
pub struct StepLine {
    /// The load step, or the row of a motion, from 1.
    pub step: u64,
    /// Load factor of the step; the time of a motion, s.
    pub load_factor: f64,
    /// Whether the run is a motion in time.
    pub in_time: bool,
    /// Displacement of the load, if there is one, in [`units`](Self::units).
    pub displacement: Option<f64>,
    /// Size of the load, if there is one, in [`units`](Self::units).
    pub load: Option<f64>,
    /// Units of displacement and load.
    pub units: Units,
    /// Number of broken bonds.
    pub broken_bonds: u64,
    /// Number of unbroken bonds that soften at the end of the last load step; none where no bond can soften.
    pub softened_bonds: Option<u64>,
    /// Stage of a load program, at the end of the last load step.
    pub stage: Option<String>,
}

impl StepLine {
    fn text(&self) -> String {
        let factor = self.load_factor;
        let mut text = match &self.stage {
            None if self.in_time => quantity(factor, "s"),
            Some(stage) => format!("stage {stage}, load factor {factor:.4}"),
            None => format!("load factor {factor:.4}"),
        };
        // Writing to a string cannot fail.
        if let Some(load) = self.load {
            let _ = write!(text, ", {}", quantity(load, self.units.force));
        }
        if let Some(displacement) = self.displacement {
            let _ = write!(
                text,
                " at {}",
                quantity(displacement, self.units.displacement)
            );
        }
        let _ = write!(text, ", {} bonds broken", self.broken_bonds);
        if let Some(softened) = self.softened_bonds {
            let _ = write!(text, ", {softened} softened");
        }
        text
    }
}

/// Display of the progress of a run.
#[derive(Debug)]
pub struct Progress {
    mode: ProgressMode,
    total: Option<u64>,
    bar: Option<ProgressBar>,
    started: Instant,
    pace: LogInterval,
    steps: Option<Sender<StepLine>>,
}

impl Progress {
    /// Progress with a mode of display.
    pub fn new(mode: ProgressMode) -> Self {
        Self {
            mode,
            total: None,
            bar: None,
            started: Instant::now(),
            pace: LogInterval::default(),
            steps: None,
        }
    }

    /// The display with a receiver of the state at the end of each load step.
    pub(crate) fn with_receiver(self, steps: Option<Sender<StepLine>>) -> Self {
        Self { steps, ..self }
    }

    /// Progress with a mode of display on rank 0 and none on other ranks.
    pub(crate) fn on(communicator: &dyn Communicator, mode: ProgressMode) -> Self {
        Self::new(match communicator.is_root() {
            true => mode,
            false => ProgressMode::Quiet,
        })
    }

    /// Shows a message about a completed stage: "bonds: 2716 points, 38120 bonds".
    pub fn stage(&self, message: &str) {
        match (&self.bar, self.mode) {
            (_, ProgressMode::Quiet) => {}
            (Some(bar), _) => bar.println(plain(message)),
            (None, _) => write_line(message),
        }
    }

    /// Starts the load steps; `total` is their largest number, where known.
    ///
    /// `noun` is the word for them.
    pub fn begin_steps(&mut self, total: Option<u64>, noun: &str) {
        self.total = total;
        self.started = Instant::now();
        self.pace = LogInterval::default();
        if self.mode == ProgressMode::Terminal {
            let bar = total.map_or_else(ProgressBar::no_length, ProgressBar::new);
            bar.set_style(style(total.is_some(), noun));
            bar.enable_steady_tick(Duration::from_millis(200));
            self.bar = Some(bar);
        }
    }

    /// Shows the state within a load step, such as after a round of breakages.
    pub fn round(&mut self, line: &StepLine) {
        self.show(line, false);
    }

    /// Shows the state at the end of a load step.
    pub fn step(&mut self, line: &StepLine) {
        if let Some(steps) = &self.steps {
            // A receiver that is gone does not end the run.
            let _ = steps.send(line.clone());
        }
        self.show(line, true);
    }

    /// Ends the load steps with a last message.
    pub fn finish(&mut self, message: &str) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
        self.stage(message);
    }

    fn show(&mut self, line: &StepLine, done: bool) {
        let steps_done = if done {
            line.step
        } else {
            line.step.saturating_sub(1)
        };
        if let Some(bar) = &self.bar {
            bar.set_position(steps_done);
            bar.set_message(line.text());
        } else if self.mode == ProgressMode::Log {
            let elapsed = self.started.elapsed();
            if self.pace.is_due(steps_done, self.total, elapsed) {
                write_line(&log_line(line, done, self.total, elapsed));
            }
        }
    }
}

fn style(has_total: bool, noun: &str) -> ProgressStyle {
    let template = match has_total {
        true => format!("{noun} {{pos}}/{{len}} [{{bar:24}}] {{msg}}, {{eta}} left"),
        false => format!("{{spinner}} {noun} {{pos}} {{msg}}, {{elapsed}} so far"),
    };
    // The templates are constants, so the fallback is never seen.
    ProgressStyle::with_template(&template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

/// Writes a line to stderr; a failure, such as a closed pipe, must not end the run.
fn write_line(line: &str) {
    let _ = writeln!(io::stderr().lock(), "{}", plain(line));
}

/// Noun for a record of a run.
pub(crate) fn noun(in_time: bool) -> &'static str {
    if in_time { "row" } else { "step" }
}

fn log_line(line: &StepLine, done: bool, total: Option<u64>, elapsed: Duration) -> String {
    let of = total
        .map(|total| format!(" of {total}"))
        .unwrap_or_default();
    let state = if done { "" } else { " (under way)" };
    let noun = noun(line.in_time);
    let mut text = format!("{noun} {}{of}{state}: {}", line.step, line.text());
    if let Some(total) = total.filter(|&total| done && line.step > 0 && line.step < total) {
        let left = elapsed.mul_f64((total - line.step) as f64 / line.step as f64);
        let _ = write!(text, ", {} left", duration_text(left));
    }
    text
}

/// A duration in two units: "1 h 2 min".
pub fn duration_text(duration: Duration) -> String {
    match duration.as_secs() {
        seconds @ 0..60 => format!("{seconds} s"),
        seconds @ 60..3600 => format!("{} min {} s", seconds / 60, seconds % 60),
        seconds => format!("{} h {} min", seconds / 3600, seconds % 3600 / 60),
    }
}

/// Selection of the steps for a log.
#[derive(Debug, Default)]
struct LogInterval {
    last: Option<(u64, Duration)>,
}

impl LogInterval {
    /// Whether a line is due after a number of steps and a time; a due line counts as written.
    fn is_due(&mut self, steps_done: u64, total: Option<u64>, elapsed: Duration) -> bool {
        let due = match self.last {
            None => true,
            Some((steps, time)) => {
                let share = total.map_or(0.0, |total| {
                    steps_done.saturating_sub(steps) as f64 / total as f64
                });
                let is_last = Some(steps_done) == total && steps_done > steps;
                elapsed - time >= LOG_PAUSE || share >= LOG_SHARE || is_last
            }
        };
        if due {
            self.last = Some((steps_done, elapsed));
        }
        due
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINE: StepLine = StepLine {
        step: 25,
        load_factor: 0.25,
        in_time: false,
        displacement: Some(-1e-4),
        load: Some(1234.5),
        units: Units::FORCE,
        broken_bonds: 7,
        softened_bonds: None,
        stage: None,
    };

    #[test]
    fn a_log_line_has_the_state_and_the_time_left() {
        assert_eq!(
            log_line(&LINE, true, Some(100), Duration::from_secs(30)),
            "step 25 of 100: load factor 0.2500, 1.234 kN at -0.1000 mm, 7 bonds broken, 1 min 30 s left"
        );
        let bare = StepLine {
            displacement: None,
            load: None,
            ..LINE
        };
        assert_eq!(
            log_line(&bare, true, None, Duration::ZERO),
            "step 25: load factor 0.2500, 7 bonds broken"
        );
        let softening = StepLine {
            softened_bonds: Some(340),
            stage: Some("pull".to_owned()),
            ..bare
        };
        assert_eq!(
            log_line(&softening, false, None, Duration::ZERO),
            "step 25 (under way): stage pull, load factor 0.2500, 7 bonds broken, 340 softened"
        );
        let moving = StepLine {
            load_factor: 7.25e-5,
            in_time: true,
            ..LINE
        };
        assert_eq!(
            log_line(&moving, true, Some(25), Duration::ZERO),
            "row 25 of 25: 72.50 us, 1.234 kN at -0.1000 mm, 7 bonds broken"
        );
    }

    #[test]
    fn fast_steps_are_logged_each_tenth_and_slow_ones_each() {
        let mut pace = LogInterval::default();
        let logged: Vec<u64> = (1..=100)
            .filter(|&step| pace.is_due(step, Some(100), Duration::from_millis(step)))
            .collect();
        assert_eq!(logged, [1, 11, 21, 31, 41, 51, 61, 71, 81, 91, 100]);
        let mut pace = LogInterval::default();
        assert!((1..=5).all(|step| pace.is_due(step, Some(1000), Duration::from_secs(3 * step))));
    }

    #[test]
    fn times_are_given_in_two_units() {
        assert_eq!(duration_text(Duration::from_secs(59)), "59 s");
        assert_eq!(duration_text(Duration::from_secs(3725)), "1 h 2 min");
    }
}
