//! `ligament calibrate`.

use std::path::{Path, PathBuf};

use clap::Args;
use ligament_analysis::solver::MOST_THREADS;
use ligament_case::case::CaseFile;
use ligament_study::calibrate::{Request, calibrate, line};

use super::argument_parsers::{number, output_folder, positive_number};
use crate::build::BUILD;
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament calibrate disk.toml --key material.tensile_strength --target 598.47e3
  ligament calibrate disk.toml --key material.tensile_strength --target 598.47e3 \\
      --set model.horizon_factor=2.5 --set mesh.file=fine.msh --out results/fine-2.5
  ligament calibrate plate.toml --key material.young --of modes.3.frequency --target 1200
  ligament calibrate results/horizon-study --key material.tensile_strength --target 598.47e3 \\
      --by mesh.file --over 2, --at 2.5,3.5

The case runs with different values of the key, starting from its own, until the result is within 1 %
of the target (--within). Names of results are those of summary.json, with their parts joined by dots.
If no value meets the target, because the result jumps over it for example, the exit code is 1 and the
record is kept.

The folder of a sweep needs no runs: the result over the target is fitted by a line over --x (such as
NHPD eq. 22). A key to which the result is proportional, as the peak load is to the strength, is its
value in the runs over the line.";

/// `ligament calibrate`.
#[derive(Debug, Args)]
pub struct CalibrateArgs {
    /// The case file (TOML) to run; or the folder of a sweep, or its table (CSV), to read a line from
    #[arg(value_name = "CASE.toml|SWEEP")]
    pub subject: PathBuf,
    /// The key whose value is sought, e.g. material.tensile_strength
    #[arg(long, value_name = "KEY")]
    pub key: String,
    /// Target of the result, in its unit
    #[arg(long, value_name = "VALUE", allow_negative_numbers = true)]
    pub target: f64,
    /// The result, by its name in summary.json
    #[arg(long, value_name = "RESULT", default_value = "first_peak.reaction")]
    pub of: String,
    /// By running the case.
    #[command(flatten)]
    pub runs: RunsArgs,
    /// By a line in the table of a sweep.
    #[command(flatten)]
    pub line: LineArgs,
}

/// Options of a calibration by runs.
#[derive(Debug, Args)]
#[command(next_help_heading = "With a case")]
pub struct RunsArgs {
    /// Change a setting of the case in all runs, e.g. model.horizon_factor=4 (may be repeated)
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// Largest difference from the target, relative to it [default: 0.01]
    #[arg(long, value_name = "SHARE", value_parser = share)]
    pub within: Option<f64>,
    /// Smallest value of the key [default: none]
    #[arg(long, value_name = "VALUE", allow_negative_numbers = true)]
    pub from: Option<f64>,
    /// Largest value of the key [default: none]
    #[arg(long, value_name = "VALUE", allow_negative_numbers = true)]
    pub to: Option<f64>,
    /// Largest number of runs [default: 15]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub max_runs: Option<u32>,
    /// Threads to compute with [default: solver.threads of the case, or one per processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_THREADS)))]
    pub threads: Option<u32>,
    /// Folder for the record and the runs [default: results/NAME-calibration with the name of the case's folder]
    #[arg(short, long, alias = "output", value_parser = output_folder(), value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace an earlier calibration in the folder instead of going on with it
    #[arg(long)]
    pub force: bool,
}

/// Options of a calibration by a line.
#[derive(Debug, Args)]
#[command(next_help_heading = "With a sweep")]
pub struct LineArgs {
    /// The column along the line [default: model.horizon_factor]
    #[arg(long, value_name = "COLUMN")]
    pub x: Option<String>,
    /// Column each value of which has a line of its own, e.g. mesh.file (may be repeated)
    #[arg(long, value_name = "COLUMN")]
    pub by: Vec<String>,
    /// Range of x over which lines are fitted [default: all]
    #[arg(long, value_name = "FROM,TO", value_parser = range, allow_hyphen_values = true)]
    pub over: Option<[f64; 2]>,
    /// Values of x at which the key is wanted
    #[arg(
        long,
        value_name = "X",
        value_delimiter = ',',
        allow_negative_numbers = true
    )]
    pub at: Vec<f64>,
}

