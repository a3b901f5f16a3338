//! Contact that is linear in the motions: the partner of each integration point follows from the undeformed body.
//!
//! With the place X of an integration point, the place Y that it faces and the normal n there, all of the undeformed body, the gap is
//!
//! g = g_0 + n . (u(X) - u(Y)), g_0 = n . (X - Y) >= 0,
//!
//! and the force is that of the law without friction, F = k A <-g> n. This is the law to the first order in the motions: right where
//! surfaces move along each other by less than a facet, and where what they slide along is as good as flat. Surfaces that overlap without
//! motion touch there.

use super::facet_pair::{FacetPair, distance_from};
use super::pair::{Missed, Pose, Step, SurfacePair};
use super::rigid::largest_size;
use super::search::Search;
use super::touch::{Touch, Vector};
use super::{Bonded, Opposite, Surface, tangential, weighted};
use crate::tensor::{dot, minus, norm};

/// Gap over the longest edge of a facet that counts as zero: the rounding of coordinates.
const CLOSED: f64 = 1e-9;

/// Gap over the length of the longest edge of a facet up to which facets face each other.
const FARTHEST: f64 = 2.0;

/// Surfaces whose integration points have their contact partners from the undeformed body.
#[derive(Debug)]
pub struct UndeformedPair<const D: usize> {
    pair: FacetPair<D>,
    /// Integration points with a partner, ascending, each with its overlap in the undeformed body.
    facing: Vec<Touch>,
    /// Row of the normal motion of each of these integration points.
    rows: Vec<Vec<(usize, f64)>>,
}

impl<const D: usize> UndeformedPair<D> {
    /// A surface with the contact partner of its integration points, without friction, and the bonds of the undeformed body.
    pub fn new(surface: Surface<D>, opposite: Opposite<D>, bonds: Bonded<'_>) -> Self {
        let still = vec![0.0; surface.layout.n_degrees_of_freedom()];
        let meets_facets = !matches!(opposite, Opposite::Rigid(..));
        let pair = FacetPair::new(surface, opposite, 0.0);
        let step = Step {
            before: &still,
            now: &still,
            rigid: [Pose::default(); 2],
            bonds,
        };
        let within = if meets_facets {
            FARTHEST * pair.reach
        } else {
            f64::INFINITY
        };
        let mut search = Search::default();
        pair.join(&mut search, &mut std::iter::empty());
        let mut facing = pair.contacts_within(&mut search, step, &[], within);
        for it in &mut facing {
            if it.overlap > -CLOSED * pair.reach {
                it.overlap = 0.0;
            }
            it.offset = 0.0;
        }
        let rows = facing.iter().map(|it| pair.row(it, it.normal)).collect();
        Self { pair, facing, rows }
    }

    /// Error of the linear gap of an integration point, m: for a rigid shape the difference from the exact gap, for a facet the motion along it. Zero
    /// without contact.
    fn gap_error(&self, touch: &Touch, step: Step<'_>) -> f64 {
        let surface = &self.pair.surface;
        let place = FacetPair::<D>::place(touch.place);
        let moved = |facet: usize, weights: &Vector| {
            let facet = surface.facet(facet);
            let still = facet.corners.map(|it| it.position);
            let now = weighted(&facet.moved(surface.layout, step.now), weights);
            (now, minus(now, weighted(&still, weights)))
        };
        let (now, way) = moved(place.facet, &place.weights);
        match (&self.pair.opposite, touch.onto) {
            (Opposite::Rigid(shape, _), _) => {
                let overlap = -distance_from(shape, now, step.rigid[1]);
                match overlap.max(touch.overlap) > 0.0 {
                    true => (overlap - touch.overlap).abs(),
                    false => 0.0,
                }
            }
            (_, Some(onto)) if touch.overlap > 0.0 => {
                let (_, other) = moved(onto as usize, &touch.weights);
                let normal = std::array::from_fn(|axis| touch.normal[axis]);
                norm(tangential(minus(way, other), normal))
            }
            _ => 0.0,
        }
    }
}

impl<const D: usize> SurfacePair for UndeformedPair<D> {
    fn join(&self, _: &mut Search, _: &mut dyn Iterator<Item = u32>) {}

    fn touches(&self, _: &mut Search, step: Step<'_>, _: &[Touch]) -> Vec<Touch> {
        let carried = step.rigid[1].displacement;
        let moved = |(touch, row): (&Touch, &Vec<(usize, f64)>)| {
            let way: f64 = row
                .iter()
                .map(|(dof, factor)| factor * step.now[*dof])
                .sum();
            Touch {
                overlap: touch.overlap + dot(carried, touch.normal) - way,
                ..*touch
            }
        };
        self.facing.iter().zip(&self.rows).map(moved).collect()
    }

    fn add_force(&self, touch: &Touch, force: Vector, forces: &mut [f64]) {
        self.pair.add_force(touch, force, forces);
    }

    fn way(&self, touch: &Touch, step: Step<'_>) -> Vector {
        self.pair.way(touch, step)
    }

    fn row(&self, touch: &Touch, direction: Vector) -> Vec<(usize, f64)> {
        self.pair.row(touch, direction)
    }

    fn is_linear(&self) -> bool {
        true
    }

    fn friction(&self) -> f64 {
        0.0
    }

    /// Without an end: what an integration point faces does not change.
    fn reach(&self) -> f64 {
        f64::INFINITY
    }

    fn coordinate(&self) -> f64 {
        let gaps = self.facing.iter().map(|it| it.overlap);
        gaps.fold(0.0, largest_size)
    }

    fn way_seen(&self) -> f64 {
        0.0
    }

    /// The first integration point at which the surfaces meet, or their gap to the first order says so, and the present gap is another one by
    /// more than a facet, or another facet is met by then.
    fn missed(&self, step: Step<'_>, touches: &[Touch]) -> Option<Missed> {
        let reach = self.pair.reach;
        let is_off = |touch: &&Touch| self.gap_error(touch, step) > reach;
        let touch = touches.iter().find(is_off)?;
        let facet = FacetPair::<D>::place(touch.place).facet;
        Some(Missed {
            point: self.pair.surface.facet(facet).corners[0].point,
            way: self.gap_error(touch, step),
            seen: reach,
        })
    }

    fn can_have(&self, touches: &[Touch]) -> bool {
        let places = touches.iter().map(|it| it.place);
        places.eq(self.facing.iter().map(|it| it.place)) && self.pair.can_have(touches)
    }

    fn degrees_of_freedom(&self) -> Vec<u32> {
        self.pair.degrees_of_freedom()
    }

    fn add_bound(&self, sums: &mut [f64]) {
        self.pair.add_bound(sums);
    }

    fn on_rigid_body(&self) -> [f64; 2] {
        self.pair.on_rigid_body()
    }
}
