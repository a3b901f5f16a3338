//! Interpolation of values at the nodes of a cell: weights of its corners at a position.

use crate::cell::Cell;
use crate::mesh::{Mesh, SolidMesh};
use crate::solid::SolidCell;

/// Largest distance of a position outside a side of a cell, relative to the height of the cell over this side, at which the position still
/// belongs to the cell: a position on a round rim lies outside the straight sides between its nodes.
const OUTSIDE: f64 = 0.1;

/// Weight below which a corner is left out: for a position on a side, the weights of the opposite corners are only rounding.
const NOTHING: f64 = 1e-9;

/// Ratio of the pivot to the largest entry below which equations have no reliable solution.
const SINGULAR: f64 = 1e-12;

/// Largest number of steps of Newton's method, and the step size below which it has converged.
const STEPS: (usize, f64) = (30, 1e-13);

/// Weights of the corners of a cell at a position.
struct CornerWeights {
    /// Depth inside the sides of the cell, over its height; negative outside.
    depth: f64,
    /// Corners and their weights, which sum to one.
    shares: Vec<(u32, f64)>,
}

impl Mesh {
    /// Nodes and their weights, which sum to one, for the value at a position (m): linear in a triangle, bilinear in a quadrangle. A
    /// position outside the mesh by less than a tenth of a cell is moved to its side; `None` farther off.
    pub fn interpolation_weights(&self, position: [f64; 2]) -> Option<Vec<(u32, f64)>> {
        let corner = |node: u32| self.positions[node as usize];
        let near =
            (self.cells.iter()).filter(|it| is_near(it.corners(), &self.positions, position));
        weights_in_deepest_cell(near.filter_map(|cell| match *cell {
            Cell::Triangle(nodes) => simplex_weights(nodes, nodes.map(corner), position),
            Cell::Quadrangle(nodes) => block_weights(&nodes, &nodes.map(corner), position),
        }))
    }
}

impl SolidMesh {
    /// Nodes and their weights, which sum to one, for the value at a position (m): linear in a tetrahedron, trilinear in a hexahedron,
    /// linear in each of the tetrahedra of a prism or a pyramid. A position outside the mesh by less than a tenth of a cell is moved to its
    /// side; `None` farther off.
    pub fn interpolation_weights(&self, position: [f64; 3]) -> Option<Vec<(u32, f64)>> {
        let corner = |node: u32| self.positions[node as usize];
        let near =
            (self.cells.iter()).filter(|it| is_near(it.corners(), &self.positions, position));
        weights_in_deepest_cell(near.filter_map(|cell| match *cell {
            SolidCell::Hexahedron(nodes) => block_weights(&nodes, &nodes.map(corner), position),
            _ => {
                let parts = cell.tetrahedra();
                let candidates =
                    parts.filter_map(|it| simplex_weights(it, it.map(corner), position));
                candidates.max_by(|one, other| one.depth.total_cmp(&other.depth))
            }
        }))
    }
}

/// Whether a position lies in the box around some nodes, or outside by no more than [`OUTSIDE`] allows.
fn is_near<const D: usize>(nodes: &[u32], positions: &[[f64; D]], position: [f64; D]) -> bool {
    (0..D).all(|axis| {
        let along = nodes.iter().map(|&node| positions[node as usize][axis]);
        let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            (low.min(x), high.max(x))
        });
        let slack = OUTSIDE * (high - low);
        (low - slack..=high + slack).contains(&position[axis])
    })
}

/// Weights in the cell with the largest depth of the position, the first of several.
fn weights_in_deepest_cell(
    candidates: impl Iterator<Item = CornerWeights>,
) -> Option<Vec<(u32, f64)>> {
    let best = candidates.reduce(|best, it| if it.depth > best.depth { it } else { best });
    let mut shares = best.filter(|it| it.depth >= -OUTSIDE)?.shares;
    shares.retain(|(_, share)| *share > NOTHING);
    let sum: f64 = shares.iter().map(|(_, share)| share).sum();
    for (_, share) in &mut shares {
        *share /= sum;
    }
    Some(shares)
}

