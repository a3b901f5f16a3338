//! The outline of a mesh: a bond whose straight line leaves the meshed body is none.
//!
//! Holes, slots, notches and re-entrant corners are what the cells leave free. The rule, decided with exact orientation predicates:
//! a bond stays in the body if it crosses no edge of the outline, and if it goes on into a cell, or along an edge of one, from every
//! node of the outline on it. Along the outline, and past a corner that it only touches, it stays: what comes closer to a line than
//! 1e-5 of the nearest distance of the bond's ends lies on it, or rounding would decide about bonds along a slanted side.

use ligament_mesh::Cell;
use rayon::prelude::*;
use rstar::primitives::{GeomWithData, Line};
use rstar::{AABB, RTree, RTreeObject};

use super::{BondSet, Incidence};
use crate::cloud::mesh::shortest_sides;
use crate::cloud::{PointCloud, distance, search_tree};
use crate::horizon::INCLUSION_TOLERANCE;
use crate::shape::{cross, orientation};

/// Points along the curve that are asked for together whether the outline is near: most of a body is far from it.
const BLOCK: usize = 64;

/// For each bond between nodes of the mesh of `cells`, whether its straight line leaves them, shape (n_bonds).
pub fn bonds_outside(cells: &[Cell], bonds: &BondSet, cloud: &PointCloud) -> Vec<bool> {
    let outline = Outline::new(cells, cloud);
    let mut first_bond = vec![0; cloud.len() + 1];
    for ends in &bonds.ends {
        first_bond[ends[0] as usize + 1] += 1;
    }
    for point in 0..cloud.len() {
        first_bond[point + 1] += first_bond[point];
    }
    let own = |point: u32| first_bond[point as usize]..first_bond[point as usize + 1];
    let reach = |point: u32| {
        let lengths = bonds.length[own(point)].iter();
        lengths.copied().fold(0.0, f64::max)
    };
    let leaves = |bond: usize, near: &[[u32; 2]]| {
        let slack = cloud.slack_between(bonds.ends[bond]);
        outline.is_left_by(bonds.ends[bond], near, slack)
    };
    let of_points: Vec<usize> = (cloud.curve.par_chunks(BLOCK))
        .filter(|block| outline.may_be_reached(block, reach))
        .flat_map_iter(|block| {
            block.iter().flat_map(|&point| {
                let near = outline.near(cloud.positions[point as usize], reach(point));
                own(point).filter(move |&bond| !near.is_empty() && leaves(bond, &near))
            })
        })
        .collect();
    let mut outside = vec![false; bonds.len()];
    for bond in of_points {
        outside[bond] = true;
    }
    outside
}

/// The nodes of an edge of the outline that another edge crosses, the first of them all; none where cells do not overlap.
pub fn first_crossing(cells: &[Cell], cloud: &PointCloud) -> Option<[u32; 2]> {
    let outline = Outline::new(cells, cloud);
    let line = |edge: [u32; 2]| edge.map(|node| cloud.positions[node as usize]);
    let is_crossed = |edge: &&GeomWithData<Line<[f64; 2]>, [u32; 2]>| {
        let mut near = outline
            .edges
            .locate_in_envelope_intersecting(edge.envelope());
        near.any(|other| crosses(line(edge.data), line(other.data), 0.0))
    };
    let crossed = outline.edges.iter().filter(is_crossed);
    crossed.map(|edge| edge.data).min()
}

/// Distance of each node of the mesh of `cells` to the nearest other one that it sees within them, shape (n_points), m.
///
/// Across a thin slot the nearest node of all may be much nearer; a horizon that follows it would reach nothing but the other side.
pub fn spacing_inside(cells: &[Cell], cloud: &PointCloud) -> Vec<f64> {
    let shortest = shortest_sides(cloud, cells);
    let mut spacing = cloud.spacing.clone();
    // What is nearer than the ends of all cell sides may lie behind a void.
    let may_be_parted: Vec<u32> = (0..cloud.len() as u32)
        .filter(|&point| {
            let shortest = shortest[point as usize];
            shortest.is_finite() && spacing[point as usize] < shortest
        })
        .collect();
    if may_be_parted.is_empty() {
        return spacing;
    }
    let (outline, tree) = (Outline::new(cells, cloud), search_tree(&cloud.positions));
    for point in may_be_parted {
        let (position, shortest) = (cloud.positions[point as usize], shortest[point as usize]);
        let near = outline.near(position, shortest);
        let is_seen = |other: u32, length: f64| {
            !outline.is_left_by([point, other], &near, cloud.tolerance(point) * length)
        };
        spacing[point as usize] = tree
            .locate_within_distance(position, shortest * shortest)
            .filter(|other| other.data != point)
            .map(|other| (other.data, distance(position, *other.geom())))
            .filter(|&(other, length)| is_seen(other, length))
            .fold(shortest, |nearest, (_, length)| nearest.min(length));
    }
    spacing
}

