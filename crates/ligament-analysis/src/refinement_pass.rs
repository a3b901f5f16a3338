//! Record of a pass of refinement: a whole run on a mesh that is finer where bonds of the runs before broke.

use serde::{Deserialize, Serialize};

use crate::termination::{Termination, Verdict};

/// Record of a pass of refinement.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "case", derive(schemars::JsonSchema))]
pub struct PassRecord {
    /// Number of the pass, from 1.
    pub pass: u32,
    /// Median size of the finest cells, m: the edge of an equilateral triangle, or of a regular tetrahedron, of one size with the cell.
    pub size: f64,
    /// Largest horizon of the points of the fine part, m; 0 in the first pass, which has none.
    pub fine_horizon: f64,
    /// Number of points.
    pub points: usize,
    /// Number of bonds.
    pub bonds: usize,
    /// Largest reaction at rest, N.
    pub peak: f64,
    /// External work at the end, J.
    pub work: f64,
    /// Mean over the points of the ratio of the energy of the bonds to that of the material, for the uniform strain with the largest deviation from 1.
    pub energy_ratio: f64,
    /// Number of bonds that the indicator counts: broken, or softened so far.
    pub open_bonds: usize,
    /// Share of these bonds between points whose horizons are no larger than the largest of the fine part; none in the first pass, or without
    /// such bonds.
    pub inside: Option<f64>,
    /// Relative change of the peak since the pass before.
    pub peak_change: Option<f64>,
    /// Relative change of the work since the pass before.
    pub work_change: Option<f64>,
    /// Largest distance of the middle of an open bond of one of this pass and the pass before from the nearest one of the other, m.
    pub path_change: Option<f64>,
}

/// Reason why no other pass follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "case", derive(schemars::JsonSchema))]
pub enum LastPass {
    /// No bond came near its limit, so that no place has to be finer.
    NothingToRefine,
    /// The next mesh would be the same.
    SameMesh,
    /// Peak, work and path changed by less than the tolerance between two passes of one size.
    WithinTolerance,
    /// The largest number of passes is reached.
    AllPasses,
    /// The pass was stopped, or ended without results that can be trusted.
    CutShort,
}

impl LastPass {
    /// Description of the reason, for the user.
    pub fn words(self) -> &'static str {
        match self {
            Self::NothingToRefine => "no bond came near its limit, so that nothing is refined",
            Self::SameMesh => "the next mesh would be the same",
            Self::WithinTolerance => "the last two passes of one size agree within the tolerance",
            Self::AllPasses => "the largest number of passes is reached",
            Self::CutShort => "the pass was cut short",
        }
    }
}

impl PassRecord {
    /// The record with its changes since an earlier pass, whose open bonds are at most `path_change` (m) apart from the present ones.
    pub fn after(self, earlier: Option<&Self>, path_change: Option<f64>) -> Self {
        let change = |of: fn(&Self) -> f64| {
            let before = of(earlier?);
            (before != 0.0).then(|| of(&self) / before - 1.0)
        };
        Self {
            peak_change: change(|it| it.peak),
            work_change: change(|it| it.work),
            path_change,
            ..self
        }
    }

    /// Whether peak and work changed by no more than a tolerance since the pass before, and the path by no more than the size of the finest cells.
    pub fn is_settled(&self, tolerance: f64) -> bool {
        let is_small = |change: Option<f64>| change.is_some_and(|it| it.abs() <= tolerance);
        is_small(self.peak_change)
            && is_small(self.work_change)
            && self.path_change.is_none_or(|it| it <= self.size)
    }
}

/// Whether a run ended before it could say where a mesh has to be finer.
pub fn is_cut_short(end: &Termination) -> bool {
    let by_time = matches!(end, Termination::WallTime { .. });
    by_time || matches!(end.row().verdict, Verdict::Stopped | Verdict::Invalid)
}