fn simplex_weights<const D: usize, const N: usize>(
    nodes: [u32; N],
    corners: [[f64; D]; N],
    position: [f64; D],
) -> Option<CornerWeights> {
    let shares = barycentric(corners, position)?;
    Some(CornerWeights {
        depth: shares.into_iter().fold(f64::INFINITY, f64::min),
        shares: nodes.into_iter().zip(shares).collect(),
    })
}

/// Weights of the corners of a triangle or tetrahedron: sum of lambda_k x_k = x with the sum of lambda_k = 1, by elimination. `None` where
/// it is flat.
pub(crate) fn barycentric<const D: usize, const N: usize>(
    corners: [[f64; D]; N],
    position: [f64; D],
) -> Option<[f64; N]> {
    let rows = std::array::from_fn(|axis| {
        std::array::from_fn(|corner| corners[corner + 1][axis] - corners[0][axis])
    });
    let right = std::array::from_fn(|axis| position[axis] - corners[0][axis]);
    let others: [f64; D] = solution(rows, right)?;
    let first = 1.0 - others.iter().sum::<f64>();
    Some(std::array::from_fn(|corner| match corner {
        0 => first,
        _ => others[corner - 1],
    }))
}

/// Weights at a position in a quadrangle or hexahedron, with its corners in the order of Gmsh, by Newton's method for sum of N_k(s) x_k = x
/// with the products N_k of s_a or 1 - s_a along each axis.
fn block_weights<const D: usize>(
    nodes: &[u32],
    corners: &[[f64; D]],
    position: [f64; D],
) -> Option<CornerWeights> {
    // Corners around the base and then around the top: along x they are 0, 1, 1, 0, along y 0, 0, 1, 1.
    let is_upper = |corner: usize, axis: usize| match axis {
        0 => (corner ^ (corner >> 1)) & 1 == 1,
        _ => (corner >> axis) & 1 == 1,
    };
    let along = |corner: usize, axis: usize, at: &[f64; D]| match is_upper(corner, axis) {
        true => at[axis],
        false => 1.0 - at[axis],
    };
    let share = |corner: usize, at: &[f64; D]| -> f64 {
        (0..D).map(|axis| along(corner, axis, at)).product()
    };
    let slope = |corner: usize, axis: usize, at: &[f64; D]| -> f64 {
        let others = (0..D).filter(|it| *it != axis);
        let rest: f64 = others.map(|it| along(corner, it, at)).product();
        if is_upper(corner, axis) { rest } else { -rest }
    };
    let sum = |of: &dyn Fn(usize) -> f64, axis: usize| -> f64 {
        (0..corners.len()).map(|k| of(k) * corners[k][axis]).sum()
    };
    let mut at = [0.5; D];
    for _ in 0..STEPS.0 {
        let right = std::array::from_fn(|row| position[row] - sum(&|k| share(k, &at), row));
        let rows = std::array::from_fn(|row| {
            std::array::from_fn(|column| sum(&|k| slope(k, column, &at), row))
        });
        let step: [f64; D] = solution(rows, right)?;
        at = std::array::from_fn(|axis| at[axis] + step[axis]);
        if step.iter().all(|it| it.abs() < STEPS.1) {
            let depths = at.iter().map(|&it| it.min(1.0 - it));
            let inside = at.map(|it| it.clamp(0.0, 1.0));
            let shares = (0..).zip(nodes).map(|(k, &node)| (node, share(k, &inside)));
            return Some(CornerWeights {
                depth: depths.fold(f64::INFINITY, f64::min),
                shares: shares.collect(),
            });
        }
    }
    None
}

