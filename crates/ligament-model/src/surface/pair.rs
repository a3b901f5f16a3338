//! Two sides that may come into contact: which integration points touch, and the forces there.

use std::fmt::Debug;

use rayon::prelude::*;

use super::facet::{Facet, Surface};
use super::nearest::nearest_weights;
use super::rigid::RigidShape;
use super::search::Search;
use super::touch::{Touch, Vector, held_slip};
use super::{Corners, normal, tangential, weighted};
use crate::tensor::{dot, minus, norm};

/// Cosine between the outward normals of two surfaces above which they do not face each other.
const FACING: f64 = -0.1;

/// Skin of the search over the length of the longest edge of a facet.
const SKIN: f64 = 0.5;

/// Gap between neighbouring facets over the length of an edge that a contact bridges: facets of a lattice move with one cell each.
const SEAM: f64 = 0.05;

/// A time step, as contacts see it.
#[derive(Debug, Clone, Copy)]
pub struct Step<'a> {
    /// Motions before the step, shape (n_degrees_of_freedom), m and rad.
    pub before: &'a [f64],
    /// Motions after the step, shape (n_degrees_of_freedom), m and rad.
    pub now: &'a [f64],
    /// Displacement of the rigid body before and after the step, m.
    pub rigid: [Vector; 2],
}

/// Surfaces that may come into contact, without their coordinates.
pub trait SurfacePair: Debug + Send + Sync {
    /// Integration points in contact after a step, ascending, given those before it. The result does not depend on the number of threads.
    fn touches(&self, search: &mut Search, step: Step<'_>, before: &[Touch]) -> Vec<Touch>;

    /// Adds the forces and moments of contacts on the points of the body, shape (n_degrees_of_freedom), N and N m; in the order of the
    /// contacts.
    fn add_forces(&self, touches: &[Touch], forces: &mut [f64]);

    /// Degrees of freedom and coefficients c of a motion of a contact along a direction d: d . (u - u_met) = c . u with the motions u and u_met of
    /// the two surfaces there; by degree of freedom, ascending.
    fn row(&self, touch: &Touch, direction: Vector) -> Vec<(usize, f64)>;

    /// Coefficient of Coulomb's friction.
    fn friction(&self) -> f64;

    /// Length of the longest edge of a facet, m: a deeper overlap is not seen.
    fn reach(&self) -> f64;

    /// Whether numbers of integration points and facets exist, in an ascending order.
    fn can_have(&self, touches: &[Touch]) -> bool;

    /// Degrees of freedom that the contact may load, ascending.
    fn degrees_of_freedom(&self) -> Vec<u32>;

    /// Adds a diagonal matrix above the stiffness that the contact can have, shape (n_degrees_of_freedom), N/m and N m: K + this matrix
    /// bounds the frequencies of the body with its contact.
    fn add_bound(&self, sums: &mut [f64]);

    /// Sum of the stiffnesses of all integration points, N/m: what a free rigid body can feel, at most.
    fn whole_stiffness(&self) -> f64;
}

/// What the integration points of a surface may meet.
#[derive(Debug, Clone)]
pub enum Opposite<const D: usize> {
    /// Facets of other sides of the same surface.
    OtherSides,
    /// A rigid shape, and whether it is free to move.
    Rigid(RigidShape<D>, bool),
}

/// The facets of a body, and what they may meet.
#[derive(Debug, Clone)]
pub struct FacetPair<const D: usize> {
    surface: Surface<D>,
    opposite: Opposite<D>,
    friction: f64,
    /// Mean stiffness of each side, Pa/m.
    of_sides: Vec<f64>,
    /// Length of the longest edge of a facet, m.
    reach: f64,
}

/// What an integration point meets.
struct Meeting<const D: usize> {
    onto: Option<u32>,
    weights: Vector,
    normal: [f64; D],
    overlap: f64,
    /// Motion of the surface that is met in the step, m.
    carried: [f64; D],
}

/// An integration point: the place of a facet that it stands for.
#[derive(Clone, Copy)]
struct Place {
    number: u32,
    facet: usize,
    weights: Vector,
}

/// Present positions of all facets before and after a step, m.
struct Present<const D: usize> {
    before: Vec<Corners<D>>,
    now: Vec<Corners<D>>,
}

impl<const D: usize> FacetPair<D> {
    /// A surface against what its integration points may meet, with the coefficient of Coulomb's friction.
    pub fn new(surface: Surface<D>, opposite: Opposite<D>, friction: f64) -> Self {
        Self {
            of_sides: surface.mean_stiffness(),
            reach: surface.largest_length(),
            surface,
            opposite,
            friction,
        }
    }

