//! Pre-cracks in the plane: polylines.

use super::{Crossing, Cut, Ends};
use crate::cloud::PointCloud;
use crate::geometry::{bounding_box, boxes_meet, distance_to};
use crate::predicates::{meet, orientation};
use crate::tensor::minus;

/// A polyline that cuts bonds.
#[derive(Debug, Clone, PartialEq)]
pub struct PreCrack {
    /// Vertices in coordinates of the case, two or more, m.
    pub points: Vec<[f64; 2]>,
    /// Whether bonds that only touch the pre-crack are cut.
    pub ends: Ends,
}

/// Bonds, given by their ends, that cross the straight line from `start` to `end` (mesh-file coordinates), by the rule of pre-cracks; the
/// flag is true where the first end lies on the left of the line.
pub fn crossing_bonds(
    bonds: impl Iterator<Item = [u32; 2]>,
    cloud: &PointCloud,
    start: [f64; 2],
    end: [f64; 2],
) -> Vec<(u32, bool)> {
    let line = PreCrack {
        points: vec![cloud.local(start), cloud.local(end)],
        ends: Ends::Excluded,
    };
    let position = |end: u32| cloud.positions[end as usize];
    (0..)
        .zip(bonds)
        .filter(|(_, ends)| line.cuts(0, ends.map(position), 0.0))
        .map(|(bond, ends)| (bond, is_left(line.piece(0), position(ends[0]))))
        .collect()
}

impl PreCrack {
    fn piece(&self, piece: u32) -> [[f64; 2]; 2] {
        [0, 1].map(|end| self.points[piece as usize + end])
    }

    /// Whether each end of a piece is an inner vertex of the polyline.
    fn is_inner(&self, piece: u32) -> [bool; 2] {
        let last = self.points.len() - 1;
        let is_closed = last > 1 && self.points[0] == self.points[last];
        [piece > 0, piece as usize + 1 < last].map(|is_inner| is_inner || is_closed)
    }
}

impl Cut<2> for PreCrack {
    fn moved(&self, by: impl Fn([f64; 2]) -> [f64; 2]) -> Self {
        Self {
            points: self.points.iter().map(|&point| by(point)).collect(),
            ends: self.ends,
        }
    }

    fn n_pieces(&self) -> u32 {
        self.points.len() as u32 - 1
    }

    fn bounds(&self, piece: u32) -> [[f64; 2]; 2] {
        bounding_box(self.piece(piece))
    }

    fn cuts(&self, piece: u32, bond: [[f64; 2]; 2], slack: f64) -> bool {
        let line = self.piece(piece);
        let [a, b] = bond;
        if self.ends == Ends::Included {
            return meet_within(line, bond, slack);
        }
        if !boxes_meet(bounding_box(line), bounding_box(bond))
            || is_left(line, a) == is_left(line, b)
        {
            return false;
        }
        if self.touches(piece, bond, slack) {
            return false;
        }
        let sides = line.map(|end| orientation(a, b, end));
        let mut inner = sides.iter().zip(self.is_inner(piece));
        sides[0] * sides[1] < 0.0 || inner.any(|(side, is_inner)| *side == 0.0 && is_inner)
    }

    /// Whether a bond passes through an end of the crack: within the slack, because places that are the same in the case differ by rounding.
    fn touches(&self, piece: u32, bond: [[f64; 2]; 2], slack: f64) -> bool {
        let is_on = |end| match slack > 0.0 {
            true => distance_to(bond, end) <= slack,
            false => {
                boxes_meet([end; 2], bounding_box(bond))
                    && orientation(bond[0], bond[1], end) == 0.0
            }
        };
        let mut ends = self.piece(piece).into_iter().zip(self.is_inner(piece));
        ends.any(|(end, is_inner)| !is_inner && !bond.contains(&end) && is_on(end))
    }

