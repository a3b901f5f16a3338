//! Checks of the nodes of a mesh.

use super::cursor::Cursor;
use super::error::GmshError;
use super::records::Node;
use crate::coincidence::{coincident_pairs, lowest_at_place};
use crate::crack::opposite_sides;
use crate::parse_options::{CoordinatePlane, ParseOptions};

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

/// Number of pairs of outer sides of cells that are the faces of a crack, where the options allow one. Other coincident nodes are refused by
/// the error that `refusal` makes for the first two of them, in the order of the file.
///
/// The outer sides are given by their nodes; there are none where the cells are refused.
pub(super) fn check_coincidence<const D: usize>(
    (cursor, options): (&Cursor<'_>, ParseOptions),
    nodes: &[Node],
    positions: &[[f64; D]],
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
    if options.allows_cracks {
        return Ok(faces.len());
    }
    Err(GmshError::CrackInMesh {
        place: cursor.place(second.offset),
        tag: second.tag,
        other: first.tag,
        faces: faces.len(),
    })
}
