//! Experiments that are files: `published/NAME.toml` says which case runs with which settings for the labels of an entry, and which
//! expression of its results is compared. docs/verification.md explains every key.
//!
//! | module | holds |
//! |---|---|
//! | `document` | the structure of the file |
//! | `expression` | numbers, names, + - * / ^ and functions of numbers, of runs and of the history of a run |
//! | `quantity`, `loaded_run`, `history` | quantities that an expression can read from a run, and from every row of its history |
//! | `entry_runs` | the runs of an entry, each with its labels and its case run, and the cache of their results |
//! | `figure` | plots |

mod document;
mod entry_runs;
mod expression;
mod figure;
mod history;
mod loaded_run;
mod quantity;

use anyhow::{Context, ensure};

use super::case_run::CaseRun;
use super::experiment::{Compute, Experiment, Findings};
use super::published::{folder, known_table};
use super::table::{Extent, KnownTable};

use document::Choice;
pub use document::ExperimentFile;
use entry_runs::{EntryRuns, RunCache};

impl ExperimentFile {
    /// Reads the experiment of a name.
    ///
    /// # Errors
    ///
    /// If the file cannot be read or does not describe an experiment.
    pub(super) fn read(name: &str) -> anyhow::Result<Self> {
        let path = folder().join(format!("{name}.toml"));
        let attempt = || -> anyhow::Result<Self> {
            let read: Self = toml::from_str(&std::fs::read_to_string(&path)?)?;
            ensure!(read.name == name, "its name is `{}`", read.name);
            Ok(read)
        };
        attempt().with_context(|| path.display().to_string())
    }

    /// The experiment, which lasts as long as the program.
    pub(super) fn experiment(self) -> Experiment {
        let file: &'static Self = Box::leak(Box::new(self));
        Experiment {
            name: &file.name,
            title: &file.title,
            source: &file.source,
            setup: &file.setup,
            cases: &[],
            compute: Compute::File(file),
        }
    }

    /// The case files of all tables, in the order of their names, from the root of the repository.
    pub(super) fn cases(&self) -> Vec<&str> {
        let runs = self.table.iter().map(|table| &table.run);
        let all = runs.chain([&self.run]).filter_map(|run| run.case.as_ref());
        let mut cases: Vec<&str> = all.flat_map(Choice::texts).collect();
        cases.sort_unstable();
        cases.dedup();
        cases
    }

    /// The run of the case of all tables with some labels, each after its key.
    pub(super) fn case_run(&self, labels: &[(&str, &str)]) -> anyhow::Result<CaseRun> {
        let labels = labels
            .iter()
            .map(|(key, label)| (key.to_string(), label.to_string()));
        figure::runs(self, "0", labels.collect())?.case_run(0)
    }

    /// Computes the tables, or their fast subset, and with all entries the plots.
    ///
    /// # Errors
    ///
    /// If a table cannot be read, a case cannot be run, or a value has no meaning for an entry.
    pub(super) fn compute(&self, extent: Extent) -> anyhow::Result<Findings> {
        let known = self.table.iter().map(|table| known_table(&table.file));
        let known: Vec<KnownTable> = known.collect::<anyhow::Result<_>>()?;
        let mut cache = RunCache::default();
        for (table, known) in self.table.iter().zip(&known) {
            known.judge(extent, |labels| {
                cache.plan(&EntryRuns::for_entry(self, table, labels)?)?;
                Ok(f64::NAN)
            })?;
        }
        let figures = match extent {
            Extent::Fast => &[][..],
            Extent::Full => &self.plot,
        };
        for figure in figures {
            figure.plan(self, &mut cache)?;
        }
        let mut tables = Vec::new();
        for (table, known) in self.table.iter().zip(&known) {
            tables.push(known.judge(extent, |labels| {
                cache.value(&EntryRuns::for_entry(self, table, labels)?)
            })?);
        }
        let mut plots = Vec::new();
        for figure in &self.plot {
            plots.extend(figure.plots(self, extent, &tables, &mut cache)?);
        }
        Ok(Findings {
            tables,
            plots,
            ..Findings::default()
        })
    }
}

#[cfg(test)]
mod tests;
