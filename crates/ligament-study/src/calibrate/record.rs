//! The record of a calibration: `calibration.json` and `calibration.csv`, and the printed lines.

use std::fs;
use std::path::PathBuf;

use ligament_output::csv::{Table, Value};
use ligament_output::folder::{Kind, ResultFolder, refuse_links};
use serde::{Deserialize, Serialize};

use super::request::{CalibrationError, Request, setting};
use super::search::{Trial, Verdict};
use crate::quantities::{Quantities, QuantityError};
use ligament_run::inputs::Inputs;

/// File that marks the folder of a calibration.
const RECORD: &str = "calibration.json";

/// The table of the runs of a calibration.
const TABLE: &str = "calibration.csv";

/// Kind of the folder of a calibration, which has a subfolder for each run.
const KIND: Kind = Kind {
    owns: |name| name == TABLE,
    holds_run: |name| {
        name.strip_prefix("run-")
            .is_some_and(|it| it.parse::<usize>().is_ok())
    },
    ..Kind::with_marker(RECORD)
};

/// Terminations of a run at which the load may still have been rising, so that the peak may be later.
const CUT_SHORT: [&str; 6] = [
    "steps-done",
    "full-load",
    "energy-dissipated",
    "displacement-reached",
    "wall-time",
    "bonds-broken",
];

/// Record of the runs so far, on disk and in memory.
pub(super) struct Record {
    request: Request,
    inputs: String,
    folder: ResultFolder,
    table: Table,
    runs: Vec<Run>,
}

/// A run of a calibration.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Run {
    /// Number of the run, from 1.
    number: usize,
    /// Value of the key, and the result.
    #[serde(flatten)]
    pub(super) trial: Trial,
    /// Reason why the calibration ended.
    termination: String,
    /// Whether breakage continued in the last state of the run.
    #[serde(default)]
    last_state_not_at_rest: bool,
    /// Number of broken bonds.
    broken_bonds: u64,
    /// Wall time, s.
    seconds: f64,
    /// Units of displacement and force.
    units: [String; 2],
}

/// Content of `calibration.json`.
#[derive(Serialize)]
struct CalibrationFile<'a> {
    version: &'static str,
    #[serde(flatten)]
    request: &'a Request,
    /// `running` until the end, then `met`, `jump`, `out-of-reach` or `out-of-runs`.
    outcome: &'static str,
    /// The value that meets the target.
    value: Option<f64>,
    /// The inputs of the case with the first value of the key.
    inputs: &'a str,
    runs: &'a [Run],
}

/// Part of `calibration.json` that is read when a calibration is continued.
#[derive(Deserialize)]
struct EarlierCalibration {
    key: String,
    of: String,
    inputs: String,
    runs: Vec<Run>,
}

impl Run {
    pub(super) fn new(
        number: usize,
        trial: Trial,
        results: &Quantities,
    ) -> Result<Self, QuantityError> {
        let word = |name: &str| {
            let value = results.get(name).and_then(serde_json::Value::as_str);
            value.unwrap_or_default().to_owned()
        };
        let count = results
            .get("broken_bonds")
            .and_then(serde_json::Value::as_u64);
        Ok(Self {
            number,
            trial,
            termination: word("termination"),
            last_state_not_at_rest: results.ends_not_at_rest(),
            broken_bonds: count.unwrap_or_default(),
            seconds: results.number("seconds")?,
            units: [word("units.displacement"), word("units.force")],
        })
    }
}

impl Record {
    /// Creates a record in a new folder, or continues the record of an earlier calibration of the same key, result and case, whose runs are
    /// trials for any target.
    pub(super) fn open(request: &Request, inputs: &Inputs) -> anyhow::Result<Self> {
        let earlier = match request.force {
            true => None,
            false => earlier_runs(request, inputs)?,
        };
        let folder = match earlier {
            None => ResultFolder::create_of_kind(&request.out, KIND, request.force)?,
            Some(_) => ResultFolder::open(&request.out, KIND)?,
        };
        let columns = [
            "run",
            &request.key,
            &request.of,
            "off",
            "termination",
            "broken_bonds",
            "seconds",
            "folder",
        ];
        let table = Table::create(folder.file(TABLE), &columns)?;
        let mut record = Self {
            request: request.clone(),
            inputs: inputs.text().to_owned(),
            folder,
            table,
            runs: Vec::new(),
        };
        // The record is saved after all runs are added, so that a kill leaves the earlier record.
        for run in earlier.unwrap_or_default() {
            record.add_run(run)?;
        }
        record.save("running", None)?;
        Ok(record)
    }

    pub(super) fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// Folder for the results of a run.
    pub(super) fn run_folder(&self, number: usize) -> PathBuf {
        self.folder.file(&run_name(number))
    }

    /// Adds a completed run, and saves the record.
    pub(super) fn append(&mut self, run: Run) -> anyhow::Result<()> {
        self.add_run(run)?;
        self.save("running", None)
    }

    fn add_run(&mut self, run: Run) -> anyhow::Result<()> {
        let name = run_name(run.number);
        self.table.append(&[
            run.number.into(),
            run.trial.key.into(),
            run.trial.result.into(),
            self.relative_difference(&run.trial).into(),
            Value::Text(&run.termination),
            run.broken_bonds.into(),
            run.seconds.into(),
            Value::Text(&name),
        ])?;
        self.runs.push(run);
        Ok(())
    }

