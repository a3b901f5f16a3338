//! Parts of the geometry of mesh cells that differ between the plane and space.

use std::collections::BTreeSet;
use std::fmt::Debug;

use ligament_mesh::{
    Cell, Faces, Group, Mesh, MeshCell, Portion, SolidCell, SolidMesh, cells_at_edges, outer_edges,
};
use ligament_model::bonds::outline::{Outline, PlaneOutline, SolidOutline};
use ligament_model::bonds::parts::{PlaneCells, Tetrahedra};
use ligament_model::correction::patch::{self, CellForces};
use ligament_model::material::Stiffness;
use ligament_model::{BondSet, Canvas, PointCloud};

use super::interface::{OffOutline, Origin};

/// Geometry of the cells of a meshed body in D dimensions.
pub trait BodyCell<const D: usize>: MeshCell<D> + Debug + Send + 'static {
    /// Type of the outline of a body of such cells.
    type Outline: Outline<D>;

    /// A mesh as the origin of a body.
    fn origin(mesh: &Mesh<D, Self>) -> Origin<'_>;

    /// The outline of some cells between the points of a cloud.
    fn outline(cells: &[Self], cloud: &PointCloud<D>) -> Self::Outline;

    /// Bonds with their composition from the materials of the cells that they cross; `materials` (n_cells) has the index of each cell's
    /// material.
    fn composed(
        bonds: BondSet<D>,
        cells: &[Self],
        cloud: &PointCloud<D>,
        materials: &[u32],
    ) -> BondSet<D>;

    /// Triangles or tetrahedra that make up the cell.
    fn simplices(&self) -> Vec<Self>;

    /// Forces of uniform strains on the points of a cloud; `material_of_cell` (n_cells) has the index of each cell's material.
    fn forces(
        cells: &[Self],
        cloud: &PointCloud<D>,
        material_of_cell: &[u32],
        stiffness: Vec<Stiffness>,
    ) -> CellForces<D>;

    /// Corners of the sides that only one cell has: edges with the cell on their left, or triangles that are counter-clockwise from
    /// outside.
    fn outer_sides(cells: &[Self], n_points: usize) -> Vec<[u32; D]>;

    /// Corners of the sides that only one cell has, ordered in the same way: edges, or whole faces of three or four corners.
    fn outer_faces(cells: &[Self], n_points: usize) -> Vec<Vec<u32>> {
        let sides = Self::outer_sides(cells, n_points).into_iter();
        sides.map(|it| it.to_vec()).collect()
    }

    /// Faces between the parts of a cell that belong to its corners: two corners each, and the corners of the face (m) in any order. `at` has
    /// the positions of nodes, m.
    fn faces_between_corners(&self, at: &dyn Fn(u32) -> [f64; D])
    -> Vec<([u32; 2], [[f64; D]; D])>;

    /// Edges, or triangles of faces, of some groups with their outward normals times lengths (m), in space times areas (m^2).
    ///
    /// # Errors
    ///
    /// If a side of the groups is not on the outline.
    fn outward(mesh: &Mesh<D, Self>, groups: &[&Group]) -> Result<Vec<Portion<D>>, OffOutline>;

    /// Triangles of some faces with their areas, m^2; empty in the plane.
    fn face_portions(mesh: &Mesh<D, Self>, faces: &[Cell]) -> Vec<Portion<1>>;

    /// Nodes of the cell around a position (m) and their interpolation weights; `None` outside of all cells.
    fn interpolation_weights(mesh: &Mesh<D, Self>, position: [f64; D]) -> Option<Vec<(u32, f64)>>;

    /// The cells for result files.
    fn canvas(cells: &[Self]) -> Canvas;
}

impl BodyCell<2> for Cell {
    type Outline = PlaneOutline;

