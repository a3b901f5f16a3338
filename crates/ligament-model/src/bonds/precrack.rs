//! Pre-cracks and slots: polylines that cut the bonds whose straight line they cross.
//!
//! The rule, decided with exact orientation predicates, with the ends of the polyline excluded:
//! - a point exactly on the crack counts as lying on its left side (seen along the polyline);
//! - a bond collinear with a piece of the crack survives;
//! - a bond that only touches an end of the polyline survives; one through an inner vertex, or through any vertex of a
//!   closed polyline, is cut.
//!
//! With the ends included every bond is cut that has a point in common with the polyline, whatever the point: an end of the
//! polyline or of the bond, or a part of it where the two are collinear. A point on the crack then loses all of its bonds. Bonds
//! of a lattice pass exactly through such ends, but not their rounded coordinates: what comes closer than 1e-5 of the nearest
//! distance of the bond's ends has a point in common.

use rayon::prelude::*;

use super::BondSet;
use crate::cloud::PointCloud;
use crate::shape::{meet_within, orientation};

/// A polyline that cuts bonds.
#[derive(Debug, Clone, PartialEq)]
pub struct PreCrack {
    /// Vertices in coordinates of the case, two or more, m.
    pub points: Vec<[f64; 2]>,
    /// Whether bonds that only touch the pre-crack are cut.
    pub ends: Ends,
}

/// Treatment of bonds that only touch a pre-crack.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Ends {
    /// Only bonds that pass through the pre-crack are cut.
    #[default]
    Excluded,
    /// Every bond that has a point in common with the pre-crack is cut.
    Included,
}

/// For each bond, whether a pre-crack cuts it, shape (n_bonds).
pub fn cut_bonds(cracks: &[PreCrack], bonds: &BondSet, cloud: &PointCloud) -> Vec<bool> {
    if cracks.is_empty() {
        return vec![false; bonds.len()];
    }
    let cracks: Vec<PreCrack> = cracks
        .iter()
        .map(|crack| crack.in_local_coordinates(cloud))
        .collect();
    bonds
        .ends
        .par_iter()
        .map(|&[a, b]| {
            let slack = cloud.slack_between([a, b]);
            let [a, b] = [a, b].map(|end| cloud.positions[end as usize]);
            cracks.iter().any(|crack| match crack.ends {
                Ends::Excluded => crack.cuts(a, b),
                Ends::Included => crack.meets(a, b, slack),
            })
        })
        .collect()
}

/// Unit normals of pre-cracks where they cut some bonds, from the first end to the second, shape (n_cut): of the piece that the
/// bond crosses, and where it crosses several of the one that it meets farthest from an end.
pub fn normals(cracks: &[PreCrack], cut: &[[u32; 2]], cloud: &PointCloud) -> Vec<[f64; 2]> {
    let in_cloud = |crack: &PreCrack| crack.in_local_coordinates(cloud);
    let cracks: Vec<PreCrack> = cracks.iter().map(in_cloud).collect();
    let of_bond = |ends: &[u32; 2]| {
        let [a, b] = ends.map(|end| cloud.positions[end as usize]);
        let pieces = cracks.iter().flat_map(|crack| crack.points.windows(2));
        let crossings = pieces.map(|ends| Crossing::new([ends[0], ends[1]], [a, b]));
        let best = crossings.reduce(|best, it| if it.depth > best.depth { it } else { best });
        best.map_or([1.0, 0.0], |it| it.normal)
    };
    cut.par_iter().map(of_bond).collect()
}

/// A bond and a piece of a pre-crack.
struct Crossing {
    /// Unit normal of the piece, from the first end of the bond to the second.
    normal: [f64; 2],
    /// Distance from the nearer end of the piece, over its length, to where the line of the bond meets it; negative beyond them.
    depth: f64,
}

impl Crossing {
    fn new([p, q]: [[f64; 2]; 2], [a, b]: [[f64; 2]; 2]) -> Self {
        let minus = |one: [f64; 2], other: [f64; 2]| [one[0] - other[0], one[1] - other[1]];
        let cross = |one: [f64; 2], other: [f64; 2]| one[0] * other[1] - one[1] * other[0];
        let (piece, bond) = (minus(q, p), minus(b, a));
        let side = cross(piece, bond);
        let length = piece[0].hypot(piece[1]);
        let sign = if side < 0.0 { -1.0 } else { 1.0 };
        let place = cross(minus(a, p), bond) / side;
        let depth = place.min(1.0 - place);
        Self {
            normal: [-piece[1], piece[0]].map(|component| sign * component / length),
            depth: if depth.is_nan() {
                f64::NEG_INFINITY
            } else {
                depth
            },
        }
    }
}