    /// Records the end of the search; an earlier calibration is then replaced.
    pub(super) fn close(self, verdict: &Verdict) -> anyhow::Result<()> {
        let (outcome, value) = match verdict {
            Verdict::Met(trial) => ("met", Some(trial.key)),
            Verdict::Jump(_) => ("jump", None),
            Verdict::OutOfReach => ("out-of-reach", None),
            Verdict::OutOfTrials => ("out-of-runs", None),
        };
        self.save(outcome, value)?;
        Ok(self.folder.finish()?)
    }

    fn save(&self, outcome: &'static str, value: Option<f64>) -> anyhow::Result<()> {
        let file = CalibrationFile {
            version: env!("CARGO_PKG_VERSION"),
            request: &self.request,
            outcome,
            value,
            inputs: &self.inputs,
            runs: &self.runs,
        };
        let text = serde_json::to_string_pretty(&file)?;
        Ok(self.folder.write(RECORD, text + "\n")?)
    }

    /// Difference from the target, relative to it.
    fn relative_difference(&self, trial: &Trial) -> f64 {
        (trial.result - self.request.target) / self.request.target.abs()
    }

    /// Heading of the lines of the runs.
    pub(super) fn heading(&self) -> String {
        let Request {
            key,
            of,
            target,
            within,
            ..
        } = &self.request;
        format!(
            "calibrating {key}: the target is {of} = {target:.6e} within {} %",
            100.0 * within
        )
    }

    /// Printed line of a run.
    pub(super) fn line(&self, run: &Run) -> String {
        let Request { key, of, .. } = &self.request;
        let unit = match of.rsplit('.').next() {
            Some("displacement") => format!(" {}", run.units[0]),
            Some("reaction") => format!(" {}", run.units[1]),
            _ => String::new(),
        };
        let Trial { key: value, result } = run.trial;
        let mut line = format!(
            "  run {}: {key} = {value:.6e} gives {result:.6e}{unit}, {:+.2} % off, {} bonds broken, {:.1} s",
            run.number,
            100.0 * self.relative_difference(&run.trial),
            run.broken_bonds,
            run.seconds,
        );
        if run.last_state_not_at_rest {
            line.push_str("; not converged: bonds were still breaking in its last state");
        }
        if of.contains("peak") && CUT_SHORT.contains(&run.termination.as_str()) {
            line.push_str("; it ended before the load fell, so the peak may lie beyond");
        }
        line
    }

    /// Text about the calibrated value.
    pub(super) fn answer(&self, trial: &Trial) -> String {
        let (key, n_runs) = (&self.request.key, self.runs.len());
        let run = self.runs.iter().find(|run| run.trial == *trial);
        let warning = match run.is_some_and(|it| it.last_state_not_at_rest) {
            true => "  NOT CONVERGED      bonds were still breaking in the last state of its run\n",
            false => "",
        };
        format!(
            "{key} = {}\n{warning}  runs               {n_runs}\n  use it by          --set {}\n  record in          {}\n",
            self.trial_text(trial),
            setting(key, trial.key),
            self.request.out.display()
        )
    }

    /// Message about a search without a result.
    pub(super) fn failure_message(&self, verdict: &Verdict) -> String {
        let Request { key, of, .. } = &self.request;
        let n_runs = self.runs.len();
        let record = self.request.out.display();
        let relative_difference = |run: &&Run| self.relative_difference(&run.trial).abs();
        let best = self
            .runs
            .iter()
            .min_by(|a, b| relative_difference(a).total_cmp(&relative_difference(b)));
        let nearest = best
            .map(|run| self.trial_text(&run.trial))
            .unwrap_or_default();
        match verdict {
            Verdict::Jump([a, b]) => format!(
                "{of} jumps over the target between {key} = {} and {} ({n_runs} runs, record in {record}); fewer bonds per iteration or \
                 smaller load steps may make it smoother; a larger --within accepts one of the two",
                self.trial_text(a),
                self.trial_text(b)
            ),
            Verdict::OutOfReach => format!(
                "no value of {key} between --from and --to meets the target; nearest is {nearest} ({n_runs} runs, record in \
                 {record})"
            ),
            Verdict::OutOfTrials | Verdict::Met(_) => format!(
                "the target was not met in {n_runs} runs (--max-runs); nearest is {key} = {nearest} (record in {record})"
            ),
        }
    }

    fn trial_text(&self, trial: &Trial) -> String {
        let (Trial { key, result }, of) = (trial, &self.request.of);
        let relative_difference = 100.0 * self.relative_difference(trial);
        format!("{key:?} with {of} = {result:.6e}, {relative_difference:+.2} % off")
    }
}

fn run_name(number: usize) -> String {
    format!("run-{number:02}")
}

/// The runs of an earlier calibration in the folder; `None` where there is none.
fn earlier_runs(request: &Request, inputs: &Inputs) -> anyhow::Result<Option<Vec<Run>>> {
    refuse_links(&request.out, KIND)?;
    let path = request.out.join(RECORD);
    let Ok(text) = fs::read_to_string(&path) else {
        return Ok(None);
    };
    let other = |difference: String| CalibrationError::Other {
        folder: request.out.clone(),
        difference,
    };
    let earlier: EarlierCalibration =
        serde_json::from_str(&text).map_err(|error| other(format!("cannot be read: {error}")))?;
    let [key, of] = [&request.key, &request.of];
    if earlier.key != *key || earlier.of != *of {
        let (key, of) = (earlier.key, earlier.of);
        return Err(other(format!("is one of {key} by {of}")).into());
    }
    if earlier.inputs != inputs.text() {
        let difference = inputs.difference(&earlier.inputs);
        return Err(other(format!("is one of another case: {difference}")).into());
    }
    Ok(Some(earlier.runs))
}
