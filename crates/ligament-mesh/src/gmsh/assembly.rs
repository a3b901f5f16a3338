//! From the records of a file to a mesh.

use super::cursor::Cursor;
use super::element_type::Shape;
use super::error::GmshError;
use super::records::{Corners, Element, Node, Records};
use super::tags::NodeIndices;
use super::{cells, fields, groups, nodes};
use crate::mesh::Mesh;
use crate::remark::Remark;

/// What the planar cells use a node for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Use {
    None,
    Inner,
    Corner,
}

/// Makes the mesh of the records, or refuses them.
pub(super) fn assemble(cursor: &Cursor<'_>, records: &Records) -> Result<Mesh, GmshError> {
    if !records
        .elements
        .iter()
        .any(|element| element.shape.dimension() == 2)
    {
        return Err(GmshError::NoCells);
    }
    let by_tag = NodeIndices::new(cursor, &records.nodes)?;
    let mut corners = resolve_corners(cursor, records, &by_tag)?;
    let uses = node_uses(cursor, records, &corners, &by_tag)?;
    let (kept, numbers) = number_nodes(&records.nodes, &uses);
    for index in corners.iter_mut().flatten() {
        *index = index.and_then(|index| numbers[index as usize]);
    }

    let size = nodes::check(cursor, &kept)?;
    let positions: Vec<_> = kept
        .iter()
        .map(|node| [node.position[0], node.position[1]])
        .collect();
    let planar = cells::oriented(cursor, records, &corners, &positions, size)?;
    let (planar, cell_of_element) = cells::merge_repeated(cursor, records, planar)?;
    cells::check_overlap(cursor, records, &planar)?;
    let higher_order = planar
        .iter()
        .filter(|cell| records.elements[cell.element].higher_order);
    let mut remarks = remarks(higher_order.count(), &uses);
    let groups = groups::collect(records, &corners, &cell_of_element, &mut remarks);
    let fields = fields::on_nodes(records, &by_tag, &numbers);
    let node_tags = kept.iter().map(|node| node.tag).collect();
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

fn missing_node(cursor: &Cursor<'_>, element: &Element, node: u64) -> GmshError {
    GmshError::MissingNode {
        place: cursor.place(element.offset),
        element: element.tag,
        node,
    }
}

/// The corners of every element as indices of node records.
fn resolve_corners(
    cursor: &Cursor<'_>,
    records: &Records,
    by_tag: &NodeIndices,
) -> Result<Vec<Corners>, GmshError> {
    let resolve = |element: &Element| {
        let mut corners = [None; 4];
        for (corner, tag) in corners.iter_mut().zip(element.corners()) {
            let index = by_tag.get(*tag);
            *corner = Some(index.ok_or_else(|| missing_node(cursor, element, *tag))?);
        }
        Ok(corners)
    };
    records.elements.iter().map(resolve).collect()
}

fn node_uses(
    cursor: &Cursor<'_>,
    records: &Records,
    corners: &[Corners],
    by_tag: &NodeIndices,
) -> Result<Vec<Use>, GmshError> {
    let mut uses = vec![Use::None; records.nodes.len()];
    for (tag, element) in &records.inner_nodes {
        let element = &records.elements[*element as usize];
        let index = by_tag.get(*tag);
        let index = index.ok_or_else(|| missing_node(cursor, element, *tag))?;
        uses[index as usize] = Use::Inner;
    }
    for (element, corners) in records.elements.iter().zip(corners) {
        if matches!(element.shape, Shape::Triangle | Shape::Quadrangle) {
            for index in corners.iter().flatten() {
                uses[*index as usize] = Use::Corner;
            }
        }
    }
    Ok(uses)
}

/// The nodes that stay, and the new number of every node record: none if it is dropped.
fn number_nodes(nodes: &[Node], uses: &[Use]) -> (Vec<Node>, Vec<Option<u32>>) {
    let mut kept = Vec::with_capacity(nodes.len());
    let number = |(node, node_use): (&Node, &Use)| {
        (*node_use == Use::Corner).then(|| {
            kept.push(*node);
            kept.len() as u32 - 1
        })
    };
    let numbers = nodes.iter().zip(uses).map(number).collect();
    (kept, numbers)
}

fn remarks(higher_order_cells: usize, uses: &[Use]) -> Vec<Remark> {
    let count = |kind| uses.iter().filter(|node_use| **node_use == kind).count();
    let mut remarks = Vec::new();
    if higher_order_cells > 0 {
        remarks.push(Remark::HigherOrderCells {
            cells: higher_order_cells,
            nodes: count(Use::Inner),
        });
    }
    let unused = count(Use::None);
    if unused > 0 {
        remarks.push(Remark::UnusedNodes { nodes: unused });
    }
    remarks
}
