//! Areas of surfaces of a solid mesh, in triangles.

use thiserror::Error;

use super::faces::Faces;
use crate::cell::Cell;
use crate::mesh::SolidMesh;
use crate::portion::Portion;

/// A face not on the outline of the body, on which a pressure cannot act.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "a pressure acts on the outline of the body, but the face of this group with the nodes {}, around ({:.6}, {:.6}, {:.6}), {}",
    .nodes.iter().map(u64::to_string).collect::<Vec<_>>().join(", "), .middle[0], .middle[1], .middle[2],
    if *.cells == 0 { "is the face of no cell" } else { "has cells on both sides" }
)]
pub struct NotOnOutline {
    /// Tags of the nodes of the face.
    pub nodes: Vec<u64>,
    /// Middle of the face, m.
    pub middle: [f64; 3],
    /// Number of cells with the face.
    pub cells: usize,
}

impl SolidMesh {
    /// Triangles of some outline faces, with a third of their areas (m²) times the outward normal for each corner. A repeated face counts
    /// once.
    ///
    /// A quadrangle has the triangles of its two splits, each with half of its area: force and moment of a pressure that is uniform or
    /// linear over a flat face are exact.
    ///
    /// # Errors
    ///
    /// Returns an error if a face is not on the outline.
    pub fn outward_portions(&self, faces: &[Cell]) -> Result<Vec<Portion<3>>, NotOnOutline> {
        let of_cells = Faces::new(&self.cells, self.positions.len());
        let mut portions = Vec::new();
        for face in distinct_faces(faces) {
            let sides = of_cells.sides_at(&face);
            let [side] = sides.as_slice() else {
                return Err(self.off_surface(&face, sides.len()));
            };
            portions.extend(thirds(&side.face).into_iter().map(|(corners, weight)| {
                let area = Cell::Triangle(corners).area_vector(&self.positions);
                Portion {
                    corners: corners.to_vec(),
                    share: area.map(|it| weight * it),
                }
            }));
        }
        Ok(portions)
    }

    /// Triangles of some faces, with a third of their areas (m²) for each corner; divided as by [`SolidMesh::outward_portions`], but the
    /// faces may lie inside the body.
    pub fn face_portions(&self, faces: &[Cell]) -> Vec<Portion<1>> {
        let triangles = distinct_faces(faces).into_iter();
        let portion = |(corners, weight): ([u32; 3], f64)| {
            let [x, y, z] = Cell::Triangle(corners).area_vector(&self.positions);
            Portion {
                corners: corners.to_vec(),
                share: [weight * (x * x + y * y + z * z).sqrt()],
            }
        };
        triangles
            .flat_map(|face| thirds(&face))
            .map(portion)
            .collect()
    }

    fn off_surface(&self, face: &Cell, cells: usize) -> NotOnOutline {
        let corners = face.corners();
        let mean = |axis: usize| {
            let sum: f64 = corners
                .iter()
                .map(|&node| self.positions[node as usize][axis])
                .sum();
            sum / corners.len() as f64
        };
        NotOnOutline {
            nodes: corners
                .iter()
                .map(|&node| self.node_tags[node as usize])
                .collect(),
            middle: [0, 1, 2].map(mean),
            cells,
        }
    }
}

/// Faces, each once.
fn distinct_faces(faces: &[Cell]) -> Vec<Cell> {
    let mut faces = faces.to_vec();
    faces.sort_by_key(Cell::sorted_corners);
    faces.dedup_by_key(|face| face.sorted_corners());
    faces
}

/// Triangles of a face, for a quadrangle of both splits, and the fraction of each triangle that belongs to one of its corners.
fn thirds(face: &Cell) -> Vec<([u32; 3], f64)> {
    match *face {
        Cell::Triangle(corners) => vec![(corners, 1.0 / 3.0)],
        Cell::Quadrangle([a, b, c, d]) => [[a, b, c], [a, c, d], [b, c, d], [b, d, a]]
            .map(|corners| (corners, 1.0 / 6.0))
            .to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::SolidCell;

    /// A frustum of a pyramid, from a square of side 4 to one of side 2 at a height of 3, and a tetrahedron below it.
    fn frustum() -> SolidMesh {
        let at = |half: f64, z: f64| {
            [
                [-half, -half, z],
                [half, -half, z],
                [half, half, z],
                [-half, half, z],
            ]
        };
        let mut positions = [at(2.0, 0.0), at(1.0, 3.0)].concat();
        positions.push([0.0, 0.0, -2.0]);
        SolidMesh {
            node_tags: (11..20).collect(),
            positions,
            cells: vec![
                SolidCell::Hexahedron([0, 1, 2, 3, 4, 5, 6, 7]),
                SolidCell::Pyramid([0, 3, 2, 1, 8]),
            ],
            ..SolidMesh::default()
        }
    }

    /// Force and moment of a unit pressure on a trapezium, by hand: its middle lies (b + 2a)/(3(a + b)) of the height over its base.
    #[test]
    fn a_pressure_keeps_force_and_moment() {
        let mesh = frustum();
        let side = [
            Cell::Quadrangle([5, 4, 0, 1]),
            Cell::Quadrangle([0, 1, 5, 4]),
        ];
        let portions = mesh.outward_portions(&side).expect("faces of the outline");
        let areas = Portion::at_points(&portions);
        let nodes: Vec<u32> = areas.iter().map(|(node, _)| *node).collect();
        assert_eq!(nodes, [0, 1, 4, 5]);
        let mut force = [0.0; 3];
        let mut moment = 0.0;
        for (node, area) in &areas {
            force = [0, 1, 2].map(|axis| force[axis] + area[axis]);
            moment += area[1] * mesh.positions[*node as usize][2];
        }
        // Mean side 3, height 3 in z, and a rise of 1 outwards.
        assert_eq!(force[0], 0.0);
        assert!(
            (force[1] + 9.0).abs() < 1e-14 && (force[2] - 3.0).abs() < 1e-14,
            "{force:?}"
        );
        assert!((moment + 9.0 * 4.0 / 3.0).abs() < 1e-14, "{moment}");
        let areas = Portion::at_points(&mesh.face_portions(&side));
        let area: f64 = areas.iter().map(|(_, [area])| area).sum();
        assert!((area - 90.0_f64.sqrt()).abs() < 1e-14);
    }

    #[test]
    fn faces_inside_or_of_no_cell_are_named() {
        let mesh = frustum();
        let refusal = |face: Cell| {
            mesh.outward_portions(&[face])
                .expect_err("no face of the outline")
        };
        let inside = refusal(Cell::Quadrangle([0, 1, 2, 3]));
        assert_eq!(
            (inside.cells, inside.nodes, inside.middle),
            (2, vec![11, 12, 13, 14], [0.0; 3])
        );
        let none = refusal(Cell::Triangle([0, 1, 2]));
        assert!(
            none.cells == 0 && none.to_string().contains("11, 12, 13"),
            "{none}"
        );
        assert_eq!(
            Portion::at_points(&mesh.face_portions(&[Cell::Quadrangle([0, 1, 2, 3])])),
            [0, 1, 2, 3].map(|node| (node, [4.0]))
        );
    }

    #[test]
    fn edges_give_half_of_their_length() {
        let mesh = frustum();
        let lengths = Portion::at_points(&mesh.edge_portions(&[[0, 1], [2, 1], [1, 0]]));
        assert_eq!(lengths, [(0, [2.0]), (1, [4.0]), (2, [2.0])]);
    }
}
