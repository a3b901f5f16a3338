//! Friction on the faces of cracks along an explicit motion ([`friction`](crate::friction)).

use std::collections::BTreeMap;

use ligament_model::contact::{ClosedPair, ContactPair};
use ligament_model::layout::Layout;
use ligament_model::tensor::{dot, minus};

use crate::friction::Anchored;

/// Friction on the faces of cracks.
#[derive(Debug, Clone, Default)]
pub(super) struct FaceFriction {
    /// Coefficient mu; 0 without friction.
    coefficient: f64,
    /// Pairs that were met, by their numbers.
    pub(super) pairs: BTreeMap<u32, Anchored>,
}

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
