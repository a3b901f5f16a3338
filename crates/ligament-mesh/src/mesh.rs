//! What was meshed: nodes, planar cells and named groups.

use crate::cell::Cell;
use crate::field::NodeField;
use crate::group::Group;
use crate::remark::Remark;

/// A planar mesh of triangles and quadrangles.
///
/// Only nodes that a cell uses are kept; they are numbered from zero in the order of the file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Tag of each node in the mesh file, shape (n_nodes).
    pub node_tags: Vec<u64>,
    /// Position of each node, shape (n_nodes), m.
    pub positions: Vec<[f64; 2]>,
    /// Cells, corners counter-clockwise, shape (n_cells).
    pub cells: Vec<Cell>,
    /// Physical groups of every dimension, in the order of dimension, then number; none is empty.
    pub groups: Vec<Group>,
    /// Values at the nodes, in the order of the file.
    pub fields: Vec<NodeField>,
    /// Remarks for the user on what was read otherwise than it stands in the file.
    pub remarks: Vec<Remark>,
}

impl Mesh {
    /// Area of all cells together, m².
    pub fn area(&self) -> f64 {
        self.cells
            .iter()
            .map(|cell| cell.area(&self.positions))
            .sum()
    }

    /// The first group of this name: the one of lowest dimension, then of lowest number.
    ///
    /// A name may stand for several groups; [`Mesh::groups_named`] gives them all.
    pub fn group(&self, name: &str) -> Option<&Group> {
        self.groups_named(name).next()
    }

    /// All groups of this name, in the order of dimension, then number.
    pub fn groups_named(&self, name: &str) -> impl Iterator<Item = &Group> {
        self.groups.iter().filter(move |group| group.name == name)
    }
}
