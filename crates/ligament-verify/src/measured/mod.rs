//! Measured tests: `experiments/experiments.toml` has one entry for each, with its case, its measured curve, the bands of acceptance and the
//! meshes. A new test is an entry there and a table of points; no code knows a test by name.
//!
//! | module | holds |
//! |---|---|
//! | [`test`](mod@test) | entries of the table, and their reader |
//! | `curve` | measured and computed curves: peaks, areas |
//! | `reading` | one run of a test, and the values read from it |
//! | `judgement` | values of a run against the bands |
//! | `size_effect` | Bazant's law through peaks of several sizes |
//! | `figure` | the figure of a test |
//! | [`scoreboard`] | scores of the runs, for the page of measured tests |

mod curve;
mod figure;
mod judgement;

mod reading;
pub mod scoreboard;
mod size_effect;
pub mod test;

use std::sync::OnceLock;

use super::experiment::{Compute, Experiment, Findings};
use super::table::Extent;

use crate::places::folder;
use curve::KnownCurve;
use judgement::Judgement;
use reading::Reading;
use scoreboard::Scores;
pub use test::MeasuredTest;

/// Beginning of the names of all measured tests on the command line.
const GROUP: &str = "experiments_";

/// The measured tests as experiments, in the order of their table.
///
/// # Errors
///
/// If the table cannot be read, or an entry is wrong.
pub fn experiments() -> anyhow::Result<&'static [Experiment]> {
    static READ: OnceLock<Vec<(MeasuredTest, [String; 3])>> = OnceLock::new();
    static ALL: OnceLock<Vec<Experiment>> = OnceLock::new();
    if let Some(all) = ALL.get() {
        return Ok(all);
    }
    let tests = test::read(&folder().join("experiments.toml"))?;
    let words = |it: &MeasuredTest| {
        [
            format!("{GROUP}{}", it.name),
            format!("{}, measured", it.source),
            format!("{} Case: `{}`.", it.material, it.case),
        ]
    };
    let tests = tests.into_iter().map(|it| (it.clone(), words(&it)));
    let tests = READ.get_or_init(|| tests.collect());
    let experiment =
        |(test, [name, source, setup]): &'static (MeasuredTest, [String; 3])| Experiment {
            name,
            title: &test.title,
            source,
            setup,
            cases: &[],
            compute: Compute::Measured(test),
        };
    Ok(ALL.get_or_init(|| tests.iter().map(experiment).collect()))
}

impl MeasuredTest {
    /// Runs the test on its meshes, or on the meshes of the fast subset, and judges the results.
    ///
    /// # Errors
    ///
    /// If the measured curve cannot be read, or a case cannot be run.
    pub(super) fn compute(&self, extent: Extent) -> anyhow::Result<Findings> {
        let chosen = (self.run.iter()).filter(|run| run.fast || extent == Extent::Full);
        let chosen: Vec<_> = chosen.collect();
        if chosen.is_empty() {
            return Ok(Findings::default());
        }
        let measured = self.measured.as_ref();
        let measured = measured.map(|file| KnownCurve::read(&folder().join(file)));
        let measured = measured.transpose()?;
        let readings = chosen
            .iter()
            .map(|variant| Reading::from_run(self, variant));
        let readings: Vec<Reading> = readings.collect::<anyhow::Result<_>>()?;
        let judgement = Judgement::new(self, measured.as_ref(), &readings)?;
        let scores = Scores::new(self, &readings);
        Ok(Findings {
            plots: vec![figure::figure(
                self,
                measured.as_ref(),
                &readings,
                &judgement,
            )],
            tables: vec![judgement.table(self)],
            scores: Some(scores),
            ..Findings::default()
        })
    }
}
