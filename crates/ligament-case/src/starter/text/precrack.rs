//! An example of an initial crack, as a comment.

use super::body::{Body, size};
use super::numbers::{coordinates, exact, quantum};
use crate::starter::groups::Ends;

/// Text of `[[precrack]]`: a crack across the load, in the middle of the body.
pub(super) fn precrack<const D: usize>(body: &Body<D>, ends: &Ends<D>) -> String {
    let quantum = quantum(body);
    let across = (0..D).filter(|axis| *axis != ends.axis);
    let sizes = across.map(|axis| size(body, axis));
    let size = sizes.fold(f64::INFINITY, f64::min);
    let centre = coordinates(body, body.middle);
    match D {
        2 => {
            let length = exact(quantum.round(0.2 * size).max(quantum.step));
            let angle = ["1.5707963268", "0.0"][ends.axis];
            format!(
                "\
# A crack or slot that is there from the start: bonds across it are cut. In the place of the three keys of a straight one,
# `points = [[x, y], [x, y]]` with two corners or more.
#[[precrack]]
#centre = {centre} # m
#length = {length} # m
#angle = {angle} # rad, from the x axis, counter-clockwise; 30 degrees are 0.5235987756
"
            )
        }
        _ => {
            let radius = exact(quantum.round(0.2 * size).max(body.spacing));
            let normal = ["[1.0, 0.0, 0.0]", "[0.0, 1.0, 0.0]", "[0.0, 0.0, 1.0]"][ends.axis];
            format!(
                "\
# A crack that is there from the start: bonds through it are cut. In the place of the three keys of a disk `points` with the corners
# [x, y, z] of a plane polygon, or the `group` of a physical surface in the mesh.
#[[precrack]]
#centre = {centre} # m
#normal = {normal}
#radius = {radius} # m
"
            )
        }
    }
}
