//! `ligament report`.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use ligament_case::case::key_path::KeyPath;
use ligament_case::case::keys::unit_of;
use ligament_report::{DIGITS, MEGABYTE, Request, SIZE, STEPS, write_report};

use super::argument_parsers::{number, output_file};
use super::plot::completed_study;
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament report results/disk                       writes results/disk/report.html
  ligament report results/coarse results/fine --labels '4 mm' '2 mm' --out both.html
  ligament report results/disk --digits 3 --steps 20 a smaller page
  ligament report results/disk-converge              a study: its intervals and pictures above all of its runs

The page is one file without anything from a network: open it in a browser, send it, print it. It has
summary and warnings, force over displacement, energies and convergence, and the body with any field,
step by step; point at it for values, click for bonds and what became of them. A solid turns, is cut by
planes and opens along its crack.";

/// Usual digits and size (MB) of the page of a study, whose runs are looked at together.
const OF_STUDY: (u32, f64) = (3, 3.0);

/// `ligament report`.
#[derive(Debug, Args)]
pub struct ReportArgs {
    /// Folders with results of runs, or the folder of a study
    #[arg(value_name = "RESULT", required = true)]
    pub results: Vec<PathBuf>,
    /// The page [default: report.html in the first folder, which takes the place of an earlier one]
    #[arg(short, long, alias = "output", value_parser = output_file(), value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Replace the file of --out if there is one
    #[arg(long)]
    pub force: bool,
    /// Names of the results in the page, one for each [default: names of the folders]
    #[arg(long, value_name = "TEXT", num_args = 1..)]
    pub labels: Vec<String>,
    /// Measured curves to draw over those of the results: tables of two columns, whose header names them with their units, as in
    /// `opening (mm),force (kN)`
    #[arg(long, value_name = "CSV", num_args = 1..)]
    pub measured: Vec<PathBuf>,
    /// Digits that the largest value of a field in a step keeps [default: 4, in the page of a study 3]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=8))]
    pub digits: Option<u32>,
    /// Steps of a result at most; of more an even choice, with the largest load
    #[arg(long, value_name = "N", default_value_t = STEPS, value_parser = clap::value_parser!(u32).range(2..))]
    pub steps: u32,
    /// Megabytes of the page at most: what a reader wants least is left out, and named [default: 15, of a study 3]
    #[arg(long, value_name = "MB", value_parser = megabytes)]
    pub size: Option<f64>,
}

impl ReportArgs {
    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        let runs = completed_study(&self.results)?;
        let study = runs.as_ref().and_then(|_| self.results.first().cloned());
        let (labels, folders) = match runs {
            Some(runs) if self.labels.is_empty() => runs.into_iter().unzip(),
            Some(runs) => (
                self.labels,
                runs.into_iter().map(|(_, folder)| folder).collect(),
            ),
            None => (self.labels, self.results),
        };
        let (usual_digits, usual_size) = match study {
            Some(_) => OF_STUDY,
            None => (DIGITS, SIZE),
        };
        let written = write_report(&Request {
            study,
            folders,
            labels,
            measured: self.measured,
            unit_of: |key| KeyPath::parse(key).and_then(|key| unit_of(&key)),
            output: self.out,
            force: self.force,
            digits: self.digits.unwrap_or(usual_digits),
            steps: self.steps as usize,
            size: (self.size.unwrap_or(usual_size) * MEGABYTE) as usize,
        })?;
        let mut out = terminal::for_messages(&written.path);
        for it in &written.contents {
            writeln!(
                out,
                "{}: {} points, {} steps",
                it.label, it.points, it.steps
            )?;
            if !it.left_out.is_empty() {
                writeln!(out, "  no room for: {}", it.left_out.join(", "))?;
            }
        }
        let megabytes = written.size as f64 / MEGABYTE;
        Ok(writeln!(
            out,
            "{} ({megabytes:.1} MB)",
            written.path.display()
        )?)
    }
}

fn megabytes(text: &str) -> Result<f64, String> {
    let size = number(text).filter(|it| (0.5..=2000.0).contains(it));
    size.ok_or_else(|| "expected a number of megabytes from 0.5 to 2000".to_owned())
}
