//! Smooth outlines of planar meshes as curves.

use std::array;
use std::collections::{BTreeMap, BTreeSet};

use crate::cell::ascending;
use crate::mesh::Mesh;

/// Angle between successive edges below which the outline is straight, rad: rounded positions on a straight side give less. A circle whose
/// edges turn by less deviates from them by 1/8000 of their length.
const STRAIGHT: f64 = 1e-3;

/// Angle between successive edges from which their node is a corner of the body, rad: 40 degrees.
const CORNER: f64 = 40.0 * std::f64::consts::PI / 180.0;

/// Ratio between the angles at the ends of an edge from which the edge is straight. Evenly divided, a straight side with an arc at its end
/// has a ratio of 2 at the first edge of the arc.
const UNEVEN: f64 = 1.9;

/// An edge of a curved outline, or a part of it.
///
/// With u from 0 to 1 along the original edge of length L, the curve is off the edge by L u (1 - u) (s_a (1 - u) + s_b u). With the angle
/// alpha between tangent and edge, the slopes s = 2 tan(alpha/2) make the middle of a circle's arc exact.
#[derive(Debug, Clone, Copy)]
pub struct Piece<const D: usize> {
    /// Start of the original edge.
    start: [f64; D],
    /// Original edge from its start to its end.
    along: [f64; D],
    /// Vector as long as the original edge and normal to it, to the outside.
    across: [f64; D],
    /// Slopes at start and end of the original edge, positive where the curve is outside of it.
    slopes: [f64; 2],
    /// Parameters u at the lower and the higher node of the part.
    ends: [f64; 2],
}

impl<const D: usize> Piece<D> {
    fn parameter_of_middle(&self) -> f64 {
        0.5 * (self.ends[0] + self.ends[1])
    }

    /// Point on the curve between the ends of the part.
    pub(super) fn middle(&self) -> [f64; D] {
        let u = self.parameter_of_middle();
        let offset = u * (1.0 - u) * (self.slopes[0] * (1.0 - u) + self.slopes[1] * u);
        array::from_fn(|axis| self.start[axis] + u * self.along[axis] + offset * self.across[axis])
    }

    /// Parts from the lower and from the higher node to the middle, whose number is higher than both.
    pub(super) fn halves(&self) -> [Self; 2] {
        let middle = self.parameter_of_middle();
        self.ends.map(|end| Self {
            ends: [end, middle],
            ..*self
        })
    }
}

/// The outline at one of its nodes.
struct Turn {
    /// Nodes before and after this one.
    neighbours: [u32; 2],
    /// Angle from the edge before to the edge after the node, positive to the left.
    angle: f64,
    /// Slopes of the circle through the three nodes on the edge before and on the edge after this one.
    slopes: [f64; 2],
}

impl Turn {
    fn new(neighbours: [u32; 2], at: [[f64; 2]; 3]) -> Self {
        let [[xa, ya], [x, y], [xb, yb]] = at;
        let (before, after) = ([x - xa, y - ya], [xb - x, yb - y]);
        let dot = |u: [f64; 2], v: [f64; 2]| u[0] * v[0] + u[1] * v[1];
        let cross = before[0] * after[1] - before[1] * after[0];
        let cosine = dot(before, after);
        // The tangent of the circle has the angle alpha with an edge u, tan(alpha) = |u x v|/(v v + u v) for the other edge v.
        let slope = |other: [f64; 2]| {
            let adjacent = dot(other, other) + cosine;
            2.0 * cross / ((adjacent * adjacent + cross * cross).sqrt() + adjacent)
        };
        Self {
            neighbours,
            angle: cross.atan2(cosine),
            slopes: [slope(after), slope(before)],
        }
    }

    fn is_straight(&self) -> bool {
        self.angle.abs() < STRAIGHT
    }

    fn is_smooth(&self) -> bool {
        !self.is_straight() && self.angle.abs() < CORNER
    }
}

/// Turns at the nodes of an outline; nodes at which it touches itself are left out.
fn turns(outline: &[[u32; 2]], positions: &[[f64; 2]]) -> BTreeMap<u32, Turn> {
    let mut before = BTreeMap::new();
    let mut touching = BTreeSet::new();
    for &[from, to] in outline {
        if before.insert(to, from).is_some() {
            touching.insert(to);
        }
    }
    let after = outline.iter().filter(|[from, _]| !touching.contains(from));
    let turn = |&[node, after]: &[u32; 2]| {
        let before = *before.get(&node)?;
        let at = [before, node, after].map(|it| positions[it as usize]);
        Some((node, Turn::new([before, after], at)))
    };
    after.filter_map(turn).collect()
}

/// Edges of the outline that stand for pieces of curves, keyed by their nodes in ascending order.
///
/// An edge is curved if the outline turns to the same side at both ends, by similar angles below 40 degrees, and goes on curved: the edges
/// of a straight side and the first edge of an arc beside it stay straight. A regular polygon with 10 or more sides counts as a
/// circle; one edge alone between two arcs, tangential to both, counts as curved.
pub(super) fn curves(mesh: &Mesh) -> BTreeMap<[u32; 2], Piece<2>> {
    let outline = mesh.outline();
    let turns = turns(&outline, &mesh.positions);
    let goes_on = |node: u32| turns.get(&node).is_none_or(|turn| !turn.is_straight());
    let piece = |&[a, b]: &[u32; 2]| {
        let [from, to] = [turns.get(&a)?, turns.get(&b)?];
        let [smaller, larger] = match from.angle.abs() < to.angle.abs() {
            true => [from.angle, to.angle],
            false => [to.angle, from.angle],
        };
        let is_even = smaller * larger > 0.0 && larger.abs() < UNEVEN * smaller.abs();
        let is_curved = from.is_smooth()
            && to.is_smooth()
            && is_even
            && goes_on(from.neighbours[0])
            && goes_on(to.neighbours[1]);
        let [[xa, ya], [xb, yb]] = [a, b].map(|node| mesh.positions[node as usize]);
        let piece = Piece {
            start: [xa, ya],
            along: [xb - xa, yb - ya],
            across: [yb - ya, xa - xb],
            slopes: [from.slopes[1], to.slopes[0]],
            ends: if a < b { [0.0, 1.0] } else { [1.0, 0.0] },
        };
        is_curved.then_some((ascending([a, b]), piece))
    };
    outline.iter().filter_map(piece).collect()
}
