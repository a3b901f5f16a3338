//! Coulomb's friction on the closed faces of cracks, with stick and slip.
//!
//! A closed pair resists the motion P w - s of its faces along the crack ([`ContactPair::slip`]) with its stiffness k, up to mu times its pressure: where the force exceeds that, the
//! anchor s follows. The anchor of a pair that was never open is zero, so that the force along the crack begins from that of its bond; the
//! anchor of an open pair follows its faces.

use std::collections::BTreeMap;

use ligament_model::contact::{ClosedPair, ContactPair};
use ligament_model::layout::Layout;
use ligament_model::surface::Vector;
use ligament_model::tensor::{dot, minus, norm};

use crate::serial;

/// Friction on the faces of cracks.
#[derive(Debug, Clone, Default)]
pub(super) struct FaceFriction {
    /// Coefficient mu; 0 without friction.
    coefficient: f64,
    /// Pairs that were met, by their numbers.
    pub(super) pairs: BTreeMap<u32, Anchored>,
}

/// Motion along the crack at which a pair of faces carries no force, and the force that it carries.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Anchored {
    /// Anchor s, m.
    anchor: Vector,
    /// Force of friction on the second end, N.
    force: Vector,
    /// Motion of the faces against each other along the crack, P w, m.
    slip: Vector,
}

serial!(Anchored {
    anchor,
    force,
    slip
});

/// Energies of friction in a step, J.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct FrictionEnergies {
    /// Energy stored in pairs that stick.
    pub(super) stored: f64,
    /// Work of friction over the step, by the trapezoidal rule.
    pub(super) work: f64,
}

impl FaceFriction {
    pub(super) fn new(coefficient: f64, pairs: BTreeMap<u32, Anchored>) -> Self {
        Self { coefficient, pairs }
    }

    /// Moves to new motions (n_degrees_of_freedom) of all pairs, of which some are closed, both in the order of their numbers, and adds the
    /// forces of friction to internal forces (n_degrees_of_freedom).
    pub(super) fn advance(
        &mut self,
        (pairs, closed): (&[ContactPair], &[ClosedPair]),
        layout: Layout,
        motions: &[f64],
        internal: &mut [f64],
    ) -> FrictionEnergies {
        let mut energies = FrictionEnergies::default();
        if self.coefficient == 0.0 {
            return energies;
        }
        for pair in pairs {
            let place = closed.binary_search_by_key(&pair.number, |it| it.pair.number);
            let pressure = place.map_or(0.0, |place| -closed[place].force());
            let of_pair = self.pairs.entry(pair.number).or_default();
            let before = *of_pair;
            of_pair.slip = pair.slip(layout, motions);
            of_pair.load(pair.stiffness, self.coefficient * pressure);
            let way = minus(of_pair.slip, before.slip);
            energies.work += 0.5 * (dot(before.force, way) + dot(of_pair.force, way));
            energies.stored += 0.5 * dot(of_pair.force, minus(of_pair.slip, of_pair.anchor));
            pair.add_along(layout, of_pair.force, internal);
        }
        energies
    }

    /// Adds the forces of the present friction of pairs to internal forces (n_degrees_of_freedom).
    pub(super) fn add_forces(&self, pairs: &[ContactPair], layout: Layout, internal: &mut [f64]) {
        for pair in pairs {
            if let Some(of_pair) = self.pairs.get(&pair.number) {
                pair.add_along(layout, of_pair.force, internal);
            }
        }
    }
}

impl Anchored {
    /// Returns the force to Coulomb's limit, N, for a stiffness, N/m.
    fn load(&mut self, stiffness: f64, limit: f64) {
        let trial = minus(self.slip, self.anchor).map(|it| stiffness * it);
        let size = norm(trial);
        let share = if size > limit { limit / size } else { 1.0 };
        self.force = trial.map(|it| share * it);
        if share < 1.0 {
            self.anchor = minus(self.slip, self.force.map(|it| it / stiffness));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pair sticks below mu times its pressure, slides at it, sticks where it turns back, and lets go where it opens.
    #[test]
    fn a_pair_sticks_and_slides() {
        let mut pair = Anchored::default();
        let at = |pair: &mut Anchored, slip: f64, limit: f64| {
            pair.slip[0] = slip;
            pair.load(2.0, limit);
            pair.force[0]
        };
        assert_eq!(at(&mut pair, 1.0, 5.0), 2.0);
        assert_eq!(at(&mut pair, 4.0, 5.0), 5.0);
        assert_eq!(pair.anchor[0], 1.5);
        assert_eq!(at(&mut pair, 3.0, 5.0), 3.0);
        assert_eq!(at(&mut pair, 3.0, 0.0), 0.0);
        assert_eq!(pair.anchor[0], 3.0);
    }
}
