//! Whether nodes can be those of a planar mesh.

use super::super::cursor::Cursor;
use super::super::error::GmshError;
use super::super::records::Node;

/// Heights may differ by this part of the mesh size.
const FLATNESS: f64 = 1e-9;
/// Nodes this near in x and in y, as a part of the mesh size, are at one place.
const COINCIDENCE: f64 = 1e-12;

/// Refuses nodes out of one plane and nodes at one place; gives the size of the mesh, m.
pub(super) fn check(cursor: &Cursor<'_>, nodes: &[Node]) -> Result<f64, GmshError> {
    let size = size(nodes);
    check_plane(cursor, nodes, size)?;
    check_distinct(cursor, nodes, size)?;
    Ok(size)
}

/// The longest side of the box around the nodes, m.
fn size(nodes: &[Node]) -> f64 {
    let extent = |axis: usize| {
        let values = nodes.iter().map(|node| node.position[axis]);
        values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
    };
    (0..3).map(extent).fold(0.0, f64::max)
}

fn check_plane(cursor: &Cursor<'_>, nodes: &[Node], size: f64) -> Result<(), GmshError> {
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

/// Refuses two nodes nearer than half the tolerance, and no two farther apart than all of it.
fn check_distinct(cursor: &Cursor<'_>, nodes: &[Node], size: f64) -> Result<(), GmshError> {
    let width = COINCIDENCE * size;
    let left = nodes
        .iter()
        .map(|node| node.position[0])
        .fold(f64::INFINITY, f64::min);
    // Near nodes fall into one strip of one of two sets of strips, shifted by half a width;
    // in y they are neighbours there.
    for shift in [0.0, 0.5] {
        let mut sorted: Vec<(i64, f64, usize)> = nodes
            .iter()
            .enumerate()
            .map(|(index, node)| {
                let strip = ((node.position[0] - left) / width + shift).floor();
                (strip as i64, node.position[1], index)
            })
            .collect();
        sorted.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        let near =
            |pair: &&[(i64, f64, usize)]| pair[0].0 == pair[1].0 && pair[1].1 - pair[0].1 <= width;
        if let Some(pair) = sorted.windows(2).find(near) {
            let (first, second) = (pair[0].2.min(pair[1].2), pair[0].2.max(pair[1].2));
            let node = &nodes[second];
            return Err(GmshError::CoincidentNodes {
                place: cursor.place(node.offset),
                tag: node.tag,
                other: nodes[first].tag,
                x: node.position[0],
                y: node.position[1],
            });
        }
    }
    Ok(())
}
