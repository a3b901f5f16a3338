//! Equilibrium of the intact bonds, updated while bonds break.

mod accuracy;
mod active_set;
mod contact_line;
mod curvature;
mod equations;
mod line_search;
mod newton;
mod path_following;
mod residual;
mod rigid;
mod secant;

use std::io::Read;
use std::sync::Arc;
use std::time::Instant;

use ligament_linalg::{Factorisation, ForwardSubstituted};
use ligament_model::failure::Criteria;

use crate::balanced::{Attempt, Balanced, Stability};
use crate::bond_numbers::BondNumbers;
use crate::breakage::Breakage;
use crate::checkpoint::CheckpointError;
use crate::connectivity::Fragments;
use crate::connectivity::decremental::Connectivity;
use crate::contact::faces::{self, FacePairs};
use crate::costs::Costs;
use crate::error::SetupError;
use crate::history::{Observer, ObserverError};
use crate::load_program::LoadProgram;
use crate::problem::Problem;
use crate::serial::Sink;
use crate::solver::SolverChoice;
use crate::state::State;
use crate::stiffness::Stiffness;
use crate::tangent::IntactSolver;
use crate::unbalanced::Unbalanced;
use crate::unknowns::Unknowns;
use active_set::ActiveSet;
use equations::{Equations, Method};
use newton::Newton;
use secant::{EarlierEquilibria, Secant};

pub(crate) use contact_line::Heading;
pub(crate) use path_following::{ControlledQuantity, Dissipation, Target};
pub(crate) use residual::ROUNDING;

/// Resultant, relative to the sum of the sizes of the external forces on a part and the largest force at a point of the body, above
/// which the forces do not balance: self-balanced loads are accepted to the same tolerance, and solutions are far more accurate.
const BALANCED: f64 = 1e-6;

/// Number of sums along one axis.
const SUMS: usize = 3;

/// Resultant along one axis, sum of the sizes of the forces, and sum of their rounding errors, N.
type Sum = [f64; SUMS];

/// Equilibrium equations of a problem, updated while its bonds break.
pub struct Equilibrium {
    equations: Equations,
    connectivity: Connectivity,
    /// Global numbers of the local bonds.
    numbers: Arc<BondNumbers>,
    /// Whether bonds may soften, and are not only intact or broken.
    softens: bool,
    /// Earlier equilibria of softening bonds.
    earlier: EarlierEquilibria,
    held: Option<ControlledQuantity>,
}

/// Equilibrium equations of an intact body with its factor, which do not change: each run begins with a copy.
pub(crate) struct IntactEquilibrium {
    equations: Equations<dyn IntactSolver>,
    connectivity: Connectivity,
    numbers: Arc<BondNumbers>,
    /// Whether bonds may soften, and are not only intact or broken.
    softens: bool,
}

impl IntactEquilibrium {
    /// A copy for a run with other criteria of the same bonds and measures.
    pub(crate) fn judged_by(&self, criteria: &Arc<Criteria>) -> Equilibrium {
        let solver = self.equations.solver.copied();
        let mut equations = self.equations.with_solver(solver);
        equations.problem.criteria = criteria.clone();
        Equilibrium {
            equations,
            connectivity: self.connectivity.clone(),
            numbers: self.numbers.clone(),
            softens: self.softens,
            earlier: EarlierEquilibria::default(),
            held: None,
        }
    }
}

impl Equilibrium {
    /// The present equations for runs that begin from here; None where the solver cannot be copied.
    pub(crate) fn intact(&self) -> Option<IntactEquilibrium> {
        let solver = self.equations.solver.intact()?;
        Some(IntactEquilibrium {
            equations: self.equations.with_solver(solver),
            connectivity: self.connectivity.clone(),
            numbers: self.numbers.clone(),
            softens: self.softens,
        })
    }

    /// Numbers the unknowns and analyses the sparsity pattern, without factorising. `energy_tolerance` is the relative change of
    /// the energy that ends an iteration (NHPD eq. 21). Bonds are taken as intact or broken, without softening.
    ///
    /// # Errors
    ///
    /// If the factor is too large.
    pub fn new(problem: &Problem, energy_tolerance: f64) -> Result<Self, SetupError> {
        let numbers = BondNumbers::new(&*problem.system)?;
        Self::numbered(problem, numbers, energy_tolerance)
    }

