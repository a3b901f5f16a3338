//! The elimination tree, cut into branches that are independent of each other.
//!
//! The columns of a supernode depend only on supernodes of its own subtree (Liu 1990), so disjoint subtrees are independent tasks.
//! Supernodes are not renumbered: a subtree is stored as a range of supernodes, which includes any that the order puts between two
//! descendants. The branches do not depend on the number of threads.

use std::ops::Range;

use crate::supernodes::Supernodes;

/// Number of values of the factor that make a task worthwhile: their substitution takes a tenth of a millisecond.
const SMALLEST_TASK: usize = 100_000;

/// Reciprocal of the largest share of the factor in one task, unless one supernode has more.
const MOST_TASKS: usize = 32;

/// A range of supernodes that depends on no supernode outside: independent parts, followed by a stem.
#[derive(Debug, PartialEq)]
pub(crate) struct Branch {
    /// Branches that are independent of each other, ascending and without a gap up to the stem; none or several.
    pub(crate) parts: Vec<Branch>,
    /// Supernodes that may depend on all parts and on earlier supernodes of the stem.
    pub(crate) stem: Range<usize>,
}

impl Branch {
    /// The whole factor, cut into tasks.
    pub(crate) fn from_supernodes(supernodes: Supernodes<'_>) -> Self {
        let total = supernodes.values_before(supernodes.len());
        Self::cut(supernodes, (total / MOST_TASKS).max(SMALLEST_TASK))
    }

    /// The whole factor, cut where two adjacent ranges of supernodes have more than `most` values each.
    pub(crate) fn cut(supernodes: Supernodes<'_>, most: usize) -> Self {
        let cutting = TreePartition {
            first: first_supernodes(supernodes),
            supernodes,
            most,
        };
        cutting.branch(0..supernodes.len())
    }

    /// All supernodes of the branch.
    pub(crate) fn supernodes(&self) -> Range<usize> {
        let mut first = self;
        while let Some(part) = first.parts.first() {
            first = part;
        }
        first.stem.start..self.stem.end
    }
}

/// For each supernode, the first one of the smallest range that ends with it and depends on no supernode outside, shape (n_supernodes).
fn first_supernodes(supernodes: Supernodes<'_>) -> Vec<usize> {
    let count = supernodes.len();
    let of_row = supernodes.supernode_of_rows();
    let mut first_child: Vec<usize> = (0..count).collect();
    let mut first = Vec::with_capacity(count);
    // Last supernodes of the ranges so far that lie in no other range.
    let mut ends: Vec<usize> = Vec::new();
    for supernode in 0..count {
        let mut start = first_child[supernode];
        while let Some(end) = ends.pop_if(|end| *end >= start) {
            start = start.min(first[end]);
        }
        first.push(start);
        ends.push(supernode);
        if let Some(&row) = supernodes.rows_below(supernode).first() {
            let parent = &mut first_child[of_row[row] as usize];
            *parent = supernode.min(*parent);
        }
    }
    first
}

struct TreePartition<'a> {
    supernodes: Supernodes<'a>,
    /// First supernode of each range, see [`first_supernodes`].
    first: Vec<usize>,
    /// Number of values of the factor up to which a range is not cut.
    most: usize,
}

impl TreePartition<'_> {
    fn is_heavy(&self, range: &Range<usize>) -> bool {
        let Range { start, end } = *range;
        self.supernodes.values_before(end) - self.supernodes.values_before(start) > self.most
    }

    /// Divides a range that depends on no supernode outside into independent ranges, ascending.
    fn independent(&self, range: Range<usize>) -> Vec<Range<usize>> {
        let mut ranges = Vec::new();
        let mut end = range.end;
        while end > range.start {
            let start = self.first[end - 1];
            ranges.push(start..end);
            end = start;
        }
        ranges.reverse();
        ranges
    }

    /// The branch of a range that depends on no supernode outside. Branches are nested only where two heavy ranges meet, which bounds their
    /// depth.
    fn branch(&self, range: Range<usize>) -> Branch {
        let mut stem = range.end..range.end;
        let mut ranges = self.independent(range);
        let mut from = 0;
        loop {
            let is_heavy = |place: &usize| self.is_heavy(&ranges[*place]);
            let mut heavy = (from..ranges.len()).filter(is_heavy);
            let (Some(place), None) = (heavy.next(), heavy.next()) else {
                break;
            };
            stem.start = ranges[place].end - 1;
            let below = ranges[place].start..stem.start;
            ranges.truncate(place);
            ranges.extend(self.independent(below));
            from = place;
        }
        let mut parts: Vec<Branch> = Vec::new();
        let mut light: Option<Range<usize>> = None;
        for range in ranges {
            let with = light.as_ref().map(|light| light.start..range.end);
            if let Some(with) = with.filter(|with| !self.is_heavy(with)) {
                light = Some(with);
                continue;
            }
            parts.extend(light.take().map(task));
            if self.is_heavy(&range) {
                parts.push(self.branch(range));
            } else {
                light = Some(range);
            }
        }
        parts.extend(light.map(task));
        if let [one] = parts.as_slice() {
            stem.start = one.stem.start;
            parts.clear();
        }
        Branch { parts, stem }
    }
}

