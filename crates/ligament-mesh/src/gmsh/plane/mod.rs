//! A planar mesh from the records of a file.

mod cells;
mod nodes;

use super::assembly::Assembly;
use super::cursor::Cursor;
use super::error::GmshError;
use super::records::Records;
use super::{fields, groups};
use crate::mesh::Mesh;

/// Makes the planar mesh of the records, or refuses them.
pub(super) fn assemble(cursor: &Cursor<'_>, records: &Records) -> Result<Mesh, GmshError> {
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
    let assembly = Assembly::new(cursor, records, 2)?;
    let size = nodes::check(cursor, &assembly.nodes)?;
    let positions: Vec<_> = (assembly.nodes.iter())
        .map(|node| [node.position[0], node.position[1]])
        .collect();
    let planar = cells::oriented(cursor, records, &assembly.corners, &positions, size)?;
    let (planar, cell_of_element) = cells::merge_repeated(cursor, records, planar)?;
    cells::check_overlap(cursor, records, &planar, &positions)?;
    let higher_order = planar
        .iter()
        .filter(|cell| records.elements[cell.element].higher_order);
    let mut remarks = assembly.remarks(higher_order.count());
    let groups = groups::collect(records, &assembly, &cell_of_element, &mut remarks);
    let fields = fields::on_nodes(records, &assembly.by_tag, &assembly.numbers);
    let node_tags = assembly.nodes.iter().map(|node| node.tag).collect();
    let cells = planar.into_iter().map(|planar| planar.cell).collect();
    Ok(Mesh {
        node_tags,
        positions,
        cells,
        groups,
        fields,
        remarks,
    })
}
