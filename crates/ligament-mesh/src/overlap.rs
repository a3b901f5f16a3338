//! Cells that overlap without a common edge or face, such as a coarse mesh over a fine one.

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use crate::cell::MeshCell;
use crate::curve::along_hilbert_curve;
use crate::interpolation::barycentric;
use crate::parallel;

/// Depth of a position within a triangle or tetrahedron, relative to the height over each side, beyond which the position lies inside. In
/// valid cells that only touch, rounded coordinates or bent faces give less.
const DEPTH: f64 = 0.01;

/// Number of positions in one box of the search tree: a box takes as much memory as three positions.
const RUN: usize = 8;

/// First pair of overlapping cells: a node of the second cell that is no corner of the first one, or the middle of the second cell, lies
/// inside the first.
///
/// `simplices` returns the triangles of a cell, in space its tetrahedra. The middle is a mean of the corners with uneven weights, since
/// centroids of regular meshes lie on edges of other meshes.
pub(crate) fn first_covering<const D: usize, const N: usize, C, S>(
    positions: &[[f64; D]],
    cells: &[C],
    simplices: impl Fn(&C) -> S + Sync,
) -> Option<[u32; 2]>
where
    C: MeshCell<D>,
    S: Iterator<Item = [u32; N]>,
{
    let at = |node: u32| positions[node as usize];
    let places = places(positions, cells);
    let runs = places.chunks(RUN).map(|run| {
        let [low, high] = box_around(run.iter().map(|(place, _)| *place));
        GeomWithData::new(Rectangle::from_corners(low, high), run)
    });
    let tree = RTree::bulk_load(runs.collect());
    let covered = parallel::flat_map(cells.len(), |cell| {
        let it = &cells[cell];
        let corners = it.corners();
        let [low, high] = box_around(corners.iter().map(|&node| at(node)));
        let near = tree.locate_in_envelope_intersecting(AABB::from_corners(low, high));
        let others = near
            .flat_map(|run| run.data)
            .filter(|(_, other)| *other != cell as u32);
        let covered = others.filter(|(place, _)| {
            let within = (0..D).all(|axis| low[axis] <= place[axis] && place[axis] <= high[axis]);
            within && simplices(it).any(|simplex| is_inside(simplex.map(at), *place))
        });
        let other = covered.map(|(_, other)| *other).min()?;
        Some([cell as u32, other])
    });
    covered.first().copied()
}

/// Lowest and highest corner of the box around positions.
pub(crate) fn box_around<const D: usize>(
    positions: impl Iterator<Item = [f64; D]>,
) -> [[f64; D]; 2] {
    let empty = [[f64::INFINITY; D], [f64::NEG_INFINITY; D]];
    positions.fold(empty, |[low, high], p| {
        [
            std::array::from_fn(|axis| p[axis].min(low[axis])),
            std::array::from_fn(|axis| p[axis].max(high[axis])),
        ]
    })
}

/// Nodes, each with its first cell, and the middles of the cells, sorted along a curve: neighbours are near each other.
fn places<const D: usize, C: MeshCell<D>>(
    positions: &[[f64; D]],
    cells: &[C],
) -> Vec<([f64; D], u32)> {
    let mut first = vec![None; positions.len()];
    for (number, cell) in (0..).zip(cells) {
        for &node in cell.corners() {
            first[node as usize].get_or_insert(number);
        }
    }
    let middle = |cell: &C| {
        let corners = cell.corners();
        let weights = (3..).map(f64::from).take(corners.len());
        let sum: f64 = weights.clone().sum();
        let weighted = weights.zip(corners);
        weighted.fold([0.0; D], |middle: [f64; D], (weight, &node)| {
            let p = positions[node as usize];
            std::array::from_fn(|axis| middle[axis] + weight / sum * p[axis])
        })
    };
    // Places are made twice, so that the unordered ones need not be stored as well.
    let middles = cells.iter().map(middle);
    let order = along_hilbert_curve(&Vec::from_iter(positions.iter().copied().chain(middles)));
    let place = |index: u32| match (index as usize).checked_sub(positions.len()) {
        None => Some((positions[index as usize], first[index as usize]?)),
        Some(cell) => Some((middle(&cells[cell]), cell as u32)),
    };
    let mut places = Vec::with_capacity(order.len());
    places.extend(order.into_iter().filter_map(place));
    places
}