    /// Equations of bonds with known global numbers.
    fn numbered(
        problem: &Problem,
        numbers: BondNumbers,
        energy_tolerance: f64,
    ) -> Result<Self, SetupError> {
        let numbers = Arc::new(numbers);
        Ok(Self {
            held: None,
            equations: Equations::new(problem, &numbers, energy_tolerance)?,
            numbers,
            connectivity: Connectivity::new(&*problem.system),
            softens: false,
            earlier: EarlierEquilibria::default(),
        })
    }

    /// Appends the bytes from which the equilibrium is restored bit for bit.
    pub(crate) fn write(&self, out: &mut dyn Sink) {
        let Equations {
            problem, unknowns, ..
        } = &self.equations;
        self.equations.write(out);
        if problem.criteria.soften() {
            self.earlier.write_all(&self.numbers, unknowns, out);
        }
    }

    /// Restores the equilibrium, its state and its measured quantities from bytes of [`Equilibrium::write`]; `numbers` are the
    /// global numbers of the local bonds.
    ///
    /// # Errors
    ///
    /// If the bytes are damaged or belong to another model, or if the factor differs in any bit.
    pub(crate) fn restored(
        problem: &Problem,
        energy_tolerance: f64,
        (numbers, mut state): (BondNumbers, State),
        from: &mut dyn Read,
    ) -> Result<(Self, State, Balanced), SetupError> {
        let n_bonds = problem.system.ends.len();
        let fits = state.fits(&*problem.system, n_bonds, &problem.criteria)
            && state.surfaces.fits(&problem.contact);
        if problem.system.subdomain.any(!fits) {
            return Err(CheckpointError::OtherModel.into());
        }
        let mut equilibrium = Self::numbered(problem, numbers, energy_tolerance)?;
        state = equilibrium.known(state);
        equilibrium.connectivity = Connectivity::held(&*problem.system, &state.intact);
        let Self {
            equations,
            numbers,
            earlier,
            ..
        } = &mut equilibrium;
        let balanced = equations.restore(&state, numbers, from)?;
        if problem.criteria.soften() {
            *earlier = EarlierEquilibria::restored(from, (numbers, &equations.unknowns))?;
        }
        if !state.softening.remaining.is_empty() {
            equilibrium.soften();
        }
        Ok((equilibrium, state, balanced))
    }

    /// Switches to the iteration for softening bonds if the criteria soften.
    pub fn soften(&mut self) {
        self.softens |= self.equations.problem.criteria.soften();
    }

    /// Replaces the loads of the problem by loads that prescribe the same degrees of freedom.
    pub fn load_with(&mut self, loads: Arc<dyn LoadProgram>) {
        self.equations.load_with(loads);
    }

    /// Sets the quantity prescribed in later equilibria; None solves at the load factor of the state.
    pub(crate) fn aim(&mut self, held: Option<ControlledQuantity>) {
        self.held = held;
    }

    /// Unknowns of the equations.
    pub fn unknowns(&self) -> &Unknowns {
        &self.equations.unknowns
    }

    /// Numbering, sparsity pattern and symbolic factor of the stiffness; none where the solver has no matrix.
    pub fn stiffness(&self) -> Option<&Stiffness> {
        self.equations.stiffness.as_deref()
    }

    /// Solver that was chosen.
    pub fn choice(&self) -> &SolverChoice {
        &self.equations.choice
    }

    /// Connected parts of the body.
    pub fn fragments(&self) -> &Fragments {
        self.connectivity.fragments()
    }

    /// Relative residual to which an iterative solver solves; none for a direct one.
    pub(crate) fn tolerance(&self) -> Option<f64> {
        self.equations.solver.tolerance()
    }

    /// Accumulated costs of the equations.
    pub fn costs(&self) -> &Costs {
        &self.equations.costs
    }

    /// Adds the costs of the equations before these.
    pub(crate) fn add_costs(&mut self, before: &Costs) {
        self.equations.costs = before.plus(&self.equations.costs);
    }

    /// Largest force at a point in all measured states so far, in equilibrium or not, N.
    pub(crate) fn largest_force(&self) -> f64 {
        self.equations.accuracy.largest_extents.force()
    }

    /// Diagonal of the box around the body, m.
    pub(crate) fn size(&self) -> f64 {
        self.equations.accuracy.size
    }

    /// Energy of the rounding of positions, J: the rounding of the size of the body against its stiffest point and against the largest force at a
    /// point, N, over this size.
    pub(crate) fn energy_of_rounding(&self, force: f64) -> f64 {
        let accuracy = &self.equations.accuracy;
        f64::EPSILON * accuracy.size * (accuracy.stiffest * accuracy.size + force)
    }

    /// Number of negative eigenvalues of the stiffness; 0 where the solver does not know it.
    pub fn negative_eigenvalues(&self) -> usize {
        let inertia = self.equations.solver.inertia();
        inertia.map_or(0, |inertia| inertia.negative)
    }

