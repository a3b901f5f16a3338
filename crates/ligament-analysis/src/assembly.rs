//! Assembly of the bonds' element stiffnesses into the global matrix (NHPD eq. 18).
//!
//! The sparsity pattern is computed once. A column of the matrix is summed by one thread, over the bonds of its point in order, so
//! that the values have the same bits for any number of threads. Broken bonds do not change the pattern. Restraints are added after
//! the bonds.

use std::sync::Arc;

use ligament_linalg::{Pattern, PatternError, SymmetricMatrix};
use ligament_model::parallel;
use ligament_model::{Bonds, UnbrokenBonds};

use crate::unknowns::Unknowns;

/// Number of points whose columns are one parallel task.
const TASK: usize = 1024;

/// Number of points whose columns one parallel task fills.
const FILLED: usize = 64;

/// Sparsity pattern of the matrix (upper triangle) for some unknowns, with all bonds; breakages only remove couplings.
pub fn pattern(system: &dyn Bonds, unknowns: &Unknowns) -> Result<Pattern, PatternError> {
    let lower_rows = |point: usize| {
        let (layout, restraints) = (unknowns.layout(), unknowns.restraints());
        let lower = restraints.lower_points(layout, &system.coupled_points, point);
        let of_point = |other: u32| unknowns.of_point(other as usize).map(|(row, _)| row);
        lower.into_iter().flat_map(of_point)
    };
    let n_points = system.n_points();
    let n_lower = parallel::values(n_points, 0, |point| lower_rows(point).count());
    let mut column_starts = vec![0];
    let mut n_entries = 0;
    // Index of the first entry of each task.
    let mut tasks = Vec::new();
    for (point, n_lower) in n_lower.into_iter().enumerate() {
        if point % TASK == 0 {
            tasks.push(n_entries);
        }
        for own in 1..=unknowns.of_point(point).count() {
            n_entries += n_lower + own;
            column_starts.push(n_entries);
        }
    }
    let mut rows = vec![0; n_entries];
    let mut rest = rows.as_mut_slice();
    let ends = tasks.iter().skip(1).chain([&n_entries]);
    let slots: Vec<&mut [usize]> = (tasks.iter().zip(ends))
        .map(|(start, end)| rest.split_off_mut(..end - start).unwrap_or_default())
        .collect();
    parallel::for_each(slots.into_iter().enumerate(), |(task, slots)| {
        let mut slots = slots.iter_mut();
        for point in TASK * task..(TASK * (task + 1)).min(n_points) {
            let lower: Vec<usize> = lower_rows(point).collect();
            for (column, _) in unknowns.of_point(point) {
                let own = unknowns.of_point(point).map(|(row, _)| row);
                let own = own.take_while(|&row| row <= column);
                let of_column = lower.iter().copied().chain(own);
                of_column
                    .zip(&mut slots)
                    .for_each(|(row, slot)| *slot = row);
            }
        }
    });
    Pattern::new(column_starts, rows)
}

/// Assembles the intact bonds over a pattern computed by [`pattern`].
///
/// Fixed unknowns (`held`) are decoupled: their rows and columns are zero except for the diagonal.
pub fn assemble(
    system: &dyn Bonds,
    unknowns: &Unknowns,
    pattern: &Arc<Pattern>,
    bonds: UnbrokenBonds<'_>,
    held: &[bool],
) -> SymmetricMatrix {
    let coupled = &system.coupled_points;
    let n_components = unknowns.layout().components.len();
    let mut matrix = SymmetricMatrix::zero(pattern.clone());
    let n_points = system.n_points();
    let mut columns = columns_of_points(&mut matrix.values, pattern, unknowns, n_points);
    let tasks = columns.chunks_mut(FILLED).enumerate();
    parallel::for_each(tasks, |(task, columns)| {
        for (point, values) in (task * FILLED..).zip(columns) {
            let (layout, restraints) = (unknowns.layout(), unknowns.restraints());
            let lower = restraints.lower_points(layout, coupled, point);
            let mut blocks = vec![0.0; (lower.len() + 1) * n_components * n_components];
            system.add_blocks(bonds, point as u32, &lower, &mut blocks);
            restraints.add_blocks(layout, point as u32, &lower, &mut blocks);
            let columns = Columns {
                unknowns,
                held,
                point,
                values,
            };
            columns.fill(&lower, |place, r, c| {
                blocks[(place * n_components + r) * n_components + c]
            });
        }
    });
    matrix
}

/// Columns of a point: couplings to points of smaller number, then its own block down to the diagonal.
struct Columns<'a> {
    unknowns: &'a Unknowns,
    held: &'a [bool],
    point: usize,
    values: &'a mut [f64],
}

impl Columns<'_> {
    /// Fills the columns with entries by block, row and column: the blocks of the `lower` points (ascending), and then the block of the
    /// point itself.
    fn fill(self, lower: &[u32], entry: impl Fn(usize, usize, usize) -> f64) {
        let Self {
            unknowns,
            held,
            point,
            values,
        } = self;
        let n_components = unknowns.layout().components.len();
        let is_held = |point: usize, place: usize| held[n_components * point + place];
        let mut slots = values.iter_mut();
        for (column, c) in unknowns.of_point(point) {
            let entry = &entry;
            let of_lower = lower.iter().enumerate().flat_map(|(place, &other)| {
                let rows = unknowns.of_point(other as usize);
                rows.map(move |(_, r)| (entry(place, r, c), is_held(other as usize, r)))
            });
            let of_own = unknowns
                .of_point(point)
                .filter(|&(row, _)| row < column)
                .map(|(_, r)| (entry(lower.len(), r, c), is_held(point, r)));
            let column_held = is_held(point, c);
            for ((value, row_held), slot) in of_lower.chain(of_own).zip(&mut slots) {
                *slot = if row_held || column_held { 0.0 } else { value };
            }
            if let Some(diagonal) = slots.next() {
                // A decoupled equation may have any positive pivot: a fixed point may have lost all its bonds.
                *diagonal = match entry(lower.len(), c, c) {
                    0.0 if column_held => 1.0,
                    value if column_held => value.abs(),
                    value => value,
                };
            }
        }
    }
}

/// Slices of the values for the columns of each point.
fn columns_of_points<'a>(
    values: &'a mut [f64],
    pattern: &Pattern,
    unknowns: &Unknowns,
    n_points: usize,
) -> Vec<&'a mut [f64]> {
    let mut rest = values;
    let mut taken = 0;
    (0..n_points)
        .map(|point| {
            let end = unknowns
                .of_point(point)
                .last()
                .map_or(taken, |(column, _)| pattern.column_starts()[column + 1]);
            let (columns, others) = std::mem::take(&mut rest).split_at_mut(end - taken);
            (rest, taken) = (others, end);
            columns
        })
        .collect()
}
