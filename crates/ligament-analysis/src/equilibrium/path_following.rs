//! Path following: the load factor as an unknown. What is prescribed instead of it is a motion, as in a test controlled by the opening of
//! a crack, or the energy that bonds dissipate.
//!
//! **Motion.** With a correction du_r by the residual forces and the rate u_B of the displacements with the load factor, a motion c . u with
//! the prescribed value c* changes the load factor by
//!
//! d_lambda = (c* - c . u - c . du_r)/(c . u_B),
//!
//! and du = du_r + d_lambda u_B brings the motion to c* (Batoz and Dhatt 1979).
//!
//! **Energy.** At a given energy dissipated by the bonds the load factor may fall past peaks and in snap-back (Gutierrez 2004; Verhoosel
//! 2009). The dissipated energy D of softening bonds is a function of their largest deformations, and grows as long as cracks do. It is
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
use ligament_model::layout::Layout;
use ligament_model::subdomain::Subdomain;
use ligament_model::thermal::ThermalStrain;

use super::equations::Equations;
use crate::balanced::Balanced;
use crate::bond_numbers::sum_over_bonds;
use crate::breakage::Breakage;
use crate::load_program::LoadProgram;
use crate::problem::Problem;
use crate::softening::Softening;
use crate::state::State;
use crate::unbalanced::Unbalanced;

/// Largest deviation of a motion from its value, relative to its change in its stage.
const MISSED_MOTION: f64 = 1e-9;

/// Rate of the controlled motion with the load factor, relative to the largest rate of a displacement, below which the load does
/// not move it.
const UNMOVED: f64 = 1e-12;

/// A motion and its prescribed value.
#[derive(Debug, Clone)]
pub(crate) struct Target {
    /// Loads that grow with the load factor, at load factor 1.
    pub(crate) rate: Arc<dyn LoadProgram>,
    pub(crate) subdomain: Subdomain,
    /// Degrees of freedom of owned points and their weights in the motion, which is a sum over all processes.
    pub(crate) weights: Vec<(u32, f64)>,
    /// The value of the motion, m or rad.
    pub(crate) value: f64,
    /// Change of the motion in its stage, m or rad.
    pub(crate) change: f64,
}

impl Target {
    /// Selects the weights at owned points.
    pub(crate) fn owned_weights(
        subdomain: &Subdomain,
        layout: Layout,
        weights: impl Iterator<Item = (u32, f64)>,
    ) -> Vec<(u32, f64)> {
        let is_owned = |dof| subdomain.owns(layout.point(dof as usize));
        weights.filter(|&(dof, _)| is_owned(dof)).collect()
    }

    /// The motion, m or rad, of displacements of shape (n_degrees_of_freedom).
    pub(super) fn motion(&self, displacement: &[f64]) -> f64 {
        let terms = self.weights.iter();
        let terms = terms.map(|&(dof, weight)| weight * displacement[dof as usize]);
        self.subdomain.sum(terms.sum())
    }

    /// Whether displacements (n_degrees_of_freedom) have the prescribed value of the motion.
    pub(super) fn is_met(&self, displacement: &[f64]) -> bool {
        let missing = self.value - self.motion(displacement);
        missing.abs() <= MISSED_MOTION * self.change.abs()
    }

    /// Adds the rate of the displacements with the load factor (n_degrees_of_freedom) to a correction (n_unknowns) of a state so that it
    /// brings the motion to its value. Returns the change of the load factor.
    ///
    /// # Errors
    ///
    /// If the load does not move the controlled motion.
    pub(super) fn constrain(
        &self,
        equations: &Equations,
        correction: &mut [f64],
        state: &State,
        growth: &[f64],
    ) -> Result<f64, Unbalanced> {
        let corrected = equations.at_degrees_of_freedom(correction);
        let largest = growth.iter().fold(0.0_f64, |size, it| size.max(it.abs()));
        let largest = self.subdomain.max(largest);
        let gained = self.motion(growth);
        let missing = self.value - self.motion(&state.displacement) - self.motion(&corrected);
        let change = missing / gained;
        if gained.abs() <= UNMOVED * largest || !change.is_finite() {
            return Err(Unbalanced::Unmoved);
        }
        for (&dof, value) in equations.degrees_of_freedom().iter().zip(correction) {
            *value += change * growth[dof as usize];
        }
        Ok(change)
    }
}

/// Largest deviation of the dissipated energy from its prescribed value, relative to its step.
const MISSED_ENERGY: f64 = 1e-2;

/// Number of equilibria after which the last one is accepted: where bonds fail at once, the energy jumps over its value.
const EQUILIBRIUM_LIMIT: usize = 12;

/// Largest factor by which the change of the motion grows while the energy is below its value.
const FARTHEST: f64 = 4.0;

/// Accuracy of the energy along the line of the present bonds, relative to its step; the equilibrium differs by more.
const NEAR: f64 = 0.01;

/// Largest number of doublings, and of halvings, in the search along that line.
const HALVINGS: usize = 60;

/// Quantity prescribed in place of the load factor, which is then an unknown.
#[derive(Debug, Clone)]
pub(crate) enum ControlledQuantity {
    /// A motion (a weighted sum of displacements).
    Motion(Target),
    /// The energy dissipated by bonds.
    Energy(Dissipation),
}

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

