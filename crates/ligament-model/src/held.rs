//! Motions along faces in contact that friction resists in a tangent.

use crate::layout::{Component, Layout};
use crate::surface::Vector;
use crate::tensor::{cross, norm};

/// Number of the first motion along faces; the motion across them is 0.
const ALONG: usize = 1;

/// Number of the motion along faces and across the direction of a sliding contact.
pub const ACROSS_THE_WAY: usize = 3;

/// Fraction of the elastic stiffness below which the resistance of a sliding contact across its direction of sliding is neglected.
const LEAST_SHARE: f64 = 1e-3;

/// A motion along faces that friction resists.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeldMotion {
    /// Number of the motion among the motions of a contact.
    pub number: usize,
    /// Unit direction.
    pub way: Vector,
    /// Share of the elastic stiffness.
    pub share: f64,
}

/// Motions along faces with a unit normal that friction resists, for its force (N) and the share of the elastic force that it holds: all where
/// the faces stick, and in space across the way where they slide under a force, since its direction turns with them.
pub fn held_motions(
    layout: Layout,
    normal: Vector,
    (force, share): (Vector, f64),
) -> Vec<HeldMotion> {
    let ways = ways_along(layout, normal);
    if share >= 1.0 {
        let numbered = (ALONG..).zip(ways);
        let held = numbered.map(|(number, way)| HeldMotion {
            number,
            way,
            share: 1.0,
        });
        return held.collect();
    }
    let size = norm(force);
    if ways.len() < 2 || size == 0.0 || share < LEAST_SHARE {
        return Vec::new();
    }
    vec![HeldMotion {
        number: ACROSS_THE_WAY,
        way: cross(normal, force.map(|it| it / size)),
        share,
    }]
}

/// Unit directions along faces with a unit normal: one in the plane, two in space.
fn ways_along(layout: Layout, normal: Vector) -> Vec<Vector> {
    if !layout.components.contains(&Component::Z) {
        return vec![[-normal[1], normal[0], 0.0]];
    }
    let mut least = 0;
    for axis in [1, 2] {
        if normal[axis].abs() < normal[least].abs() {
            least = axis;
        }
    }
    let axis = [0, 1, 2].map(|it| if it == least { 1.0 } else { 0.0 });
    let first = cross(normal, axis);
    let first = first.map(|it| it / norm(first));
    vec![first, cross(normal, first)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tensor::dot;

    /// Directions along a normal are at right angles to it and to each other.
    #[test]
    fn ways_along_a_normal_are_orthogonal() {
        let layout = Layout {
            n_points: 2,
            components: &Component::IN_SPACE,
        };
        for normal in [[1.0, 0.0, 0.0], [0.6, 0.0, -0.8], [0.48, 0.64, 0.6]] {
            let all = ways_along(layout, normal);
            for (place, one) in all.iter().enumerate() {
                assert!(dot(*one, normal).abs() < 1e-15);
                for (other_place, other) in all.iter().enumerate() {
                    let expected = f64::from(u8::from(place == other_place));
                    assert!((dot(*one, *other) - expected).abs() < 1e-15);
                }
            }
        }
    }
}
