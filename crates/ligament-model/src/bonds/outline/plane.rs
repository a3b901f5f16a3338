//! Edges that belong to one cell of the plane only, and the triangles beside them.

use ligament_mesh::{Cell, MeshCell};
use rayon::prelude::*;

use super::{Outline, PlaneOutline};
use crate::cloud::PointCloud;
use crate::geometry::is_between;
use crate::predicates::{crosses, side_of_line};
use crate::tensor::{dot, minus};

impl PlaneOutline {
    /// The outline of some cells between the points of a cloud.
    pub fn from_cells(cells: &[Cell], cloud: &PointCloud) -> Self {
        let mut all: Vec<[u32; 2]> = cells.iter().flat_map(Cell::edges).collect();
        all.par_sort_unstable();
        let alone = all
            .chunk_by(|one, other| one == other)
            .filter(|equal| equal.len() == 1);
        let alone: Vec<[u32; 2]> = alone.map(|edge| edge[0]).collect();
        let triangles = cells.iter().flat_map(Cell::triangles);
        Self::new(&alone, triangles, &cloud.positions)
    }

    /// Whether the line from a node to a position begins in a triangle or along an edge of one; inside the body it always does.
    fn continues_in_body(&self, node: u32, end: [f64; 2], slack: f64) -> bool {
        let position = self.at(node);
        let goes_into = |[a, b, c]: [u32; 3]| {
            let [next, last] = if node == a {
                [b, c]
            } else if node == b {
                [c, a]
            } else {
                [a, b]
            }
            .map(|corner| self.at(corner));
            let [left, right] = [next, last].map(|it| side_of_line([position, it], end, slack));
            // Opposite to a corner, a position lies on the line of the edge but not along the edge.
            let along = |corner: [f64; 2]| dot(minus(corner, position), minus(end, position)) > 0.0;
            (left == 0.0 && along(next))
                || (right == 0.0 && along(last))
                || (left > 0.0 && right < 0.0)
        };
        let mut triangles = self.parts_at(node).peekable();
        triangles.peek().is_none() || triangles.any(goes_into)
    }
}

impl Outline<2> for PlaneOutline {
    type Facet = [u32; 2];

    fn facets_within(&self, bounds: [[f64; 2]; 2]) -> impl Iterator<Item = [u32; 2]> {
        self.facets_in_box(bounds)
    }

    fn is_crossed_by_bonds(&self, [a, b]: [u32; 2], near: &[[u32; 2]], slack: f64) -> bool {
        let ends = [a, b].map(|node| self.at(node));
        let leaves_at = |node: u32| !self.continues_in_body(node, ends[1], slack);
        let is_on_line = |node: u32| {
            let position = self.at(node);
            side_of_line(ends, position, slack) == 0.0 && is_between(position, ends)
        };
        leaves_at(a)
            || near.iter().any(|edge| {
                crosses(ends, edge.map(|node| self.at(node)), slack)
                    || edge.iter().any(|&node| is_on_line(node) && leaves_at(node))
            })
    }

    fn is_doubled(&self, node: u32) -> bool {
        self.is_doubled[node as usize]
    }

    fn position(&self, node: u32) -> [f64; 2] {
        self.at(node)
    }

    fn begins_in_body(&self, node: u32, end: [f64; 2]) -> bool {
        self.continues_in_body(node, end, 0.0)
    }

    fn first_crossing(&self) -> Option<[u32; 2]> {
        let line = |edge: [u32; 2]| edge.map(|node| self.at(node));
        self.first_edge_through(|edge, ends| crosses(ends, line(edge), 0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bonds::BondSet;
    use crate::bonds::outline::bonds_outside;
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
            ..Mesh::default()
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
            let outside = bonds_outside(&PlaneOutline::from_cells(&cells, &cloud), &bonds, &cloud);
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
        assert!(
            !bonds_outside(&PlaneOutline::from_cells(&cells, &cloud), &bonds, &cloud)
                .contains(&true)
        );
    }
}
