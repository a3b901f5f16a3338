//! Two sides that may come into contact: which integration points touch, and the forces there.

use rayon::prelude::*;

use super::cells::Bonded;
use super::facet::{Facet, Surface};
use super::nearest::nearest_weights;
use super::pair::{Missed, Pose, Step, SurfacePair};
use super::rigid::{RigidShape, in_space, rotated};
use super::search::{Search, Sought};
use super::touch::{Touch, Vector, held_slip};
use super::{Corners, extent, normal, tangential, weighted};
use crate::geometry::bounding_box;
use crate::parallel;
use crate::tensor::{cross, dot, minus, norm};

/// Cosine between the outward normals of two surfaces above which they do not face each other.
const FACING: f64 = -0.1;

/// Skin of the search over the length of the longest edge of a facet.
const SKIN: f64 = 0.5;

/// Gap between neighbouring facets over the length of an edge that a contact bridges: facets of a lattice move with one cell each.
const SEAM: f64 = 0.05;

/// Depth, as a fraction of the half-width of a rigid shape, up to which contact may miss an integration point.
const UNNOTICED: f64 = 0.5;

/// Distance from a facet over its longest edge below which a position lies on it.
const ON_FACET: f64 = 1e-9;

/// Relative rounding of a distance from the plane of a facet, generously.
const ROUNDING: f64 = 1e-9;

/// Number of divisions, each into thirds, in the search along the path of a step for its deepest point: to 1e-7 of the path.
const DIVISIONS: usize = 40;

/// Possible contact partner of the integration points of a surface.
#[derive(Debug, Clone)]
pub enum Opposite<const D: usize> {
    /// Facets of other sides of the same surface.
    OtherSides,
    /// Facets of the same surface whose points no unbroken bond connects with the point of the integration point; each facet moves with one point.
    Unbonded,
    /// A rigid shape, and whether it is free to move.
    Rigid(RigidShape<D>, bool),
}

/// The facets of a body with their possible contact partner.
#[derive(Debug, Clone)]
pub struct FacetPair<const D: usize> {
    pub(super) surface: Surface<D>,
    pub(super) opposite: Opposite<D>,
    pub(super) friction: f64,
    /// Mean stiffness of each side, Pa/m.
    of_sides: Vec<f64>,
    /// Length of the longest edge of a facet, m.
    pub(super) reach: f64,
}

/// The contact partner of an integration point in a state.
struct ContactPartner<const D: usize> {
    onto: Option<u32>,
    weights: Vector,
    normal: [f64; D],
    overlap: f64,
    /// Vector from the middle of a rigid body to the contact, m.
    arm: Vector,
    /// Motion of the contact partner in the step, m.
    carried: [f64; D],
}

/// An integration point of a facet.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub(super) number: u32,
    /// Number of the facet.
    pub(super) facet: usize,
    pub(super) weights: Vector,
}

/// Present facets of a surface, by their indices in the search.
struct Present<'a, const D: usize> {
    /// Numbers of the facets.
    numbers: &'a [u32],
    /// Positions before the step, m.
    before: Vec<Corners<D>>,
    /// Positions after the step, m.
    now: Vec<Corners<D>>,
    /// Outward normals; `None` for a facet without area.
    normals: Vec<Option<[f64; D]>>,
    /// Largest distances of a corner from the first one, m.
    extents: Vec<f64>,
    /// Gap below which an integration point is in contact, m.
    within: f64,
}

impl<const D: usize> FacetPair<D> {
    /// A surface with the contact partner of its integration points and the coefficient of Coulomb's friction.
    pub fn new(surface: Surface<D>, opposite: Opposite<D>, friction: f64) -> Self {
        Self {
            of_sides: surface.mean_stiffness(),
            reach: surface.largest_length(),
            surface,
            opposite,
            friction,
        }
    }

