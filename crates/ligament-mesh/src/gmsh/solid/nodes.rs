//! Whether nodes can be those of a solid mesh.

use super::super::cursor::Cursor;
use super::super::error::GmshError;
use super::super::records::Node;

/// Nodes this near along every axis, as a part of the mesh size, are at one place.
const COINCIDENCE: f64 = 1e-12;

/// Refuses two nodes nearer than half the tolerance along every axis, and no two farther apart than all of it.
pub(super) fn check_distinct(cursor: &Cursor<'_>, nodes: &[Node]) -> Result<(), GmshError> {
    let bounds = [0, 1, 2].map(|axis| {
        let values = nodes.iter().map(|node| node.position[axis]);
        let lower = values.clone().fold(f64::INFINITY, f64::min);
        [lower, values.fold(f64::NEG_INFINITY, f64::max)]
    });
    let size = bounds.iter().map(|[lower, upper]| upper - lower);
    let width = COINCIDENCE * size.fold(0.0, f64::max);
    // Near nodes fall into one column of one of four sets of columns, shifted by half a width; in z they are neighbours there.
    for shifts in [[0.0, 0.0], [0.5, 0.0], [0.0, 0.5], [0.5, 0.5]] {
        let place = |node: &Node, axis: usize| {
            ((node.position[axis] - bounds[axis][0]) / width + shifts[axis]).floor() as i64
        };
        let column = |(index, node): (usize, &Node)| {
            let column = [place(node, 0), place(node, 1)];
            (column, node.position[2], index)
        };
        let mut sorted: Vec<([i64; 2], f64, usize)> =
            nodes.iter().enumerate().map(column).collect();
        sorted.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        let mut pairs = sorted.windows(2);
        let near = pairs.find(|pair| pair[0].0 == pair[1].0 && pair[1].1 - pair[0].1 <= width);
        if let Some(pair) = near {
            let [first, second] = [pair[0].2.min(pair[1].2), pair[0].2.max(pair[1].2)];
            return Err(GmshError::CoincidentNodesInSpace {
                place: cursor.place(nodes[second].offset),
                tag: nodes[second].tag,
                other: nodes[first].tag,
                position: nodes[second].position,
            });
        }
    }
    Ok(())
}
