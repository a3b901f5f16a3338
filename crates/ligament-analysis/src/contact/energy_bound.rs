//! Contacts of a pair of surfaces, which in explicit steps never give energy.
//!
//! An integration point with the stored energy U and the force F before a step, U' and F' after it, whose surfaces move by s against each other in
//! the step, takes the energy
//!
//! D = U - U' - 1/2 (F . s + F' . s')
//!
//! by the trapezoidal rule, with which central differences conserve energy; s' is the motion at the place that it meets after the step. D is zero
//! while a contact goes on along a facet. It would be negative where the point comes to another facet, where facets turn, and in the step in
//! which a contact ends, because its force acts until the end of that step. So
//!
//! 1. a contact may return the energy that it has taken across the surfaces so far (its credit C >= 0), as in the step in which it began; a
//!    contact that ends may also return the energy taken by contacts of the pair of surfaces that have ended;
//! 2. the depth d of the contact is at most the larger root of k d^2 - k d a = 2 (U_n + C) - F_n . s, with the approach a = -n' . s' and the
//!    parts U_n and F_n along the normal before the step; this is a for a new contact and at least d + a for a contact that goes on. The
//!    elastic part of the sliding is bounded in the same way, without credit;
//! 3. energy that is still missing is taken by a drag 2 (D + C) s/|s|^2 against the motion, which acts for one step. Where a contact ends, the
//!    drag leaves the work of a force that ends when the surfaces part, and is smaller than the force before.
//!
//! So the contacts of a pair of surfaces together never release energy.

use ligament_model::surface::{Step, SurfacePair, Touch, Vector};
use ligament_model::tensor::{dot, norm};
use serde::{Deserialize, Serialize};

/// Depth, relative to the longest edge of a facet, that is only rounding of positions.
const ROUNDING: f64 = 1e-13;

/// Force on surfaces that were in contact, against their motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Drag {
    /// Contact before the step.
    pub touch: Touch,
    /// Force on its integration point, N.
    pub force: Vector,
}

/// Contacts of a pair of surfaces.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct PairContacts {
    /// Integration points in contact, ascending.
    pub touches: Vec<Touch>,
    /// Forces on contacts that ended, for one step; only in explicit steps.
    pub drags: Vec<Drag>,
    /// Energy that ended contacts took across the surfaces, and that other contacts may return, J; only in explicit steps, otherwise 0.
    pub credit: f64,
}

impl PairContacts {
    /// Forces of the contacts on their integration points, N.
    pub(super) fn forces(&self) -> impl Iterator<Item = (&Touch, Vector)> {
        let pressed = self.touches.iter().filter(|it| it.depth() > 0.0);
        let touches = pressed.map(|it| (it, it.force()));
        touches.chain(self.drags.iter().map(|it| (&it.touch, it.force)))
    }

    /// Contacts after an explicit step, from the integration points that were found in contact there, ascending.
    pub(super) fn after(
        &self,
        surfaces: &dyn SurfacePair,
        step: Step<'_>,
        mut touches: Vec<Touch>,
    ) -> Self {
        let mut after = Self {
            credit: self.credit,
            ..Self::default()
        };
        let rounding = ROUNDING * surfaces.reach();
        for before in &self.drags {
            let way = surfaces.way(&before.touch, step);
            let given = 0.5 * dot(before.force, way);
            after.credit += (-given).max(0.0);
            after.take(given, &before.touch, way);
        }
        let mut ended = self.touches.iter().peekable();
        for touch in &mut touches {
            while let Some(before) = ended.next_if(|it| it.place < touch.place) {
                after.end(before, surfaces.way(before, step));
            }
            let moved = surfaces.way(touch, step);
            match ended.next_if(|it| it.place == touch.place) {
                None => {
                    bound(touch, moved, Left::default(), rounding);
                    touch.credit = (-across(touch, moved)).max(0.0);
                }
                Some(before) => {
                    let way = surfaces.way(before, step);
                    let left = left(before, way);
                    bound(touch, moved, left, rounding);
                    touch.credit = (left.along_normal - across(touch, moved)).max(0.0);
                    let needed = touch.energy() + 0.5 * dot(touch.force(), moved);
                    let small = touch.stiffness * touch.depth().max(before.depth()) * rounding;
                    after.take(needed - left.total() - small, before, way);
                }
            }
        }
        for before in ended {
            after.end(before, surfaces.way(before, step));
        }
        after.touches = touches;
        after
    }

    /// Ends a contact, whose surfaces moved by `way` (m) in the step.
    fn end(&mut self, before: &Touch, way: Vector) {
        let left = left(before, way);
        self.credit += left.along_normal.min(left.total()).max(0.0);
        self.take(-left.total(), before, way);
    }

    /// Removes an energy (J) that a contact released in the step: from the credit of ended contacts, otherwise by a drag against its motion
    /// `way` (m).
    fn take(&mut self, given: f64, touch: &Touch, way: Vector) {
        let square = dot(way, way);
        if given <= 0.0 || square == 0.0 {
            return;
        }
        let of_others = given.min(self.credit);
        self.credit -= of_others;
        if given > of_others {
            let drag = 2.0 * (given - of_others) / square;
            let force = way.map(|it| -drag * it);
            let touch = *touch;
            self.drags.push(Drag { touch, force });
        }
    }
}

/// Energy that the pressure of a contact after a step stores and the work that it did in the step (motion of its surfaces, m), J.
fn across(touch: &Touch, way: Vector) -> f64 {
    let depth = touch.depth().max(0.0);
    0.5 * touch.stiffness * depth * depth + 0.5 * dot(touch.normal_force(), way)
}

/// Energy of a contact, with its credit, less the work of its force in a step, J.
#[derive(Debug, Clone, Copy, Default)]
struct Left {
    along_normal: f64,
    of_sliding: f64,
}

impl Left {
    fn total(self) -> f64 {
        self.along_normal + self.of_sliding
    }
}

/// Energy that a contact before a step has left after the motion of its surfaces in the step (m).
fn left(before: &Touch, way: Vector) -> Left {
    let Touch {
        stiffness, slip, ..
    } = *before;
    let of_sliding = 0.5 * stiffness * dot(slip, slip);
    Left {
        along_normal: before.energy() + before.credit
            - of_sliding
            - 0.5 * dot(before.normal_force(), way),
        of_sliding: of_sliding - 0.5 * dot(before.friction_force(), way),
    }
}

/// Bounds the depth and the elastic sliding of a contact after a step, with the motion of its surfaces in the step (m) and the energy that
/// it has left; overlaps up to `rounding` (m) count as none.
fn bound(touch: &mut Touch, way: Vector, left: Left, rounding: f64) {
    let largest = |along: f64, left: f64| {
        0.5 * along + (0.25 * along * along + 2.0 * left.max(0.0) / touch.stiffness).sqrt()
    };
    let (depth, slid) = (touch.depth(), norm(touch.slip));
    let deepest = largest(-dot(touch.normal, way), left.along_normal);
    let mut factor = 1.0_f64;
    if slid > 0.0 {
        let farthest = largest(dot(touch.slip, way) / slid, left.of_sliding);
        factor = if farthest < slid - rounding {
            farthest / slid
        } else {
            1.0
        };
    }
    if deepest < depth - rounding {
        touch.offset = touch.overlap - deepest;
        // Friction stays within its share of the pressure.
        factor = factor.min(deepest / depth);
    }
    if factor < 1.0 {
        touch.slip = touch.slip.map(|it| factor * it);
    }
}