    fn origin(mesh: &Mesh) -> Origin<'_> {
        Origin::Mesh(mesh)
    }

    fn outline(cells: &[Self], cloud: &PointCloud) -> PlaneOutline {
        PlaneOutline::from_cells(cells, cloud)
    }

    fn composed(bonds: BondSet, cells: &[Self], cloud: &PointCloud, materials: &[u32]) -> BondSet {
        let cells = PlaneCells {
            cells,
            cloud,
            materials,
        };
        bonds.through(&cells, cloud)
    }

    fn simplices(&self) -> Vec<Self> {
        self.triangles().map(Self::Triangle).collect()
    }

    fn forces(
        cells: &[Self],
        cloud: &PointCloud,
        material_of_cell: &[u32],
        stiffness: Vec<Stiffness>,
    ) -> CellForces {
        patch::forces_of_mesh(cells, cloud, material_of_cell, stiffness)
    }

    fn outer_sides(cells: &[Self], _: usize) -> Vec<[u32; 2]> {
        outer_edges(cells)
    }

    /// Faces from the middle of the cell to the middles of its edges.
    fn faces_between_corners(
        &self,
        at: &dyn Fn(u32) -> [f64; 2],
    ) -> Vec<([u32; 2], [[f64; 2]; 2])> {
        let middle = mean(self.corners(), at);
        let edges = edges_around(self.corners());
        edges
            .map(|ends| (ends, [middle, mean(&ends, at)]))
            .collect()
    }

    /// Each edge with half of its normal, m.
    fn outward(mesh: &Mesh, groups: &[&Group]) -> Result<Vec<Portion<2>>, OffOutline> {
        let edges = groups.iter().flat_map(|group| &group.edges);
        let edges: BTreeSet<[u32; 2]> = edges.map(|&edge| ascending(edge)).collect();
        if edges.is_empty() {
            return Ok(Vec::new());
        }
        let of_cells = cells_at_edges(&mesh.cells);
        let mut portions = Vec::new();
        for edge in edges {
            let (cells, along) = of_cells.get(&edge).copied().unwrap_or((0, edge));
            let [p, q] = along.map(|node| mesh.positions[node as usize]);
            if cells != 1 {
                return Err(OffOutline {
                    side: "edge",
                    nodes: edge.map(|node| mesh.node_tags[node as usize]).to_vec(),
                    middle: (0..2).map(|axis| 0.5 * (p[axis] + q[axis])).collect(),
                    cells,
                });
            }
            // Corners are in counter-clockwise order: the outside is on the right.
            portions.push(Portion {
                corners: edge.to_vec(),
                share: [0.5 * (q[1] - p[1]), 0.5 * (p[0] - q[0])],
            });
        }
        Ok(portions)
    }

    fn face_portions(_: &Mesh, _: &[Cell]) -> Vec<Portion<1>> {
        Vec::new()
    }

    fn interpolation_weights(mesh: &Mesh, position: [f64; 2]) -> Option<Vec<(u32, f64)>> {
        mesh.interpolation_weights(position)
    }

    fn canvas(cells: &[Self]) -> Canvas {
        Canvas::Between(cells.to_vec())
    }
}

impl BodyCell<3> for SolidCell {
    type Outline = SolidOutline;

    fn origin(mesh: &SolidMesh) -> Origin<'_> {
        Origin::SolidMesh(mesh)
    }

    fn outline(cells: &[Self], cloud: &PointCloud<3>) -> SolidOutline {
        SolidOutline::from_cells(cells, cloud)
    }

    fn composed(
        bonds: BondSet<3>,
        cells: &[Self],
        cloud: &PointCloud<3>,
        materials: &[u32],
    ) -> BondSet<3> {
        bonds.through(&Tetrahedra::new(cells, cloud, materials), cloud)
    }

    fn simplices(&self) -> Vec<Self> {
        self.tetrahedra().map(Self::Tetrahedron).collect()
    }

    fn forces(
        cells: &[Self],
        cloud: &PointCloud<3>,
        material_of_cell: &[u32],
        stiffness: Vec<Stiffness>,
    ) -> CellForces<3> {
        patch::forces_of_solid_mesh(cells, cloud, material_of_cell, stiffness)
    }

    fn outer_sides(cells: &[Self], n_points: usize) -> Vec<[u32; 3]> {
        let outer = Faces::new(cells, n_points).outer();
        outer.iter().flat_map(|it| it.face.triangles()).collect()
    }

    fn outer_faces(cells: &[Self], n_points: usize) -> Vec<Vec<u32>> {
        let outer = Faces::new(cells, n_points).outer();
        let corners = outer.iter().map(|it| it.face.corners().to_vec());
        corners.collect()
    }

    /// Faces from the middle of the cell over the middles of its faces to the middles of its edges.
    fn faces_between_corners(
        &self,
        at: &dyn Fn(u32) -> [f64; 3],
    ) -> Vec<([u32; 2], [[f64; 3]; 3])> {
        let middle = mean(self.corners(), at);
        let mut parts = Vec::new();
        for face in self.faces() {
            let of_face = mean(face.corners(), at);
            let edges = edges_around(face.corners());
            parts.extend(edges.map(|ends| (ends, [middle, of_face, mean(&ends, at)])));
        }
        parts
    }

    fn outward(mesh: &SolidMesh, groups: &[&Group]) -> Result<Vec<Portion<3>>, OffOutline> {
        let faces: Vec<Cell> = groups.iter().flat_map(|it| &it.faces).copied().collect();
        mesh.outward_portions(&faces).map_err(|it| OffOutline {
            side: "face",
            nodes: it.nodes,
            middle: it.middle.to_vec(),
            cells: it.cells,
        })
    }

    fn face_portions(mesh: &SolidMesh, faces: &[Cell]) -> Vec<Portion<1>> {
        mesh.face_portions(faces)
    }

    fn interpolation_weights(mesh: &SolidMesh, position: [f64; 3]) -> Option<Vec<(u32, f64)>> {
        mesh.interpolation_weights(position)
    }

    fn canvas(cells: &[Self]) -> Canvas {
        Canvas::Solid(cells.to_vec())
    }
}

/// Edges between corners in their order.
fn edges_around(corners: &[u32]) -> impl Iterator<Item = [u32; 2]> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(&from, &to)| [from, to])
}

/// Mean position of nodes, m.
fn mean<const D: usize>(nodes: &[u32], at: &dyn Fn(u32) -> [f64; D]) -> [f64; D] {
    let sum = |axis: usize| nodes.iter().map(|&it| at(it)[axis]).sum::<f64>();
    std::array::from_fn(|axis| sum(axis) / nodes.len() as f64)
}

fn ascending([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
