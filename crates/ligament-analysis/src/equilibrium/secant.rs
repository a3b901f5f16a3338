//! Equilibrium of bonds that soften, by a quasi-Newton iteration from their secant stiffness.

use std::io::Read;

use ligament_model::element::{BondDeformation, StiffnessFactors, Term};
use ligament_model::failure::{CriteriaInState, Weakened};
use ligament_model::prefix_sums::exclusive_prefix_sums;
use ligament_model::subdomain::Subdomain;
use rayon::prelude::*;

use super::curvature::Curvature;
use super::equations::{Equations, Iterate, Iteration, Method};
use super::line_search;
use super::path_following::Target;
use super::residual::RESIDUAL_TOLERANCE;
use crate::bond_numbers::BondNumbers;
use crate::checkpoint::CheckpointError;
use crate::lists_of_all::{read_by_index, write_by_index};
use crate::problem::Problem;
use crate::serial::{Serial, Sink};
use crate::state::State;
use crate::tangent::AllowedResidual;
use crate::unbalanced::Unbalanced;
use crate::unknowns::Unknowns;
use crate::vectors::dot_of_all;

/// Largest ratio of a load step to the one before for which the last step is extrapolated.
const GROWTH: f64 = 2.0;

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
/// Three measures lengthen it: the [falling stiffness](falling_terms) of bonds that are loaded further, where the stiffness is still
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
    /// Place of the earlier equilibria between iterations that reach one.
    kept: &'a mut EarlierEquilibria,
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
        self.earlier = std::mem::take(self.kept);
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
        let extrapolated = softened(at.equations, &mut ahead, false);
        let most = (self.target).map_or(iterate.residual.relative, |_| LARGEST_AHEAD);
        if extrapolated.residual.relative < most {
            *at.state = ahead;
            return extrapolated;
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
        self.earlier.learn(at.state, self.is_new);
        *self.kept = std::mem::take(&mut self.earlier);
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
    pub(super) fn new(target: Option<&'a Target>, kept: &'a mut EarlierEquilibria) -> Self {
        Self {
            target,
            kept,
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
        let falling = falling_terms(&equations.problem, state, &iterate.deformations);
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
            let (mut motion, rate) = equations.rate(state, &*target.rate);
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
            load_change = target.constrain(equations, &mut step, state, &growth.motion)?;
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

/// The bonds of a state that are loaded further at deformations (n_bonds), ascending, each with a term c g g^T, c < 0, that its tangent
/// has beside its secant: what the tangent has less than the secant.
///
/// A bond with the stiffness K and the deformation d has the force omega K d, with the share omega that its law leaves at the largest
/// kappa = e/e_0 so far. The measure e is homogeneous in d; where e^2 is proportional to d . K d (the energy of the bond, or its stretch
/// with the axial stiffness alone), the tangent in further loading is
///
/// omega K + omega' kappa (K d) (K d)^T / (d . K d), omega' < 0.
///
/// Other measures, strains that take no part in the measure and cells of a volumetric stiffness keep their secants, so that the stiffness
/// stays symmetric.
fn falling_terms(
    problem: &Problem,
    state: &State,
    deformations: &[BondDeformation],
) -> Vec<(u32, Term)> {
    let criteria = state.softening.criteria(&problem.criteria);
    let of_bond = |bond: usize| {
        let deformation = &deformations[bond];
        let (place, slope) = (state.softening).fall(&criteria, bond, deformation)?;
        let strains = strains_of_measure(&criteria, place, deformation)?;
        let terms = problem.system.terms(&state.intact, bond, &strains);
        let (mut energy, mut force) = (0.0, Vec::new());
        for (rigidity, entries) in terms {
            let strain: f64 = (entries.iter())
                .map(|&(dof, value)| value * state.displacement[dof])
                .sum();
            energy += rigidity * strain * strain;
            let entries = entries.into_iter();
            force.extend(entries.map(|(dof, value)| (dof, rigidity * strain * value)));
        }
        (energy > 0.0 && slope < 0.0).then(|| (bond as u32, (slope / energy, force)))
    };
    let bonds = (0..deformations.len()).into_par_iter();
    bonds
        .filter(|bond| state.intact[*bond])
        .filter_map(of_bond)
        .collect()
}

/// Factors one for the strains that the measure of a criterion has, zero for others; None where the square of the measure is no energy.
fn strains_of_measure(
    criteria: &CriteriaInState<'_>,
    place: usize,
    deformation: &BondDeformation,
) -> Option<StiffnessFactors> {
    let whole = |is: bool| if is { 1.0 } else { 0.0 };
    let is_open = deformation.stretch() > 0.0;
    let measure = criteria.criteria().list[place].measure;
    let is_energy = measure.needs_shear_stiffness();
    let is_stretch = measure.opens() && !measure.takes_rotations();
    if !(is_energy || is_stretch) {
        return None;
    }
    let axial = is_open || measure.weakens() == Weakened::Whole;
    Some(StiffnessFactors {
        axial: whole(axial),
        shear: whole(is_energy),
        rotational: 0.0,
    })
}

/// Curvature and equilibria from earlier iterations.
#[derive(Clone, Default)]
pub(super) struct EarlierEquilibria {
    /// Stiffness along the last corrections.
    pub(super) curvature: Curvature,
    /// Equilibria of the last two load steps, the older one first.
    equilibria: Vec<Precedent>,
}

/// Load factor and displacements of an earlier equilibrium.
#[derive(Clone)]
struct Precedent {
    load_factor: f64,
    /// Shape (n_degrees_of_freedom).
    displacement: Vec<f64>,
}

/// Places of the owned unknowns among the unknowns of the body, in the order of the degrees of freedom.
struct OwnUnknowns {
    places: Vec<usize>,
    n_all: usize,
}

impl OwnUnknowns {
    /// The places on this process; collective.
    fn new(subdomain: &Subdomain, unknowns: &Unknowns) -> Self {
        let layout = unknowns.layout();
        let of_points = |point: u32| unknowns.of_point(point as usize).count() as f64;
        let counts: Vec<f64> = subdomain.owned().map(of_points).collect();
        let starts = exclusive_prefix_sums(subdomain, &counts);
        let mut next: Vec<usize> = starts.into_iter().map(|it| it as usize).collect();
        let place = |dof: &u32| {
            let next = &mut next[subdomain.row(layout.point(*dof as usize))?];
            *next += 1;
            Some(*next - 1)
        };
        Self {
            places: unknowns
                .degrees_of_freedom()
                .iter()
                .filter_map(place)
                .collect(),
            n_all: subdomain.count(unknowns.len()),
        }
    }
}

impl EarlierEquilibria {
    /// Restores the earlier equilibria from bytes of [`EarlierEquilibria::write_all`].
    ///
    /// # Errors
    ///
    /// If the bytes are damaged or belong to another model.
    pub(super) fn restored(
        from: &mut dyn Read,
        (numbers, unknowns): (&BondNumbers, &Unknowns),
    ) -> Result<Self, CheckpointError> {
        let own = OwnUnknowns::new(numbers.subdomain(), unknowns);
        let values = |from: &mut dyn Read| match usize::read(from)? {
            count if count == own.n_all => Ok(read_by_index(
                count,
                &0.0,
                own.places.iter().copied(),
                from,
            )?),
            _ => Err(CheckpointError::OtherModel),
        };
        let curvature = Curvature::read(values, from)?;
        let count = usize::read(from)?;
        let n_components = unknowns.layout().components.len();
        let mut precedent = || {
            Ok(Precedent {
                load_factor: Serial::read(from)?,
                displacement: numbers.read_points(n_components, 0.0, from)?,
            })
        };
        let equilibria: Result<Vec<Precedent>, CheckpointError> =
            (0..count).map(|_| precedent()).collect();
        let earlier = Self {
            curvature,
            equilibria: equilibria?,
        };
        let n = unknowns.layout().n_degrees_of_freedom();
        let is_whole = |it: &Precedent| it.displacement.len() == n;
        match earlier.equilibria.iter().all(is_whole) {
            true => Ok(earlier),
            false => Err(CheckpointError::OtherModel),
        }
    }

    /// Appends the earlier equilibria at the unknowns and points of all processes, valid only on rank 0; collective.
    pub(super) fn write_all(&self, numbers: &BondNumbers, unknowns: &Unknowns, out: &mut dyn Sink) {
        let own = OwnUnknowns::new(numbers.subdomain(), unknowns);
        let values = |values: &[f64], out: &mut dyn Sink| {
            let numbered = own.places.iter().copied().zip(values.iter().copied());
            write_by_index(numbers.subdomain(), own.n_all, numbered, 0.0, out);
        };
        self.curvature.write(values, out);
        self.equilibria.len().write(out);
        let n_components = unknowns.layout().components.len();
        for Precedent {
            load_factor,
            displacement,
        } in &self.equilibria
        {
            load_factor.write(out);
            numbers.write_points((displacement, n_components), 0.0, out);
        }
    }

    /// Whether the last equilibrium has the load of a state, or the target value of a motion: then only bonds have changed since.
    pub(super) fn has_load(&self, state: &State, target: Option<&Target>) -> bool {
        let last = self.equilibria.last();
        last.is_some_and(|last| match target {
            None => last.load_factor == state.load_factor,
            Some(target) => target.is_met(&last.displacement),
        })
    }

    /// Records an equilibrium; one whose load is not new replaces the one before it.
    pub(super) fn learn(&mut self, state: &State, is_new: bool) {
        if !is_new {
            self.equilibria.pop();
        } else if self.equilibria.len() == 2 {
            self.equilibria.remove(0);
        }
        self.equilibria.push(Precedent {
            load_factor: state.load_factor,
            displacement: state.displacement.clone(),
        });
    }

    /// Extrapolates the last load step to the load factor of the state or to the target value of a motion; None where the direction
    /// reverses or the step grows too much.
    pub(super) fn ahead(&self, state: &State, target: Option<&Target>) -> Option<State> {
        let [before, last] = self.equilibria.as_slice() else {
            return None;
        };
        let part = match target {
            None => {
                (state.load_factor - last.load_factor) / (last.load_factor - before.load_factor)
            }
            Some(target) => {
                let [first, second] = [before, last].map(|it| target.motion(&it.displacement));
                (target.value - second) / (second - first)
            }
        };
        if !(part > 0.0 && part <= GROWTH) {
            return None;
        }
        let mut ahead = state.clone();
        if target.is_some() {
            ahead.load_factor += part * (last.load_factor - before.load_factor);
        }
        let changes = last.displacement.iter().zip(&before.displacement);
        for (value, (last, before)) in ahead.displacement.iter_mut().zip(changes) {
            *value += part * (last - before);
        }
        Some(ahead)
    }
}
