//! Selection of the nodes that the cells use, from the records of a file.

use super::cursor::Cursor;
use super::error::GmshError;
use super::records::{Element, Node, Records};
use super::tags::NodeIndices;
use crate::remark::Remark;

/// Number of a corner whose node was dropped.
pub(super) const DROPPED_NODE: u32 = u32::MAX;

/// Use of a node by the cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum NodeUse {
    None,
    Inner,
    Corner,
}

/// Nodes that are corners of cells, and the references to them.
pub(super) struct Assembly {
    /// Nodes that are kept, in the order of the file.
    pub(super) nodes: Vec<Node>,
    /// Indices of node records by their tags.
    pub(super) by_tag: NodeIndices,
    /// New number of every node record; `None` for a dropped node.
    pub(super) numbers: Vec<Option<u32>>,
    /// New numbers of the corners of all elements, one after the other; [`DROPPED_NODE`] for a dropped node.
    pub(super) corners: Vec<u32>,
    uses: Vec<NodeUse>,
}

impl Assembly {
    /// Keeps the nodes that are corners of cells of a given dimension, and takes the corners of the elements from the records.
    pub(super) fn new(
        cursor: &Cursor<'_>,
        records: &mut Records,
        dimension: u8,
    ) -> Result<Self, GmshError> {
        records.require_memory()?;
        let by_tag = NodeIndices::new(cursor, &records.nodes)?;
        let tags = std::mem::take(&mut records.corners);
        let mut corners = resolve_corners(cursor, records, tags, &by_tag)?;
        let uses = node_uses(cursor, records, &corners, &by_tag, dimension)?;
        let (nodes, numbers) = number_nodes(&records.nodes, &uses);
        for index in &mut corners {
            *index = numbers[*index as usize].unwrap_or(DROPPED_NODE);
        }
        Ok(Self {
            nodes,
            by_tag,
            numbers,
            corners,
            uses,
        })
    }

    /// Remarks on dropped nodes, for a number of cells of higher order.
    pub(super) fn remarks(&self, higher_order_cells: usize) -> Vec<Remark> {
        let count = |kind| {
            let uses = self.uses.iter();
            uses.filter(|node_use| **node_use == kind).count()
        };
        let mut remarks = Vec::new();
        if higher_order_cells > 0 {
            remarks.push(Remark::HigherOrderCells {
                cells: higher_order_cells,
                nodes: count(NodeUse::Inner),
            });
        }
        let unused = count(NodeUse::None);
        if unused > 0 {
            remarks.push(Remark::UnusedNodes { nodes: unused });
        }
        remarks
    }
}

fn missing_node(cursor: &Cursor<'_>, element: &Element, node: u64) -> GmshError {
    GmshError::MissingNode {
        place: cursor.place(element.offset),
        element: element.tag,
        node,
    }
}

/// Corners of every element as indices of node records.
fn resolve_corners(
    cursor: &Cursor<'_>,
    records: &Records,
    tags: Vec<u64>,
    by_tag: &NodeIndices,
) -> Result<Vec<u32>, GmshError> {
    let mut corners = Vec::with_capacity(tags.len());
    for element in &records.elements {
        for tag in &tags[element.corners()] {
            let index = by_tag.get(*tag);
            corners.push(index.ok_or_else(|| missing_node(cursor, element, *tag))?);
        }
    }
    Ok(corners)
}

fn node_uses(
    cursor: &Cursor<'_>,
    records: &Records,
    corners: &[u32],
    by_tag: &NodeIndices,
    dimension: u8,
) -> Result<Vec<NodeUse>, GmshError> {
    let mut uses = vec![NodeUse::None; records.nodes.len()];
    for (tag, element) in &records.inner_nodes {
        let element = &records.elements[*element as usize];
        let index = by_tag.get(*tag);
        let index = index.ok_or_else(|| missing_node(cursor, element, *tag))?;
        if element.shape.dimension() == dimension {
            uses[index as usize] = NodeUse::Inner;
        }
    }
    for element in &records.elements {
        if element.shape.dimension() == dimension {
            for index in &corners[element.corners()] {
                uses[*index as usize] = NodeUse::Corner;
            }
        }
    }
    Ok(uses)
}

/// Nodes that are kept, and the new number of every node record; `None` for a dropped node.
fn number_nodes(nodes: &[Node], uses: &[NodeUse]) -> (Vec<Node>, Vec<Option<u32>>) {
    let mut kept = Vec::with_capacity(nodes.len());
    let number = |(node, node_use): (&Node, &NodeUse)| {
        (*node_use == NodeUse::Corner).then(|| {
            kept.push(*node);
            kept.len() as u32 - 1
        })
    };
    let numbers = nodes.iter().zip(uses).map(number).collect();
    (kept, numbers)
}