/// A branch of supernodes that are processed one after the other.
fn task(stem: Range<usize>) -> Branch {
    let parts = Vec::new();
    Branch { parts, stem }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matrix::Pattern;
    use crate::symbolic::{Elimination, Symbolic};
    use std::sync::Arc;

    /// The structure of a matrix with a diagonal and some entries (row, column) above it.
    fn structure(n: usize, above: impl Iterator<Item = (usize, usize)>) -> Symbolic {
        let mut columns = vec![Vec::new(); n];
        above.for_each(|(row, column)| columns[column].push(row));
        let (mut starts, mut rows) = (vec![0], Vec::new());
        for (column, mut of_column) in columns.into_iter().enumerate() {
            of_column.sort_unstable();
            of_column.dedup();
            rows.extend(of_column);
            rows.push(column);
            starts.push(rows.len());
        }
        let pattern = Arc::new(Pattern::new(starts, rows).expect("pattern"));
        let in_turn = Elimination::Given((0..n).collect());
        Symbolic::analyse(pattern, in_turn).expect("analysis")
    }

    /// Checks that parts do not depend on each other, and returns the supernodes of the branch, in their order, and its depth.
    fn checked(supernodes: Supernodes<'_>, branch: &Branch) -> (Vec<usize>, usize) {
        let (mut all, mut depth) = (Vec::new(), 0);
        let of_row = supernodes.supernode_of_rows();
        for part in &branch.parts {
            let (of_part, depth_of_part) = checked(supernodes, part);
            for &supernode in &of_part {
                for &row in supernodes.rows_below(supernode) {
                    let reached = of_row[row] as usize;
                    assert!(part.supernodes().contains(&reached) || reached >= branch.stem.start);
                }
            }
            all.extend(of_part);
            depth = depth.max(depth_of_part + 1);
        }
        all.extend(branch.stem.clone());
        (all, depth)
    }

    /// A chain, two chains, a chain with a leaf before each link, blocks on a common border, and one supernode.
    #[test]
    fn branches_need_nothing_of_each_other() {
        let n = 150_000;
        let pairs = (0..n - 1).map(|k| (k, k + 1));
        let halves = (0..n - 1).filter(|k| k + 1 != n / 2).map(|k| (k, k + 1));
        let leaves = (0..n - 2)
            .step_by(2)
            .flat_map(|k| [(k, k + 1), (k + 1, k + 3)]);
        let leaves = leaves.filter(|&(_, column)| column < n);
        let blocks = (0..1_000).flat_map(|block| {
            let inside =
                (0..20).flat_map(move |b| (0..b).map(move |a| (20 * block + a, 20 * block + b)));
            inside.chain((0..20).map(move |a| (20 * block + a, 20_000 + a)))
        });
        let full = (0..500).flat_map(|b| (0..b).map(move |a| (a, b)));
        for (name, symbolic, has_parts) in [
            ("chain", structure(n, pairs), false),
            ("two chains", structure(n, halves), true),
            ("leaves", structure(n, leaves), false),
            ("blocks", structure(20_020, blocks), true),
            ("full", structure(500, full), false),
        ] {
            let supernodes = symbolic.supernodes();
            assert!(symbolic.n_factor_values() > 2 * SMALLEST_TASK, "{name}");
            let branch = Branch::from_supernodes(supernodes);
            let (all, depth) = checked(supernodes, &branch);
            assert!(all.into_iter().eq(0..supernodes.len()), "{name}");
            assert!(depth <= MOST_TASKS, "{name}: {depth}");
            assert_eq!(!branch.parts.is_empty(), has_parts, "{name}: {branch:?}");
        }
    }
}
