//! The cells of a lattice as one surface where the lattice is whole.
//!
//! Each cell moves with its point, so that neighbouring cells of a stretched body separate or overlap by a little, everywhere; magnified,
//! this is a net of hairlines. Corners that coincide without load, and are still near each other, are drawn at their mean; where a crack
//! opens they stay apart.

use std::collections::HashMap;

use ligament_output::vtu::Cell;

use crate::drawing::frame::bounds;

/// Distance, as a share of the shorter side of a cell, beyond which corners are apart.
const NEAR: f64 = 0.25;

/// Merged corners and their places.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MergedCorners {
    /// The number of the place of each corner, shape (n_corners).
    pub(super) place_of: Vec<u32>,
    /// Places, shape (n_places), m.
    pub(super) places: Vec<[f64; 2]>,
}

impl MergedCorners {
    /// Joins the corners of cells, by their positions without load and as they are drawn, both of shape (n_corners).
    pub(super) fn new(cells: &[Cell], reference: &[[f64; 2]], positions: &[[f64; 2]]) -> Self {
        let corners = cells.first().map_or(&[][..], Cell::points);
        let corners: Vec<[f64; 2]> = corners.iter().map(|it| reference[*it as usize]).collect();
        // A corner of the grid, and the sides that all cells share, m.
        let [origin, opposite] = bounds(&corners).unwrap_or_default();
        let sides = [0, 1].map(|axis| opposite[axis] - origin[axis]);
        let near = NEAR * sides[0].min(sides[1]);
        let mut meeting: HashMap<[i64; 2], Vec<u32>> = HashMap::new();
        let mut place_of = Vec::with_capacity(reference.len());
        // Sums of the positions at a place, and their number.
        let mut sums: Vec<([f64; 2], f64)> = Vec::new();
        for (at, drawn) in reference.iter().zip(positions) {
            // Corners are whole sides away from the first one, and rounding is far from half a side.
            let key = [0, 1].map(|axis| ((at[axis] - origin[axis]) / sides[axis]).round() as i64);
            let known = meeting.entry(key).or_default();
            let is_near = |place: &u32| {
                let (sum, count) = sums[*place as usize];
                (sum[0] / count - drawn[0]).hypot(sum[1] / count - drawn[1]) <= near
            };
            let place = known.iter().copied().find(is_near);
            let place = place.unwrap_or_else(|| {
                known.push(sums.len() as u32);
                sums.push(([0.0; 2], 0.0));
                sums.len() as u32 - 1
            });
            let (sum, count) = &mut sums[place as usize];
            *sum = [sum[0] + drawn[0], sum[1] + drawn[1]];
            *count += 1.0;
            place_of.push(place);
        }
        let mean = |(sum, count): ([f64; 2], f64)| sum.map(|it| it / count);
        Self {
            place_of,
            places: sums.into_iter().map(mean).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two cells side by side, with the right one moved by a tenth and by half of a cell.
    #[test]
    fn cells_are_joined_unless_a_crack_opens() {
        let square = |x: f64| [[x, 0.0], [x + 0.1, 0.0], [x + 0.1, 0.1], [x, 0.1]];
        let reference = [square(0.0), square(0.1)].concat();
        let cells = [Cell::Quad([0, 1, 2, 3]), Cell::Quad([4, 5, 6, 7])];
        let joined = |moved: f64| {
            let positions = [square(0.0), square(0.1 + moved)].concat();
            MergedCorners::new(&cells, &reference, &positions)
        };
        let near = joined(0.01);
        assert_eq!(near.places.len(), 6);
        assert_eq!(near.place_of[1], near.place_of[4]);
        assert!((near.places[near.place_of[1] as usize][0] - 0.105).abs() < 1e-15);
        let apart = joined(0.05);
        assert_eq!(apart.places.len(), 8);
        assert_eq!(
            apart.places[apart.place_of[4] as usize],
            [0.15000000000000002, 0.0]
        );
    }
    /// Flat cells above each other, on a grid whose corners are no multiples of their sides: each corner of the grid is one place.
    #[test]
    fn cells_of_any_shape_and_place_are_told_apart() {
        let rows = 7;
        let row = |row: u32| {
            let (low, high) = (
                0.0125 + 0.01 * f64::from(row),
                0.0125 + 0.01 * f64::from(row + 1),
            );
            [[0.025, low], [0.125, low], [0.125, high], [0.025, high]]
        };
        let reference: Vec<[f64; 2]> = (0..rows).flat_map(row).collect();
        let cells: Vec<Cell> = (0..rows)
            .map(|row| Cell::Quad([0, 1, 2, 3].map(|corner| 4 * row + corner)))
            .collect();
        let joined = MergedCorners::new(&cells, &reference, &reference);
        assert_eq!(joined.places.len(), 2 * (rows as usize + 1));
        for (place, at) in joined.place_of.iter().zip(&reference) {
            let drawn = joined.places[*place as usize];
            // Rounding of the mean of two numbers of this size.
            assert!((0..2).all(|axis| (drawn[axis] - at[axis]).abs() < 1e-15));
        }
    }
}
