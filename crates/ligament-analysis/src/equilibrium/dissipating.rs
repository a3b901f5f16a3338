//! Equilibrium at a given energy dissipated by the bonds, with the load factor as an unknown, which may fall past peaks and in
//! snap-back (Gutierrez 2004; Verhoosel 2009).
//!
//! The dissipated energy D of softening bonds is a function of their largest deformations, and grows as long as cracks do. It is
//! not linear in the displacements, and constant where nothing softens, so that it is not prescribed directly. Instead, a motion
//! ([`Target`]) that grows with D is prescribed, and D follows from its value:
//!
//! 1. Along the line u + w u_B of the present bonds there is a w > 0 at which D has its value; the crack opens at the bonds that
//!    soften further there.
//! 2. The motion is c . u with the forces c = sum (1 - omega) K_b u that these bonds have lost by softening: the opening of the
//!    crack, weighted by the lost force of each bond. In a bond with linear softening the rate of dissipation is proportional to it.
//! 3. Equilibria at values of c . u give D; the value is found by false position between one below and one above.
//!
//! After a breakage c . u keeps its value, with the bonds that are then at their largest deformations.

use std::sync::Arc;

use rayon::prelude::*;

use ligament_model::UnbrokenBonds;
use ligament_model::deformation::Deformations;
use ligament_model::element::{BondDeformation, StiffnessFactors};
use ligament_model::thermal::ThermalStrain;

use super::equations::Equations;
use super::iteration;
use super::line;
use super::secant::Secant;
use super::target::Target;
use crate::balanced::Attempt;
use crate::bond_numbers::sum_over_bonds;
use crate::breakage::Breakage;
use crate::history::{Observer, ObserverError};
use crate::load_program::LoadProgram;
use crate::problem::Problem;
use crate::softening::Softening;
use crate::state::State;
use crate::unbalanced::Unbalanced;

/// Largest deviation of the dissipated energy from its prescribed value, relative to its step.
const MISSED: f64 = 1e-2;

/// Number of equilibria after which the last one is accepted: where bonds fail at once, the energy jumps over its value.
const EQUILIBRIUM_LIMIT: usize = 12;

/// Largest factor by which the change of the motion grows while the energy is below its value.
const FARTHEST: f64 = 4.0;

/// Accuracy of the energy along the line of the present bonds, relative to its step; the equilibrium differs by more.
const NEAR: f64 = 0.01;

/// Largest number of doublings, and of halvings, in the search along that line.
const HALVINGS: usize = 60;

/// A prescribed dissipated energy.
#[derive(Debug, Clone)]
pub(crate) struct Dissipation {
    /// Loads that grow with the load factor, at load factor 1.
    pub(crate) rate: Arc<dyn LoadProgram>,
    /// Dissipated energy, J.
    pub(crate) energy: f64,
    /// Change of the dissipated energy in a load step, J.
    pub(crate) step: f64,
}

/// Brings a state into equilibrium with a dissipated energy and finds its load factor; after a breakage, at fixed crack opening.
pub(super) fn balance(
    equations: &mut Equations,
    state: &mut State,
    breakage: &Breakage,
    goal: &Dissipation,
    observer: &mut dyn Observer,
) -> Result<Attempt, ObserverError> {
    let here = equations.deformations(state);
    let start = dissipated(&equations.problem, state, &here);
    if !breakage.bonds.is_empty() || goal.energy - start <= MISSED * goal.step {
        let target = opening(&equations.problem, state, &here, goal);
        let mut way = Secant::new(target.as_ref());
        return iteration::balance(equations, state, breakage, &mut way, observer);
    }
    let ahead = match ahead(equations, state, &here, goal) {
        Ok(ahead) => ahead,
        Err(unbalanced) => return Ok(Attempt::Unbalanced(unbalanced)),
    };
    let Some(there) = opening(&equations.problem, state, &ahead.deformations, goal) else {
        return Ok(Attempt::Unbalanced(Unbalanced::NothingDissipates));
    };
    let from = there.motion(&state.displacement);
    let softening = state.softening.clone();
    let mut way = Bracket::new(
        start - goal.energy,
        ahead.load_factor * there.motion(&ahead.growth),
    );
    for count in 1.. {
        let target = Target {
            value: from + way.next,
            way: way.next,
            ..there.clone()
        };
        let mut secant = Secant::new(Some(&target));
        let attempt = iteration::balance(equations, state, breakage, &mut secant, observer)?;
        let Attempt::Balanced(balanced) = &attempt else {
            return Ok(attempt);
        };
        let energy = dissipated(&equations.problem, state, &balanced.deformations);
        let excess = energy - goal.energy;
        if excess.abs() <= MISSED * goal.step || count == EQUILIBRIUM_LIMIT {
            return Ok(attempt);
        }
        way.learn(excess);
        if count + 1 == EQUILIBRIUM_LIMIT {
            way.end_above();
        }
        state.softening = softening.clone();
    }
    unreachable!("the loop ends at its limit")
}

/// Energy that the bonds of a state would have dissipated at deformations (n_bonds), J.
fn dissipated(problem: &Problem, state: &State, deformations: &[BondDeformation]) -> f64 {
    let system = &*problem.system;
    let criteria = state.softening.criteria(&problem.criteria);
    let of_bond = |(bond, deformation): (usize, &BondDeformation)| match state.intact[bond] {
        true => (state.softening).dissipated_at(system, &criteria, bond, deformation),
        false => state.dissipated[bond],
    };
    let of_bonds: Vec<f64> = (deformations.par_iter().enumerate()).map(of_bond).collect();
    sum_over_bonds(system, of_bonds.into_iter())
}