    /// The integration point with a given number: D on each facet, by Gauss's rule on a segment and the rule of degree two on a triangle.
    pub(super) fn place(number: u32) -> Place {
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
    pub(super) fn area(&self, facet: &Facet<D>) -> f64 {
        let share = match self.opposite {
            Opposite::OtherSides | Opposite::Unbonded => 0.5,
            Opposite::Rigid(..) => 1.0,
        };
        share * facet.area / D as f64
    }

    /// Number and contact stiffness (Pa/m) of the side of a facet that belongs to the surface.
    fn side(&self, facet: usize) -> (u32, f64) {
        let known = self.surface.side_and_stiffness(facet);
        known.expect("facets that join belong to the surface")
    }

    /// Contact stiffness of a facet against a side, Pa/m: two springs in series, each with twice the stiffness of its side.
    pub(super) fn stiffness(&self, facet: usize, of_other: Option<f64>) -> f64 {
        let own = self.side(facet).1;
        of_other.map_or(own, |other| 2.0 * own * other / (own + other))
    }

    fn present<'a>(&self, numbers: &'a [u32], step: Step<'_>, within: f64) -> Present<'a, D> {
        let surface = &self.surface;
        let moved = |motions: &[f64]| -> Vec<Corners<D>> {
            parallel::values(numbers.len(), [[0.0; D]; D], |place| {
                let facet = surface.facet(numbers[place] as usize);
                facet.moved(surface.layout, motions)
            })
        };
        let now = moved(step.now);
        Present {
            numbers,
            before: moved(step.before),
            normals: now.iter().map(normal).collect(),
            extents: now.iter().map(extent).collect(),
            now,
            within,
        }
    }

    /// Facets among those at some places that the facet at a place faces, with their places and normals.
    fn facing(at: usize, present: &Present<'_, D>, near: &[u32]) -> Vec<(usize, [f64; D])> {
        let Some(own_normal) = present.normals[at] else {
            return Vec::new();
        };
        let with_normal = |&other: &u32| {
            let other = other as usize;
            present.normals[other].map(|normal| (other, normal))
        };
        let is_turned_away = |(_, normal): &(usize, [f64; D])| dot(*normal, own_normal) >= FACING;
        let all = near.iter().filter_map(with_normal);
        all.filter(|it| !is_turned_away(it)).collect()
    }

    /// Whether contact between two facets of the surface is possible.
    pub(super) fn may_meet(&self, own: u32, other: u32) -> bool {
        let of_cells = |it: u32| self.surface.facet(it as usize).corners[0].point;
        match self.opposite {
            Opposite::OtherSides => self.side(own as usize).0 != self.side(other as usize).0,
            Opposite::Unbonded => of_cells(own) != of_cells(other),
            Opposite::Rigid(..) => false,
        }
    }

    /// Largest overlap with a facet that counts, m, and the distance beside it: where all facets move with one point each, an integration
    /// point that is farther behind than both points met another face.
    fn limits(&self, own: &Facet<D>, met: &Facet<D>, overlap: f64) -> [f64; 2] {
        let seam = SEAM * met.length();
        match self.surface.cracks {
            None => [f64::INFINITY, seam.max(overlap)],
            Some(_) => [(own.depth() + met.depth()).max(0.5 * self.reach), seam],
        }
    }

    /// The facet that an integration point of the facet at a place meets, among those that this one [faces](Self::facing): the nearest one within
    /// reach, if the gap to it is less than the largest one. A facet behind it is not met, however deep the overlap.
    fn facet_met(
        &self,
        (at, place): (usize, Place),
        present: &Present<'_, D>,
        facing: &[(usize, [f64; D])],
        bonds: Bonded<'_>,
    ) -> Option<ContactPartner<D>> {
        let position = weighted(&present.now[at], &place.weights);
        let mut nearest = self.reach.max(present.within);
        let mut met = None;
        for &(other, normal) in facing {
            let corners = &present.now[other];
            // No place of a facet is nearer than its plane, nor than the sphere around it, up to rounding.
            let from_first = minus(position, corners[0]);
            let height = dot(from_first, normal);
            let farthest = (nearest + present.extents[other]) * (1.0 + ROUNDING);
            if height.abs() > nearest * (1.0 + ROUNDING)
                || dot(from_first, from_first) > farthest * farthest
            {
                continue;
            }
            let weights = nearest_weights(corners, position);
            let way = minus(position, weighted(corners, &weights));
            let distance = norm(way);
            let gap = dot(way, normal);
            if distance >= nearest {
                continue;
            }
            let beside = norm(tangential(way, normal));
            let number = present.numbers[other] as usize;
            let [own, facet] = [place.facet, number].map(|it| self.surface.facet(it));
            let [deepest, aside] = self.limits(&own, &facet, -gap);
            let [one, another] = [own, facet].map(|it| it.corners[0].point);
            let is_free =
                || !(matches!(self.opposite, Opposite::Unbonded) && bonds.joins(one, another));
            if beside <= aside && -gap < deepest && is_free() {
                nearest = distance;
                met = Some((other, weights, normal, -gap));
            }
        }
        let (other, weights, normal, overlap) = met.filter(|it| it.3 > -present.within)?;
        let [before, now] = [&present.before, &present.now];
        let [before, now] = [before, now].map(|it| weighted(&it[other], &weights));
        Some(ContactPartner {
            onto: Some(present.numbers[other]),
            weights,
            normal,
            overlap,
            arm: [0.0; 3],
            carried: minus(now, before),
        })
    }

    /// Contact with the rigid shape, if the gap of the integration point is small enough.
    fn shape_met(
        shape: &RigidShape<D>,
        (at, place): (usize, Place),
        present: &Present<'_, D>,
        rigid: [Pose; 2],
    ) -> Option<ContactPartner<D>> {
        let own = &present.now[at];
        let [before, now] = rigid.map(|it| std::array::from_fn(|axis| it.displacement[axis]));
        let mut position = minus(weighted(own, &place.weights), now);
        let arm = minus(position, shape.middle());
        let step: Vector = minus(rigid[1].rotation, rigid[0].rotation);
        let carried = minus(arm, rotated(arm, step.map(|it| -it)));
        // Of the shapes in space only spheres turn.
        let angle = if D == 2 { rigid[1].rotation } else { [0.0; 3] };
        if angle != [0.0; 3] {
            let back = rotated(arm, angle.map(|it| -it));
            position = std::array::from_fn(|axis| shape.middle()[axis] + back[axis]);
        }
        let (gap, outward) = shape.distance(position);
        let outward = rotated(outward, angle);
        let meets = gap < present.within && dot(outward, present.normals[at]?) < FACING;
        meets.then(|| ContactPartner {
            onto: None,
            weights: [0.0; 3],
            normal: outward,
            overlap: -gap,
            arm: in_space(arm),
            carried: std::array::from_fn(|axis| now[axis] - before[axis] + carried[axis]),
        })
    }

    /// Contact of an integration point with its partner, from the contact before the step.
    ///
    /// A new contact whose overlap is deeper than the motion of the step explains begins without force.
    fn touch(
        &self,
        (at, place): (usize, Place),
        partner: &ContactPartner<D>,
        present: &Present<'_, D>,
        before: Option<&Touch>,
    ) -> Touch {
        let &ContactPartner {
            normal, overlap, ..
        } = partner;
        let [then, now] = [&present.before, &present.now];
        let [then, now] = [then, now].map(|it| weighted(&it[at], &place.weights));
        let slid = minus(minus(now, then), partner.carried);
        let unexplained = (overlap + dot(slid, normal)).max(0.0);
        let offset = before.map_or(unexplained, |it| it.offset).min(overlap);
        let held = before.map_or([0.0; D], |it| std::array::from_fn(|axis| it.slip[axis]));
        let trial = std::array::from_fn(|axis| held[axis] + slid[axis]);
        let slip = held_slip(tangential(trial, normal), self.friction, overlap - offset);
        let area = self.area(&self.surface.facet(place.facet));
        let side_met = partner.onto.map(|it| self.side(it as usize).0);
        let other = side_met.map(|it| self.of_sides[it as usize]);
        Touch {
            place: place.number,
            onto: partner.onto,
            weights: partner.weights,
            arm: partner.arm,
            normal: in_space(normal),
            overlap,
            offset,
            slip: in_space(slip),
            stiffness: area * self.stiffness(place.facet, other),
            credit: before.map_or(0.0, |it| it.credit),
            area,
            is_first: partner
                .onto
                .is_none_or(|it| self.is_first(place.facet, it as usize)),
        }
    }
}

impl<const D: usize> FacetPair<D> {
    /// Integration points in contact, with less than a gap (m), after a step, ascending, from the contacts before it.
    pub(super) fn contacts_within(
        &self,
        search: &mut Search,
        step: Step<'_>,
        before: &[Touch],
        within: f64,
    ) -> Vec<Touch> {
        let facets = search.facets().to_vec();
        let present = self.present(&facets, step, within);
        let known = |place: Place| {
            let known = before.binary_search_by_key(&place.number, |it| it.place);
            known.ok().map(|it| &before[it])
        };
        let places = |at: usize| {
            let first = D as u32 * facets[at];
            (0..D as u32).map(move |corner| (at, Self::place(first + corner)))
        };
        let mut touches: Vec<Touch> = if let Opposite::Rigid(shape, _) = &self.opposite {
            parallel::flat_map(facets.len(), |at| {
                let present = &present;
                places(at).filter_map(move |place| {
                    let partner = Self::shape_met(shape, place, present, step.rigid)?;
                    Some(self.touch(place, &partner, present, known(place.1)))
                })
            })
        } else {
            let skin = SKIN * self.reach;
            let sought = Sought {
                corners: &present.now,
                within: self.reach.max(within) + skin,
                may_meet: &|own, other| self.may_meet(own, other),
            };
            search.update(&sought, skin);
            let search = &*search;
            parallel::flat_map(facets.len(), |at| {
                let facing = Self::facing(at, &present, search.neighbours(at));
                let present = &present;
                places(at).filter_map(move |place| {
                    let partner = self.facet_met(place, present, &facing, step.bonds)?;
                    Some(self.touch(place, &partner, present, known(place.1)))
                })
            })
        };
        touches.sort_unstable_by_key(|it| it.place);
        touches
    }

