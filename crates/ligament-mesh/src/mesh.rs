//! Meshes: nodes, cells and named groups.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::cell::{Cell, MeshCell};
use crate::field::NodeField;
use crate::group::Group;
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

    /// Length of some edges assigned to each of their nodes, m, ascending by node: half of each edge.
    pub fn lengths_at_nodes(&self, edges: &[[u32; 2]]) -> Vec<(u32, f64)> {
        let mut edges: Vec<[u32; 2]> = edges.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
        edges.sort_unstable();
        edges.dedup();
        let mut lengths: BTreeMap<u32, f64> = BTreeMap::new();
        for edge in edges {
            let [p, q] = edge.map(|node| self.positions[node as usize]);
            let along = p.iter().zip(&q).map(|(from, to)| to - from);
            let half = 0.5 * along.fold(0.0, f64::hypot);
            for node in edge {
                *lengths.entry(node).or_default() += half;
            }
        }
        lengths.into_iter().collect()
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