    /// The integration point of a number: D on each facet, by Gauss's rule on a segment and that of degree two on a triangle.
    fn place(number: u32) -> Place {
        let own = if D == 2 {
            0.5 + 0.5 / 3.0_f64.sqrt()
        } else {
            2.0 / 3.0
        };
        let others = (1.0 - own) / (D - 1) as f64;
        let corner = number as usize % D;
        Place {
            number,
            facet: number as usize / D,
            weights: std::array::from_fn(|it| match it {
                _ if it == corner => own,
                _ if it < D => others,
                _ => 0.0,
            }),
        }
    }

    /// Area that an integration point of a facet stands for, m^2: both surfaces of a pair carry half of the pressure each.
    fn area(&self, facet: usize) -> f64 {
        let share = match self.opposite {
            Opposite::OtherSides => 0.5,
            Opposite::Rigid(..) => 1.0,
        };
        share * self.surface.facets[facet].area / D as f64
    }

    /// Contact stiffness of a facet against a side, Pa/m: that of both in turn, as springs in series with twice the stiffness each.
    fn stiffness(&self, facet: usize, of_other: Option<f64>) -> f64 {
        let own = self.surface.stiffness[facet];
        of_other.map_or(own, |other| 2.0 * own * other / (own + other))
    }

    fn present(&self, step: Step<'_>) -> Present<D> {
        let (layout, facets) = (self.surface.layout, &self.surface.facets);
        let moved = |motions: &[f64]| {
            let facets = facets.par_iter();
            facets.map(|it| it.moved(layout, motions)).collect()
        };
        Present {
            before: moved(step.before),
            now: moved(step.now),
        }
    }

    /// The facet that an integration point meets, among some facets: the nearest one that faces its own and that it is behind, within reach.
    fn facet_met(&self, place: Place, present: &Present<D>, near: &[u32]) -> Option<Meeting<D>> {
        let own = &present.now[place.facet];
        let position = weighted(own, &place.weights);
        let own_normal = normal(own)?;
        let mut nearest = self.reach;
        let mut met = None;
        for &facet in near {
            let corners = &present.now[facet as usize];
            let weights = nearest_weights(corners, position);
            let way = minus(position, weighted(corners, &weights));
            let distance = norm(way);
            if distance >= nearest {
                continue;
            }
            let Some(normal) = normal(corners) else {
                continue;
            };
            let gap = dot(way, normal);
            let beside = norm(tangential(way, normal));
            let seam = SEAM * self.surface.facets[facet as usize].length();
            if gap < 0.0 && beside <= seam.max(-gap) && dot(normal, own_normal) < FACING {
                nearest = distance;
                met = Some((facet, weights, normal, -gap));
            }
        }
        let (facet, weights, normal, overlap) = met?;
        let [before, now] = [&present.before, &present.now];
        let [before, now] = [before, now].map(|it| weighted(&it[facet as usize], &weights));
        Some(Meeting {
            onto: Some(facet),
            weights,
            normal,
            overlap,
            carried: minus(now, before),
        })
    }