    /// Whether the first of two facets comes first among the sides, or, of cells of one side, by its point.
    fn is_first(&self, one: usize, other: usize) -> bool {
        let order = |it: usize| (self.side(it).0, self.surface.facet(it).corners[0].point);
        let [one, other] = [one, other].map(order);
        match self.opposite {
            Opposite::OtherSides | Opposite::Rigid(..) => one.0 < other.0,
            Opposite::Unbonded => one < other,
        }
    }
}

impl<const D: usize> SurfacePair for FacetPair<D> {
    fn join(&self, search: &mut Search, broken: &mut dyn Iterator<Item = u32>) {
        if search.facets().is_empty() {
            search.join(0..self.surface.facets.len() as u32);
            let cut = self
                .surface
                .cracks
                .iter()
                .flat_map(|it| it.boundaries.cut());
            search.join(self.surface.facets_at(cut.copied()));
        }
        if let Some(cracks) = &self.surface.cracks {
            let faces = broken.flat_map(|bond| cracks.boundaries.crossed_by(bond));
            let facets = self.surface.facets_at(faces);
            search.join(facets);
        }
    }

    fn touches(&self, search: &mut Search, step: Step<'_>, before: &[Touch]) -> Vec<Touch> {
        self.contacts_within(search, step, before, 0.0)
    }

