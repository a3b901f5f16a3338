//! Motions that faces in contact resist: rank-one terms of the tangent stiffness.

use ligament_model::contact::ClosedPair;
use ligament_model::element::Term;
use ligament_model::layout::{Component, Layout};
use ligament_model::surface::Vector;
use ligament_model::tensor::{cross, dot, norm};

use crate::serial;

/// Least cosine between two directions, and least ratio of two stiffnesses, of terms that pass for the same in a factor: those of sliding
/// pairs change with every iterate, and matter little.
const NEAR: [f64; 2] = [0.99, 0.5];

/// Share of the elastic stiffness below which what a sliding pair resists across its way does not count.
const LEAST_SHARE: f64 = 1e-3;

/// A motion c . u that a contact resists with a stiffness k: the term k c c^T.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Resisting {
    /// Number of the contact, and which of its motions this is ([`ACROSS`] and further ones). Pairs across cracks have the numbers of their
    /// bonds, of 32 bits; integration points of surfaces have theirs, with the number of their contact from one on in the upper 32 bits.
    pub(crate) key: (u64, usize),
    /// Direction of the motion.
    pub(crate) direction: Vector,
    /// Stiffness k, N/m.
    pub(crate) stiffness: f64,
    /// Degrees of freedom with their coefficients c.
    pub(crate) row: Vec<(usize, f64)>,
}

serial!(Resisting {
    key,
    direction,
    stiffness,
    row
});

/// Motion across the faces.
pub(crate) const ACROSS: usize = 0;

/// First motion along the faces.
const ALONG: usize = 1;

/// Motion along the faces and across the way of a contact that slides.
const ACROSS_THE_WAY: usize = 3;

impl Resisting {
    /// The term in the stiffness.
    pub(crate) fn term(&self) -> Term {
        (self.stiffness, self.row.clone())
    }

    /// Whether it belongs to a contact between surfaces, whose points the bonds need not couple.
    pub(crate) fn is_of_surfaces(&self) -> bool {
        self.key.0 > u64::from(u32::MAX)
    }

    /// Points that the motion couples, ascending.
    pub(crate) fn points(&self, layout: Layout) -> Vec<u32> {
        let mut points: Vec<u32> = self.row.iter().map(|it| layout.point(it.0)).collect();
        points.sort_unstable();
        points.dedup();
        points
    }

    /// Whether a factor with the other term will do.
    fn is_near(&self, other: &Self) -> bool {
        if self.key.1 != ACROSS_THE_WAY {
            return self == other;
        }
        let [cosine, ratio] = NEAR;
        let (one, two) = (self.stiffness, other.stiffness);
        dot(self.direction, other.direction).abs() >= cosine && one.min(two) >= ratio * one.max(two)
    }
}

/// Unit directions along faces with a unit normal: one in the plane, two in space.
fn directions_along(layout: Layout, normal: Vector) -> Vec<Vector> {
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

/// Directions along faces with a normal that friction resists, with the motion of each and its share of the elastic stiffness: all where the
/// faces stick, and across the way where they slide under a force, since its direction turns with them.
pub(crate) fn held_along(
    layout: Layout,
    normal: Vector,
    (force, share): (Vector, f64),
) -> Vec<(usize, Vector, f64)> {
    let directions = directions_along(layout, normal);
    if share >= 1.0 {
        let numbered = (ALONG..).zip(directions);
        return numbered.map(|(motion, it)| (motion, it, 1.0)).collect();
    }
    let size = norm(force);
    if directions.len() < 2 || size == 0.0 || share < LEAST_SHARE {
        return Vec::new();
    }
    let across = cross(normal, force.map(|it| it / size));
    vec![(ACROSS_THE_WAY, across, share)]
}

/// What closed pairs across cracks resist.
pub(crate) fn by_faces(closed: &[ClosedPair], layout: Layout) -> Vec<Resisting> {
    let of_pair = |it: &ClosedPair| {
        let pair = &it.pair;
        let row = pair.row.iter().filter(|(_, factor)| *factor != 0.0);
        let number = u64::from(pair.number);
        let mut all = vec![Resisting {
            key: (number, ACROSS),
            direction: pair.normal,
            stiffness: pair.stiffness,
            row: row.map(|&(dof, factor)| (dof as usize, factor)).collect(),
        }];
        if let Some(rubbing) = it.rubbing {
            let along = held_along(layout, pair.normal, (rubbing.force, rubbing.share));
            all.extend(
                along
                    .into_iter()
                    .map(|(motion, direction, share)| Resisting {
                        key: (number, motion),
                        direction,
                        stiffness: share * pair.stiffness,
                        row: pair.row_along(layout, direction),
                    }),
            );
        }
        all
    };
    closed.iter().flat_map(of_pair).collect()
}

/// Terms of a list in a factor that another list lacks, and those that it has beyond them; terms that will do take the place of those in the
/// other list. Both are in the order of their keys.
pub(crate) fn changes(
    in_factor: &[Resisting],
    now: &mut [Resisting],
) -> (Vec<Resisting>, Vec<Resisting>) {
    let mut come = Vec::new();
    let mut stays = vec![false; in_factor.len()];
    for it in now {
        let place = in_factor.binary_search_by_key(&it.key, |other| other.key);
        match place {
            Ok(place) if in_factor[place].is_near(it) => {
                stays[place] = true;
                it.clone_from(&in_factor[place]);
            }
            _ => come.push(it.clone()),
        }
    }
    let gone = in_factor.iter().zip(stays).filter(|(_, stays)| !stays);
    (gone.map(|(it, _)| it.clone()).collect(), come)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn across_the_way(direction: Vector, stiffness: f64) -> Resisting {
        Resisting {
            key: (7, ACROSS_THE_WAY),
            direction,
            stiffness,
            row: vec![(0, direction[0]), (1, direction[1])],
        }
    }

    /// Directions along a normal are at right angles to it and to each other.
    #[test]
    fn directions_along_a_normal_are_orthogonal() {
        let layout = Layout {
            n_points: 2,
            components: &Component::IN_SPACE,
        };
        for normal in [[1.0, 0.0, 0.0], [0.6, 0.0, -0.8], [0.48, 0.64, 0.6]] {
            let all = directions_along(layout, normal);
            for (place, one) in all.iter().enumerate() {
                assert!(dot(*one, normal).abs() < 1e-15);
                for (other_place, other) in all.iter().enumerate() {
                    let expected = f64::from(u8::from(place == other_place));
                    assert!((dot(*one, *other) - expected).abs() < 1e-15);
                }
            }
        }
    }

    /// A term of a sliding pair stays in the factor until its direction or stiffness has changed; one of a sticking pair must be the same.
    #[test]
    fn near_terms_stay_in_the_factor() {
        let old = across_the_way([1.0, 0.0, 0.0], 1.0);
        let mut now = [across_the_way([-0.998, 0.063, 0.0], 1.5)];
        let (gone, come) = changes(std::slice::from_ref(&old), &mut now);
        assert!(gone.is_empty() && come.is_empty() && now[0] == old);
        let mut now = [across_the_way([1.0, 0.0, 0.0], 0.4)];
        let (gone, come) = changes(std::slice::from_ref(&old), &mut now);
        assert_eq!((gone.len(), come.len()), (1, 1));
        let sticks = Resisting {
            key: (7, ALONG),
            ..old
        };
        let mut now = [Resisting {
            stiffness: 1.1,
            ..sticks.clone()
        }];
        assert_eq!(changes(&[sticks], &mut now).1.len(), 1);
    }
}
