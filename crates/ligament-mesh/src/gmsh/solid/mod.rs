//! Solid meshes from the records of a file.

mod cells;

use super::assembly::{Assembly, DROPPED_NODE};
use super::cells::{Cells, check_covering, merge_repeated};
use super::cursor::Cursor;
use super::error::GmshError;
use super::records::{Node, Records};
use super::{fields, groups, nodes};
use crate::crack::outer_faces_of;
use crate::mesh::{Group, SolidMesh};
use crate::solid::{Faces, SolidCell};

/// Makes the solid mesh of the records, or refuses them.
pub(super) fn assemble(cursor: &Cursor<'_>, mut records: Records) -> Result<SolidMesh, GmshError> {
    let assembly = Assembly::new(cursor, &mut records, 3)?;
    let records = &records;
    let positions: Vec<_> = assembly.nodes.iter().map(|node| node.position).collect();
    let oriented = |element: &_, cell| cells::oriented(cursor, element, cell, &positions);
    let all = Cells::from_elements(cursor, records, &assembly, cells::cell, oriented);
    let solid = all.and_then(|all| merge_repeated(cursor, records, all, positions.len()));
    let cells = solid.as_ref().map(|(it, _)| it.cells.as_slice());
    let cells = cells.unwrap_or_default();
    let refusal = |[first, second]: [&Node; 2]| GmshError::CoincidentNodesInSpace {
        place: cursor.place(second.offset),
        tag: second.tag,
        other: first.tag,
        position: second.position,
    };
    let sides = || outer_faces_of(cells, positions.len());
    let all = (assembly.nodes.as_slice(), positions.as_slice());
    let n_crack_faces = nodes::check_coincidence(cursor, all, cells, sides, refusal)?;
    let (solid, cell_of_element) = solid?;
    let mut remarks = assembly.remarks(solid.n_higher_order(records));
    remarks.extend(solid.remarks(n_crack_faces));
    remarks.extend(records.ignored.remark(cursor));
    let groups = groups::collect(records, &assembly, &cell_of_element, &mut remarks);
    drop(cell_of_element);
    let faces = Faces::new(&solid.cells, positions.len());
    check_overlap(cursor, records, &solid, &faces)?;
    check_faces(cursor, records, &assembly, &faces, &groups)?;
    // The search for overlapping cells needs the most memory: the faces are freed before it.
    drop(faces);
    check_covering(cursor, records, &solid, &positions, SolidCell::tetrahedra)?;
    let fields = fields::on_nodes(records, &assembly.by_tag, &assembly.numbers);
    Ok(SolidMesh {
        node_tags: assembly.nodes.iter().map(|node| node.tag).collect(),
        positions,
        cells: solid.cells,
        groups,
        fields,
        remarks,
    })
}

/// Refuses cells on the same side of a common face, which overlap.
fn check_overlap(
    cursor: &Cursor<'_>,
    records: &Records,
    solid: &Cells<SolidCell>,
    faces: &Faces<'_>,
) -> Result<(), GmshError> {
    let Some(pair) = faces.first_overlap() else {
        return Ok(());
    };
    let [first, second] = solid.elements_of(records, pair);
    Err(GmshError::OverlappingSolids {
        place: cursor.place(second.offset),
        element: second.tag,
        other: first.tag,
    })
}

/// Refuses surface elements in a group that are not faces of cells: shells beside the solid, or a surface that was meshed again.
fn check_faces(
    cursor: &Cursor<'_>,
    records: &Records,
    assembly: &Assembly,
    faces: &Faces<'_>,
    groups: &[Group],
) -> Result<(), GmshError> {
    for element in records
        .elements
        .iter()
        .filter(|it| it.shape.dimension() == 2)
    {
        let numbers = records.physicals.get(&(2, element.owner));
        let Some(&number) = numbers.and_then(|numbers| numbers.iter().find(|it| **it != 0)) else {
            continue;
        };
        let corners = &assembly.corners[element.corners()];
        let is_face = !corners.contains(&DROPPED_NODE)
            && groups::face(corners).is_some_and(|face| !faces.sides_at(&face).is_empty());
        if !is_face {
            let mut named = groups.iter();
            let named = named.find(|it| (it.dimension, it.number) == (2, number));
            return Err(GmshError::LooseFace {
                place: cursor.place(element.offset),
                element: element.tag,
                group: named.map_or_else(|| number.to_string(), |it| it.name.clone()),
            });
        }
    }
    Ok(())
}