/// The bonds, by their ends, that cross the straight line from `start` to `end` (mesh-file coordinates), by the rule of pre-cracks,
/// and whether their first end lies on its left.
pub fn crossing_bonds(
    bonds: impl Iterator<Item = [u32; 2]>,
    cloud: &PointCloud,
    start: [f64; 2],
    end: [f64; 2],
) -> Vec<(u32, bool)> {
    let line = PreCrack {
        points: vec![start, end],
        ends: Ends::Excluded,
    }
    .in_local_coordinates(cloud);
    let position = |point: u32| cloud.positions[point as usize];
    (0..)
        .zip(bonds)
        .filter(|(_, ends)| line.cuts(position(ends[0]), position(ends[1])))
        .map(|(bond, ends)| (bond, line.starts_on_the_left(position(ends[0]))))
        .collect()
}

/// Number of bonds that the pre-cracks leave whole although an end of theirs lies exactly on the bond: where a crack begins
/// on the outline of a mesh, these are the bonds along the outline.
pub fn count_touched_bonds(
    cracks: &[PreCrack],
    bonds: &BondSet,
    cloud: &PointCloud,
    is_cut: &[bool],
) -> usize {
    if cracks.is_empty() {
        return 0;
    }
    let cracks: Vec<PreCrack> = cracks
        .iter()
        .map(|crack| crack.in_local_coordinates(cloud))
        .collect();
    let is_touched = |&[a, b]: &[u32; 2]| {
        let (a, b) = (cloud.positions[a as usize], cloud.positions[b as usize]);
        cracks.iter().any(|crack| crack.ends_on(a, b))
    };
    let whole = bonds.ends.par_iter().zip(is_cut).filter(|(_, cut)| !**cut);
    let here = whole.filter(|(ends, _)| cloud.counts(**ends) && is_touched(ends));
    cloud.total(here.count())
}

impl PreCrack {
    /// The polyline in the coordinates of the cloud.
    pub fn in_local_coordinates(&self, cloud: &PointCloud) -> Self {
        Self {
            points: self.points.iter().map(|&p| cloud.local(p)).collect(),
            ends: self.ends,
        }
    }

    /// Whether an end of the polyline lies on the bond from `a` to `b`, between its ends.
    fn ends_on(&self, a: [f64; 2], b: [f64; 2]) -> bool {
        let ends = [self.points[0], self.points[self.points.len() - 1]];
        ends.into_iter().any(|end| {
            end != a && end != b && boxes_touch(end, end, a, b) && orientation(a, b, end) == 0.0
        })
    }

    /// Whether a point lies on the left of the polyline's first piece (or on its line).
    pub fn starts_on_the_left(&self, point: [f64; 2]) -> bool {
        is_left(self.points[0], self.points[1], point)
    }

    /// Whether the polyline with its ends has a point in common with the bond from `a` to `b`, or comes no farther away than
    /// `slack` (m).
    fn meets(&self, a: [f64; 2], b: [f64; 2], slack: f64) -> bool {
        let mut pieces = self.points.windows(2);
        pieces.any(|ends| meet_within([ends[0], ends[1]], [a, b], slack))
    }

    /// Whether the polyline without its ends cuts the bond from `a` to `b` (all in the same coordinates).
    pub fn cuts(&self, a: [f64; 2], b: [f64; 2]) -> bool {
        let last = self.points.len() - 1;
        let closed = last > 1 && self.points[0] == self.points[last];
        self.points.windows(2).enumerate().any(|(piece, ends)| {
            let [p, q] = [ends[0], ends[1]];
            if !boxes_touch(p, q, a, b) || is_left(p, q, a) == is_left(p, q, b) {
                return false;
            }
            let (side_p, side_q) = (orientation(a, b, p), orientation(a, b, q));
            let touches_inner_p = side_p == 0.0 && (piece > 0 || closed);
            let touches_inner_q = side_q == 0.0 && (piece + 1 < last || closed);
            side_p * side_q < 0.0 || touches_inner_p || touches_inner_q
        })
    }
}

fn is_left(p: [f64; 2], q: [f64; 2], point: [f64; 2]) -> bool {
    orientation(p, q, point) >= 0.0
}