    /// The rigid shape, where an integration point is in it and faces its surface.
    fn shape_met(
        shape: &RigidShape<D>,
        place: Place,
        present: &Present<D>,
        rigid: [Vector; 2],
    ) -> Option<Meeting<D>> {
        let own = &present.now[place.facet];
        let [before, now] = rigid.map(|it| std::array::from_fn(|axis| it[axis]));
        let position = minus(weighted(own, &place.weights), now);
        let (gap, outward) = shape.distance(position);
        let meets = gap < 0.0 && dot(outward, normal(own)?) < FACING;
        meets.then(|| Meeting {
            onto: None,
            weights: [0.0; 3],
            normal: outward,
            overlap: -gap,
            carried: minus(now, before),
        })
    }

    /// The contact of an integration point with what it meets, given the one before the step.
    ///
    /// A new contact whose overlap is deeper than the motion of the step explains begins without force.
    fn touch(
        &self,
        place: Place,
        meeting: &Meeting<D>,
        present: &Present<D>,
        before: Option<&Touch>,
    ) -> Touch {
        let &Meeting {
            normal, overlap, ..
        } = meeting;
        let [then, now] = [&present.before, &present.now];
        let [then, now] = [then, now].map(|it| weighted(&it[place.facet], &place.weights));
        let slid = minus(minus(now, then), meeting.carried);
        let unexplained = (overlap + dot(slid, normal)).max(0.0);
        let offset = before.map_or(unexplained, |it| it.offset).min(overlap);
        let held = before.map_or([0.0; D], |it| std::array::from_fn(|axis| it.slip[axis]));
        let trial = std::array::from_fn(|axis| held[axis] + slid[axis]);
        let slip = held_slip(tangential(trial, normal), self.friction, overlap - offset);
        let area = self.area(place.facet);
        let side_met = meeting.onto.map(|it| self.surface.sides[it as usize]);
        let other = side_met.map(|it| self.of_sides[it as usize]);
        Touch {
            place: place.number,
            onto: meeting.onto,
            weights: meeting.weights,
            normal: in_space(normal),
            overlap,
            offset,
            slip: in_space(slip),
            stiffness: area * self.stiffness(place.facet, other),
            area,
            is_first: side_met.is_none_or(|it| self.surface.sides[place.facet] < it),
        }
    }
}

impl<const D: usize> SurfacePair for FacetPair<D> {
    fn touches(&self, search: &mut Search, step: Step<'_>, before: &[Touch]) -> Vec<Touch> {
        let present = self.present(step);
        let at = |place: Place, meeting: Option<Meeting<D>>| {
            let known = before.binary_search_by_key(&place.number, |it| it.place);
            let known = known.ok().map(|it| &before[it]);
            Some(self.touch(place, &meeting?, &present, known))
        };
        if let Opposite::Rigid(shape, _) = &self.opposite {
            let places = (0..(D * present.now.len()) as u32).into_par_iter();
            return places
                .filter_map(|number| {
                    let place = Self::place(number);
                    at(place, Self::shape_met(shape, place, &present, step.rigid))
                })
                .collect();
        }
        let skin = SKIN * self.reach;
        if search.is_old(&present.now, skin) {
            let position = |number: u32| {
                let place = Self::place(number);
                weighted(&present.now[place.facet], &place.weights)
            };
            let sides = &self.surface.sides;
            let may_meet = |own: u32, other: u32| sides[own as usize] != sides[other as usize];
            search.renew(&present.now, &position, self.reach + skin, &may_meet);
        }
        let search = &*search;
        let places = search.places().par_iter();
        places
            .filter_map(|&(number, near)| {
                let place = Self::place(number);
                at(place, self.facet_met(place, &present, search.facets(near)))
            })
            .collect()
    }

