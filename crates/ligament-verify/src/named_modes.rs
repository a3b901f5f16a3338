//! The modes of a cantilever by their names.

use anyhow::{Context, anyhow, ensure};
use ligament_analysis::modal::Mode;

use super::published::Published;
use super::table::{Extent, LabelError, Labels, Table};
use super::trial::Trial;

/// The modes of the three tables in the papers.
const MODES: [fn(Frequencies) -> f64; 3] =
    [|it| it.flexural, |it| it.axial, |it| it.second_flexural];

/// Names of these modes, as the papers have them.
pub(super) const NAMES: [&str; 3] = ["flexural I", "axial I", "flexural II"];

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
        let [flexural, axial, second_flexural] = in_named_order(modes.collect(), |it| it.1)?;
        Ok(Self {
            flexural: flexural.0,
            axial: axial.0,
            second_flexural: second_flexural.0,
        })
    }
}

/// The first flexural, the axial and the second flexural of three modes with rising frequencies, by their shares in a motion
/// along the cantilever.
pub(super) fn in_named_order<T>(
    modes: Vec<T>,
    along: impl Fn(&T) -> f64,
) -> anyhow::Result<[T; 3]> {
    let modes: [T; 3] = modes
        .try_into()
        .map_err(|modes: Vec<T>| anyhow!("{} modes, expected 3", modes.len()))?;
    let shares = modes.each_ref().map(|mode| along(mode).powi(2));
    let largest = shares.iter().copied().fold(0.0, f64::max);
    let axial: Vec<usize> = (0..3).filter(|it| shares[*it] == largest).collect();
    ensure!(axial.len() == 1, "no mode is the axial one");
    let [first, second, third] = modes;
    Ok(match axial[0] {
        0 => [second, first, third],
        1 => [first, second, third],
        _ => [first, third, second],
    })
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