/// Whether a position lies in a triangle or tetrahedron, at least the depth from each side; a flat one has no interior.
fn is_inside<const D: usize, const N: usize>(corners: [[f64; D]; N], place: [f64; D]) -> bool {
    barycentric(corners, place).is_some_and(|shares| shares.iter().all(|share| *share >= DEPTH))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
mod tests {
    use super::*;
    use crate::{Cell, SolidCell};

    fn covering(positions: &[[f64; 2]], triangles: &[[u32; 3]]) -> Option<[u32; 2]> {
        let cells: Vec<Cell> = triangles.iter().map(|&it| Cell::Triangle(it)).collect();
        first_covering(positions, &cells, Cell::triangles)
    }

    /// A fan of six triangles around a node, and one triangle more between nodes halfway between the nodes of the fan.
    #[test]
    fn a_fan_of_more_than_a_turn_is_found() {
        let on_circle = |sixth: f64| {
            let (sin, cos) = (sixth * std::f64::consts::FRAC_PI_3).sin_cos();
            [cos, sin]
        };
        let ring = (0..6).map(|k| on_circle(f64::from(k)));
        let more = [on_circle(0.5), on_circle(1.5)];
        let positions: Vec<[f64; 2]> = [[0.0; 2]].into_iter().chain(ring).chain(more).collect();
        let mut triangles: Vec<[u32; 3]> = (0..6).map(|k| [0, 1 + k, 1 + (k + 1) % 6]).collect();
        assert_eq!(covering(&positions, &triangles), None);
        triangles.push([0, 7, 8]);
        let [cell, other] = covering(&positions, &triangles).unwrap();
        assert!(other == 6 || cell == 6, "{cell} {other}");
    }

    /// A needle of one in ten million beside its neighbours, and nodes that rounding moved across their common edge.
    #[test]
    fn slivers_and_rounded_nodes_are_sound() {
        for height in [1e-7, 1e-12, -1e-9] {
            let positions = [
                [0.0, 0.0],
                [1.0, 0.0],
                [0.5, height],
                [0.5, 1.0],
                [0.5, -1.0],
            ];
            let triangles = [[0, 2, 3], [2, 1, 3], [0, 4, 1]];
            assert_eq!(covering(&positions, &triangles), None, "{height}");
            let with_needle = [triangles[0], triangles[1], triangles[2], [0, 1, 2]];
            assert_eq!(covering(&positions, &with_needle), None, "{height}");
        }
    }

    /// A tetrahedron across a row of two cubes lies in both, one on a face of the row only touches it.
    #[test]
    fn solids_in_each_other_are_found() {
        let layer = |x: f64| [[x, 0.0, 0.0], [x, 1.0, 0.0], [x, 1.0, 1.0], [x, 0.0, 1.0]];
        let apex = [[1.0, 0.5, 1.5]];
        let positions = [layer(0.0).as_slice(), &layer(1.0), &layer(2.0), &apex].concat();
        let cubes = [[0, 4, 5, 1, 3, 7, 6, 2], [4, 8, 9, 5, 7, 11, 10, 6]];
        let found = |last: [u32; 4]| {
            let cells = cubes.map(SolidCell::Hexahedron);
            let cells = [cells[0], cells[1], SolidCell::Tetrahedron(last)];
            first_covering(&positions, &cells, SolidCell::tetrahedra)
        };
        assert_eq!(found([0, 8, 9, 12]), Some([1, 2]));
        assert_eq!(found([3, 11, 10, 12]), None);
    }
}
