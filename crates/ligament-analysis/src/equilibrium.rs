//! Equilibrium of the intact bonds, updated while bonds break.

mod accuracy;
mod active_set;
mod contact_line;
mod curvature;
mod dissipating;
mod earlier_equilibria;
mod equations;
mod external;
mod falling;
mod intact;
mod iteration;
mod line;
mod line_search;
mod mechanism;
mod newton;
mod on_rigid;
mod residual;
mod rigid;
mod secant;
mod target;

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
use crate::contact::faces::FacePairs;
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
use earlier_equilibria::EarlierEquilibria;
use equations::Equations;
use iteration::Method;
use newton::Newton;
use secant::Secant;

pub(crate) use contact_line::Heading;
pub(crate) use dissipating::Dissipation;
pub(crate) use residual::ROUNDING;
pub(crate) use target::Target;

/// Quantity prescribed in place of the load factor, which is then an unknown.
#[derive(Debug, Clone)]
pub(crate) enum ControlledQuantity {
    /// A motion (a weighted sum of displacements).
    Motion(Target),
    /// The energy dissipated by bonds.
    Energy(Dissipation),
}

/// Equilibrium equations of a problem, updated while its bonds break.
pub struct Equilibrium {
    equations: Equations,
    connectivity: Connectivity,
    /// Global numbers of the local bonds.
    numbers: Arc<BondNumbers>,
    /// Whether bonds may soften, and are not only intact or broken.
    softens: bool,
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
        })
    }

    /// Appends the bytes from which the equilibrium is restored bit for bit.
    pub(crate) fn write(&self, out: &mut dyn Sink) {
        self.equations.write(&self.numbers, out);
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
        let balanced = equilibrium
            .equations
            .restore(&state, &equilibrium.numbers, from)?;
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
            earlier,
            ..
        } = &mut self.equations;
        let system = &*problem.system;
        self.connectivity = Connectivity::held(system, &state.intact);
        contact.faces = FacePairs::new(system, &state.intact);
        *earlier = EarlierEquilibria::default();
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
        let growth = line::growth(&mut self.equations, state, loads)?;
        match line::load_on_added_support(&self.equations, state, &growth, loads) {
            Some(reason) => Err(reason),
            None => Ok(growth),
        }
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
            if let Some(here) = subdomain.local_index(dof, layout.components.len()) {
                state.held[here] = true;
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
        let target = match &self.held {
            Some(ControlledQuantity::Energy(goal)) => {
                let attempt = dissipating::balance(equations, state, breakage, goal, observer)?;
                return Ok(self.accepted(attempt, state));
            }
            Some(ControlledQuantity::Motion(target)) => Some(target),
            None => None,
        };
        let method: &mut dyn Method = if self.softens {
            &mut Secant::new(target)
        } else if target.is_none() && equations.problem.may_press() {
            &mut ActiveSet::new(equations)
        } else {
            &mut Newton { target }
        };
        let attempt = iteration::balance(equations, state, breakage, method, observer)?;
        Ok(self.accepted(attempt, state))
    }

    /// Accepts an equilibrium, from which surfaces and friction continue, unless forces on a part do not balance or surfaces missed each
    /// other.
    fn accepted(&self, attempt: Attempt, state: &mut State) -> Attempt {
        let Attempt::Balanced(balanced) = &attempt else {
            return attempt;
        };
        let fragments = self.connectivity.fragments();
        let imbalance = external::imbalance(&self.equations, state, balanced, fragments);
        let reason = imbalance.or_else(|| self.missed(state, balanced));
        if reason.is_none() {
            self.equations.contact.settle(state, balanced);
        }
        reason.map_or(attempt, Attempt::Unbalanced)
    }
}
