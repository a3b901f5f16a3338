//! Assembly of the bonds' element stiffnesses into the global matrix (NHPD eq. 18).
//!
//! The pattern is made once. A column of the matrix is summed by one thread, over the bonds of its point in their order,
//! so that the values have the same bits for any number of threads. A broken bond leaves the pattern as it is.

use std::sync::Arc;

use ligament_linalg::{Pattern, PatternError, SymmetricMatrix};
use ligament_model::BondSystem;
use nalgebra::Matrix6;
use rayon::prelude::*;

use crate::unknowns::{COMPONENTS, Unknowns};

/// The pattern of the matrix (upper triangle) for some unknowns.
pub fn pattern(system: &BondSystem, unknowns: &Unknowns) -> Result<Pattern, PatternError> {
    let mut column_starts = vec![0];
    let mut rows = Vec::new();
    for point in 0..system.cloud.len() {
        let lower_rows: Vec<usize> = lower_neighbours(system, point)
            .flat_map(|(_, neighbour)| unknowns.of_point(neighbour).map(|(row, _)| row))
            .collect();
        for (column, _) in unknowns.of_point(point) {
            rows.extend_from_slice(&lower_rows);
            rows.extend(
                unknowns
                    .of_point(point)
                    .map(|(row, _)| row)
                    .filter(|&row| row <= column),
            );
            column_starts.push(rows.len());
        }
    }
    Pattern::new(column_starts, rows)
}

/// Assembles the intact bonds over the pattern made by [`pattern`].
///
/// A held unknown is cut off from the others: its row and column are zero but for the diagonal.
pub fn assemble(
    system: &BondSystem,
    unknowns: &Unknowns,
    pattern: &Arc<Pattern>,
    intact: &[bool],
    held: &[bool],
) -> SymmetricMatrix {
    let mut matrix = SymmetricMatrix::zero(pattern.clone());
    columns_of_points(&mut matrix.values, pattern, unknowns, system.cloud.len())
        .into_par_iter()
        .enumerate()
        .for_each(|(point, values)| fill_columns(system, unknowns, intact, held, point, values));
    matrix
}

/// Bonds to points of smaller number, with that point, ascending.
fn lower_neighbours(
    system: &BondSystem,
    point: usize,
) -> impl Iterator<Item = (usize, usize)> + '_ {
    let bonds = system
        .bonds
        .incidence
        .of(point as u32)
        .iter()
        .map(|&bond| bond as usize);
    bonds
        .map(|bond| (bond, system.bonds.ends[bond][0] as usize))
        .take_while(move |&(_, neighbour)| neighbour < point)
}

/// The part of the values that belongs to the columns of each point.
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

fn fill_columns(
    system: &BondSystem,
    unknowns: &Unknowns,
    intact: &[bool],
    held: &[bool],
    point: usize,
    values: &mut [f64],
) {
    let diagonal_block = diagonal_block(system, intact, point);
    let couplings: Vec<(usize, Matrix6<f64>)> = lower_neighbours(system, point)
        .map(|(bond, neighbour)| {
            let stiffness = if intact[bond] {
                system.element(bond).stiffness()
            } else {
                Matrix6::zeros()
            };
            (neighbour, stiffness)
        })
        .collect();
    let mut values = values.iter_mut();
    let mut put = |value: f64| {
        if let Some(slot) = values.next() {
            *slot = value;
        }
    };
    let is_held = |point: usize, component: usize| held[COMPONENTS * point + component];
    for (column, c) in unknowns.of_point(point) {
        for (neighbour, stiffness) in &couplings {
            for (_, r) in unknowns.of_point(*neighbour) {
                let cut_off = is_held(*neighbour, r) || is_held(point, c);
                put(if cut_off {
                    0.0
                } else {
                    stiffness[(r, COMPONENTS + c)]
                });
            }
        }
        for (_, r) in unknowns.of_point(point).filter(|&(row, _)| row < column) {
            put(if is_held(point, r) || is_held(point, c) {
                0.0
            } else {
                diagonal_block[(r, c)]
            });
        }
        let diagonal = diagonal_block[(c, c)];
        // A held point may have lost all its bonds; any pivot does for an equation that stands alone.
        put(if is_held(point, c) && diagonal == 0.0 {
            1.0
        } else {
            diagonal
        });
    }
}

fn diagonal_block(system: &BondSystem, intact: &[bool], point: usize) -> nalgebra::Matrix3<f64> {
    let mut block = nalgebra::Matrix3::zeros();
    for &bond in system.bonds.incidence.of(point as u32) {
        let bond = bond as usize;
        if intact[bond] {
            let offset = if system.bonds.ends[bond][0] as usize == point {
                0
            } else {
                COMPONENTS
            };
            block += system
                .element(bond)
                .stiffness()
                .fixed_view::<3, 3>(offset, offset);
        }
    }
    block
}
