//! The modes of a cantilever by name.

use anyhow::{anyhow, bail, ensure};
use ligament_analysis::modal::Mode;

use super::case_run::CaseRun;

/// Names of the modes of the three tables, as in the papers.
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
    /// The frequency of a mode by its name.
    pub(super) fn named(self, name: &str) -> anyhow::Result<f64> {
        match name {
            "flexural" => Ok(self.flexural),
            "axial" => Ok(self.axial),
            "second_flexural" => Ok(self.second_flexural),
            other => bail!("no mode `{other}`"),
        }
    }

    /// The named frequencies of a case run with three modes, whose cantilever lies along the component `axis` (0: x, 1: y).
    ///
    /// The axial mode has the largest effective mass along the cantilever, at any place among the three: with PDS its frequency is below
    /// the first flexural one for nu < 0, and equal to it for nu = 0.
    pub(super) fn from_case_run(case_run: &CaseRun, axis: usize) -> anyhow::Result<Self> {
        let modes = case_run.modes()?;
        let named = |mode: &Mode| (mode.frequency(), mode.participation[axis]);
        Self::from_modes(modes.iter().map(named))
    }

    /// The named frequencies of three modes, each given by its frequency and its participation along the cantilever.
    pub(super) fn from_modes(modes: impl Iterator<Item = (f64, f64)>) -> anyhow::Result<Self> {
        let [flexural, axial, second_flexural] = in_named_order(modes.collect(), |it| it.1)?;
        Ok(Self {
            flexural: flexural.0,
            axial: axial.0,
            second_flexural: second_flexural.0,
        })
    }
}

/// The first flexural, the axial and the second flexural one of three modes with ascending frequencies, by their participations along the
/// cantilever.
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
