//! Sources of the values of a factor, in the order of elimination: entries of the matrix, and updates between supernodes.

use crate::factorisation::FactorError;
use crate::matrix::Pattern;
use crate::supernodes::Supernodes;

/// Entries of a matrix by the columns of its factor.
#[derive(Debug)]
pub(crate) struct Sources {
    /// First entry of each column, then their number, shape (n + 1).
    starts: Vec<u32>,
    /// Row in the order of elimination and index in the matrix of each entry, shape (n_entries, 2).
    entries: Vec<[u32; 2]>,
}

impl Sources {
    /// The entries of a pattern, for the row of the factor of each unknown (n).
    pub(crate) fn new(pattern: &Pattern, row_of_unknown: &[usize]) -> Result<Self, FactorError> {
        if u32::try_from(pattern.n_entries()).is_err() {
            return Err(FactorError::IndexOverflow);
        }
        let n = pattern.dimension();
        let rows: Vec<u32> = row_of_unknown.iter().map(|&row| row as u32).collect();
        let in_columns = || {
            (0..n).flat_map(|column| {
                let places = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
                places.map(move |place| (column, place))
            })
        };
        let mut starts = vec![0; n + 1];
        for (column, place) in in_columns() {
            let row = pattern.rows()[place];
            starts[rows[row].min(rows[column]) as usize + 1] += 1;
        }
        for column in 0..n {
            starts[column + 1] += starts[column];
        }
        let mut next = starts.clone();
        let mut entries = vec![[0; 2]; pattern.n_entries()];
        for (column, place) in in_columns() {
            let [one, other] = [rows[pattern.rows()[place]], rows[column]];
            let slot = &mut next[one.min(other) as usize];
            entries[*slot as usize] = [one.max(other), place as u32];
            *slot += 1;
        }
        Ok(Self { starts, entries })
    }

    /// Row and index in the matrix of each entry of a column.
    pub(crate) fn column_entries(&self, column: usize) -> &[[u32; 2]] {
        &self.entries[self.starts[column] as usize..self.starts[column + 1] as usize]
    }
}

/// For each supernode, the earlier supernodes that update it because they have rows among its columns.
#[derive(Debug)]
pub(crate) struct UpdatingSupernodes {
    /// First updating supernode of each supernode in the list, then the length of the list, shape (n_supernodes + 1).
    starts: Vec<usize>,
    /// Updating supernodes, ascending for each supernode.
    supernodes: Vec<u32>,
}

impl UpdatingSupernodes {
    pub(crate) fn new(supernodes: Supernodes<'_>) -> Self {
        let of_row = supernodes.supernode_of_rows();
        let reached = |supernode: usize| {
            let rows = supernodes.rows_below(supernode);
            let of_rows = |rows: &[usize]| of_row[rows[0]] as usize;
            rows.chunk_by(|one, other| of_row[*one] == of_row[*other])
                .map(of_rows)
        };
        let count = supernodes.len();
        let mut starts = vec![0; count + 1];
        for target in (0..count).flat_map(reached) {
            starts[target + 1] += 1;
        }
        for supernode in 0..count {
            starts[supernode + 1] += starts[supernode];
        }
        let mut next = starts.clone();
        let mut updating_supernodes = vec![0; starts[count]];
        for supernode in 0..count {
            for target in reached(supernode) {
                updating_supernodes[next[target]] = supernode as u32;
                next[target] += 1;
            }
        }
        Self {
            starts,
            supernodes: updating_supernodes,
        }
    }

    /// The supernodes that update a supernode, ascending.
    pub(crate) fn supernodes(&self, reached: usize) -> &[u32] {
        &self.supernodes[self.starts[reached]..self.starts[reached + 1]]
    }
}