    fn add_forces(&self, touches: &[Touch], forces: &mut [f64]) {
        let (layout, facets) = (self.surface.layout, &self.surface.facets);
        for touch in touches.iter().filter(|it| it.depth() > 0.0) {
            let force = touch.force();
            let force: [f64; D] = std::array::from_fn(|axis| force[axis]);
            let place = Self::place(touch.place);
            facets[place.facet].add_force(layout, &place.weights, force, forces);
            if let Some(onto) = touch.onto {
                let opposite = force.map(|it| -it);
                facets[onto as usize].add_force(layout, &touch.weights, opposite, forces);
            }
        }
    }

    fn row(&self, touch: &Touch, direction: Vector) -> Vec<(usize, f64)> {
        let (layout, facets) = (self.surface.layout, &self.surface.facets);
        let along: [f64; D] = std::array::from_fn(|axis| direction[axis]);
        let place = Self::place(touch.place);
        let mut row = facets[place.facet].row(layout, &place.weights, along);
        if let Some(onto) = touch.onto {
            let opposite = along.map(|it| -it);
            row.extend(facets[onto as usize].row(layout, &touch.weights, opposite));
        }
        // Corners of a facet may move with one point.
        row.sort_by_key(|(dof, _)| *dof);
        row.dedup_by(|next, sum| {
            let is_same = next.0 == sum.0;
            if is_same {
                sum.1 += next.1;
            }
            is_same
        });
        row.retain(|(_, factor)| *factor != 0.0);
        row
    }

    fn friction(&self) -> f64 {
        self.friction
    }

    fn reach(&self) -> f64 {
        self.reach
    }

    fn can_have(&self, touches: &[Touch]) -> bool {
        let n_facets = self.surface.facets.len();
        let exists = |it: &Touch| {
            let is_facet = it.onto.is_none_or(|facet| (facet as usize) < n_facets);
            (it.place as usize) < D * n_facets && is_facet
        };
        touches.iter().all(exists) && touches.is_sorted_by(|one, other| one.place < other.place)
    }

    fn degrees_of_freedom(&self) -> Vec<u32> {
        self.surface.degrees_of_freedom()
    }

    /// With (x - y)^2 <= 2 x^2 + 2 y^2 for the motions x and y of the two surfaces; an integration point of another side may act on one point
    /// alone, and as many as the own ones.
    fn add_bound(&self, sums: &mut [f64]) {
        let is_driven = matches!(self.opposite, Opposite::Rigid(_, false));
        let factor = if is_driven { 1.0 } else { 2.0 };
        let meets_facets = matches!(self.opposite, Opposite::OtherSides);
        let other = meets_facets.then(|| self.surface.largest_stiffness());
        let n_facets = self.surface.facets.len();
        let of_place = |facet: usize| factor * self.area(facet) * self.stiffness(facet, other);
        for number in 0..(D * n_facets) as u32 {
            let place = Self::place(number);
            let times = if meets_facets { 2.0 } else { 1.0 };
            let stiffness = times * of_place(place.facet);
            self.surface
                .add_bound(place.facet, &place.weights, stiffness, sums);
        }
        if !meets_facets {
            return;
        }
        let one = (0..n_facets).map(of_place).fold(0.0, f64::max);
        let mut seen = vec![false; self.surface.layout.n_points];
        for (facet, it) in self.surface.facets.iter().enumerate() {
            for (corner, point) in it.points().into_iter().enumerate() {
                if !std::mem::replace(&mut seen[point as usize], true) {
                    let weights: Vector =
                        std::array::from_fn(|it| f64::from(u8::from(it == corner)));
                    self.surface.add_bound(facet, &weights, one, sums);
                }
            }
        }
    }

    fn whole_stiffness(&self) -> f64 {
        let of_facet = |(facet, it): (usize, &Facet<D>)| it.area * self.stiffness(facet, None);
        self.surface.facets.iter().enumerate().map(of_facet).sum()
    }
}

fn in_space<const D: usize>(vector: [f64; D]) -> Vector {
    std::array::from_fn(|axis| vector.get(axis).copied().unwrap_or(0.0))
}