/// The edges that one cell has alone.
struct Outline<'a> {
    cells: &'a [Cell],
    positions: &'a [[f64; 2]],
    /// The edges, as a tree for searches by place.
    edges: RTree<GeomWithData<Line<[f64; 2]>, [u32; 2]>>,
    /// The cells at each node of the outline; none at the others.
    cells_at: Incidence,
}

impl<'a> Outline<'a> {
    fn new(cells: &'a [Cell], cloud: &'a PointCloud) -> Self {
        let sides = |cell: &'a Cell| {
            let corners = cell.corners();
            let next = corners.iter().cycle().skip(1);
            corners
                .iter()
                .zip(next)
                .map(|(p, q)| [*p.min(q), *p.max(q)])
        };
        let mut all: Vec<[u32; 2]> = cells.iter().flat_map(sides).collect();
        all.par_sort_unstable();
        let alone = all
            .chunk_by(|one, other| one == other)
            .filter(|equal| equal.len() == 1);
        let alone: Vec<[u32; 2]> = alone.map(|edge| edge[0]).collect();
        let mut is_on_outline = vec![false; cloud.len()];
        for &node in alone.as_flattened() {
            is_on_outline[node as usize] = true;
        }
        let numbered = (0..).zip(cells);
        let corners = numbered
            .flat_map(|(number, cell)| cell.corners().iter().map(move |&node| (node, number)));
        let at_outline = corners.filter(|(node, _)| is_on_outline[*node as usize]);
        let line = |edge: [u32; 2]| {
            let [p, q] = edge.map(|node| cloud.positions[node as usize]);
            GeomWithData::new(Line::new(p, q), edge)
        };
        Self {
            cells,
            positions: &cloud.positions,
            cells_at: Incidence::from_pairs(at_outline, cloud.len()),
            edges: RTree::bulk_load(alone.into_iter().map(line).collect()),
        }
    }

    /// Whether an edge may be in the reach (m) of any of some points, by the rectangle around them.
    fn may_be_reached(&self, points: &[u32], reach: impl Fn(u32) -> f64) -> bool {
        let (mut lower, mut upper) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for &point in points {
            let reach = reach(point) * (1.0 + INCLUSION_TOLERANCE);
            for (axis, x) in self.positions[point as usize].into_iter().enumerate() {
                lower[axis] = lower[axis].min(x - reach);
                upper[axis] = upper[axis].max(x + reach);
            }
        }
        let around = AABB::from_corners(lower, upper);
        let mut edges = self.edges.locate_in_envelope_intersecting(around);
        edges.next().is_some()
    }

    /// The edges no farther from a position than `reach`, m.
    fn near(&self, position: [f64; 2], reach: f64) -> Vec<[u32; 2]> {
        let reach = reach * (1.0 + INCLUSION_TOLERANCE);
        let found = self.edges.locate_within_distance(position, reach * reach);
        found.map(|edge| edge.data).collect()
    }

    /// Whether the line between two nodes leaves the cells, with all edges of the outline that it may meet.
    fn is_left_by(&self, [a, b]: [u32; 2], edges: &[[u32; 2]], slack: f64) -> bool {
        let [start, end] = [a, b].map(|node| self.positions[node as usize]);
        let leaves_at = |node: u32| !self.goes_on(node, end, slack);
        leaves_at(a)
            || edges.iter().any(|edge| {
                let [p, q] = edge.map(|node| self.positions[node as usize]);
                crosses([start, end], [p, q], slack)
                    || edge
                        .iter()
                        .any(|&node| self.is_between(node, [start, end], slack) && leaves_at(node))
            })
    }

    /// Whether a node lies on the line between two positions, but at none of them.
    fn is_between(&self, node: u32, [start, end]: [[f64; 2]; 2], slack: f64) -> bool {
        let position = self.positions[node as usize];
        let ahead = |from: [f64; 2], to: [f64; 2]| {
            (position[0] - from[0]) * (to[0] - from[0])
                + (position[1] - from[1]) * (to[1] - from[1])
        };
        side(start, end, position, slack) == 0.0
            && ahead(start, end) > 0.0
            && ahead(end, start) > 0.0
    }

    /// Whether the way from a node to a position begins in a cell or along an edge of one; inside the body it always does.
    fn goes_on(&self, node: u32, end: [f64; 2], slack: f64) -> bool {
        let cells = self.cells_at.at(node);
        let position = self.positions[node as usize];
        cells.is_empty()
            || cells.iter().any(|&cell| {
                let corners = self.cells[cell as usize].corners();
                let n = corners.len();
                let place = corners
                    .iter()
                    .position(|&corner| corner == node)
                    .unwrap_or_default();
                let [next, last] = [corners[(place + 1) % n], corners[(place + n - 1) % n]]
                    .map(|corner| self.positions[corner as usize]);
                let sides = [
                    side(position, next, end, slack),
                    side(position, last, end, slack),
                ];
                // Opposite to a corner a position lies on the line of the edge, but not along it.
                let along = |corner: [f64; 2]| {
                    (corner[0] - position[0]) * (end[0] - position[0])
                        + (corner[1] - position[1]) * (end[1] - position[1])
                        > 0.0
                };
                match sides {
                    [0.0, _] if along(next) => true,
                    [_, 0.0] if along(last) => true,
                    [left, right] => left > 0.0 && right < 0.0,
                }
            })
    }
}

