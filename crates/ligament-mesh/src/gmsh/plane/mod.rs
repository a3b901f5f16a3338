//! Planar meshes from the records of a file.

mod cells;

use super::assembly::Assembly;
use super::cells::{Cells, check_covering, merge_repeated};
use super::cursor::Cursor;
use super::error::GmshError;
use super::records::{Node, Records};
use super::{fields, groups, nodes};
use crate::cell::Cell;
use crate::coincidence::size;
use crate::coordinate_plane::CoordinatePlane;
use crate::crack::outer_edges_of;
use crate::disjoint::are_disjoint;
use crate::edges::Edges;
use crate::mesh::Mesh;
use crate::remark::Remark;

/// Makes the planar mesh of the records, or refuses them.
pub(super) fn assemble(
    cursor: &Cursor<'_>,
    mut records: Records,
    plane: CoordinatePlane,
) -> Result<Mesh, GmshError> {
    check_elements(cursor, &records)?;
    for node in &mut records.nodes {
        node.position = plane.turned(node.position);
    }
    let assembly = Assembly::new(cursor, &mut records, 2)?;
    let records = &records;
    let size = size(assembly.nodes.iter().map(|node| node.position));
    nodes::check_plane(cursor, &assembly.nodes, size, plane)?;
    let positions: Vec<_> = (assembly.nodes.iter())
        .map(|node| [node.position[0], node.position[1]])
        .collect();
    let oriented = |element: &_, cell| cells::oriented(cursor, element, cell, &positions, size);
    let all = Cells::from_elements(cursor, records, &assembly, cells::cell, oriented);
    let planar = all.and_then(|all| merge_repeated(cursor, records, all, positions.len()));
    let cells = planar.as_ref().map(|(it, _)| it.cells.as_slice());
    let cells = cells.unwrap_or_default();
    let refusal = |[first, second]: [&Node; 2]| GmshError::CoincidentNodes {
        place: cursor.place(second.offset),
        tag: second.tag,
        other: first.tag,
        x: second.position[0],
        y: second.position[1],
    };
    let sides = || outer_edges_of(cells);
    let all = (assembly.nodes.as_slice(), positions.as_slice());
    let n_crack_faces = nodes::check_coincidence(cursor, all, cells, sides, refusal)?;
    let (planar, cell_of_element) = planar?;
    let edges = Edges::new(&planar.cells);
    cells::check_common_edges(cursor, records, &planar, &edges)?;
    let outer = edges.outer();
    drop(edges);
    if !are_disjoint(&positions, &planar.cells, &outer) {
        check_covering(cursor, records, &planar, &positions, Cell::triangles)?;
    }
    let mut remarks = assembly.remarks(planar.n_higher_order(records));
    remarks.extend(planar.remarks(n_crack_faces));
    remarks.extend(records.ignored.remark(cursor));
    remarks.extend((plane != CoordinatePlane::Xy).then_some(Remark::Turned { plane }));
    let groups = groups::collect(records, &assembly, &cell_of_element, &mut remarks);
    let fields = fields::on_nodes(records, &assembly.by_tag, &assembly.numbers);
    Ok(Mesh {
        node_tags: assembly.nodes.iter().map(|node| node.tag).collect(),
        positions,
        cells: planar.cells,
        groups,
        fields,
        remarks,
    })
}

/// Refuses solid elements, and elements that are no cells alone.
fn check_elements(cursor: &Cursor<'_>, records: &Records) -> Result<(), GmshError> {
    if let Some(record) = records.first_solid {
        return Err(GmshError::VolumeElement {
            place: cursor.place(record.offset),
            code: record.code,
        });
    }
    let mut elements = records.elements.iter();
    match elements.any(|element| element.shape.dimension() == 2) {
        true => Ok(()),
        false => Err(GmshError::NoCells),
    }
}
