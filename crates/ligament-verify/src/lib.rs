//! The program `ligament-verify`: runs the published cases and compares the results, entry by entry.
//!
//! | Module | Holds |
//! |--------|-------|
//! | `published` | the reader of `published/*.csv`: known values, tolerances, misprints with their reasons |
//! | [`table`], [`entry`], `printed` | tables, verdicts on entries, numbers with their printed digits |
//! | `case_run` | a case of the repository, run in memory by the functions of `ligament run` |
//! | [`experiment_file`] | experiments that are files beside their tables, and the quantities that their expressions can read |
//! | `fast_crack`, `griffith`, `hole`, `record`, ... | quantities of a run, one subject each |
//! | `readings`, `tension`, `maps`, `yielding` | the other experiments, one module each |
//! | [`finite_elements`] | classical elasticity, for comparison with the lattices of the papers |
//! | [`measured`] | measured tests with bands of acceptance, from a table |
//! | `papers` | the papers' tables and figures, and the tables of this report that compare them |
//! | `report`, [`tally`] | console, the page of the papers, the long report, CSV and SVG |
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

use std::io::Write;
use std::path::PathBuf;
use std::sync::OnceLock;

use clap::Parser;
use ligament::suggestion::hint;
use ligament_cli::commands::argument_parsers::output_folder;
use ligament_output::folder::{Kind, ResultFolder};

mod anisotropy;
mod case_run;
mod contact_pressure;
mod convergence;
mod crack_path;
mod directions;
pub mod entry;
mod experiment;
pub mod experiment_file;
mod fast_crack;
pub mod finite_elements;
mod ghost_forces;
mod griffith;
mod hole;
mod lamina_elements;
mod maps;
pub mod measured;
mod named_modes;
mod papers;
mod patch_test;
mod places;
mod printed;
mod published;
mod readings;
mod record;
mod refinement;
mod report;
mod ring;
mod square_elements;
pub mod table;
pub mod tally;
mod tension;
mod uniform_stress;
mod yielding;

use ExperimentSource::{Code, File};
pub use experiment::{Compute, Experiment, Findings};
pub use measured::experiments;

use entry::Verdict;
use experiment_file::ExperimentFile;
use report::{console, files, markdown, page, scoreboard};
use table::Extent;
use tally::Tally;

/// Source of an experiment: a module or a file.
enum ExperimentSource {
    /// An experiment that is a module.
    Code(&'static Experiment),
    /// An experiment that is a file of its name ([`experiment_file`]).
    File(&'static str),
}

/// Experiments of published values, in the order of the report; the measured tests follow them ([`experiments`]).
static PUBLISHED: [ExperimentSource; 50] = [
    File("frequencies"),
    File("statics"),
    Code(&readings::EXPERIMENT),
    File("lamina"),
    Code(&tension::EXPERIMENT),
    Code(&maps::EXPERIMENT),
    File("directions"),
    File("moduli"),
    File("poisson"),
    Code(&yielding::EXPERIMENT),
    File("anisotropy"),
    File("disk"),
    File("slots"),
    File("inclined"),
    File("griffith"),
    File("softening"),
    File("plates"),
    File("cylinder"),
    File("cracks"),
    File("cost"),
    File("patch_test"),
    File("bars"),
    File("incompressible"),
    File("ring"),
    File("hole"),
    File("horizons"),
    File("disk_modes"),
    File("strength_squares"),
    File("strength_hole"),
    File("strength_disk"),
    File("strength_crack"),
    File("strength_bar"),
    File("strength_cube"),
    File("strength_glass"),
    File("motion_waves"),
    File("motion_vibration"),
    File("motion_lamb"),
    File("motion_branching"),
    File("motion_kalthoff"),
    File("motion_spall"),
    File("motion_stretching"),
    File("motion_disk"),
    File("motion_splitting"),
    File("motion_contact"),
    File("motion_schemes"),
    File("contact_sliding"),
    File("contact_hertz"),
    File("contact_flaw"),
    Code(&convergence::EXPERIMENT),
    Code(&refinement::EXPERIMENT),
];

const EXAMPLES: &str = "\
Examples:
  ligament-verify                    everything: results/verification/README.md
  ligament-verify disk --fast        one experiment, and of it what the tests run
  ligament-verify strength           all whose names begin with strength_
  ligament-verify experiments        the measured tests: experiments.md
  ligament-verify --list             the experiments

The exit code is 1 if a value that should agree does not.";

/// Published values beside those that Ligament computes.
///
/// Runs cases of the papers that the models are from, and prints for every known value what this
/// program computes, the difference, and whether that is as it should be; known misprints with
/// their reasons. Writes the same as Markdown, CSV and plots (SVG).
#[derive(Debug, Parser)]
#[command(name = "ligament-verify", version, after_help = EXAMPLES)]
pub struct Request {
    /// Experiments to run [default: all]
    #[arg(value_name = "NAME")]
    pub names: Vec<String>,
    /// List the experiments with their sources, and run none
    #[arg(long)]
    pub list: bool,
    /// Run the subset that the tests run
    #[arg(long)]
    pub fast: bool,
    /// Folder for the report
    #[arg(
        long,
        alias = "output", value_parser = output_folder(),
        value_name = "DIR",
        default_value = "results/verification"
    )]
    pub out: PathBuf,
    /// Replace an earlier report in the folder
    #[arg(long)]
    pub force: bool,
}

/// Error of a verification.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum VerifyError {
    /// No experiment has this name.
    #[error("no experiment `{name}`{}", hint(name, known, "experiments", '`'))]
    UnknownExperiment {
        /// The name given.
        name: String,
        /// Existing names.
        known: Vec<String>,
    },
    /// Entries fail.
    #[error("{failed} of {entries} entries fail: those marked {} above", Verdict::Failed.words())]
    EntriesFail {
        /// Number of entries that fail.
        failed: usize,
        /// Number of all entries.
        entries: usize,
    },
}