/// Whether two lines cross at a point that is an end of neither.
pub(crate) fn crosses([a, b]: [[f64; 2]; 2], [p, q]: [[f64; 2]; 2], slack: f64) -> bool {
    side(a, b, p, slack) * side(a, b, q, slack) < 0.0
        && side(p, q, a, slack) * side(p, q, b, slack) < 0.0
}

/// The side of c seen from a to b, positive on the left; zero where of b and c the nearer to a is within `slack` (m) of the line to
/// the other.
fn side(a: [f64; 2], b: [f64; 2], c: [f64; 2], slack: f64) -> f64 {
    let reach = distance(a, b).max(distance(a, c));
    if cross(a, b, c).abs() <= slack * reach {
        0.0
    } else {
        orientation(a, b, c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::horizon::Horizons;
    use ligament_mesh::Mesh;

    /// A grid of 7 by 7 nodes, turned by an angle, whose cells are those for which `has` of column and row is true.
    fn body(angle: f64, has: impl Fn(u32, u32) -> bool) -> (PointCloud, Vec<Cell>, BondSet) {
        let (sin, cos) = angle.sin_cos();
        let node = |column: u32, row: u32| 7 * row + column;
        let positions = (0..49u32).map(|k| {
            let [x, y] = [k % 7, k / 7].map(f64::from);
            [cos * x - sin * y, sin * x + cos * y]
        });
        let cells = (0..36u32)
            .map(|k| (k % 6, k / 6))
            .filter(|&(c, r)| has(c, r));
        let corners = |(c, r)| {
            Cell::Quadrangle([
                node(c, r),
                node(c + 1, r),
                node(c + 1, r + 1),
                node(c, r + 1),
            ])
        };
        let mesh = Mesh {
            node_tags: (1..=49).collect(),
            positions: positions.collect(),
            cells: cells.map(corners).collect(),
            groups: Vec::new(),
            fields: Vec::new(),
            remarks: Vec::new(),
        };
        let cloud = PointCloud::from_mesh(&mesh, 1.0, &vec![0; mesh.cells.len()], 1);
        let bonds = BondSet::search(&cloud, &Horizons::unified(3.2, cloud.len()));
        (cloud, mesh.cells, bonds)
    }

    /// A bond stays in the body if points along it are all in a cell, rims included: sampled, and so without any predicate. A notch
    /// from the left, a hole and a step of the outline.
    #[test]
    fn bonds_agree_with_points_along_them() {
        let is_free = |c: u32, r: u32| (r == 3 && (c < 2 || c == 4)) || (r > 4 && c > 3);
        let has = |c: u32, r: u32| !is_free(c, r);
        for angle in [0.0, 0.3, 1.1] {
            let (cloud, cells, bonds) = body(angle, has);
            let outside = bonds_outside(&cells, &bonds, &cloud);
            let (sin, cos) = angle.sin_cos();
            let mut count = 0;
            // Nodes without a cell are none of a mesh.
            let is_node = |end: &u32| cells.iter().any(|cell| cell.corners().contains(end));
            for (ends, found) in bonds
                .ends
                .iter()
                .zip(outside)
                .filter(|(ends, _)| ends.iter().all(is_node))
            {
                let [a, b] = ends.map(|end| [end % 7, end / 7].map(f64::from));
                let is_in = |place: f64| {
                    let at = [0, 1].map(|axis| a[axis] + place * (b[axis] - a[axis]));
                    let cells =
                        |x: f64| [(x - 1e-9).floor(), (x + 1e-9).floor()].map(|it| it as i64);
                    cells(at[0]).into_iter().any(|c| {
                        cells(at[1]).into_iter().any(|r| {
                            (0..6).contains(&c) && (0..6).contains(&r) && has(c as u32, r as u32)
                        })
                    })
                };
                let wanted = (0..=1000).any(|k| !is_in(f64::from(k) / 1000.0));
                assert_eq!(found, wanted, "{a:?} {b:?} turned by {angle} ({sin} {cos})");
                count += usize::from(found);
            }
            assert!(count > 20, "{count} bonds leave the body");
        }
    }

    #[test]
    fn a_whole_rectangle_loses_nothing() {
        let (cloud, cells, bonds) = body(0.7, |_, _| true);
        assert!(!bonds_outside(&cells, &bonds, &cloud).contains(&true));
    }
}
