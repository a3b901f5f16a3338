//! An experiment, and what it comes to.

use anyhow::Context;
use ligament_plot::picture::maps::Maps;
use ligament_plot::plots::Plot;

use super::table::{Extent, Table};
use super::trial::Template;

/// A published case, or several that belong together.
#[derive(Debug, Clone, Copy)]
pub struct Experiment {
    /// Name on the command line.
    pub name: &'static str,
    /// Title.
    pub title: &'static str,
    /// Paper, tables and figures, or closed form.
    pub source: &'static str,
    /// What is computed, and how.
    pub setup: &'static str,
    /// The cases that are run, with settings of each entry.
    pub cases: &'static [&'static Template],
    /// Computes the tables, or their fast subset.
    pub compute: fn(Extent) -> anyhow::Result<Findings>,
}

impl Experiment {
    /// Runs the experiment; a table without entries in the subset is left out.
    ///
    /// # Errors
    ///
    /// If a case of it cannot be run.
    pub fn run(&self, extent: Extent) -> anyhow::Result<Findings> {
        let mut findings = (self.compute)(extent)
            .with_context(|| format!("experiment {} cannot be run", self.name))?;
        findings.tables.retain(|table| !table.rows.is_empty());
        Ok(findings)
    }
}

/// What an experiment comes to.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Findings {
    /// Known and computed values.
    pub tables: Vec<Table>,
    /// Curves of them.
    pub plots: Vec<Plot>,
    /// Pictures of bodies.
    pub maps: Vec<Maps>,
}
