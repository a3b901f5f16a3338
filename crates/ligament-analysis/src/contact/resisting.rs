//! Motions that faces in contact resist: rank-one terms of the tangent stiffness.

use ligament_model::contact::ClosedPair;
use ligament_model::element::Term;
use ligament_model::held::{ACROSS_THE_WAY, held_motions};
use ligament_model::layout::Layout;
use ligament_model::surface::Vector;
use ligament_model::tensor::dot;
use serde::{Deserialize, Serialize};

/// Smallest cosine between the directions of two terms that count as equal in a factor: the directions of sliding pairs change with every
/// iterate, and matter little.
const NEAR: f64 = 0.99;

/// Smallest ratio of the stiffnesses of two terms that count as equal in a factor.
const AS_STIFF: f64 = 0.5;

/// A motion c . u that a contact resists with a stiffness k: the term k c c^T.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Resisting {
    /// Number of the contact, and which of its motions this is ([`ACROSS`] and further ones). Pairs across cracks have the numbers of their
    /// bonds, of 32 bits; integration points of surfaces have theirs, with the number of their contact from one on in the upper 32 bits.
    pub(crate) key: (u64, usize),
    /// Unit vector of the motion.
    pub(crate) way: Vector,
    /// Stiffness k, N/m.
    pub(crate) stiffness: f64,
    /// Degrees of freedom with their coefficients c.
    pub(crate) row: Vec<(usize, f64)>,
}

/// Motion across the faces.
pub(crate) const ACROSS: usize = 0;

impl Resisting {
    /// The term in the stiffness.
    pub(crate) fn term(&self) -> Term {
        (self.stiffness, self.row.clone())
    }

    /// Whether it belongs to a contact between surfaces, whose points the bonds need not couple.
    pub(crate) fn is_of_surfaces(&self) -> bool {
        self.contact().is_some()
    }

    /// Index of the contact between surfaces to which it belongs.
    pub(crate) fn contact(&self) -> Option<usize> {
        ((self.key.0 >> 32) as usize).checked_sub(1)
    }

    /// Points that the motion couples, ascending.
    pub(crate) fn points(&self, layout: Layout) -> Vec<u32> {
        let mut points: Vec<u32> = self.row.iter().map(|it| layout.point(it.0)).collect();
        points.sort_unstable();
        points.dedup();
        points
    }

    /// Whether the other term in a factor is near enough to this one.
    fn is_near(&self, other: &Self) -> bool {
        if self.key.1 != ACROSS_THE_WAY {
            return self == other;
        }
        let (one, two) = (self.stiffness, other.stiffness);
        dot(self.way, other.way).abs() >= NEAR && one.min(two) >= AS_STIFF * one.max(two)
    }
}

/// Motions that closed pairs across cracks resist.
pub(crate) fn by_faces(closed: &[ClosedPair], layout: Layout) -> Vec<Resisting> {
    let of_pair = |it: &ClosedPair| {
        let pair = &it.pair;
        let row = pair.row.iter().filter(|(_, factor)| *factor != 0.0);
        let number = u64::from(pair.number);
        let mut all = vec![Resisting {
            key: (number, ACROSS),
            way: pair.normal,
            stiffness: pair.stiffness,
            row: row.map(|&(dof, factor)| (dof as usize, factor)).collect(),
        }];
        if let Some(friction) = it.friction {
            let held = held_motions(layout, pair.normal, (friction.force, friction.share));
            all.extend(held.into_iter().map(|held| Resisting {
                key: (number, held.number),
                way: held.way,
                stiffness: held.share * pair.stiffness,
                row: pair.row_along(layout, held.way),
            }));
        }
        all
    };
    closed.iter().flat_map(of_pair).collect()
}

/// Terms to be removed from a factor, and terms to be added to it, so that it has the terms `now`. A term of the factor that is near enough
/// stays, and replaces its counterpart in `now`. Both lists are in the order of their keys.
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

    fn across_the_way(way: Vector, stiffness: f64) -> Resisting {
        Resisting {
            key: (7, ACROSS_THE_WAY),
            way,
            stiffness,
            row: vec![(0, way[0]), (1, way[1])],
        }
    }

    /// A term of a sliding pair stays in the factor until its direction or stiffness has changed; a term of a sticking pair must be the
    /// same.
    #[test]
    fn near_terms_stay_in_the_factor() {
        let old = across_the_way([1.0, 0.0, 0.0], 1.0);
        let mut now = [across_the_way([-0.998, 0.063, 0.0], 1.5)];
        let (gone, come) = changes(std::slice::from_ref(&old), &mut now);
        assert!(gone.is_empty() && come.is_empty() && now[0] == old);
        let mut now = [across_the_way([1.0, 0.0, 0.0], 0.4)];
        let (gone, come) = changes(std::slice::from_ref(&old), &mut now);
        assert_eq!((gone.len(), come.len()), (1, 1));
        let sticks = Resisting { key: (7, 1), ..old };
        let mut now = [Resisting {
            stiffness: 1.1,
            ..sticks.clone()
        }];
        assert_eq!(changes(&[sticks], &mut now).1.len(), 1);
    }
}