    fn add_force(&self, touch: &Touch, force: Vector, forces: &mut [f64]) {
        let (layout, surface) = (self.surface.layout, &self.surface);
        let force: [f64; D] = std::array::from_fn(|axis| force[axis]);
        let place = Self::place(touch.place);
        let facet = surface.facet(place.facet);
        facet.add_force(layout, &place.weights, force, forces);
        if let Some(onto) = touch.onto {
            let opposite = force.map(|it| -it);
            let onto = surface.facet(onto as usize);
            onto.add_force(layout, &touch.weights, opposite, forces);
        }
    }

    fn way(&self, touch: &Touch, step: Step<'_>) -> Vector {
        let layout = self.surface.layout;
        let of_facet = |number: usize, weights: &Vector| {
            let facet = self.surface.facet(number);
            let [before, now] = [step.before, step.now].map(|it| facet.motion(layout, weights, it));
            minus(now, before)
        };
        let place = Self::place(touch.place);
        let own = in_space(of_facet(place.facet, &place.weights));
        let met = match touch.onto {
            Some(onto) => in_space(of_facet(onto as usize, &touch.weights)),
            None => {
                let [before, now] = step.rigid;
                let turned = cross(minus(now.rotation, before.rotation), touch.arm);
                let moved = minus(now.displacement, before.displacement);
                std::array::from_fn(|axis| moved[axis] + turned[axis])
            }
        };
        minus(own, met)
    }

