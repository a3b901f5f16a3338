//! The modes of a cantilever by their names.

use anyhow::{Context, ensure};
use ligament_analysis::modal::Mode;

use super::published::Published;
use super::table::{Extent, LabelError, Labels, Table};
use super::trial::Trial;

/// The modes of the three tables in the papers.
const MODES: [fn(Frequencies) -> f64; 3] =
    [|it| it.flexural, |it| it.axial, |it| it.second_flexural];

/// Frequencies of the three lowest modes of a cantilever, Hz.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frequencies {
    /// First flexural mode.
    pub(super) flexural: f64,
    /// First axial mode.
    pub(super) axial: f64,
    /// Second flexural mode.
    pub(super) second_flexural: f64,
}

impl Frequencies {
    /// No frequencies: of an entry that is not computed.
    pub(super) const NONE: Self = Self {
        flexural: f64::NAN,
        axial: f64::NAN,
        second_flexural: f64::NAN,
    };

    /// The named frequencies of a trial with three modes, whose cantilever lies along the component `axis` (0: x, 1: y).
    ///
    /// The axial mode has the largest effective mass along the cantilever, wherever it stands among the three:
    /// with PDS it is below the first flexural one for nu < 0, and equal to it for nu = 0.
    pub(super) fn from_trial(trial: &Trial, axis: usize) -> anyhow::Result<Self> {
        let modes = trial.modes()?;
        let named = |mode: &Mode| (mode.frequency(), mode.participation[axis]);
        Self::from_modes(modes.iter().map(named))
    }

    /// The named frequencies of three modes, each a frequency and its share in a motion along the cantilever.
    pub(super) fn from_modes(modes: impl Iterator<Item = (f64, f64)>) -> anyhow::Result<Self> {
        let modes: Vec<(f64, f64)> = modes.collect();
        ensure!(modes.len() == 3, "{} modes, expected 3", modes.len());
        let along = |mode: &(f64, f64)| mode.1.powi(2);
        let largest = modes.iter().map(along).fold(0.0, f64::max);
        let (axial, flexural): (Vec<(f64, f64)>, Vec<_>) =
            modes.iter().partition(|mode| along(mode) == largest);
        ensure!(axial.len() == 1, "no mode is the axial one");
        Ok(Self {
            flexural: flexural[0].0,
            axial: axial[0].0,
            second_flexural: flexural[1].0,
        })
    }
}

/// Tables of the first flexural, the axial and the second flexural mode, of the frequencies that an entry asks for.
pub(super) fn tables(
    published: [Published; 3],
    extent: Extent,
    mut frequencies: impl FnMut(Labels<'_>) -> anyhow::Result<Frequencies>,
) -> anyhow::Result<Vec<Table>> {
    let table = |(table, frequency): (Published, fn(Frequencies) -> f64)| {
        table.judge(extent, |labels| frequencies(labels).map(frequency))
    };
    published.into_iter().zip(MODES).map(table).collect()
}

/// A table of the distances of the lattice from the finite elements, %: of an entry for the table of a number, from the rows
/// of that table with the labels of the lattice and of the elements.
pub(super) fn errors(
    published: Published,
    extent: Extent,
    tables: &[Table],
    rows: impl Fn(Labels<'_>) -> Result<[String; 2], LabelError>,
) -> anyhow::Result<Table> {
    published.judge(extent, |labels| {
        let name = format!("-table-{}", labels.text("table")?);
        let table = (tables.iter())
            .find(|table| table.heading.name.ends_with(&name))
            .context("no such table")?;
        let frequency = |of: &str| {
            let found = table.computed(&table.heading.keys[0], of)?;
            found.first().map(|it| it[1]).context("no such frequency")
        };
        let [lattice, elements] = rows(labels)?;
        Ok(100.0 * (frequency(&lattice)? / frequency(&elements)? - 1.0).abs())
    })
}