    /// Inertia of the stiffness and of its rotation block for the bonds of an equilibrium state; none where the solver does not
    /// know it.
    pub fn stability(&self, state: &State) -> Result<Option<Stability>, SetupError> {
        let inertia = self.equations.solver.inertia();
        let Some((inertia, stiffness)) = inertia.zip(self.equations.stiffness.as_ref()) else {
            return Ok(None);
        };
        Ok(Some(Stability {
            negative: inertia.negative,
            expected: stiffness.negative_rotations(state)?,
        }))
    }

    /// Adds the time since `start` to the cost of bond computations.
    pub(crate) fn count_bond_work(&mut self, start: Instant) {
        self.equations.costs.bonds += start.elapsed();
    }

    /// Global numbers of the local bonds.
    pub(crate) fn numbers(&self) -> &BondNumbers {
        &self.numbers
    }

    /// Breaks bonds, given by global numbers: marks them as broken in the state and fixes detached parts.
    ///
    /// Must be called before the first solution with all bonds that the state lacks, and later with every bond that breaks; the
    /// next equilibrium is the one after the breakage.
    pub fn break_bonds(&mut self, state: &mut State, bonds: &[u32]) -> Breakage {
        let Equations {
            problem,
            unknowns,
            contact,
            costs,
            ..
        } = &mut self.equations;
        let (system, loads) = (&*problem.system, &problem.loads);
        let expansion = loads.thermal_strain(state.load_factor);
        let local = self.numbers.all_local(bonds);
        let mut breakage = Breakage::new(system, expansion, state, &local);
        breakage.bonds = bonds.to_vec();
        let start = Instant::now();
        self.connectivity
            .bonds_broke(system, &mut state.intact, &local);
        let held = &state.held;
        breakage.holds = self.connectivity.missing_supports(
            system,
            loads.restraints(),
            |dof| loads.is_prescribed(dof) || held[dof],
            |dof| unknowns.is_unknown(dof),
        );
        let (subdomain, layout) = (&system.subdomain, system.layout);
        for hold in &breakage.holds {
            let dof = subdomain.local_index(hold.degree_of_freedom, layout.components.len());
            if let Some(dof) = dof {
                state.held[dof] = true;
            }
        }
        contact.faces = FacePairs::new(system, &state.intact);
        costs.connectivity += start.elapsed();
        breakage
    }

    /// Takes breakages back, so that the equations hold for the bonds of a state again.
    pub(crate) fn return_to(&mut self, state: &State) {
        let Equations {
            problem,
            contact,
            solver,
            ..
        } = &mut self.equations;
        let system = &*problem.system;
        self.connectivity = Connectivity::held(system, &state.intact);
        contact.faces = FacePairs::new(system, &state.intact);
        self.earlier = EarlierEquilibria::default();
        solver.discard();
    }

    /// Measures a state that is known to be in equilibrium at its load factor, without solving.
    pub(crate) fn measured(&mut self, state: &mut State) -> Balanced {
        self.equations.measured(state)
    }

    /// Rate of the displacements with the load factor, shape (n_degrees_of_freedom), for the bonds of an equilibrium state under
    /// the given loads at load factor 1; the loads must prescribe the same degrees of freedom as the loads of the problem.
    ///
    /// # Errors
    ///
    /// If the stiffness has no factor, an iterative solver does not converge, or an added support would carry a load.
    pub(crate) fn growth(
        &mut self,
        state: &mut State,
        loads: &dyn LoadProgram,
    ) -> Result<Vec<f64>, Unbalanced> {
        let equations = &mut self.equations;
        let growth = equations.displacement_rate(state, loads)?;
        if equations.subdomain().any(state.held.contains(&true)) {
            let line = equations::at_one(state, growth.clone());
            let forces = equations.line_forces(&line, loads, &[]);
            equations
                .load_on_added_support(&forces)
                .map_or(Ok(()), Err)?;
        }
        Ok(growth)
    }

    /// Rate of the displacements with the load factor in a direction, shape (n_degrees_of_freedom), where contacts open and close, for the
    /// bonds of an equilibrium state.
    ///
    /// # Errors
    ///
    /// If the stiffness has no factor, the rate is not found, or an added support would carry a load.
    pub(crate) fn growth_in_contact(
        &mut self,
        state: &mut State,
        heading: Heading,
    ) -> Result<Vec<f64>, Unbalanced> {
        let loads = self.equations.problem.loads.clone();
        contact_line::growth(&mut self.equations, state, &*loads, heading)
    }

