//! What surfaces moved through in a step, or into, without meeting it: more than a facet at once.
//!
//! Contact is found at the end of a step. An integration point that is deep in a rigid shape there but does not face it, or has left it on the
//! other side, is in no contact; nor is one that is farther behind a facet than the facet is long.

use rayon::prelude::*;

use super::facet_pair::{FacetPair, Opposite, Place};
use super::nearest::nearest_weights;
use super::pair::{Pose, Step};
use super::rigid::{RigidShape, turned};
use super::touch::Touch;
use super::{Corners, normal, weighted};
use crate::geometry::bounding_box;
use crate::tensor::{dot, minus, norm};

/// Part of the half-width of a rigid shape to which integration points get into it unnoticed.
const UNNOTICED: f64 = 0.5;

/// Distance of a place from a facet over the length of its longest edge, within which it lies on it.
const ON_FACET: f64 = 1e-9;

/// Divisions of the way of a step in the search for its deepest place, each into thirds: to 1e-7 of the way.
const DIVISIONS: usize = 40;

/// A place where surfaces moved through each other, or into each other, without contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Missed {
    /// Point of the body there.
    pub point: u32,
    /// Way of the surfaces against each other in the step, m.
    pub way: f64,
    /// Way in a step that contact is sure to see, m.
    pub seen: f64,
}

/// An integration point in a step.
struct Passing<const D: usize> {
    place: Place,
    /// Position after the step, m.
    now: [f64; D],
    /// Motion in the step, m.
    way: [f64; D],
}

/// A facet in a step.
struct Passed<const D: usize> {
    number: u32,
    /// Corners after the step, m.
    now: Corners<D>,
    /// Mean motion in the step, m.
    way: [f64; D],
}

impl<const D: usize> FacetPair<D> {
    /// Way of the surfaces against each other in a step that contact is sure to see, m.
    pub(super) fn largest_way_seen(&self) -> f64 {
        match &self.opposite {
            Opposite::Rigid(shape, _) => self.reach.min(UNNOTICED * shape.half_width()),
            Opposite::OtherSides | Opposite::Unbonded => self.reach,
        }
    }

    /// The first integration point of the outline that moved through what it may meet in a step or into it, but is not in contact after it.
    pub(super) fn first_missed(&self, step: Step<'_>, touches: &[Touch]) -> Option<Missed> {
        let is_free = |number: u32| {
            touches
                .binary_search_by_key(&number, |it| it.place)
                .is_err()
        };
        let facets = self.moved(step);
        let of_facet = |it: &Passed<D>| {
            let first = D as u32 * it.number;
            (0..D as u32).map(move |corner| first + corner)
        };
        let free = facets.iter().flat_map(of_facet).filter(|it| is_free(*it));
        let places: Vec<Passing<D>> = free.map(|it| self.passing(it, step)).collect();
        let found = match &self.opposite {
            Opposite::Rigid(shape, _) => {
                let into = |it: &Passing<D>| self.way_into(shape, it, step.rigid);
                let deep = places.iter().find_map(|it| Some((it.place, into(it)?)));
                let has_contact = |it: &&Passed<D>| {
                    (0..D as u32).any(|corner| !is_free(D as u32 * it.number + corner))
                };
                let others = facets.iter().filter(|it| !has_contact(it));
                deep.or_else(|| self.swallowed(shape, others, step.rigid))
            }
            Opposite::OtherSides if self.move_as_one(&facets, &places) => None,
            Opposite::OtherSides => {
                let through = |it: &Passing<D>| Some((it.place, self.way_through(it, &facets)?));
                places.par_iter().find_map_first(through)
            }
            Opposite::Unbonded => None,
        };
        let (place, way) = found?;
        Some(Missed {
            point: self.surface.facet(place.facet).corners[0].point,
            way,
            seen: self.largest_way_seen(),
        })
    }

    /// Whether no integration point moves far against a facet.
    fn move_as_one(&self, facets: &[Passed<D>], places: &[Passing<D>]) -> bool {
        let ways = facets.iter().map(|it| it.way);
        let [low, high] = bounding_box(ways.chain(places.iter().map(|it| it.way)));
        norm(minus(high, low)) <= self.reach
    }

    /// Facets of the outline in a step.
    fn moved(&self, step: Step<'_>) -> Vec<Passed<D>> {
        let layout = self.surface.layout;
        let of_facet = |number: usize| {
            let facet = self.surface.facet(number);
            let [before, now] = [step.before, step.now].map(|it| facet.moved(layout, it));
            let even = [1.0 / D as f64; D];
            Passed {
                number: number as u32,
                way: minus(weighted(&now, &even), weighted(&before, &even)),
                now,
            }
        };
        (0..self.surface.facets.len()).map(of_facet).collect()
    }

    fn passing(&self, number: u32, step: Step<'_>) -> Passing<D> {
        let place = Self::place(number);
        let facet = self.surface.facet(place.facet);
        let at = |motions| {
            let corners = facet.moved(self.surface.layout, motions);
            weighted(&corners, &place.weights)
        };
        let now = at(step.now);
        Passing {
            place,
            way: minus(now, at(step.before)),
            now,
        }
    }

