//! Parts of a factor that are substituted backward one by one, each after its parent.

use std::ops::Range;

use crate::branches::Branch;
use crate::supernodes::Supernodes;

/// Rows of a factor whose backward substitution needs, besides themselves, only rows of ancestor parts.
///
/// Rows are counted in the order of elimination.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// Number of the parent part, smaller than the part's own; `None` for the root.
    pub above: Option<usize>,
    /// Rows of the part itself.
    pub rows: Range<usize>,
    /// Rows of ancestor parts that the part and its descendants need, ascending.
    pub border: Vec<usize>,
    pub(crate) supernodes: Range<usize>,
}

impl Part {
    /// Number of values of the factor in the part, counted as one dense panel.
    pub fn n_values(&self) -> usize {
        self.rows.len() * (self.rows.len() / 2 + self.border.len())
    }

    /// The parts of a factor, each after its parent; every part that has children has at least `least` values together with its descendants.
    pub(crate) fn from_supernodes(supernodes: Supernodes<'_>, least: usize) -> Vec<Self> {
        let mut parts = Vec::new();
        let mut branches = vec![(None, Branch::cut(supernodes, least))];
        while let Some((above, branch)) = branches.pop() {
            let number = parts.len();
            let all = branch.supernodes();
            let rows = |range: &Range<usize>| {
                supernodes.columns_before(range.start)..supernodes.columns_before(range.end)
            };
            let end = rows(&all).end;
            let below = all.flat_map(|supernode| supernodes.rows_below(supernode));
            let mut border: Vec<usize> = (below.copied()).filter(|&row| row >= end).collect();
            border.sort_unstable();
            border.dedup();
            parts.push(Self {
                above,
                rows: rows(&branch.stem),
                border,
                supernodes: branch.stem,
            });
            let below = branch.parts.into_iter().map(|part| (Some(number), part));
            branches.extend(below);
        }
        parts
    }
}
