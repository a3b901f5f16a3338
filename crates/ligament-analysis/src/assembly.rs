//! Assembly of the bonds' element stiffnesses into the global matrix (NHPD eq. 18).
//!
//! The pattern is made once. A column of the matrix is summed by one thread, over the bonds of its point in their order,
//! so that the values have the same bits for any number of threads. A broken bond leaves the pattern as it is.

mod imaginary;

use std::sync::Arc;

use ligament_linalg::{Pattern, PatternError, SymmetricMatrix};
use ligament_model::BondSystem;
use ligament_model::element::ElementKind;
use ligament_model::element::beam::BeamBond;
use ligament_model::element::pair::{Pair, PairKinematics};
use ligament_model::element::spring::SpringBond;
use nalgebra::{Matrix3, Matrix6};
use rayon::prelude::*;

use crate::state::BondsLeft;
use crate::unknowns::{COMPONENTS, Unknowns};

/// The pattern of the matrix (upper triangle) for some unknowns.
pub fn pattern(system: &BondSystem, unknowns: &Unknowns) -> Result<Pattern, PatternError> {
    match system.element {
        // The stiffness of small strains, and that of the energy, with which others iterate or begin.
        ElementKind::Imaginary | ElementKind::TrueStrain | ElementKind::Pairwise => {
            imaginary::pattern(system, unknowns)
        }
        ElementKind::Beam | ElementKind::Spring => pattern_of(system, unknowns, |point| {
            let neighbours = lower_neighbours(system, point);
            neighbours.map(|(_, neighbour)| neighbour).collect()
        }),
    }
}

/// The pattern with the couplings of each point to points of smaller number, which are given ascending.
fn pattern_of(
    system: &BondSystem,
    unknowns: &Unknowns,
    lower_points: impl Fn(usize) -> Vec<usize>,
) -> Result<Pattern, PatternError> {
    let mut column_starts = vec![0];
    let mut rows = Vec::new();
    for point in 0..system.cloud.len() {
        let lower_rows: Vec<usize> = lower_points(point)
            .into_iter()
            .flat_map(|other| unknowns.of_point(other).map(|(row, _)| row))
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
    bonds: BondsLeft<'_>,
    held: &[bool],
) -> SymmetricMatrix {
    match system.element {
        ElementKind::Beam => assemble_pairs::<BeamBond>(system, unknowns, pattern, bonds, held),
        ElementKind::Spring => assemble_pairs::<SpringBond>(system, unknowns, pattern, bonds, held),
        ElementKind::Imaginary | ElementKind::TrueStrain | ElementKind::Pairwise => {
            imaginary::assemble(system, unknowns, pattern, bonds, held)
        }
    }
}

fn assemble_pairs<B: PairKinematics>(
    system: &BondSystem,
    unknowns: &Unknowns,
    pattern: &Arc<Pattern>,
    bonds: BondsLeft<'_>,
    held: &[bool],
) -> SymmetricMatrix {
    let of_point = |point: usize, columns: Columns<'_>| {
        let own = diagonal_block::<B>(system, bonds, point);
        let (lower, couplings): (Vec<usize>, Vec<Matrix6<f64>>) = lower_neighbours(system, point)
            .map(|(bond, neighbour)| (neighbour, stiffness::<B>(system, bonds, bond)))
            .unzip();
        let coupling = |place: usize, r: usize, c: usize| couplings[place][(r, COMPONENTS + c)];
        columns.fill(&lower, coupling, |r, c| own[(r, c)]);
    };
    assemble_columns(system, unknowns, pattern, held, of_point)
}

/// Assembles a matrix over its pattern; `of_point` fills the columns of each point.
fn assemble_columns(
    system: &BondSystem,
    unknowns: &Unknowns,
    pattern: &Arc<Pattern>,
    held: &[bool],
    of_point: impl Fn(usize, Columns<'_>) + Sync,
) -> SymmetricMatrix {
    let mut matrix = SymmetricMatrix::zero(pattern.clone());
    columns_of_points(&mut matrix.values, pattern, unknowns, system.cloud.len())
        .into_par_iter()
        .enumerate()
        .for_each(|(point, values)| {
            let columns = Columns {
                unknowns,
                held,
                point,
                values,
            };
            of_point(point, columns);
        });
    matrix
}

/// The columns of a point: couplings to points of smaller number, then its own block down to the diagonal.
struct Columns<'a> {
    unknowns: &'a Unknowns,
    held: &'a [bool],
    point: usize,
    values: &'a mut [f64],
}

impl Columns<'_> {
    /// Fills them with the `coupling` of each of the points `lower` (ascending), by its place among them, row and column, and with
    /// the `own` block.
    fn fill(
        self,
        lower: &[usize],
        coupling: impl Fn(usize, usize, usize) -> f64,
        own: impl Fn(usize, usize) -> f64,
    ) {
        let Self {
            unknowns,
            held,
            point,
            values,
        } = self;
        let is_held = |point: usize, component: usize| held[COMPONENTS * point + component];
        let mut slots = values.iter_mut();
        for (column, c) in unknowns.of_point(point) {
            let coupling = &coupling;
            let of_lower = lower.iter().enumerate().flat_map(|(place, &other)| {
                let rows = unknowns.of_point(other);
                rows.map(move |(_, r)| (coupling(place, r, c), is_held(other, r)))
            });
            let of_own = unknowns
                .of_point(point)
                .filter(|&(row, _)| row < column)
                .map(|(_, r)| (own(r, c), is_held(point, r)));
            let column_held = is_held(point, c);
            for ((value, row_held), slot) in of_lower.chain(of_own).zip(&mut slots) {
                *slot = if row_held || column_held { 0.0 } else { value };
            }
            if let Some(diagonal) = slots.next() {
                // Any positive pivot does for an equation that stands alone: a held point may have lost all its bonds.
                *diagonal = match own(c, c) {
                    0.0 if column_held => 1.0,
                    value if column_held => value.abs(),
                    value => value,
                };
            }
        }
    }
}

/// Bonds to points of smaller number, with that point, ascending.
fn lower_neighbours(
    system: &BondSystem,
    point: usize,
) -> impl Iterator<Item = (usize, usize)> + '_ {
    let bonds = system
        .bonds
        .incidence
        .at(point as u32)
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

/// Element stiffness of a bond, zero if it is broken.
fn stiffness<B: PairKinematics>(
    system: &BondSystem,
    bonds: BondsLeft<'_>,
    bond: usize,
) -> Matrix6<f64> {
    let element = bonds.typed_element::<Pair<B>>(system, bond);
    element.map_or_else(Matrix6::zeros, |pair| pair.bond.stiffness())
}

fn diagonal_block<B: PairKinematics>(
    system: &BondSystem,
    bonds: BondsLeft<'_>,
    point: usize,
) -> Matrix3<f64> {
    let mut block = Matrix3::zeros();
    for &bond in system.bonds.incidence.at(point as u32) {
        let bond = bond as usize;
        let is_first_end = system.bonds.ends[bond][0] as usize == point;
        let offset = if is_first_end { 0 } else { COMPONENTS };
        let stiffness = stiffness::<B>(system, bonds, bond);
        block += stiffness.fixed_view::<COMPONENTS, COMPONENTS>(offset, offset);
    }
    block
}
