//! Equilibrium of bonds that soften, by a quasi-Newton iteration from their secant stiffness.

use super::earlier_equilibria::EarlierEquilibria;
use super::equations::{Equations, Iterate};
use super::falling;
use super::iteration::{Iteration, Method};
use super::line;
use super::line_search;
use super::residual::RESIDUAL_TOLERANCE;
use super::target::Target;
use crate::state::State;
use crate::tangent::AllowedResidual;
use crate::unbalanced::Unbalanced;
use crate::vectors::dot_of_all;

/// Largest residual of an equilibrium accepted by the energy rule: residuals of thousands of points add up in the balance of the
/// external forces, and the falling stiffness of softening bonds magnifies them.
const LARGEST_RESIDUAL: f64 = 1e-8;

/// Largest residual of an equilibrium accepted by the energy rule where a motion is prescribed or faces close: energies of a run
/// then balance to 1e-8, against 2e-8 with a residual of 1e-8.
const LARGEST_FOLLOWING: f64 = 2e-9;

/// Residual up to which an extrapolated state begins the iteration where a motion is prescribed; a residual without extrapolation
/// is then no measure.
const LARGEST_AHEAD: f64 = 0.2;

/// Relative residual that an iterative solver may leave. The stiffness of the secants is only near the tangent, and the recorded curvature
/// belongs to the steps that are taken: with 1e-6 a run needs nearly as many corrections, and three times as long.
const SOLVED: f64 = 0.3;

/// Number of corrections for which an iterative solver solves for the growth with the load once.
const GROWTH_EVERY: usize = 5;

/// Number of corrections after which the falling stiffness is taken anew. A beam of 1,728 points took 761 corrections with 6 and 765 with
/// 15, and 162 and 98 factorisations.
const FALLING_FOR: usize = 15;

/// Largest number of iterations of a solve.
const ITERATION_LIMIT: usize = 1000;

/// Largest number of trials of a line search; where surfaces meet, friction turns round and contacts close within a small part of a correction,
/// and the search goes on.
const TRIES: usize = 5;
const TRIES_IN_CONTACT: usize = 53;

/// Number of iterations after which a force at an added support is accepted where faces close.
const CARRIED_AFTER: usize = 60;

/// Number of iterations after which damage of the iterates no longer heals: a solution that has not converged by then is a sudden
/// drop in which bonds alternate, and damage that only grows terminates.
const ONE_WAY_AFTER: usize = 150;

/// Number of iterations from which a state may count as diverging, and the factor on the size of the body, or on its prescribed motions,
/// that the displacement of some point then exceeds. Before that a detached part may have moved as far, and is then supported.
const DIVERGING: (usize, f64) = (20, 1e6);

/// Equilibrium of softening bonds at a load factor, or at the value of a motion with the load factor as an unknown: the same iteration
/// in the plane of displacements with that motion, for a body that is stable under such control.
///
/// Every iterate determines the remaining stiffness of the bonds. The secants are positive, so that the secant stiffness K_s is
/// positive definite where the elastic one is; and since the energy of a bond is concave in the square of its deformation, the
/// energy with the secants lies above the true one. A correction by K_s therefore lowers the potential energy, but is too short.
/// Three measures lengthen it: the [falling stiffness](super::falling) of bonds that are loaded further, where the stiffness is still
/// positive definite with it; the curvature along the last steps ([`Curvature`](super::curvature::Curvature)), including steps of
/// earlier equilibria; and a line search ([`line_search`]). All lower the energy and end in a stable equilibrium. The factor may
/// differ from the stiffness, because the last two need only an approximate one.
///
/// A load step begins at the extrapolation of the last one if that has the smaller residual. Where faces close, nothing is used
/// from earlier equilibria, and at the load of the last equilibrium, where bonds broke or began to soften, no curvature. Otherwise the
/// first correction takes the bonds of the last equilibrium, because bonds next to prescribed motions deform too much until their
/// surroundings follow. The iteration ends by NHPD's energy rule (eq. 21) with a residual below 1e-8, or with a residual below 1e-10. Extremes of iterates do not count unless
/// equilibrium is reached ([`Softening::follow`](crate::softening::Softening::follow)).
pub(super) struct Secant<'a> {
    target: Option<&'a Target>,
    earlier: EarlierEquilibria,
    /// Whether the load differs from that of the last equilibrium.
    is_new: bool,
    /// Growth of the state by which an earlier correction brought the motion to its value.
    growth: Option<Growth>,
    /// Whether the next correction is the first one after a change of the load or of the bonds that soften.
    begins: bool,
    /// Number of corrections since the last change of the falling stiffness.
    used: usize,
}

/// Growth of a state with the load factor.
struct Growth {
    /// Residual force that the loads cause at load factor 1, shape (n_unknowns), N.
    force: Vec<f64>,
    /// Rate of the displacements, shape (n_degrees_of_freedom).
    motion: Vec<f64>,
    /// Number of corrections made with it.
    used: usize,
}

