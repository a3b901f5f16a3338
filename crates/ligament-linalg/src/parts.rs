//! Parts of a factor that can be substituted backward one by one, each after those above it.

use std::ops::Range;

use crate::branches::Branch;
use crate::supernodes::Supernodes;

/// Rows of a factor whose backward substitution needs, beside them, only rows of the parts above.
///
/// Rows are counted in the order of elimination.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// The part above, which has a smaller number; None of the last rows.
    pub above: Option<usize>,
    /// Rows of the part itself.
    pub rows: Range<usize>,
    /// Rows of parts above that the part and all parts below it need, ascending.
    pub border: Vec<usize>,
    pub(crate) supernodes: Range<usize>,
}

impl Part {
    /// Number of values of the factor in the part, as if it were one panel.
    pub fn n_values(&self) -> usize {
        self.rows.len() * (self.rows.len() / 2 + self.border.len())
    }

    /// The parts of a factor, each after the one above it; no part below which there is another one has less than `least` values with it.
    pub(crate) fn of_factor(supernodes: Supernodes<'_>, least: usize) -> Vec<Self> {
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