    /// Change of the load factor along a rate of the displacements (n_degrees_of_freedom) to where the first contact opens or closes.
    pub(crate) fn reach(&mut self, state: &State, growth: &[f64], heading: Heading) -> f64 {
        let loads = self.equations.problem.loads.clone();
        contact_line::reach(&mut self.equations, state, (&*loads, growth), heading)
    }

    /// Measures a state known to be in equilibrium, whose contacts become the contacts of the last equilibrium.
    pub(crate) fn arrived(&mut self, state: &mut State) -> Balanced {
        let balanced = self.equations.measured(state);
        self.equations.contact.settle(state, &balanced);
        balanced
    }

    /// Reason why a balanced state is no equilibrium after the last one: surfaces moved through each other unseen on the way.
    pub(crate) fn missed(&self, state: &State, balanced: &Balanced) -> Option<Unbalanced> {
        self.equations.contact.missed(state, &balanced.touching)
    }

    /// Whether [`Equilibrium::update_and_forward_solve`] can update the factor for a breakage.
    pub(crate) fn can_update(&self, breakage: &Breakage) -> bool {
        breakage.holds.is_empty() && self.equations.solver.can_update(breakage.n_elements())
    }

    /// Updates the factor for a breakage and passes the half-solved correction to `finish`, which does the backward substitution;
    /// None where the update or `finish` failed, and the factor must be computed anew.
    pub(crate) fn update_and_forward_solve<T>(
        &mut self,
        state: &State,
        breakage: &Breakage,
        finish: impl FnOnce(&dyn Factorisation, &ForwardSubstituted) -> Option<T>,
    ) -> Option<T> {
        let Equations {
            solver,
            problem,
            costs,
            ..
        } = &mut self.equations;
        let expansion = problem.loads.thermal_strain(state.load_factor);
        let half = solver.update_and_forward_solve(breakage, state, expansion, costs)?;
        let start = Instant::now();
        let finished = finish(half.factor, &half.correction);
        costs.backward += start.elapsed();
        costs.solves += 1;
        if finished.is_none() {
            solver.discard();
        }
        finished
    }

    /// The size of the body, or its largest prescribed displacement where that is larger, m.
    pub(crate) fn size_or_prescribed(&self, state: &State) -> f64 {
        self.equations.accuracy.size_or_prescribed(state)
    }

    /// Degree of freedom (of the body) that moves farthest, where a body with broken or softened bonds moves farther than its own
    /// size.
    pub(crate) fn beyond_size(&self, state: &State) -> Option<usize> {
        self.equations.motions().beyond_size(state)
    }

    /// Adds supports to a state at degrees of freedom (of the body) for motions without stiffness.
    pub(crate) fn hold(&mut self, state: &mut State, dofs: &[usize]) {
        let Equations {
            problem, solver, ..
        } = &mut self.equations;
        let (subdomain, layout) = (&problem.system.subdomain, problem.system.layout);
        for &dof in dofs {
            if let Some(local) = subdomain.local_index(dof, layout.components.len()) {
                state.held[local] = true;
            }
        }
        solver.discard();
    }

    /// Factor of the stiffness; None where there is none at present.
    pub(crate) fn factor(&self) -> Option<&dyn Factorisation> {
        self.equations.solver.factor()
    }

    /// Invalidates the displacements of the state that this process does not know.
    pub(crate) fn known(&self, mut state: State) -> State {
        let halo = &self.equations.halo;
        halo.poison_unknown(&mut state.displacement);
        state
    }

    /// Brings the state into equilibrium at its load factor after the last breakage, which is empty where none occurred since the
    /// last equilibrium.
    ///
    /// # Errors
    ///
    /// If the observer fails. A missing equilibrium is not an error.
    pub fn balance(
        &mut self,
        state: &mut State,
        breakage: &Breakage,
        observer: &mut dyn Observer,
    ) -> Result<Attempt, ObserverError> {
        let equations = &mut self.equations;
        let is_softening = self.softens || matches!(self.held, Some(ControlledQuantity::Energy(_)));
        let (mut target, mut search) = match &self.held {
            None => (None, None),
            Some(ControlledQuantity::Motion(target)) => (Some(target.clone()), None),
            Some(ControlledQuantity::Energy(goal)) => {
                match path_following::begin(equations, state, breakage, goal) {
                    Ok(first) => first,
                    Err(reason) => return Ok(Attempt::Unbalanced(reason)),
                }
            }
        };
        loop {
            let target_now = target.as_ref();
            let method: &mut dyn Method = if is_softening {
                &mut Secant::new(target_now, &mut self.earlier)
            } else if target.is_none() && equations.problem.may_press() {
                &mut ActiveSet::new(equations)
            } else {
                &mut Newton { target: target_now }
            };
            let attempt = equations::balance(equations, state, breakage, method, observer)?;
            target = match (&mut search, &attempt) {
                (Some(search), Attempt::Balanced(it)) => search.next(&equations.problem, state, it),
                _ => None,
            };
            if target.is_none() {
                return Ok(self.accepted(attempt, state));
            }
        }
    }

