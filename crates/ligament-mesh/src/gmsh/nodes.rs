//! Checks of the nodes of a mesh.

use std::collections::BTreeSet;

use super::cursor::Cursor;
use super::error::GmshError;
use super::records::Node;
use crate::cell::MeshCell;
use crate::coincidence::{coincident_pairs, lowest_at_place};
use crate::coordinate_plane::CoordinatePlane;
use crate::crack::opposite_sides;

/// Largest difference of heights, relative to the mesh size.
const FLATNESS: f64 = 1e-9;

/// Refuses nodes off the plane in which the mesh is expected, which was turned into the plane of x and y; `size` is that of the mesh.
pub(super) fn check_plane(
    cursor: &Cursor<'_>,
    nodes: &[Node],
    size: f64,
    wanted: CoordinatePlane,
) -> Result<(), GmshError> {
    let off_plane = |plane: CoordinatePlane| {
        let (_, axis) = plane.normal();
        let height = move |node: &Node| wanted.turned_back(node.position)[axis];
        let common = height(&nodes[0]);
        let mut others = nodes.iter().map(move |node| (node, height(node), common));
        others.find(|(_, height, common)| (height - common).abs() > FLATNESS * size)
    };
    let Some((node, height, common)) = off_plane(wanted) else {
        return Ok(());
    };
    let (place, tag) = (cursor.place(node.offset), node.tag);
    let mut planes = CoordinatePlane::ALL.into_iter();
    Err(match planes.find(|it| off_plane(*it).is_none()) {
        Some(plane) => GmshError::OtherPlane {
            place,
            plane,
            height: wanted.turned_back(node.position)[plane.normal().1],
            wanted,
        },
        None if wanted == CoordinatePlane::Xy => GmshError::NotPlanar {
            place,
            tag,
            z: height,
            plane: common,
        },
        None => GmshError::NotInPlane {
            place,
            tag,
            wanted,
            height,
            common,
        },
    })
}

/// Number of pairs of outer sides of cells that are the faces of a crack. Other coincident nodes are refused by the error that `refusal` makes
/// for the first two of them, in the order of the file, and so is a seam: a crack that parts the mesh into more pieces than it would have
/// with each place as one node.
///
/// The outer sides are given by their nodes; there are none where the cells are refused.
pub(super) fn check_coincidence<const D: usize, C: MeshCell<D>>(
    cursor: &Cursor<'_>,
    (nodes, positions): (&[Node], &[[f64; D]]),
    cells: &[C],
    sides: impl FnOnce() -> Vec<Vec<u32>>,
    refusal: impl FnOnce([&Node; 2]) -> GmshError,
) -> Result<usize, GmshError> {
    let Some(pair) = coincident_pairs(positions).next() else {
        return Ok(0);
    };
    let [first, second] = pair.map(|node| &nodes[node as usize]);
    let lowest = lowest_at_place(positions).unwrap_or_default();
    let faces = opposite_sides(sides(), &lowest);
    let mut is_on_crack = vec![false; nodes.len()];
    for node in faces.iter().flatten().flatten() {
        is_on_crack[*node as usize] = true;
    }
    let mut places = (0..).zip(&lowest).filter(|(node, lowest)| node != *lowest);
    if places.any(|(node, lowest)| !is_on_crack[node as usize] || !is_on_crack[*lowest as usize]) {
        return Err(refusal([first, second]));
    }
    let as_given: Vec<u32> = (0..nodes.len() as u32).collect();
    if n_pieces(cells, &as_given) > n_pieces(cells, &lowest) {
        return Err(GmshError::Seam {
            place: cursor.place(second.offset),
            tag: second.tag,
            other: first.tag,
            faces: faces.len(),
        });
    }
    Ok(faces.len())
}

/// Number of pieces of a mesh whose cells hold together where they have a node in common, for the node that stands for each node (n_nodes).
fn n_pieces<const D: usize, C: MeshCell<D>>(cells: &[C], stands_for: &[u32]) -> usize {
    let mut nearer: Vec<u32> = (0..stands_for.len() as u32).collect();
    let root_of = |nearer: &mut [u32], mut node: u32| {
        while nearer[node as usize] != node {
            nearer[node as usize] = nearer[nearer[node as usize] as usize];
            node = nearer[node as usize];
        }
        node
    };
    let mut roots_of = |cell: &C| {
        let corners = cell.corners().iter();
        let roots = corners.map(|&it| root_of(&mut nearer, stands_for[it as usize]));
        let roots: Vec<u32> = roots.collect();
        let lowest = roots.iter().copied().min().unwrap_or_default();
        for root in roots {
            nearer[root as usize] = lowest;
        }
        lowest
    };
    for cell in cells {
        roots_of(cell);
    }
    cells.iter().map(roots_of).collect::<BTreeSet<u32>>().len()
}