/// Lists the experiments, or runs some, prints the tables of each, and writes the report.
///
/// # Errors
///
/// If a name is unknown, the folder cannot be used, an experiment cannot be run, or, after the report is written, if an entry fails.
pub fn verify(request: &Request, screen: &mut dyn Write) -> anyhow::Result<()> {
    if request.list {
        return Ok(console::list(screen, &all()?)?);
    }
    let extent = match request.fast {
        true => Extent::Fast,
        false => Extent::Full,
    };
    let chosen = select(&request.names)?;
    let folder = ResultFolder::create_of_kind(
        &request.out,
        Kind::with_marker(files::SUMMARY),
        request.force,
    )?;
    let mut summary = files::Summary::create(&folder)?;
    let mut done = Vec::new();
    for experiment in chosen {
        console::announce(screen, &experiment)?;
        let findings = experiment.run(extent)?;
        console::write(screen, &findings)?;
        files::write(&folder, &findings)?;
        summary.append(&experiment, &Tally::from_findings(&findings))?;
        done.push((experiment, findings));
    }
    folder.write("README.md", page::text(&done, extent)?)?;
    folder.write("report.md", markdown::text(&done))?;
    if let Some(text) = scoreboard::text(&done) {
        folder.write(scoreboard::PAGE, text)?;
    }
    folder.finish()?;
    let all: Tally = done
        .iter()
        .map(|(_, findings)| Tally::from_findings(findings))
        .sum();
    writeln!(screen, "{all}")?;
    writeln!(
        screen,
        "report in {}",
        request.out.join("README.md").display()
    )?;
    Ok(conclude(&all)?)
}

/// Returns an error if an entry fails.
fn conclude(all: &Tally) -> Result<(), VerifyError> {
    let (failed, entries) = (all.count(Verdict::Failed), all.entries());
    if failed == 0 {
        Ok(())
    } else {
        Err(VerifyError::EntriesFail { failed, entries })
    }
}

/// The experiments of published values, in the order of the report.
///
/// # Errors
///
/// If the file of one cannot be read.
pub fn published_experiments() -> anyhow::Result<&'static [Experiment]> {
    static READ: OnceLock<Vec<Experiment>> = OnceLock::new();
    if let Some(all) = READ.get() {
        return Ok(all);
    }
    let all = PUBLISHED.iter().map(|it| match it {
        Code(experiment) => Ok(**experiment),
        File(name) => Ok(ExperimentFile::read(name)?.experiment()),
    });
    let all = all.collect::<anyhow::Result<Vec<_>>>()?;
    Ok(READ.get_or_init(|| all))
}

/// All experiments, in the order of the report.
///
/// # Errors
///
/// If the file of an experiment or the table of measured tests is wrong.
pub fn all() -> anyhow::Result<Vec<Experiment>> {
    let published = published_experiments()?.iter();
    Ok(published.chain(experiments()?).copied().collect())
}

/// The experiments of these names, in the order of the report; all without names. A name that no experiment has selects a group: all
/// experiments whose names begin with it and an underscore.
///
/// # Errors
///
/// If a name is unknown, or the table of measured tests is wrong.
pub fn select(names: &[String]) -> anyhow::Result<Vec<Experiment>> {
    let all = all()?;
    let known = || all.iter().map(|experiment| experiment.name.to_owned());
    let is_of = |experiment: &Experiment, name: &str| {
        let is_group = known().all(|it| it != name);
        let rest = experiment.name.strip_prefix(name);
        rest.is_some_and(|rest| rest.is_empty() || is_group && rest.starts_with('_'))
    };
    let is_known = |name: &str| all.iter().any(|it| is_of(it, name));
    if let Some(name) = names.iter().find(|name| !is_known(name)) {
        return Err(VerifyError::UnknownExperiment {
            name: name.clone(),
            known: known().collect(),
        }
        .into());
    }
    let is_chosen = |experiment: &&Experiment| {
        names.is_empty() || names.iter().any(|name| is_of(experiment, name))
    };
    Ok(all.iter().filter(is_chosen).copied().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_entry_that_fails_fails_the_verification() {
        assert_eq!(conclude(&Tally::from([5, 0, 4, 3, 2, 1, 1, 0])), Ok(()));
        let error = conclude(&Tally::from([5, 1, 4, 3, 2, 1, 0, 2])).unwrap_err();
        assert_eq!(
            error,
            VerifyError::EntriesFail {
                failed: 2,
                entries: 18
            }
        );
        assert_eq!(
            error.to_string(),
            "2 of 18 entries fail: those marked FAILED above"
        );
    }

    #[test]
    fn experiments_are_chosen_by_name_in_the_order_of_the_report() {
        let names = |chosen: &[&str]| {
            let chosen: Vec<String> = chosen.iter().map(|&name| name.to_owned()).collect();
            select(&chosen).map(|list| list.iter().map(|it| it.name).collect::<Vec<_>>())
        };
        assert_eq!(names(&[]).unwrap().len(), all().unwrap().len());
        assert_eq!(names(&["disk", "poisson"]).unwrap(), ["poisson", "disk"]);
        let measured = experiments().unwrap();
        assert_eq!(names(&["experiments"]).unwrap().len(), measured.len());
        let group = names(&["strength"]).unwrap();
        assert_eq!((group.len(), group[0]), (7, "strength_squares"));
        assert!(names(&["stren"]).is_err());
        let error = names(&["poison"]).unwrap_err().to_string();
        assert!(
            error.starts_with("no experiment `poison`; did you mean `poisson`?"),
            "{error}"
        );
    }
}