/// Point on the line of the present bonds at which the energy has its value.
struct Ahead {
    /// Change of the load factor.
    load_factor: f64,
    /// Rate of the displacements with the load factor, shape (n_degrees_of_freedom).
    growth: Vec<f64>,
    /// Deformations at this point, shape (n_bonds).
    deformations: Deformations,
}

/// First point ahead on the line of the present bonds, from deformations (n_bonds), with the prescribed dissipated energy.
fn ahead(
    equations: &mut Equations,
    state: &mut State,
    here: &Deformations,
    goal: &Dissipation,
) -> Result<Ahead, Unbalanced> {
    let growth = line::growth(equations, state, &*goal.rate)?;
    let problem = &equations.problem;
    let expansion = goal.rate.thermal_strain(1.0);
    let slopes = (problem.system).deformations(&state.intact, &growth, expansion);
    let criteria = state.softening.criteria(&problem.criteria);
    let largest = (slopes.par_iter().enumerate())
        .filter(|(bond, _)| state.intact[*bond])
        .map(|(bond, slope)| criteria.utilisation(bond, slope))
        .reduce(|| 0.0, f64::max);
    let largest = problem.system.subdomain.max(largest);
    let at = |by: f64| here.ahead(&slopes, by);
    let excess = |by: f64| dissipated(problem, state, &at(by)) - goal.energy;
    let (mut low, mut high) = (0.0, 1.0 / largest);
    let mut above = excess(high);
    for _ in 0..HALVINGS {
        if above >= 0.0 {
            break;
        }
        (low, high) = (high, 2.0 * high);
        above = excess(high);
    }
    if !high.is_finite() || above.is_nan() || above < 0.0 {
        return Err(Unbalanced::NothingDissipates);
    }
    for _ in 0..HALVINGS {
        if above <= NEAR * goal.step {
            break;
        }
        let middle = 0.5 * (low + high);
        match excess(middle) {
            below if below < 0.0 => low = middle,
            beyond => (high, above) = (middle, beyond),
        }
    }
    let deformations = at(high);
    Ok(Ahead {
        load_factor: high,
        growth,
        deformations,
    })
}

/// Opening of the bonds that soften further at deformations (n_bonds), with its value in a state; None where no bond does.
fn opening(
    problem: &Problem,
    state: &State,
    deformations: &Deformations,
    goal: &Dissipation,
) -> Option<Target> {
    let (system, intact) = (&*problem.system, &state.intact);
    let mut there: Softening = state.softening.clone();
    there.follow(&problem.criteria, intact, deformations, false);
    let criteria = state.softening.criteria(&problem.criteria);
    let lost = |(bond, deformation): (usize, &BondDeformation)| {
        let opens = intact[bond] && state.softening.goes_on(&criteria, bond, deformation);
        match opens {
            true => StiffnessFactors::WHOLE.lost(&there.remaining[bond]),
            false => StiffnessFactors::NOTHING,
        }
    };
    let lost: Vec<StiffnessFactors> = (deformations.par_iter().enumerate()).map(lost).collect();
    let bonds = UnbrokenBonds {
        remaining: &lost,
        intact,
    };
    let forces = system.forces(bonds, deformations.clone(), ThermalStrain::NONE);
    let values = (0..).zip(forces.internal.values);
    let subdomain = &system.subdomain;
    let weights = values.filter(|(_, weight)| *weight != 0.0);
    let weights = Target::owned_weights(subdomain, system.layout, weights);
    let opens = subdomain.any(!weights.is_empty());
    let mut target = Target {
        subdomain: subdomain.clone(),
        rate: goal.rate.clone(),
        weights,
        value: 0.0,
        way: 0.0,
    };
    target.value = target.motion(&state.displacement);
    target.way = target.value;
    opens.then_some(target)
}

/// A change of the motion that was tried.
#[derive(Clone, Copy)]
struct Tried {
    way: f64,
    /// Dissipated energy minus its prescribed value, J.
    excess: f64,
}

/// Bracket of the change of the motion at which the dissipated energy has its value.
struct Bracket {
    low: Tried,
    high: Option<Tried>,
    /// Change to try next.
    next: f64,
    was_below: bool,
}

impl Bracket {
    /// Bracket from the first energy minus its value, negative, and the change to try first.
    fn new(excess: f64, next: f64) -> Self {
        Self {
            low: Tried { way: 0.0, excess },
            high: None,
            was_below: true,
            next,
        }
    }

    /// Records the energy minus its value at the tried change and chooses the next one: false position, where a side that stays
    /// counts half (the Illinois rule), or linear extrapolation while no change above is known.
    fn learn(&mut self, excess: f64) {
        let tried = Tried {
            way: self.next,
            excess,
        };
        let stays = (excess < 0.0) == self.was_below;
        self.was_below = excess < 0.0;
        if excess >= 0.0 {
            if stays {
                self.low.excess *= 0.5;
            }
            self.high = Some(tried);
        } else {
            let on = excess * (tried.way - self.low.way) / (self.low.excess - excess);
            self.low = tried;
            let Some(high) = &mut self.high else {
                let share = 1.0 + (on / tried.way).abs();
                self.next = tried.way * share.clamp(1.0 + MISSED, FARTHEST);
                return;
            };
            if stays {
                high.excess *= 0.5;
            }
        }
        if let Some(high) = self.high {
            let low = self.low;
            self.next = low.way - low.excess * (high.way - low.way) / (high.excess - low.excess);
        }
    }

    /// Tries the nearest change above.
    fn end_above(&mut self) {
        if let Some(high) = self.high {
            self.next = high.way;
        }
    }
}
