//! Meshed bodies as bytes of messages between processes.

use std::io::Read;

use ligament_analysis::serial::{self, Damaged, Serial, Sink};
use ligament_mesh::{Group, Mesh, NodeField, Numbering};

use super::mesh::BodyOnMesh;
use super::mesh_cells::BodyCell;

/// Parts of a meshed body in a message: tags and coordinates of the nodes, cells, groups, fields, remarks, and the numbers of nodes and cells
/// in the file.
type Contents<C> = (
    (Vec<u64>, Vec<f64>, Vec<C>),
    (Vec<Group>, Vec<NodeField>, Vec<String>),
    (Option<Vec<u32>>, Vec<u32>),
);

impl<const D: usize, C: BodyCell<D>> BodyOnMesh<D, C> {
    /// Appends the body to a message.
    pub(super) fn write(&self, out: &mut dyn Sink) {
        let Self {
            mesh,
            remarks,
            numbering,
            cell_numbers,
        } = self;
        let points = 0..mesh.positions.len() as u32;
        let in_file = numbering.order_of_file().map(|_| {
            let numbers = points.map(|point| numbering.in_file(point));
            numbers.collect::<Vec<u32>>()
        });
        let nodes = (&*mesh.node_tags, mesh.positions.as_flattened(), &mesh.cells);
        let named = (&mesh.groups, &mesh.fields, &**remarks);
        serial::write(&(nodes, named, (in_file, cell_numbers)), out);
    }

    /// Reads the body of a message.
    ///
    /// # Errors
    ///
    /// If the bytes encode no such body.
    pub(super) fn read(from: &mut dyn Read) -> Result<Self, Damaged> {
        let ((node_tags, coordinates, cells), (groups, fields, remarks), (in_file, cell_numbers)) =
            Contents::read(from)?;
        Ok(Self {
            mesh: Mesh {
                node_tags: node_tags.into(),
                positions: coordinates.as_chunks().0.to_vec(),
                cells,
                groups,
                fields,
                remarks: Vec::new(),
            },
            remarks: remarks.into(),
            numbering: in_file.map_or_else(Numbering::default, Numbering::of_numbers),
            cell_numbers,
        })
    }
}
