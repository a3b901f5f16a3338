//! Unknowns that an analysis need not tell apart, and what of a pattern has the same factor without them.

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use rayon::prelude::*;

use crate::matrix::Pattern;

/// Columns that make a task worth while.
const TASK: usize = 1024;

/// Column starts (n + 1) and rows of a part of a pattern whose factor has entries where that of the whole pattern has them, with the
/// place of each unknown in the order of elimination (n).
///
/// Unknowns that are coupled with each other and with the same others, as those of a point are, and follow each other in the order of
/// elimination have columns in the factor that differ in nothing but their beginning (indistinguishable nodes, George and Liu 1989):
/// the first one hands its rows on to the next. So of all of them the entries of the first are enough.
pub(crate) fn reduced(pattern: &Pattern, places: &[usize]) -> (Vec<usize>, Vec<usize>) {
    let follows = &followers(pattern, places);
    let kept = |column: usize| {
        let is_kept = move |&&row: &&usize| {
            let earlier = if places[row] < places[column] {
                row
            } else {
                column
            };
            row == column || !follows[earlier].load(Relaxed)
        };
        rows_of(pattern, column).iter().filter(is_kept).copied()
    };
    let columns = || (0..pattern.dimension()).into_par_iter().with_min_len(TASK);
    let counts: Vec<usize> = columns().map(|column| kept(column).count()).collect();
    let mut starts = vec![0];
    let mut n_entries = 0;
    for count in counts {
        n_entries += count;
        starts.push(n_entries);
    }
    (starts, columns().flat_map_iter(kept).collect())
}

/// For each unknown, whether nothing but its place right behind the one of the number before distinguishes it from that one, shape (n).
fn followers(pattern: &Pattern, places: &[usize]) -> Vec<AtomicBool> {
    let columns = || (0..pattern.dimension()).into_par_iter().with_min_len(TASK);
    let is_like_last = |column: usize| {
        let Some(last) = column.checked_sub(1) else {
            return false;
        };
        let (before, rows) = (rows_of(pattern, last), rows_of(pattern, column));
        places[column] == places[last] + 1 && rows[..rows.len() - 1] == *before
    };
    let follows: Vec<AtomicBool> = columns().map(is_like_last).map(AtomicBool::new).collect();
    let part = |unknown: usize| {
        if follows[unknown].load(Relaxed) {
            follows[unknown].store(false, Relaxed);
        }
    };
    columns().for_each(|column| {
        let [others @ .., _] = rows_of(pattern, column) else {
            return;
        };
        // Where a run of numbers begins or ends, one of two neighbours is coupled with the column alone.
        for run in others.chunk_by(|one, next| one + 1 == *next) {
            part(run[0]);
            let behind = run[0] + run.len();
            if behind < column {
                part(behind);
            }
        }
    });
    follows
}

/// Rows of a column, the diagonal last.
fn rows_of(pattern: &Pattern, column: usize) -> &[usize] {
    &pattern.rows()[pattern.column_starts()[column]..pattern.column_starts()[column + 1]]
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// A pattern of points with some unknowns each (3, or fewer where they are held), coupled where `is_coupled` says so, and the
    /// first unknown of each point and behind the last one their number.
    fn of_points(
        n_points: usize,
        is_coupled: impl Fn(usize, usize) -> bool,
    ) -> (Pattern, Vec<usize>) {
        let mut firsts = vec![0];
        for point in 0..n_points {
            firsts.push(firsts[point] + if point % 5 == 2 { point % 3 } else { 3 });
        }
        let (mut starts, mut rows) = (vec![0], Vec::new());
        for point in 0..n_points {
            for column in firsts[point]..firsts[point + 1] {
                for other in (0..point).filter(|other| is_coupled(*other, point)) {
                    rows.extend(firsts[other]..firsts[other + 1]);
                }
                rows.extend(firsts[point]..=column);
                starts.push(rows.len());
            }
        }
        (Pattern::new(starts, rows).expect("a pattern"), firsts)
    }

    /// Rows of each column of the factor, by elimination of one unknown after the other.
    fn filled(starts: &[usize], rows: &[usize], places: &[usize]) -> Vec<BTreeSet<usize>> {
        let mut columns = vec![BTreeSet::new(); places.len()];
        for (column, ends) in starts.windows(2).enumerate() {
            for &row in &rows[ends[0]..ends[1]] {
                let [one, other] = [places[row], places[column]];
                columns[one.min(other)].insert(one.max(other));
            }
        }
        for column in 0..places.len() {
            let mut below: BTreeSet<usize> = columns[column].clone();
            below.remove(&column);
            if let Some(first) = below.pop_first() {
                columns[first].insert(first);
                columns[first].extend(below);
            }
        }
        columns
    }

    #[test]
    fn the_factor_has_entries_where_it_had_them() {
        let mut state = 7_u64;
        let mut below = |bound: usize| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 33) as usize % bound
        };
        for density in [0, 1, 3, 9] {
            let coupled: Vec<bool> = (0..900).map(|_| below(10) < density).collect();
            let (pattern, firsts) = of_points(30, |one, other| coupled[30 * one + other]);
            let mut points: Vec<usize> = (0..30).collect();
            (1..30).for_each(|k| points.swap(k, below(k + 1)));
            let of_points = points.iter().flat_map(|it| firsts[*it]..firsts[it + 1]);
            let together: Vec<usize> = of_points.collect();
            let mut apart = together.clone();
            (1..apart.len()).for_each(|k| apart.swap(k, below(k + 1)));
            for (order, is_apart) in [(together, false), (apart, true)] {
                let mut places = vec![0; order.len()];
                for (place, &unknown) in order.iter().enumerate() {
                    places[unknown] = place;
                }
                let (starts, rows) = reduced(&pattern, &places);
                let whole = filled(pattern.column_starts(), pattern.rows(), &places);
                assert_eq!(filled(&starts, &rows, &places), whole);
                if !is_apart && density > 1 {
                    let n_entries = pattern.n_entries();
                    assert!(2 * rows.len() < n_entries, "{} of {n_entries}", rows.len());
                }
            }
        }
    }
}
