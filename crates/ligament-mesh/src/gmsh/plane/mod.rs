//! Planar meshes from the records of a file.

mod cells;

use super::assembly::Assembly;
use super::cells::{Cells, check_covering, merge_repeated};
use super::cursor::Cursor;
use super::error::GmshError;
use super::records::Records;
use super::{fields, groups, nodes};
use crate::cell::Cell;
use crate::mesh::Mesh;

/// Makes the planar mesh of the records, or refuses them.
pub(super) fn assemble(cursor: &Cursor<'_>, mut records: Records) -> Result<Mesh, GmshError> {
    if let Some(record) = records.first_solid {
        return Err(GmshError::VolumeElement {
            place: cursor.place(record.offset),
            code: record.code,
        });
    }
    let mut elements = records.elements.iter();
    if !elements.any(|element| element.shape.dimension() == 2) {
        return Err(GmshError::NoCells);
    }
    let assembly = Assembly::new(cursor, &mut records, 2)?;
    let records = &records;
    let size = nodes::size(&assembly.nodes);
    nodes::check_plane(cursor, &assembly.nodes, size)?;
    if let Some([first, second]) = nodes::coincident(&assembly.nodes, size, 2) {
        return Err(GmshError::CoincidentNodes {
            place: cursor.place(second.offset),
            tag: second.tag,
            other: first.tag,
            x: second.position[0],
            y: second.position[1],
        });
    }
    let positions: Vec<_> = (assembly.nodes.iter())
        .map(|node| [node.position[0], node.position[1]])
        .collect();
    let oriented = |element: &_, cell| cells::oriented(cursor, element, cell, &positions, size);
    let planar = Cells::from_elements(cursor, records, &assembly, cells::cell, oriented)?;
    let (planar, cell_of_element) = merge_repeated(cursor, records, planar, positions.len())?;
    cells::check_common_edges(cursor, records, &planar)?;
    check_covering(cursor, records, &planar, &positions, Cell::triangles)?;
    let mut remarks = assembly.remarks(planar.n_higher_order(records));
    let groups = groups::collect(records, &assembly, &cell_of_element, &mut remarks);
    let fields = fields::on_nodes(records, &assembly.by_tag, &assembly.numbers);
    let node_tags = assembly.nodes.iter().map(|node| node.tag).collect();
    Ok(Mesh {
        node_tags,
        positions,
        cells: planar.cells,
        groups,
        fields,
        remarks,
    })
}
