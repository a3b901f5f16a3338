//! Meshes: nodes, cells, physical groups, and values at the nodes.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::cell::{Cell, MeshCell, ascending};
use crate::edges::outer_edges;
use crate::portion::Portion;
use crate::remark::Remark;
use crate::solid::SolidCell;

/// A planar mesh of triangles and quadrangles, or in space a mesh of tetrahedra, hexahedra, prisms and pyramids.
///
/// Only nodes that a cell uses are kept; they are numbered from zero in the order of the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh<const D: usize = 2, C = Cell> {
    /// Tag of each node in the mesh file, shape (n_nodes).
    pub node_tags: Arc<[u64]>,
    /// Position of each node, shape (n_nodes), m.
    pub positions: Vec<[f64; D]>,
    /// Cells, shape (n_cells): corners counter-clockwise, in space of positive volume.
    pub cells: Vec<C>,
    /// Physical groups of every dimension, in the order of dimension, then number; none is empty.
    pub groups: Vec<Group>,
    /// Values at the nodes, in the order of the file.
    pub fields: Vec<NodeField>,
    /// Remarks for the user on parts of the file that were changed or left out.
    pub remarks: Vec<Remark>,
}

/// A mesh of tetrahedra, hexahedra, prisms and pyramids.
pub type SolidMesh = Mesh<3, SolidCell>;

impl<const D: usize, C> Default for Mesh<D, C> {
    fn default() -> Self {
        Self {
            node_tags: Arc::default(),
            positions: Vec::new(),
            cells: Vec::new(),
            groups: Vec::new(),
            fields: Vec::new(),
            remarks: Vec::new(),
        }
    }
}

impl Mesh {
    /// Area of all cells, m².
    pub fn area(&self) -> f64 {
        self.size()
    }

    /// Edges that belong to one cell alone, with the cell on their left, ascending by their nodes.
    pub fn outline(&self) -> Vec<[u32; 2]> {
        outer_edges(&self.cells)
    }

    /// Angle of the cells at each node, rad, shape (n_nodes): 2 pi inside, pi on a straight outline, more at re-entrant corners.
    pub fn angles_at_nodes(&self) -> Vec<f64> {
        let mut angles = vec![0.0; self.positions.len()];
        for cell in &self.cells {
            let corners = cell.corners();
            let n = corners.len();
            for (place, &node) in corners.iter().enumerate() {
                let [xo, yo] = self.positions[node as usize];
                let towards = |place: usize| {
                    let [x, y] = self.positions[corners[place % n] as usize];
                    [x - xo, y - yo]
                };
                let (u, v) = (towards(place + 1), towards(place + n - 1));
                let (cross, dot) = (u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]);
                angles[node as usize] += cross.atan2(dot);
            }
        }
        angles
    }
}

impl SolidMesh {
    /// Volume of all cells, m³.
    pub fn volume(&self) -> f64 {
        self.size()
    }
}

impl<const D: usize, C> Mesh<D, C> {
    fn size(&self) -> f64
    where
        C: MeshCell<D>,
    {
        let sizes = self.cells.iter().map(|cell| cell.size(&self.positions));
        sizes.sum()
    }

