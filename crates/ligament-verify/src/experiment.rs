//! An experiment and its results.

use anyhow::Context;
use ligament_plot::picture::maps::Maps;
use ligament_plot::plots::Plot;

use super::experiment_file::ExperimentFile;
use super::measured::MeasuredTest;
use super::measured::scoreboard::Scores;
use super::table::{Extent, Table};

/// One or several related published cases, or a measured test.
#[derive(Debug, Clone, Copy)]
pub struct Experiment {
    /// Name on the command line.
    pub name: &'static str,
    /// Title of the experiment.
    pub title: &'static str,
    /// Paper, tables and figures, or closed form.
    pub source: &'static str,
    /// Description of the computation.
    pub setup: &'static str,
    /// Paths of the cases that are run, with settings of each entry; empty for an experiment file, which names its cases itself.
    pub cases: &'static [&'static str],
    /// Computation of the tables.
    pub compute: Compute,
}

/// Computation of the tables of an experiment.
#[derive(Debug, Clone, Copy)]
pub enum Compute {
    /// Function that computes the tables, or their fast subset.
    Code(fn(Extent) -> anyhow::Result<Findings>),
    /// File of the experiment.
    File(&'static ExperimentFile),
    /// Entry of the table of measured tests.
    Measured(&'static MeasuredTest),
}

impl Experiment {
    /// Paths of the cases that are run, from the root of the repository.
    pub fn case_files(&self) -> Vec<&'static str> {
        match self.compute {
            Compute::File(file) => file.cases(),
            _ => self.cases.to_vec(),
        }
    }

    /// Runs the experiment; a table without entries in the subset is left out.
    ///
    /// # Errors
    ///
    /// If a case of the experiment cannot be run.
    pub fn run(&self, extent: Extent) -> anyhow::Result<Findings> {
        let findings = match self.compute {
            Compute::Code(compute) => compute(extent),
            Compute::File(file) => file.compute(extent),
            Compute::Measured(test) => test.compute(extent),
        };
        let mut findings =
            findings.with_context(|| format!("experiment {} cannot be run", self.name))?;
        findings.tables.retain(|table| !table.rows.is_empty());
        Ok(findings)
    }
}

/// Results of an experiment.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Findings {
    /// Tables of known and computed values.
    pub tables: Vec<Table>,
    /// Plots of the values.
    pub plots: Vec<Plot>,
    /// Pictures of bodies.
    pub maps: Vec<Maps>,
    /// Scores of a measured test.
    pub scores: Option<Scores>,
}
