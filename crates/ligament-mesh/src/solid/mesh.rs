//! What was meshed in space: nodes, solid cells and named groups.

use super::cell::SolidCell;
use crate::field::NodeField;
use crate::group::Group;
use crate::remark::Remark;

/// A mesh of tetrahedra, hexahedra, prisms and pyramids.
///
/// Only nodes that a cell uses are kept; they are numbered from zero in the order of the file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SolidMesh {
    /// Tag of each node in the mesh file, shape (n_nodes).
    pub node_tags: Vec<u64>,
    /// Position of each node, shape (n_nodes), m.
    pub positions: Vec<[f64; 3]>,
    /// Cells, of positive volume, shape (n_cells).
    pub cells: Vec<SolidCell>,
    /// Physical groups of every dimension, in the order of dimension, then number; none is empty.
    pub groups: Vec<Group>,
    /// Values at the nodes, in the order of the file.
    pub fields: Vec<NodeField>,
    /// Remarks for the user on what was read otherwise than it stands in the file.
    pub remarks: Vec<Remark>,
}

impl SolidMesh {
    /// Volume of all cells together, m³.
    pub fn volume(&self) -> f64 {
        let volumes = self.cells.iter().map(|cell| cell.volume(&self.positions));
        volumes.sum()
    }

    /// The first group of this name: the one of lowest dimension, then of lowest number.
    ///
    /// A name may stand for several groups; [`SolidMesh::groups_named`] gives them all.
    pub fn group(&self, name: &str) -> Option<&Group> {
        self.groups_named(name).next()
    }

    /// All groups of this name, in the order of dimension, then number.
    pub fn groups_named(&self, name: &str) -> impl Iterator<Item = &Group> {
        self.groups.iter().filter(move |group| group.name == name)
    }
}