    /// Edges of all cells, each once, ascending.
    pub fn edges(&self) -> Vec<[u32; 2]>
    where
        C: MeshCell<D>,
    {
        let mut edges: Vec<[u32; 2]> = self.cells.iter().flat_map(C::edges).collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// Some edges, each with half of its length (m) for each node. A repeated edge counts once.
    pub fn edge_portions(&self, edges: &[[u32; 2]]) -> Vec<Portion<1>> {
        let mut edges: Vec<[u32; 2]> = edges.iter().copied().map(ascending).collect();
        edges.sort_unstable();
        edges.dedup();
        let portion = |edge: [u32; 2]| {
            let [p, q] = edge.map(|node| self.positions[node as usize]);
            let along = p.iter().zip(&q).map(|(from, to)| to - from);
            Portion {
                corners: edge.to_vec(),
                share: [0.5 * along.fold(0.0, f64::hypot)],
            }
        };
        edges.into_iter().map(portion).collect()
    }

    /// First group of a given name: the one of lowest dimension, then of lowest number.
    ///
    /// A name may belong to several groups; [`Mesh::groups_named`] returns them all.
    pub fn group(&self, name: &str) -> Option<&Group> {
        self.groups_named(name).next()
    }

    /// All groups of a given name, in the order of dimension, then number.
    pub fn groups_named(&self, name: &str) -> impl Iterator<Item = &Group> {
        self.groups.iter().filter(move |group| group.name == name)
    }
}

/// A mesh that is planar or solid.
#[derive(Debug, Clone, PartialEq)]
pub enum AnyMesh {
    /// Triangles and quadrangles in a plane.
    Plane(Mesh),
    /// Tetrahedra, hexahedra, prisms and pyramids.
    Solid(SolidMesh),
}

impl AnyMesh {
    /// The mesh with its coordinates multiplied by a positive factor.
    pub fn scaled(mut self, factor: f64) -> Self {
        match &mut self {
            AnyMesh::Plane(mesh) => scale(&mut mesh.positions, factor),
            AnyMesh::Solid(mesh) => scale(&mut mesh.positions, factor),
        }
        self
    }

    /// Number of cells.
    pub fn n_cells(&self) -> usize {
        match self {
            AnyMesh::Plane(mesh) => mesh.cells.len(),
            AnyMesh::Solid(mesh) => mesh.cells.len(),
        }
    }

    /// Number of nodes.
    pub fn n_nodes(&self) -> usize {
        match self {
            AnyMesh::Plane(mesh) => mesh.positions.len(),
            AnyMesh::Solid(mesh) => mesh.positions.len(),
        }
    }

    /// Groups in the order of dimension, then number.
    pub fn groups(&self) -> &[Group] {
        match self {
            AnyMesh::Plane(mesh) => &mesh.groups,
            AnyMesh::Solid(mesh) => &mesh.groups,
        }
    }

    /// Remarks for the user on parts of the file that were changed or left out.
    pub fn remarks(&self) -> &[Remark] {
        match self {
            AnyMesh::Plane(mesh) => &mesh.remarks,
            AnyMesh::Solid(mesh) => &mesh.remarks,
        }
    }
}

/// Multiplies coordinates by a factor.
fn scale<const D: usize>(positions: &mut [[f64; D]], factor: f64) {
    let coordinates = positions.iter_mut().flatten();
    coordinates.for_each(|it| *it *= factor);
}

/// A physical group of the mesh file: a named set of nodes, with its edges, faces or cells.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Group {
    /// Name of the group; for an unnamed group its number in decimal.
    pub name: String,
    /// Dimension: 0 points, 1 curves, 2 surfaces, 3 volumes.
    pub dimension: u8,
    /// Number of the physical group in the file.
    pub number: i32,
    /// Nodes of the group, ascending, each once.
    pub nodes: Vec<u32>,
    /// Edges of a curve group, ascending by their nodes, each once (else empty).
    pub edges: Vec<[u32; 2]>,
    /// Faces of a surface group of a solid mesh, ascending by their nodes, each once, with either orientation (else empty).
    pub faces: Vec<Cell>,
    /// Cells, ascending: of a surface group of a planar mesh, or a volume group of a solid one (else empty).
    pub cells: Vec<u32>,
}

/// A view of a post-processing program at one time: a section `$NodeData`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NodeField {
    /// Name of the view.
    pub name: String,
    /// Number of the time step, by which several sections of one name differ.
    pub time_step: i32,
    /// Number of values per node: 1 for scalars, 3 for vectors, 9 for tensors.
    pub components: u64,
    /// Nodes with their values, ascending; nodes without a value are left out. Empty for vectors and tensors: only scalars are stored.
    pub values: Vec<(u32, f64)>,
}

impl NodeField {
    /// Value at each node, shape (n_nodes); `None` where the section has no value.
    pub fn at_nodes(&self, n_nodes: usize) -> Vec<Option<f64>> {
        let mut dense = vec![None; n_nodes];
        for &(node, value) in &self.values {
            dense[node as usize] = Some(value);
        }
        dense
    }
}