    fn row(&self, touch: &Touch, direction: Vector) -> Vec<(usize, f64)> {
        let (layout, surface) = (self.surface.layout, &self.surface);
        let along: [f64; D] = std::array::from_fn(|axis| direction[axis]);
        let place = Self::place(touch.place);
        let facet = surface.facet(place.facet);
        let mut row = facet.row(layout, &place.weights, along);
        if let Some(onto) = touch.onto {
            let onto = surface.facet(onto as usize);
            row.extend(onto.row(layout, &touch.weights, along.map(|it| -it)));
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

    fn has_faces_of_cracks(&self) -> bool {
        self.surface.cracks.is_some()
    }

    fn friction(&self) -> f64 {
        self.friction
    }

    fn reach(&self) -> f64 {
        self.reach
    }

    fn coordinate(&self) -> f64 {
        let own = self.surface.largest_coordinate();
        match &self.opposite {
            Opposite::Rigid(shape, _) => own.max(shape.coordinate()),
            Opposite::OtherSides | Opposite::Unbonded => own,
        }
    }

    fn way_seen(&self) -> f64 {
        self.largest_way_seen()
    }

    fn missed(&self, step: Step<'_>, touches: &[Touch]) -> Option<Missed> {
        self.first_missed(step, touches)
    }

    fn can_have(&self, touches: &[Touch]) -> bool {
        let n_facets = self.surface.n_facets();
        let exists = |it: &Touch| {
            let is_facet = it.onto.is_none_or(|facet| (facet as usize) < n_facets);
            (it.place as usize) < D * n_facets && is_facet
        };
        touches.iter().all(exists) && touches.is_sorted_by(|one, other| one.place < other.place)
    }

    fn degrees_of_freedom(&self) -> Vec<u32> {
        self.surface.degrees_of_freedom()
    }

    fn add_bound(&self, sums: &mut [f64]) {
        self.add_bound_of_all(sums);
    }

    /// Sum over the outline without crack faces: the contact area of a rigid body at one time is at most the width of the body.
    fn on_rigid_body(&self) -> [f64; 2] {
        let facets = self.surface.facets.iter().enumerate();
        let of_facet = |(number, it): (usize, &Facet<D>)| it.area * self.stiffness(number, None);
        let reach = match &self.opposite {
            Opposite::Rigid(shape, _) => shape.reach(),
            Opposite::OtherSides | Opposite::Unbonded => 0.0,
        };
        [facets.map(of_facet).sum(), reach]
    }
}

impl<const D: usize> FacetPair<D> {
    /// Shares of the axes in the stiffness of a facet: without friction the stiffness of a face of cells acts only across the face.
    fn axes(&self, facet: &Facet<D>) -> [f64; D] {
        let across = normal(&facet.corners.map(|it| it.position));
        match across.filter(|_| self.surface.cracks.is_some() && self.friction == 0.0) {
            Some(normal) => {
                let sum: f64 = normal.iter().map(|it| it.abs()).sum();
                normal.map(|it| it.abs() * sum)
            }
            None => [1.0; D],
        }
    }

    /// Adds a diagonal matrix above the stiffness that the contact can have, shape (n_degrees_of_freedom), N/m and N m.
    ///
    /// With (x - y)^2 <= 2 x^2 + 2 y^2 for the motions x and y of the two surfaces; an integration point of another side may act on one point
    /// alone, and as many as the own ones.
    pub(super) fn add_bound_of_all(&self, sums: &mut [f64]) {
        let is_driven = matches!(self.opposite, Opposite::Rigid(_, false));
        let factor = if is_driven { 1.0 } else { 2.0 };
        let meets_facets = !matches!(self.opposite, Opposite::Rigid(..));
        let other = meets_facets.then(|| self.surface.largest_stiffness());
        let of_place =
            |number: usize, it: &Facet<D>| factor * self.area(it) * self.stiffness(number, other);
        let times = if meets_facets { 2.0 } else { 1.0 };
        for (number, facet) in self.surface.all() {
            let (stiffness, axes) = (times * of_place(number, &facet), self.axes(&facet));
            for corner in 0..D as u32 {
                let weights = Self::place(corner).weights;
                self.surface
                    .add_bound((&facet, &weights), stiffness, axes, sums);
            }
        }
        if !meets_facets {
            return;
        }
        let all = self.surface.all();
        let one = all
            .map(|(number, it)| of_place(number, &it))
            .fold(0.0, f64::max);
        let mut seen = vec![false; self.surface.layout.n_points];
        for (_, facet) in self.surface.all() {
            for (corner, it) in facet.corners.iter().enumerate() {
                if !std::mem::replace(&mut seen[it.point as usize], true) {
                    let weights: Vector =
                        std::array::from_fn(|it| f64::from(u8::from(it == corner)));
                    self.surface
                        .add_bound((&facet, &weights), one, [1.0; D], sums);
                }
            }
        }
    }
}

/// An integration point in a step.
struct PointInStep<const D: usize> {
    place: Place,
    /// Position after the step, m.
    now: [f64; D],
    /// Motion in the step, m.
    way: [f64; D],
}

/// A facet in a step.
struct FacetInStep<const D: usize> {
    number: u32,
    /// Corners after the step, m.
    now: Corners<D>,
    /// Mean motion in the step, m.
    way: [f64; D],
}

impl<const D: usize> FacetPair<D> {
    /// Relative motion of the surfaces in a step up to which no contact is missed, m.
    pub(super) fn largest_way_seen(&self) -> f64 {
        match &self.opposite {
            Opposite::Rigid(shape, _) => self.reach.min(UNNOTICED * shape.half_width()),
            Opposite::OtherSides | Opposite::Unbonded => self.reach,
        }
    }

    /// The first integration point of the outline that penetrated its partner in a step but is not in contact after it.
    pub(super) fn first_missed(&self, step: Step<'_>, touches: &[Touch]) -> Option<Missed> {
        let is_free = |number: u32| {
            touches
                .binary_search_by_key(&number, |it| it.place)
                .is_err()
        };
        let facets = self.moved(step);
        let of_facet = |it: &FacetInStep<D>| {
            let first = D as u32 * it.number;
            (0..D as u32).map(move |corner| first + corner)
        };
        let free = facets.iter().flat_map(of_facet).filter(|it| is_free(*it));
        let places: Vec<PointInStep<D>> = free.map(|it| self.passing(it, step)).collect();
        let found = match &self.opposite {
            Opposite::Rigid(shape, _) => {
                let into = |it: &PointInStep<D>| self.path_into_shape(shape, it, step.rigid);
                let deep = places.iter().find_map(|it| Some((it.place, into(it)?)));
                let has_contact = |it: &&FacetInStep<D>| {
                    (0..D as u32).any(|corner| !is_free(D as u32 * it.number + corner))
                };
                let others = facets.iter().filter(|it| !has_contact(it));
                deep.or_else(|| self.facet_crossed_by_shape(shape, others, step.rigid))
            }
            Opposite::OtherSides if self.move_as_one(&facets, &places) => None,
            Opposite::OtherSides => {
                let through =
                    |it: &PointInStep<D>| Some((it.place, self.path_through(it, &facets)?));
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

    /// Whether integration points and facets move nearly as one.
    fn move_as_one(&self, facets: &[FacetInStep<D>], places: &[PointInStep<D>]) -> bool {
        let ways = facets.iter().map(|it| it.way);
        let [low, high] = bounding_box(ways.chain(places.iter().map(|it| it.way)));
        norm(minus(high, low)) <= self.reach
    }

    /// Facets of the outline in a step.
    fn moved(&self, step: Step<'_>) -> Vec<FacetInStep<D>> {
        let layout = self.surface.layout;
        let of_facet = |number: usize| {
            let facet = self.surface.facet(number);
            let [before, now] = [step.before, step.now].map(|it| facet.moved(layout, it));
            let even = [1.0 / D as f64; D];
            FacetInStep {
                number: number as u32,
                way: minus(weighted(&now, &even), weighted(&before, &even)),
                now,
            }
        };
        (0..self.surface.facets.len()).map(of_facet).collect()
    }

    fn passing(&self, number: u32, step: Step<'_>) -> PointInStep<D> {
        let place = Self::place(number);
        let facet = self.surface.facet(place.facet);
        let at = |motions| {
            let corners = facet.moved(self.surface.layout, motions);
            weighted(&corners, &place.weights)
        };
        let now = at(step.now);
        PointInStep {
            place,
            way: minus(now, at(step.before)),
            now,
        }
    }

    /// Length of the path of an integration point relative to a rigid shape, m, if it leads deep into the shape.
    fn path_into_shape(
        &self,
        shape: &RigidShape<D>,
        passing: &PointInStep<D>,
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
    fn facet_crossed_by_shape<'a>(
        &self,
        shape: &RigidShape<D>,
        mut facets: impl Iterator<Item = &'a FacetInStep<D>>,
        rigid: [Pose; 2],
    ) -> Option<(Place, f64)> {
        if UNNOTICED * shape.half_width() >= self.reach {
            return None;
        }
        let middle = shape.middle();
        let end = std::array::from_fn(|axis| middle[axis] + rigid[1].displacement[axis]);
        let facet = facets.find(|it| {
            let way = minus(carried(rigid), it.way);
            crosses_facet(&it.now, minus(end, way), end)
        })?;
        let way = norm(minus(carried(rigid), facet.way));
        Some((Self::place(D as u32 * facet.number), way))
    }

    /// Length of the path of an integration point relative to a facet of another side that it crossed from outside, m.
    fn path_through(&self, passing: &PointInStep<D>, facets: &[FacetInStep<D>]) -> Option<f64> {
        let own = passing.place.facet as u32;
        facets.iter().find_map(|it| {
            let way = minus(passing.way, it.way);
            let goes_far = dot(way, way) > self.reach * self.reach;
            let is_through = goes_far
                && self.may_meet(own, it.number)
                && crosses_facet(&it.now, minus(passing.now, way), passing.now);
            is_through.then(|| norm(way))
        })
    }
}

/// Displacement of a rigid body in a step, m.
fn carried<const D: usize>([before, now]: [Pose; 2]) -> [f64; D] {
    std::array::from_fn(|axis| now.displacement[axis] - before.displacement[axis])
}

/// Signed distance of a position from a moved rigid shape, m.
pub(super) fn distance_from<const D: usize>(
    shape: &RigidShape<D>,
    position: [f64; D],
    pose: Pose,
) -> f64 {
    let still: [f64; D] = std::array::from_fn(|axis| position[axis] - pose.displacement[axis]);
    let arm = minus(still, shape.middle());
    // Of the shapes in space only spheres turn.
    let angle = if D == 2 { pose.rotation } else { [0.0; 3] };
    let back = rotated(arm, angle.map(|it| -it));
    let unturned = std::array::from_fn(|axis| shape.middle()[axis] + back[axis]);
    shape.distance(unturned).0
}

/// Whether a straight path crosses a facet from its outer side.
fn crosses_facet<const D: usize>(corners: &Corners<D>, from: [f64; D], to: [f64; D]) -> bool {
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
    use super::super::facet::Corner;
    use super::*;
    use crate::bonds::Incidence;
    use crate::layout::{Component, Layout};
    use crate::topology::Families;

    /// Facets of two sides, of all sizes up to 1 m and in all directions, in a box of 3 m.
    fn two_sides<const D: usize>() -> FacetPair<D> {
        let mut last = 1_u64;
        let mut number = move || {
            last = last.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (last >> 11) as f64 / (1_u64 << 53) as f64
        };
        let facets = (0..300).map(|point| {
            let (middle, size): ([f64; D], f64) = ([(); D].map(|()| 3.0 * number()), number());
            let corner = |_| middle.map(|x| x + 0.5 * size * (number() - 0.5));
            let corners = std::array::from_fn(corner).map(|position| Corner {
                point,
                others: None,
                position,
                arm: [0.0; D],
            });
            let facet = Facet { corners, area: 1.0 };
            (facet, point % 2, 1e9)
        });
        let layout = Layout {
            n_points: 300,
            components: Component::in_dimensions(D),
        };
        let surface = Surface::new(layout, facets.collect());
        FacetPair::new(surface, Opposite::OtherSides, 0.0)
    }

    /// The facet that an integration point meets, by its number, among all of the other side.
    fn met_among_all<const D: usize>(pair: &FacetPair<D>, place: Place) -> Option<u32> {
        let corners = |facet: usize| pair.surface.facets[facet].corners.map(|it| it.position);
        let own = corners(place.facet);
        let position = weighted(&own, &place.weights);
        let own_normal = normal(&own)?;
        let mut nearest = (pair.reach, None);
        for other in (0..300).filter(|it| it % 2 != place.facet % 2) {
            let corners = corners(other);
            let normal = normal(&corners)?;
            let way = minus(
                position,
                weighted(&corners, &nearest_weights(&corners, position)),
            );
            let overlap = -dot(way, normal);
            let seam = SEAM * pair.surface.facets[other].length();
            let is_beside = norm(tangential(way, normal)) > seam.max(overlap);
            if dot(normal, own_normal) < FACING && !is_beside && norm(way) < nearest.0 {
                nearest = (norm(way), (overlap > 0.0).then_some(other as u32));
            }
        }
        nearest.1
    }

    fn meets_the_nearest<const D: usize>() {
        let pair = two_sides::<D>();
        let incidence = Incidence::from_pairs(std::iter::empty(), 300);
        let still = vec![0.0; pair.surface.layout.n_degrees_of_freedom()];
        let step = Step {
            before: &still,
            now: &still,
            rigid: [Pose::default(); 2],
            bonds: Bonded {
                families: Families {
                    ends: &[],
                    incidence: &incidence,
                    far_field: None,
                },
                intact: &[],
            },
        };
        let mut search = Search::default();
        search.join(0..300);
        let found = pair.contacts_within(&mut search, step, &[], 0.0);
        let found: Vec<(u32, Option<u32>)> = found.iter().map(|it| (it.place, it.onto)).collect();
        let all =
            (0..300 * D as u32).map(|it| (it, met_among_all(&pair, FacetPair::<D>::place(it))));
        let expected: Vec<(u32, Option<u32>)> = all.filter(|it| it.1.is_some()).collect();
        assert!(found.len() > 50, "{}", found.len());
        assert_eq!(found, expected);
    }

    /// What a search leaves out by boxes, normals, planes and spheres is not met: each integration point meets the same facet as by a comparison
    /// with all of them.
    #[test]
    fn what_is_left_out_is_not_met() {
        meets_the_nearest::<2>();
        meets_the_nearest::<3>();
    }

    /// Ways through a segment and a triangle, beside them, and out of the body.
    #[test]
    fn ways_through_a_facet_come_from_outside() {
        // The body is on the left of a segment: below this one.
        let segment = [[1.0, 0.0], [0.0, 0.0]];
        assert!(crosses_facet(&segment, [0.2, 3.0], [0.4, -5.0]));
        assert!(!crosses_facet(&segment, [0.4, -5.0], [0.2, 3.0]));
        assert!(!crosses_facet(&segment, [1.2, 3.0], [1.2, -5.0]));
        assert!(!crosses_facet(&segment, [0.2, 3.0], [0.4, 0.5]));
        let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert!(crosses_facet(&triangle, [0.2, 0.2, 2.0], [0.3, 0.3, -7.0]));
        assert!(!crosses_facet(&triangle, [0.8, 0.8, 2.0], [0.8, 0.8, -7.0]));
    }
}