    /// Length of the way of an integration point against a rigid shape, m, if it leads deep into the shape.
    fn way_into(
        &self,
        shape: &RigidShape<D>,
        passing: &Passing<D>,
        rigid: [Pose; 2],
    ) -> Option<f64> {
        let way = minus(passing.way, carried(rigid));
        let length = norm(way);
        if length <= self.largest_way_seen() {
            return None;
        }
        let distance = |part: f64| {
            let back: [f64; D] = std::array::from_fn(|axis| passing.now[axis] - part * way[axis]);
            distance_from(shape, back, rigid[1])
        };
        // The distance from a convex shape is a convex function along a line.
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..DIVISIONS {
            let third = (high - low) / 3.0;
            if distance(low + third) < distance(high - third) {
                high -= third;
            } else {
                low += third;
            }
        }
        let least = distance(0.5 * (low + high)).min(distance(0.0));
        (least < -self.largest_way_seen()).then_some(length)
    }

    /// A facet without contact through which the middle of a shape that fits between integration points moved, and the length of its way, m.
    fn swallowed<'a>(
        &self,
        shape: &RigidShape<D>,
        mut facets: impl Iterator<Item = &'a Passed<D>>,
        rigid: [Pose; 2],
    ) -> Option<(Place, f64)> {
        if UNNOTICED * shape.half_width() >= self.reach {
            return None;
        }
        let middle = shape.middle();
        let end = std::array::from_fn(|axis| middle[axis] + rigid[1].displacement[axis]);
        let facet = facets.find(|it| {
            let way = minus(carried(rigid), it.way);
            passes(&it.now, minus(end, way), end)
        })?;
        let way = norm(minus(carried(rigid), facet.way));
        Some((Self::place(D as u32 * facet.number), way))
    }

    /// Length of the way of an integration point against a facet of another side that it moved through from outside, m.
    fn way_through(&self, passing: &Passing<D>, facets: &[Passed<D>]) -> Option<f64> {
        let own = passing.place.facet as u32;
        facets.iter().find_map(|it| {
            let way = minus(passing.way, it.way);
            let goes_far = dot(way, way) > self.reach * self.reach;
            let is_through = goes_far
                && self.may_meet(own, it.number)
                && passes(&it.now, minus(passing.now, way), passing.now);
            is_through.then(|| norm(way))
        })
    }
}

/// Displacement of a rigid body in a step, m.
fn carried<const D: usize>([before, now]: [Pose; 2]) -> [f64; D] {
    std::array::from_fn(|axis| now.displacement[axis] - before.displacement[axis])
}

/// Signed distance of a position from a shape in a place, m.
pub(super) fn distance_from<const D: usize>(
    shape: &RigidShape<D>,
    position: [f64; D],
    pose: Pose,
) -> f64 {
    let still: [f64; D] = std::array::from_fn(|axis| position[axis] - pose.displacement[axis]);
    let arm = minus(still, shape.middle());
    // Of the shapes in space only spheres turn.
    let angle = if D == 2 { pose.rotation } else { [0.0; 3] };
    let back = turned(arm, angle.map(|it| -it));
    let unturned = std::array::from_fn(|axis| shape.middle()[axis] + back[axis]);
    shape.distance(unturned).0
}

/// Whether a straight way leads through a facet from its outer side.
fn passes<const D: usize>(corners: &Corners<D>, from: [f64; D], to: [f64; D]) -> bool {
    let Some(normal) = normal(corners) else {
        return false;
    };
    let height = |it: [f64; D]| dot(minus(it, corners[0]), normal);
    let (start, end) = (height(from), height(to));
    if !(start >= 0.0 && end < 0.0) {
        return false;
    }
    let part = start / (start - end);
    let at: [f64; D] = std::array::from_fn(|axis| from[axis] + part * (to[axis] - from[axis]));
    let nearest = weighted(corners, &nearest_weights(corners, at));
    let edge = norm(minus(corners[1], corners[0]));
    norm(minus(at, nearest)) <= ON_FACET * edge
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ways through a segment and a triangle, beside them, and out of the body.
    #[test]
    fn ways_through_a_facet_come_from_outside() {
        // The body is on the left of a segment: below this one.
        let segment = [[1.0, 0.0], [0.0, 0.0]];
        assert!(passes(&segment, [0.2, 3.0], [0.4, -5.0]));
        assert!(!passes(&segment, [0.4, -5.0], [0.2, 3.0]));
        assert!(!passes(&segment, [1.2, 3.0], [1.2, -5.0]));
        assert!(!passes(&segment, [0.2, 3.0], [0.4, 0.5]));
        let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert!(passes(&triangle, [0.2, 0.2, 2.0], [0.3, 0.3, -7.0]));
        assert!(!passes(&triangle, [0.8, 0.8, 2.0], [0.8, 0.8, -7.0]));
    }
}
