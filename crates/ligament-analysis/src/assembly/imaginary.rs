//! Pattern and values for imaginary elements, which couple points beside the ends of their bonds.

use std::sync::Arc;

use ligament_linalg::{Pattern, PatternError, SymmetricMatrix};
use ligament_model::BondSystem;
use ligament_model::element::imaginary::ImaginaryElement;

use super::{Columns, assemble_columns, pattern_of};
use crate::state::BondsLeft;
use crate::unknowns::Unknowns;

/// The pattern with all bonds: breakages only take points from the elements.
pub(super) fn pattern(system: &BondSystem, unknowns: &Unknowns) -> Result<Pattern, PatternError> {
    pattern_of(system, unknowns, |point| lower_points(system, point))
}

/// Assembles the intact bonds over that pattern.
pub(super) fn assemble(
    system: &BondSystem,
    unknowns: &Unknowns,
    pattern: &Arc<Pattern>,
    bonds: BondsLeft<'_>,
    held: &[bool],
) -> SymmetricMatrix {
    let of_point = |point: usize, columns: Columns<'_>| {
        let lower = lower_points(system, point);
        let blocks = blocks(system, bonds, &lower, point);
        let coupling = |place: usize, r: usize, c: usize| blocks[place][r][c];
        columns.fill(&lower, coupling, |r, c| blocks[lower.len()][r][c]);
    };
    assemble_columns(system, unknowns, pattern, held, of_point)
}

/// Points of smaller number that some element couples with a point, ascending.
fn lower_points(system: &BondSystem, point: usize) -> Vec<usize> {
    let coupled = system
        .coupled_points(point as u32)
        .map(|other| other as usize);
    coupled.take_while(|&other| other < point).collect()
}

/// Blocks of the columns of a point: rows of its `lower` points and of itself, summed over its elements in their order.
fn blocks(
    system: &BondSystem,
    bonds: BondsLeft<'_>,
    lower: &[usize],
    point: usize,
) -> Vec<[[f64; 2]; 2]> {
    let mut blocks = vec![[[0.0; 2]; 2]; lower.len() + 1];
    for &bond in system.elements_of(point as u32) {
        let Some(element) = bonds.typed_element::<ImaginaryElement>(system, bond as usize) else {
            continue;
        };
        let points = element.points();
        let Some(column) = points.iter().position(|&it| it as usize == point) else {
            continue;
        };
        for (row, &other) in points.iter().enumerate() {
            let other = other as usize;
            let place = if other == point {
                Some(lower.len())
            } else {
                lower.binary_search(&other).ok()
            };
            if let Some(place) = place {
                let block = element.block(row, column);
                for (sums, values) in blocks[place].iter_mut().zip(block) {
                    for (sum, value) in sums.iter_mut().zip(values) {
                        *sum += value;
                    }
                }
            }
        }
    }
    blocks
}
