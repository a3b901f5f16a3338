//! Checks of the nodes of a mesh.

use super::cursor::Cursor;
use super::error::GmshError;
use super::records::Node;

/// Largest difference of heights, relative to the mesh size.
const FLATNESS: f64 = 1e-9;
/// Distance along every axis, relative to the mesh size, below which nodes coincide.
const COINCIDENCE: f64 = 1e-12;

/// Longest side of the box around the nodes, m.
pub(super) fn size(nodes: &[Node]) -> f64 {
    let extent = |axis: usize| {
        let values = nodes.iter().map(|node| node.position[axis]);
        values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
    };
    (0..3).map(extent).fold(0.0, f64::max)
}

/// Refuses nodes off a common plane.
pub(super) fn check_plane(cursor: &Cursor<'_>, nodes: &[Node], size: f64) -> Result<(), GmshError> {
    let plane = nodes[0].position[2];
    match nodes
        .iter()
        .find(|node| (node.position[2] - plane).abs() > FLATNESS * size)
    {
        Some(node) => Err(GmshError::NotPlanar {
            place: cursor.place(node.offset),
            tag: node.tag,
            z: node.position[2],
            plane,
        }),
        None => Ok(()),
    }
}

/// Two coincident nodes, if any, in the order of the file. Nodes of a mesh of a given dimension that are nearer than half the tolerance
/// along each axis are always found, nodes farther apart than the tolerance never.
pub(super) fn coincident(nodes: &[Node], size: f64, dimension: usize) -> Option<[&Node; 2]> {
    let width = COINCIDENCE * size;
    let lowest = |axis: usize| {
        let values = nodes.iter().map(|node| node.position[axis]);
        values.fold(f64::INFINITY, f64::min)
    };
    let lowest = [lowest(0), lowest(1)];
    let across = dimension - 1;
    // Two sets of strips are shifted by half a width (in space, four sets of columns): near nodes share a strip of one set, in which they
    // are adjacent along the last axis.
    (0..1 << across).find_map(|shifted: usize| {
        let place = |node: &Node, axis: usize| {
            let shift = if (shifted >> axis) & 1 == 1 { 0.5 } else { 0.0 };
            ((node.position[axis] - lowest[axis]) / width + shift).floor() as i64
        };
        let placed = |(index, node): (usize, &Node)| {
            let strip = [0, 1].map(|axis| if axis < across { place(node, axis) } else { 0 });
            (strip, node.position[across], index)
        };
        let mut sorted: Vec<([i64; 2], f64, usize)> =
            nodes.iter().enumerate().map(placed).collect();
        sorted.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        let mut pairs = sorted.windows(2);
        let near = pairs.find(|pair| pair[0].0 == pair[1].0 && pair[1].1 - pair[0].1 <= width)?;
        Some([near[0].2.min(near[1].2), near[0].2.max(near[1].2)].map(|index| &nodes[index]))
    })
}
