//! Coulomb's friction on the closed faces of cracks, with stick and slip.
//!
//! A closed pair resists the motion P w - s of its faces along the crack ([`ContactPair::slip`]) with its stiffness k, up to mu times its pressure: where the force exceeds that, the
//! anchor s follows. The anchor of a pair that was never open is zero, so that the force along the crack begins from the force of its bond; the
//! anchor of an open pair follows its faces.
//!
//! The friction of each equilibrium, and of each explicit step, follows from the friction of the one before, which [`Friction`] stores: the
//! return mapping of implicit steps (Wriggers 2006, chapter 10).

use ligament_model::contact::{ClosedPair, ContactPair, PairFriction};
use ligament_model::layout::Layout;
use ligament_model::surface::Vector;
use ligament_model::tensor::{minus, norm};
use serde::{Deserialize, Serialize};

/// Rounding by which a force may exceed its limit where nothing has moved.
const ROUNDING: f64 = 1e-12;

/// Motion along the crack at which a pair of faces carries no force, and the force that it carries.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
struct Anchored {
    /// Anchor s, m.
    anchor: Vector,
    /// Force of friction on the second end, N.
    force: Vector,
    /// Motion of the faces against each other along the crack, P w, m.
    slip: Vector,
}

impl Anchored {
    /// Returns the force to Coulomb's limit, N, for a stiffness, N/m; the result is the share of the elastic force that is left.
    fn load(&mut self, stiffness: f64, limit: f64) -> f64 {
        let trial = minus(self.slip, self.anchor).map(|it| stiffness * it);
        let size = norm(trial);
        let share = if size > limit { limit / size } else { 1.0 };
        self.force = trial.map(|it| share * it);
        if share < 1.0 {
            self.anchor = minus(self.slip, self.force.map(|it| it / stiffness));
        }
        share
    }
}

/// Friction of the faces of cracks in the last equilibrium or after the last time step; empty without friction.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Friction {
    /// Pairs by their numbers, ascending.
    pairs: Vec<(u32, Anchored)>,
}

impl Friction {
    /// Friction of a pair at a motion along the crack (m) and Coulomb's limit (N), from its friction in the last equilibrium.
    ///
    /// Where nothing has moved the force is the same to the last bit.
    fn at(&self, pair: &ContactPair, slip: Vector, limit: f64) -> (Anchored, f64) {
        let place = self.pairs.binary_search_by_key(&pair.number, |it| it.0);
        let mut now = place.map_or_else(|_| Anchored::default(), |place| self.pairs[place].1);
        let rests = place.is_ok() && now.slip == slip;
        if rests && norm(now.force) <= (1.0 + ROUNDING) * limit {
            return (now, 1.0);
        }
        now.slip = slip;
        let share = now.load(pair.stiffness, limit);
        (now, share)
    }

    /// Sets the friction of closed pairs for a coefficient and the motions of all points (n_degrees_of_freedom).
    pub(crate) fn rub(
        &self,
        coefficient: f64,
        closed: &mut [ClosedPair],
        layout: Layout,
        motions: &[f64],
    ) {
        for it in closed {
            let slip = it.pair.slip(layout, motions);
            let (now, share) = self.at(&it.pair, slip, -coefficient * it.force());
            let force = now.force;
            it.friction = Some(PairFriction { force, share });
        }
    }

    /// Stores the friction of an equilibrium with these pairs and the closed ones among them, both in the order of their numbers.
    pub(crate) fn settle(
        &mut self,
        coefficient: f64,
        (pairs, closed): (&[ContactPair], &[ClosedPair]),
        layout: Layout,
        motions: &[f64],
    ) {
        let settled = pairs.iter().map(|pair| {
            let place = closed.binary_search_by_key(&pair.number, |it| it.pair.number);
            let pressure = place.map_or(0.0, |place| -closed[place].force());
            let slip = pair.slip(layout, motions);
            (pair.number, self.at(pair, slip, coefficient * pressure).0)
        });
        self.pairs = settled.collect();
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
            let share = pair.load(2.0, limit);
            (pair.force[0], share)
        };
        assert_eq!(at(&mut pair, 1.0, 5.0), (2.0, 1.0));
        assert_eq!(at(&mut pair, 4.0, 5.0), (5.0, 0.625));
        assert_eq!(pair.anchor[0], 1.5);
        assert_eq!(at(&mut pair, 3.0, 5.0), (3.0, 1.0));
        assert_eq!(at(&mut pair, 3.0, 0.0), (0.0, 0.0));
        assert_eq!(pair.anchor[0], 3.0);
    }
}