/// Solution of a small linear system by elimination with the largest pivot of each column; `None` for a singular one.
fn solution<const D: usize>(mut rows: [[f64; D]; D], mut right: [f64; D]) -> Option<[f64; D]> {
    let entries = rows.as_flattened().iter();
    let largest = entries.fold(0.0, |most: f64, it| most.max(it.abs()));
    for column in 0..D {
        let size = |row: &usize| rows[*row][column].abs();
        let pivot = (column..D).max_by(|one, other| size(one).total_cmp(&size(other)))?;
        if size(&pivot) <= SINGULAR * largest {
            return None;
        }
        rows.swap(column, pivot);
        right.swap(column, pivot);
        let (upper, value) = (rows[column], right[column]);
        for row in (0..D).filter(|row| *row != column) {
            let factor = rows[row][column] / upper[column];
            for (entry, above) in rows[row].iter_mut().zip(upper) {
                *entry -= factor * above;
            }
            right[row] -= factor * value;
        }
    }
    Some(std::array::from_fn(|axis| right[axis] / rows[axis][axis]))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
mod tests {
    use super::*;

    /// A crooked quadrangle with a triangle beside it.
    fn mesh() -> Mesh {
        Mesh {
            node_tags: (1..=5).collect(),
            positions: vec![[0.0, 0.0], [2.0, 0.2], [2.4, 1.9], [0.1, 1.5], [3.5, 0.8]],
            cells: vec![Cell::Quadrangle([0, 1, 2, 3]), Cell::Triangle([1, 4, 2])],
            ..Mesh::default()
        }
    }

    fn value<const D: usize>(shares: &[(u32, f64)], positions: &[[f64; D]]) -> f64 {
        let field = |p: &[f64; D]| 3.0 + (1..).zip(p).map(|(k, x)| f64::from(k) * x).sum::<f64>();
        let parts = shares
            .iter()
            .map(|(node, share)| share * field(&positions[*node as usize]));
        parts.sum()
    }

    /// A linear field is interpolated exactly; a node has its own value, a position on an edge the values of its two ends.
    #[test]
    fn linear_fields_are_met_in_the_plane() {
        let mesh = mesh();
        for place in [[0.7, 0.9], [1.9, 1.2], [2.6, 1.0], [2.2, 1.05]] {
            let shares = mesh.interpolation_weights(place).unwrap();
            let expected = 3.0 + place[0] + 2.0 * place[1];
            assert!((value(&shares, &mesh.positions) - expected).abs() < 1e-12);
        }
        assert_eq!(mesh.interpolation_weights([2.4, 1.9]), Some(vec![(2, 1.0)]));
        let on_edge = mesh.interpolation_weights([2.1, 0.625]).unwrap();
        assert_eq!(on_edge.len(), 2);
        assert!((on_edge[0].1 - 0.75).abs() < 1e-12 && on_edge[0].0 == 1);
        // Just below the base, and far below.
        assert!(mesh.interpolation_weights([1.0, 0.1 - 0.01]).is_some());
        assert_eq!(mesh.interpolation_weights([1.0, -0.5]), None);
    }

    /// The middle of a square has a quarter of each corner, for either diagonal; in a cube and a prism a linear field is exact.
    #[test]
    fn blocks_and_prisms() {
        let corner = |k: u32| [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]][k as usize % 4];
        let square = Mesh {
            positions: (0..4).map(corner).collect(),
            cells: vec![Cell::Quadrangle([0, 1, 2, 3])],
            ..Mesh::default()
        };
        let fourths = (0..4).map(|node| (node, 0.25)).collect();
        assert_eq!(square.interpolation_weights([0.5, 0.5]), Some(fourths));
        let solid = |cells: Vec<SolidCell>| SolidMesh {
            positions: (0..8)
                .map(|k| [corner(k)[0], corner(k)[1], if k < 4 { 0.0 } else { 1.3 }])
                .collect(),
            cells,
            ..SolidMesh::default()
        };
        let cube = solid(vec![SolidCell::Hexahedron([0, 1, 2, 3, 4, 5, 6, 7])]);
        let prism = solid(vec![SolidCell::Prism([0, 1, 3, 4, 5, 7])]);
        for (mesh, corners) in [(cube, 8), (prism, 4)] {
            let place = [0.2, 0.3, 0.4];
            let shares = mesh.interpolation_weights(place).unwrap();
            assert_eq!(shares.len(), corners);
            assert!((value(&shares, &mesh.positions) - (3.0 + 0.2 + 0.6 + 1.2)).abs() < 1e-12);
        }
    }
}