/// Search for the value of the opening of a crack at which its equilibrium has the dissipated energy.
pub(super) struct EnergySearch {
    goal: Dissipation,
    /// The opening, with its value at the beginning.
    opening: Target,
    /// Softening of the bonds at the beginning.
    softening: Softening,
    bracket: Bracket,
    /// Number of equilibria so far.
    count: usize,
}

impl EnergySearch {
    /// The opening at the value to try next.
    fn target(&self) -> Target {
        let change = self.bracket.next;
        Target {
            value: self.opening.value + change,
            change,
            ..self.opening.clone()
        }
    }

    /// What the next equilibrium prescribes, from the softening at the beginning on; None where this one has the energy.
    pub(super) fn next(
        &mut self,
        problem: &Problem,
        state: &mut State,
        balanced: &Balanced,
    ) -> Option<Target> {
        self.count += 1;
        let excess = dissipated(problem, state, &balanced.deformations) - self.goal.energy;
        let is_met = excess.abs() <= MISSED_ENERGY * self.goal.step;
        if is_met || self.count == EQUILIBRIUM_LIMIT {
            return None;
        }
        self.bracket.learn(excess);
        if self.count + 1 == EQUILIBRIUM_LIMIT {
            self.bracket.end_above();
        }
        state.softening.clone_from(&self.softening);
        Some(self.target())
    }
}

/// What the first equilibrium at a dissipated energy prescribes, with the search for others: none after a breakage and where the energy
/// has its value, which keep the opening of the crack, if one opens.
///
/// # Errors
///
/// If the loads dissipate nothing, or the rate of the displacements is not found.
pub(super) fn begin(
    equations: &mut Equations,
    state: &mut State,
    breakage: &Breakage,
    goal: &Dissipation,
) -> Result<(Option<Target>, Option<EnergySearch>), Unbalanced> {
    let deformations = equations.deformations(state);
    let start = dissipated(&equations.problem, state, &deformations);
    if !breakage.bonds.is_empty() || goal.energy - start <= MISSED_ENERGY * goal.step {
        let opening = opening(&equations.problem, state, &deformations, goal);
        return Ok((opening, None));
    }
    let ahead = ahead(equations, state, &deformations, goal)?;
    let opening = opening(&equations.problem, state, &ahead.deformations, goal);
    let opening = opening.ok_or(Unbalanced::NothingDissipates)?;
    let first = ahead.load_factor * opening.motion(&ahead.growth);
    let search = EnergySearch {
        bracket: Bracket::new(start - goal.energy, first),
        goal: goal.clone(),
        softening: state.softening.clone(),
        opening,
        count: 0,
    };
    Ok((Some(search.target()), Some(search)))
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
    deformations: &Deformations,
    goal: &Dissipation,
) -> Result<Ahead, Unbalanced> {
    let growth = equations.displacement_rate(state, &*goal.rate)?;
    let problem = &equations.problem;
    let expansion = goal.rate.thermal_strain(1.0);
    let slopes = (problem.system).deformations(&state.intact, &growth, expansion);
    let criteria = state.softening.criteria(&problem.criteria);
    let largest = (slopes.par_iter().enumerate())
        .filter(|(bond, _)| state.intact[*bond])
        .map(|(bond, slope)| criteria.utilisation(bond, slope))
        .reduce(|| 0.0, f64::max);
    let largest = problem.system.subdomain.max(largest);
    let at = |by: f64| deformations.ahead(&slopes, by);
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
    let mut softening: Softening = state.softening.clone();
    softening.follow(&problem.criteria, intact, deformations, false);
    let criteria = state.softening.criteria(&problem.criteria);
    let lost = |(bond, deformation): (usize, &BondDeformation)| {
        let opens = intact[bond] && state.softening.goes_on(&criteria, bond, deformation);
        match opens {
            true => StiffnessFactors::WHOLE.lost(&softening.remaining[bond]),
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
        change: 0.0,
    };
    target.value = target.motion(&state.displacement);
    target.change = target.value;
    opens.then_some(target)
}

/// A change of the motion that was tried.
#[derive(Clone, Copy)]
struct Tried {
    change: f64,
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
            low: Tried {
                change: 0.0,
                excess,
            },
            high: None,
            was_below: true,
            next,
        }
    }

    /// Records the energy minus its value at the tried change and chooses the next one: false position, where a side that stays
    /// counts half (the Illinois rule), or linear extrapolation while no change above is known.
    fn learn(&mut self, excess: f64) {
        let tried = Tried {
            change: self.next,
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
            let further = excess * (tried.change - self.low.change) / (self.low.excess - excess);
            self.low = tried;
            let Some(high) = &mut self.high else {
                let share = 1.0 + (further / tried.change).abs();
                self.next = tried.change * share.clamp(1.0 + MISSED_ENERGY, FARTHEST);
                return;
            };
            if stays {
                high.excess *= 0.5;
            }
        }
        if let Some(high) = self.high {
            let low = self.low;
            self.next =
                low.change - low.excess * (high.change - low.change) / (high.excess - low.excess);
        }
    }

    /// Tries the nearest change above.
    fn end_above(&mut self) {
        if let Some(high) = self.high {
            self.next = high.change;
        }
    }
}