fn boxes_touch(p: [f64; 2], q: [f64; 2], a: [f64; 2], b: [f64; 2]) -> bool {
    (0..2).all(|axis| {
        p[axis].min(q[axis]) <= a[axis].max(b[axis]) && a[axis].min(b[axis]) <= p[axis].max(q[axis])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crack(points: &[[f64; 2]]) -> PreCrack {
        PreCrack {
            points: points.to_vec(),
            ends: Ends::Excluded,
        }
    }

    #[test]
    fn crossing_missing_and_collinear() {
        let slot = crack(&[[-1.0, 0.0], [1.0, 0.0]]);
        assert!(slot.cuts([0.3, -0.5], [0.1, 0.5]));
        assert!(slot.cuts([0.1, 0.5], [0.3, -0.5]));
        assert!(!slot.cuts([1.3, -0.5], [1.1, 0.5]));
        assert!(
            !slot.cuts([-0.5, 0.0], [0.5, 0.0]),
            "collinear bonds survive"
        );
        assert!(!slot.cuts([0.5, 0.1], [0.6, 2.0]));
    }

    #[test]
    fn a_point_on_the_crack_counts_as_left() {
        let slot = crack(&[[-1.0, 0.0], [1.0, 0.0]]);
        assert!(
            !slot.cuts([0.0, 0.0], [0.0, 1.0]),
            "left of the crack is above it"
        );
        assert!(slot.cuts([0.0, 0.0], [0.0, -1.0]));
        let reversed = crack(&[[1.0, 0.0], [-1.0, 0.0]]);
        assert!(reversed.cuts([0.0, 0.0], [0.0, 1.0]));
        assert!(!reversed.cuts([0.0, 0.0], [0.0, -1.0]));
    }

    #[test]
    fn a_touched_tip_survives_and_an_inner_vertex_cuts() {
        let straight = crack(&[[-1.0, 0.0], [0.0, 0.0]]);
        assert!(
            !straight.cuts([0.0, -1.0], [0.0, 1.0]),
            "the bond passes through the tip"
        );
        let prolonged = crack(&[[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0]]);
        assert!(prolonged.cuts([0.0, -1.0], [0.0, 1.0]));
        let corner = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
        let closed = crack(&[corner[0], corner[1], corner[2], corner[0]]);
        let (a, b) = ([0.5, -0.5], [-0.5, 0.5]);
        assert!(closed.cuts(a, b), "a closed polyline has no tip");
        assert!(!crack(&corner).cuts(a, b), "here the same vertex is a tip");
    }

    #[test]
    fn an_end_on_a_bond_is_noticed() {
        let edge = crack(&[[0.0, 0.0], [0.0, 1.0]]);
        let (a, b) = ([-1.0, 0.0], [1.0, 0.0]);
        assert!(edge.ends_on(a, b) && !edge.cuts(a, b));
        assert!(
            !edge.ends_on([0.5, 0.0], b)
                && !edge.ends_on(a, [1.0, 0.1])
                && !edge.ends_on(a, [0.0, 0.0])
        );
    }

    #[test]
    fn a_crack_with_its_ends_cuts_what_it_touches() {
        let slot = crack(&[[-1.0, 0.0], [1.0, 0.0]]);
        let tip = [1.0, 0.0];
        for (a, b, meets) in [
            ([1.0, -1.0], [1.0, 1.0], true),
            ([0.5, 1.0], [1.5, -1.0], true),
            ([1.0 + 1e-15, -1.0], [1.0 + 1e-15, 1.0], false),
            ([0.0, 0.0], [0.0, 1.0], true),
            ([0.0, 0.0], [0.0, -1.0], true),
            ([0.0, 1e-300], [0.0, 1.0], false),
            (tip, [2.0, 0.0], true),
            ([-2.0, 0.0], [2.0, 0.0], true),
            ([1.5, 0.0], [2.0, 0.0], false),
            ([-0.5, 0.0], [0.5, 0.0], true),
            ([-0.5, 0.1], [0.5, 0.1], false),
        ] {
            assert_eq!(slot.meets(a, b, 0.0), meets, "{a:?} {b:?}");
            assert_eq!(slot.meets(b, a, 0.0), meets, "{b:?} {a:?}");
        }
        let (beside, above) = ([1.0 + 1e-10, -1.0], [1.0 + 1e-10, 1.0]);
        assert!(slot.meets(beside, above, 1e-9) && !slot.meets(beside, above, 1e-11));
        assert!(slot.meets([0.3, 1e-10], [0.3, 1.0], 1e-9));
    }

    #[test]
    fn the_normal_is_that_of_the_piece_that_is_crossed() {
        let bent = [[[0.0, 0.0], [1.0, 0.0]], [[1.0, 0.0], [1.0, 2.0]]];
        let (a, b) = ([0.7, -0.2], [0.6, 0.3]);
        let [flat, upright] = bent.map(|piece| Crossing::new(piece, [a, b]));
        assert_eq!(flat.normal, [0.0, 1.0]);
        assert!((flat.depth - 0.34).abs() < 1e-12, "{}", flat.depth);
        assert!(upright.depth < 0.0);
        assert_eq!(Crossing::new(bent[0], [b, a]).normal, [-0.0, -1.0]);
        let along = Crossing::new(bent[0], [[0.2, 0.0], [0.4, 0.0]]);
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
                assert_eq!(bent.cuts(a, b), bent.cuts(b, a), "{a:?} {b:?}");
                cut += usize::from(bent.cuts(a, b));
            }
        }
        assert!(cut > 100, "the test must see cut bonds");
    }
}