    fn crossing(&self, piece: u32, [a, b]: [[f64; 2]; 2]) -> Crossing<2> {
        let [p, q] = self.piece(piece);
        let cross = |one: [f64; 2], other: [f64; 2]| one[0] * other[1] - one[1] * other[0];
        let (way, bond) = (minus(q, p), minus(b, a));
        let side = cross(way, bond);
        let sign = if side < 0.0 { -1.0 } else { 1.0 };
        let length = way[0].hypot(way[1]);
        let place = cross(minus(a, p), bond) / side;
        let depth = place.min(1.0 - place);
        Crossing {
            normal: [-way[1], way[0]].map(|component| sign * component / length),
            depth: if depth.is_nan() {
                f64::NEG_INFINITY
            } else {
                depth
            },
        }
    }
}

/// Whether two segments have a point in common, or come within `slack` (m) of each other.
fn meet_within(one: [[f64; 2]; 2], other: [[f64; 2]; 2], slack: f64) -> bool {
    // Disjoint segments are nearest to each other at an end of one of them.
    let is_near = |line, ends: [_; 2]| ends.into_iter().any(|it| distance_to(line, it) <= slack);
    meet(one, other) || is_near(one, other) || is_near(other, one)
}

/// Whether a point lies on the left of a line or on it.
fn is_left([p, q]: [[f64; 2]; 2], point: [f64; 2]) -> bool {
    orientation(p, q, point) >= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    type Bond = [[f64; 2]; 2];

    fn crack(points: &[[f64; 2]]) -> PreCrack {
        PreCrack {
            points: points.to_vec(),
            ends: Ends::Excluded,
        }
    }

    fn cuts(crack: &PreCrack, bond: Bond) -> bool {
        (0..crack.n_pieces()).any(|piece| crack.cuts(piece, bond, 0.0))
    }

    /// Whether the crack with its ends cuts a bond.
    fn meets(crack: &PreCrack, bond: Bond, slack: f64) -> bool {
        let ends = Ends::Included;
        let with_ends = PreCrack {
            ends,
            ..crack.clone()
        };
        (0..crack.n_pieces()).any(|piece| with_ends.cuts(piece, bond, slack))
    }

    #[test]
    fn crossing_missing_and_collinear() {
        let slot = crack(&[[-1.0, 0.0], [1.0, 0.0]]);
        assert!(cuts(&slot, [[0.3, -0.5], [0.1, 0.5]]));
        assert!(cuts(&slot, [[0.1, 0.5], [0.3, -0.5]]));
        assert!(!cuts(&slot, [[1.3, -0.5], [1.1, 0.5]]));
        assert!(
            !cuts(&slot, [[-0.5, 0.0], [0.5, 0.0]]),
            "collinear bonds survive"
        );
        assert!(!cuts(&slot, [[0.5, 0.1], [0.6, 2.0]]));
    }

    #[test]
    fn a_point_on_the_crack_counts_as_left() {
        let slot = crack(&[[-1.0, 0.0], [1.0, 0.0]]);
        assert!(
            !cuts(&slot, [[0.0, 0.0], [0.0, 1.0]]),
            "left of the crack is above it"
        );
        assert!(cuts(&slot, [[0.0, 0.0], [0.0, -1.0]]));
        let reversed = crack(&[[1.0, 0.0], [-1.0, 0.0]]);
        assert!(cuts(&reversed, [[0.0, 0.0], [0.0, 1.0]]));
        assert!(!cuts(&reversed, [[0.0, 0.0], [0.0, -1.0]]));
    }

    #[test]
    fn a_touched_tip_survives_and_an_inner_vertex_cuts() {
        let straight = crack(&[[-1.0, 0.0], [0.0, 0.0]]);
        assert!(
            !cuts(&straight, [[0.0, -1.0], [0.0, 1.0]]),
            "the bond passes through the tip"
        );
        let prolonged = crack(&[[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0]]);
        assert!(cuts(&prolonged, [[0.0, -1.0], [0.0, 1.0]]));
        let corner = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
        let closed = crack(&[corner[0], corner[1], corner[2], corner[0]]);
        let (a, b) = ([0.5, -0.5], [-0.5, 0.5]);
        assert!(cuts(&closed, [a, b]), "a closed polyline has no tip");
        assert!(
            !cuts(&crack(&corner), [a, b]),
            "here the same vertex is a tip"
        );
    }

    #[test]
    fn an_end_on_a_bond_is_noticed() {
        let edge = crack(&[[0.0, 0.0], [0.0, 1.0]]);
        let (a, b) = ([-1.0, 0.0], [1.0, 0.0]);
        let touches = |a, b| edge.touches(0, [a, b], 0.0);
        assert!(touches(a, b) && !cuts(&edge, [a, b]));
        assert!(!touches([0.5, 0.0], b) && !touches(a, [1.0, 0.1]) && !touches(a, [0.0; 2]));
    }

    #[test]
    fn a_crack_with_its_ends_cuts_what_it_touches() {
        let slot = crack(&[[-1.0, 0.0], [1.0, 0.0]]);
        let tip = [1.0, 0.0];
        for (a, b, expected) in [
            ([1.0, -1.0], [1.0, 1.0], true),
            ([0.5, 1.0], [1.5, -1.0], true),
            ([1.0 + 1e-15, -1.0], [1.0 + 1e-15, 1.0], false),
            ([0.0, 0.0], [0.0, 1.0], true),
            ([0.0, 0.0], [0.0, -1.0], true),
            ([0.0, 1e-150], [0.0, 1.0], false),
            (tip, [2.0, 0.0], true),
            ([-2.0, 0.0], [2.0, 0.0], true),
            ([1.5, 0.0], [2.0, 0.0], false),
            ([-0.5, 0.0], [0.5, 0.0], true),
            ([-0.5, 0.1], [0.5, 0.1], false),
        ] {
            assert_eq!(meets(&slot, [a, b], 0.0), expected, "{a:?} {b:?}");
            assert_eq!(meets(&slot, [b, a], 0.0), expected, "{b:?} {a:?}");
        }
        let (beside, above) = ([1.0 + 1e-10, -1.0], [1.0 + 1e-10, 1.0]);
        assert!(meets(&slot, [beside, above], 1e-9) && !meets(&slot, [beside, above], 1e-11));
        assert!(meets(&slot, [[0.3, 1e-10], [0.3, 1.0]], 1e-9));
    }

    #[test]
    fn the_normal_is_that_of_the_piece_that_is_crossed() {
        let bent = crack(&[[0.0, 0.0], [1.0, 0.0], [1.0, 2.0]]);
        let (a, b) = ([0.7, -0.2], [0.6, 0.3]);
        let [flat, upright] = [0, 1].map(|piece| bent.crossing(piece, [a, b]));
        assert_eq!(flat.normal, [0.0, 1.0]);
        assert!((flat.depth - 0.34).abs() < 1e-12, "{}", flat.depth);
        assert!(upright.depth < 0.0);
        assert_eq!(bent.crossing(0, [b, a]).normal, [-0.0, -1.0]);
        let along = bent.crossing(0, [[0.2, 0.0], [0.4, 0.0]]);
        assert_eq!(along.depth, f64::NEG_INFINITY);
    }

    #[test]
    fn the_order_of_the_ends_does_not_matter() {
        let bent = crack(&[[-1.0, -0.2], [0.1, 0.0], [1.0, 0.7]]);
        let grid: Vec<[f64; 2]> = (-6..=6)
            .flat_map(|i| (-6..=6).map(move |j| [i as f64 / 5.0, j as f64 / 5.0]))
            .collect();
        let mut cut = 0;
        for &a in &grid {
            for &b in &grid {
                assert_eq!(cuts(&bent, [a, b]), cuts(&bent, [b, a]), "{a:?} {b:?}");
                cut += usize::from(cuts(&bent, [a, b]));
            }
        }
        assert!(cut > 100, "the test must see cut bonds");
    }
}