impl RunsArgs {
    /// The first of these options that is given.
    fn first_given(&self) -> Option<&'static str> {
        let options = [
            ("--set", !self.overrides.is_empty()),
            ("--within", self.within.is_some()),
            ("--from", self.from.is_some()),
            ("--to", self.to.is_some()),
            ("--max-runs", self.max_runs.is_some()),
            ("--threads", self.threads.is_some()),
            ("--out", self.out.is_some()),
            ("--force", self.force),
        ];
        options
            .into_iter()
            .find_map(|(name, is_given)| is_given.then_some(name))
    }
}

impl LineArgs {
    /// The first of these options that is given.
    fn first_given(&self) -> Option<&'static str> {
        let options = [
            ("--x", self.x.is_some()),
            ("--by", !self.by.is_empty()),
            ("--over", self.over.is_some()),
            ("--at", !self.at.is_empty()),
        ];
        options
            .into_iter()
            .find_map(|(name, is_given)| is_given.then_some(name))
    }
}

impl CalibrateArgs {
    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        if line::is_table(&self.subject) {
            return match self.runs.first_given() {
                Some(option) => anyhow::bail!(
                    "{option} goes with a case to run; this is a sweep or its table, of which a line is made"
                ),
                None => self.by_line(),
            };
        }
        match self.line.first_given() {
            Some(option) => anyhow::bail!(
                "{option} goes with the folder or the table of a sweep; this is a case, which is run"
            ),
            None => self.by_runs(),
        }
    }

    fn by_runs(self) -> anyhow::Result<()> {
        let runs = self.runs;
        let name = CaseFile::load(&self.subject, &runs.overrides)?.name();
        let default_out = || Path::new("results").join(format!("{name}-calibration"));
        let request = Request {
            case: self.subject,
            overrides: runs.overrides,
            threads: runs.threads,
            key: self.key,
            of: self.of,
            target: self.target,
            within: runs.within.unwrap_or(0.01),
            from: runs.from,
            to: runs.to,
            most_runs: runs.max_runs.unwrap_or(15) as usize,
            out: runs.out.unwrap_or_else(default_out),
            force: runs.force,
            build: BUILD,
        };
        calibrate(&request, &mut terminal::stderr(), &mut terminal::stdout())
    }

    fn by_line(self) -> anyhow::Result<()> {
        let request = line::Request {
            table: self.subject,
            x: (self.line.x).unwrap_or_else(|| "model.horizon_factor".to_owned()),
            of: self.of,
            by: self.line.by,
            over: self.line.over.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]),
            at: self.line.at,
            key: self.key,
            target: self.target,
        };
        let lines = line::lines(&request)?;
        Ok(line::write(&request, &lines, &mut terminal::stdout())?)
    }
}

/// A share on the command line, more than 0.
fn share(text: &str) -> Result<f64, String> {
    let share = positive_number(text);
    share.ok_or_else(|| "expected a share greater than 0, such as 0.01 for 1 %".to_owned())
}

/// A range on the command line; either end may be left out.
fn range(text: &str) -> Result<[f64; 2], String> {
    let end = |text: &str, open: f64| match text.trim() {
        "" => Some(open),
        text => number(text),
    };
    let ends = text
        .split_once(',')
        .and_then(|(from, to)| Some([end(from, f64::NEG_INFINITY)?, end(to, f64::INFINITY)?]));
    let ends = ends.filter(|[from, to]| from < to);
    ends.ok_or_else(|| "expected FROM,TO such as 2,4 or 2,".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_may_be_open() {
        assert_eq!(range("2,4"), Ok([2.0, 4.0]));
        assert_eq!(range("2,"), Ok([2.0, f64::INFINITY]));
        assert_eq!(range(",4"), Ok([f64::NEG_INFINITY, 4.0]));
        for wrong in ["2", "4,2", "a,b", "2,2"] {
            assert!(range(wrong).is_err(), "{wrong}");
        }
        assert!(share("0").is_err() && share("x").is_err() && share("0.02") == Ok(0.02));
    }
}