/// Correction of a state, with the residual force that it removes.
struct Direction {
    /// Residual force at the corrected load factor, shape (n_unknowns), N.
    force: Vec<f64>,
    /// Change of the unknowns, shape (n_unknowns).
    step: Vec<f64>,
    load_change: f64,
}

impl Method for Secant<'_> {
    fn begin(&mut self, at: &mut Iteration<'_>) -> Iterate {
        self.earlier = std::mem::take(&mut at.equations.earlier);
        // Bonds that break or begin to soften do so at the load of the last equilibrium.
        self.is_new = at.breakage.bonds.is_empty() && !self.earlier.has_load(at.state, self.target);
        // Pairs that close and open change the stiffness at once; and where one breakage causes another, curvature from before it would
        // affect where the drop ends.
        if at.equations.problem.may_press() {
            self.earlier = EarlierEquilibria::default();
        } else if !self.is_new {
            self.earlier.curvature.discard();
        }
        let iterate = at.begin();
        let is_small = at.is_small(&iterate, RESIDUAL_TOLERANCE);
        self.begins = at.breakage.bonds.is_empty();
        // Bonds that begin to soften leave the forces as they are.
        let is_beginning = self.begins && !self.is_new;
        if at.number > 0 || is_beginning || (is_small && self.target.is_none()) {
            return softened(at.equations, at.state, false);
        }
        let ahead = self
            .is_new
            .then(|| self.earlier.ahead(at.state, self.target));
        let Some(mut ahead) = ahead.flatten() else {
            return iterate;
        };
        at.equations.prescribe(&mut ahead);
        let there = softened(at.equations, &mut ahead, false);
        let most = (self.target).map_or(iterate.residual.relative, |_| LARGEST_AHEAD);
        if there.residual.relative < most {
            *at.state = ahead;
            return there;
        }
        iterate
    }

    fn is_met(&mut self, at: &mut Iteration<'_>, iterate: &mut Iterate) -> bool {
        let faces_close = at.equations.problem.may_press();
        let largest = match self.target.is_some() || faces_close {
            true => LARGEST_FOLLOWING,
            false => LARGEST_RESIDUAL,
        };
        let is_small = at.is_small(iterate, RESIDUAL_TOLERANCE);
        // A force at an added support may in the end be carried by closed faces.
        let may_close = faces_close && at.number < CARRIED_AFTER;
        (is_small || at.energy_settled(iterate, largest))
            && !(may_close && iterate.residual.carried.is_some())
            && self.has_value(at.state)
    }

    fn settle(&mut self, at: &mut Iteration<'_>) {
        at.state.softening.settle();
        let mut earlier = std::mem::take(&mut self.earlier);
        earlier.learn(at.state, self.is_new);
        at.equations.earlier = earlier;
    }

    fn gives_up(&self, at: &Iteration<'_>) -> bool {
        let (least, times) = DIVERGING;
        let layout = at.equations.layout();
        let accuracy = &at.equations.accuracy;
        at.number == ITERATION_LIMIT
            || at.number >= least && accuracy.moves_beyond(layout, at.state, times)
    }

    fn correct(
        &mut self,
        at: &mut Iteration<'_>,
        iterate: &Iterate,
    ) -> Result<Iterate, Unbalanced> {
        let (equations, state) = (&mut *at.equations, &mut *at.state);
        self.fall(equations, state, iterate);
        equations
            .solver
            .update_for_softening(state, &mut equations.costs);
        let held = equations.make_ready(state, iterate)?;
        if !held.is_empty() {
            self.forget();
        }
        at.mechanisms.extend(held);
        // A motion reaches its value by a whole correction, for which curvature recorded elsewhere may be wrong.
        let has_value = self.has_value(state);
        if !has_value {
            self.earlier.curvature.discard();
        }
        let force = equations.out_of_balance(state, iterate);
        let mut search_direction = self.search_direction(equations, state, force.clone())?;
        if equations.dot(&search_direction.force, &search_direction.step) <= 0.0 {
            self.forget();
            search_direction = self.search_direction(equations, state, force)?;
        }
        Ok(self.search(at, search_direction, has_value))
    }
}

impl<'a> Secant<'a> {
    pub(super) fn new(target: Option<&'a Target>) -> Self {
        Self {
            target,
            earlier: EarlierEquilibria::default(),
            is_new: true,
            growth: None,
            begins: false,
            used: 0,
        }
    }

    /// Whether the prescribed motion has its value in a state.
    fn has_value(&self, state: &State) -> bool {
        (self.target).is_none_or(|it| it.is_met(&state.displacement))
    }

    /// Lets the stiffness of the bonds that are loaded further fall in the factor, at the beginning and where the iteration is slow.
    fn fall(&mut self, equations: &mut Equations, state: &State, iterate: &Iterate) {
        if equations.problem.may_press() || !(self.begins || self.used >= FALLING_FOR) {
            self.used += 1;
            return;
        }
        (self.begins, self.used) = (false, 1);
        let falling = falling::terms(&equations.problem, state, &iterate.deformations);
        if equations.solver.fall(falling) {
            self.forget();
        }
    }