    /// Accepts an equilibrium, from which surfaces and friction continue, unless forces on a part do not balance or surfaces missed each
    /// other.
    fn accepted(&self, attempt: Attempt, state: &mut State) -> Attempt {
        let Attempt::Balanced(balanced) = &attempt else {
            return attempt;
        };
        let fragments = self.connectivity.fragments();
        let imbalance = imbalance(&self.equations, state, balanced, fragments);
        let reason = imbalance.or_else(|| self.missed(state, balanced));
        if reason.is_none() {
            self.equations.contact.settle(state, balanced);
        }
        reason.map_or(attempt, Attempt::Unbalanced)
    }
}

/// First part of the body on which the external forces of a state do not balance along some axis.
///
/// Moments are not checked, except by the residual: bonds that resist shear between points without rotations exert couples.
fn imbalance(
    equations: &Equations,
    state: &State,
    balanced: &Balanced,
    fragments: &Fragments,
) -> Option<Unbalanced> {
    let layout = equations.layout();
    let n_components = layout.components.len();
    let external = external_forces(equations, state, balanced);
    let surfaces = &equations.contact.surfaces;
    let rounding = (equations.accuracy).rounding(layout, state, (surfaces, &balanced.touching));
    let mut sums = vec![Sum::default(); n_components * fragments.len()];
    let of_points = external
        .chunks(n_components)
        .zip(rounding.chunks(n_components));
    let subdomain = equations.subdomain();
    let of_each = (0..).zip(of_points.zip(&fragments.of_point));
    let owned = of_each.filter(|(point, _)| subdomain.owns(*point));
    for (_, ((forces, rounding), &fragment)) in owned {
        let of_part = &mut sums[n_components * fragment as usize..];
        for ((sum, force), rounding) in of_part.iter_mut().zip(forces).zip(rounding) {
            let of_point = [*force, force.abs(), *rounding];
            sum.iter_mut()
                .zip(of_point)
                .for_each(|(it, part)| *it += part);
        }
    }
    subdomain.all_reduce_sum(sums.as_flattened_mut());
    let of_body = equations.largest_force(balanced.internal.force_scale);
    let bound = equations.accuracy.bound(equations.loaded(state));
    let is_off = |(place, [resultant, size, rounding]): &(usize, &Sum)| {
        let is_force = !layout.components[place % n_components].is_rotation();
        // A resultant that is not a number is out of balance.
        let is_balanced = resultant.abs() <= BALANCED * (size + of_body).min(bound) + rounding;
        is_force && !is_balanced
    };
    let (place, &[resultant, size, _]) = sums.iter().enumerate().find(is_off)?;
    let extent = fragments.extents[place / n_components];
    Some(Unbalanced::NoForceBalance {
        component: layout.components[place % n_components],
        resultant,
        size,
        points: extent.n_points,
        first: extent.first,
    })
}

/// Forces on the points of each part by loads, supports and other parts, shape (n_degrees_of_freedom).
fn external_forces(equations: &Equations, state: &State, balanced: &Balanced) -> Vec<f64> {
    let (problem, layout) = (&equations.problem, equations.layout());
    // External forces at free points are the given loads, at other points the internal forces.
    let mut external = balanced.internal.values.clone();
    let dofs = equations.degrees_of_freedom();
    let given = problem.loads.forces(state.load_factor, dofs);
    for (&dof, given) in dofs.iter().zip(given) {
        if !state.held[dof as usize] && !problem.loads.reacts_at(dof as usize) {
            external[dof as usize] = given;
        }
    }
    let closed = balanced.closed.iter();
    let closed_forces = closed.flat_map(|it| faces::end_forces(it, layout));
    // Forces that other parts exert through closed faces are external to a part.
    for (dof, force) in closed_forces {
        external[dof] -= force;
    }
    let surfaces = equations.contact.surfaces.problem();
    let by_surfaces = balanced.touching.forces(surfaces, external.len());
    for (sum, force) in external.iter_mut().zip(by_surfaces) {
        *sum += force;
    }
    external
}