    /// Discards the stiffness recorded by earlier corrections.
    fn forget(&mut self) {
        self.earlier.curvature.discard();
        self.growth = None;
    }

    /// Correction for a residual force (n_unknowns) by the stiffness with the recorded curvature. The growth with the load of an earlier
    /// correction is near enough for an iterative solver: the motion reaches its value along any growth.
    fn search_direction(
        &mut self,
        equations: &mut Equations,
        state: &State,
        mut force: Vec<f64>,
    ) -> Result<Direction, Unbalanced> {
        let subdomain = equations.subdomain().clone();
        let dot = |one: &[f64], other: &[f64]| dot_of_all(&subdomain, one, other);
        let curvature = &self.earlier.curvature;
        let left = AllowedResidual::Share(SOLVED);
        let is_iterative = equations.solver.tolerance().is_some();
        let mut recent = (self.growth.take()).filter(|it| is_iterative && it.used < GROWTH_EVERY);
        let mut step;
        let mut load_change = 0.0;
        if let (Some(target), None) = (self.target, &recent) {
            // Growth of the state with the load factor, for the bonds of the state.
            let (mut motion, rate) = line::rate(equations, state, &*target.rate);
            let both = [force.clone(), rate.clone()];
            let solve = |both| equations.solve_both(state, both, left);
            let grown;
            [step, grown] = curvature.corrections(both, &dot, solve)?;
            for (&dof, value) in equations.degrees_of_freedom().iter().zip(&grown) {
                motion[dof as usize] = *value;
            }
            recent = Some(Growth {
                force: rate,
                motion,
                used: 0,
            });
        } else {
            let solve = |[it]: [Vec<f64>; 1]| Ok([equations.solve(state, it, left)?]);
            [step] = curvature.corrections([force.clone()], &dot, solve)?;
        }
        if let (Some(target), Some(mut growth)) = (self.target, recent) {
            growth.used += 1;
            load_change = equations.constrain(&mut step, state, &growth.motion, target)?;
            for (value, rate) in force.iter_mut().zip(&growth.force) {
                *value += load_change * rate;
            }
            self.growth = Some(growth);
        }
        Ok(Direction {
            force,
            step,
            load_change,
        })
    }

    /// Corrects the load factor, moves the state along the direction as far as that lowers the energy, and records the curvature. Where the
    /// motion does not have its value, the state takes the whole direction.
    fn search(
        &mut self,
        at: &mut Iteration<'_>,
        mut search_direction: Direction,
        has_value: bool,
    ) -> Iterate {
        let is_one_way = at.number > ONE_WAY_AFTER;
        let (equations, state) = (&mut *at.equations, &mut *at.state);
        let is_short = shorten(equations, &mut search_direction.step);
        let Direction {
            force,
            step,
            load_change,
        } = search_direction;
        state.load_factor += load_change;
        let (start, subdomain) = (state.displacement.clone(), equations.subdomain().clone());
        let work = dot_of_all(&subdomain, &force, &step);
        let most = match equations.contact.surfaces.is_empty() {
            true => TRIES,
            false => TRIES_IN_CONTACT,
        };
        let mut along = |part: f64| {
            state.displacement.clone_from(&start);
            equations.add_correction(state, part, &step);
            equations.prescribe(state);
            let iterate = softened(equations, state, is_one_way);
            let left = equations.out_of_balance(state, &iterate);
            (dot_of_all(&subdomain, &left, &step), (iterate, left))
        };
        let whole = along(1.0);
        // Surfaces would not detect each other beyond the end of a shortened correction.
        let is_searched = has_value && !(is_short && whole.0 >= 0.0);
        let tries = if is_searched { most } else { 1 };
        let (part, (iterate, left)) = line_search::part(work, whole, tries, along);
        let change: Vec<f64> = force.iter().zip(&left).map(|(was, is)| was - is).collect();
        let moved: Vec<f64> = step.iter().map(|it| part * it).collect();
        let work = dot_of_all(&subdomain, &moved, &change);
        self.earlier.curvature.learn(moved, change, work);
        iterate
    }
}

/// Shortens a correction where surfaces would move too far at once to see each other; returns whether it does.
fn shorten(equations: &Equations, step: &mut [f64]) -> bool {
    let surfaces = &equations.contact.surfaces;
    if surfaces.is_empty() {
        return false;
    }
    let part = surfaces.part_within_reach(&equations.at_degrees_of_freedom(step), &[]);
    step.iter_mut().for_each(|it| *it *= part);
    part < 1.0
}

/// Softens the bonds of an iterate and measures it.
fn softened(equations: &mut Equations, state: &mut State, is_one_way: bool) -> Iterate {
    let deformations = equations.deformations(state);
    let State {
        softening, intact, ..
    } = &mut *state;
    let criteria = &equations.problem.criteria;
    softening.follow(criteria, intact, &deformations, is_one_way);
    equations.measure_deformed(state, deformations)
}
