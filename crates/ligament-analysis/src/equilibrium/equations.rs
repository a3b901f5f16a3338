//! Equations of a problem, and the iteration to their solution: one loop for all ways to correct a state.

use std::io::Read;
use std::sync::{Arc, OnceLock};
use std::time::Instant;

use ligament_linalg::FactorKind;
use ligament_model::deformation::Deformations;
use ligament_model::subdomain::Subdomain;
use ligament_model::surface::Vector;
use ligament_model::tensor::norm;
use ligament_model::thermal::ThermalStrain;

use super::accuracy::{Accuracy, Loaded, Motions};
use super::residual::{Extents, OF_GAPS, RESIDUAL_TOLERANCE, ROUNDING, Residual, Rounded};
use crate::balanced::{Attempt, Balanced};
use crate::bond_numbers::BondNumbers;
use crate::breakage::Breakage;
use crate::checkpoint::CheckpointError;
use crate::contact::faces::FacePairs;
use crate::contact::{ContactSearch, Contacts, Touching};
use crate::costs::Costs;
use crate::error::SetupError;
use crate::halo::HaloExchange;
use crate::history::{Observer, ObserverError};
use crate::internal::{BondSweep, InternalForces};
use crate::load_program::LoadProgram;
use crate::problem::Problem;
use crate::serial::{Serial, Sink};
use crate::solver::SolverChoice;
use crate::state::State;
use crate::stiffness::Stiffness;
use crate::tangent::solving::Solving;
use crate::tangent::{AllowedResidual, TangentSolver, Unsolved, distributed};
use crate::unbalanced::{Place, Unbalanced};
use crate::unknowns::{Layout, Unknowns};
use crate::vectors::dot_of_all;

/// Share of the energy of the thermal expansions below which the energy of motion of a heated body counts as zero: in a fully fixed
/// body it is a difference of sums over all bonds, of up to 10^7 terms.
const CANCELLED: f64 = 1e-10;

/// Share of their scale to which energies balance.
const ENERGY: f64 = 1e-6;

/// Error of a rate, as a share of the tolerance of an iterative solver; all states on the line have that error.
const LINE: f64 = 0.1;

/// Number of solutions after which an iterative solver is given up: each reaches its tolerance, unless it reaches rounding.
const MOST_SOLUTIONS: usize = 8;

/// Equations of a problem and their solver.
pub(super) struct Equations<S: ?Sized = dyn TangentSolver> {
    pub(super) problem: Problem,
    pub(super) unknowns: Arc<Unknowns>,
    pub(super) halo: HaloExchange,
    /// None where the solver has no matrix.
    pub(super) stiffness: Option<Arc<Stiffness>>,
    pub(super) choice: SolverChoice,
    pub(super) solver: Box<S>,
    /// Relative change of the energy that ends the iteration, NHPD eq. 21.
    pub(super) energy_tolerance: f64,
    pub(super) accuracy: Accuracy,
    pub(super) contact: ContactSearch,
    pub(super) costs: Costs,
}

impl Equations {
    /// Numbers the unknowns, analyses the sparsity pattern and chooses the solver, without factorising.
    pub(super) fn new(
        problem: &Problem,
        numbers: &Arc<BondNumbers>,
        energy_tolerance: f64,
    ) -> Result<Self, SetupError> {
        let (system, loads) = (&problem.system, &problem.loads);
        let unknowns = Unknowns::all_but(&**system, |dof| loads.is_prescribed(dof));
        let unknowns = unknowns.of_owned(&system.subdomain);
        let unknowns = Arc::new(unknowns.restrained_by(loads.restraints()));
        let Solving {
            stiffness,
            choice,
            solver,
        } = Solving::new(
            system,
            &unknowns,
            &problem.solver,
            (numbers, problem.may_press()),
        )?;
        let analysis = stiffness.as_ref().map(|it| it.analysis_time());
        let mut accuracy =
            Accuracy::new(&**system, &**loads, solver.tolerance()).with_contacts(&problem.contact);
        accuracy.is_unbounded |= !problem.contact.rigid_bodies.is_empty();
        Ok(Self {
            // The residual alone decides where strains are not linear in the displacements or forces have no energy.
            energy_tolerance: if system.element.is_linear() && system.element.has_energy() {
                energy_tolerance
            } else {
                0.0
            },
            accuracy,
            contact: ContactSearch::new(problem),
            costs: Costs {
                analysis: analysis.unwrap_or_default(),
                ..Costs::default()
            },
            halo: HaloExchange::new(problem),
            problem: problem.clone(),
            unknowns,
            stiffness,
            choice,
            solver,
        })
    }

    /// Replaces the loads by loads that prescribe the same degrees of freedom.
    pub(super) fn load_with(&mut self, loads: Arc<dyn LoadProgram>) {
        self.accuracy.load_with(&*loads);
        self.problem.loads = loads;
    }

    /// Appends the data that do not follow from the problem.
    pub(super) fn write(&self, out: &mut dyn Sink) {
        let Self {
            accuracy,
            costs,
            solver,
            problem: _,
            unknowns: _,
            halo: _,
            stiffness: _,
            choice: _,
            energy_tolerance: _,
            contact: _,
        } = self;
        accuracy.largest_extents.write(out);
        costs.write(out);
        solver.write(out);
    }

    /// Restores newly built equations from the bytes of [`Equations::write`], and measures the state, which was in equilibrium.
    pub(super) fn restore(
        &mut self,
        state: &State,
        numbers: &BondNumbers,
        from: &mut dyn Read,
    ) -> Result<Balanced, CheckpointError> {
        self.accuracy.largest_extents = Serial::read(from)?;
        let costs = Serial::read(from)?;
        let is_shared = matches!(self.choice, SolverChoice::Distributed(_));
        let layout = self.unknowns.layout();
        distributed::restore((&mut *self.solver, is_shared), (numbers, layout), from)?;
        self.contact.faces = FacePairs::new(&*self.problem.system, &state.intact);
        let measured = self.measure(state).balanced(0, Vec::new());
        self.costs = costs;
        Ok(measured)
    }

    /// Degree of freedom of each unknown, ascending.
    pub(super) fn degrees_of_freedom(&self) -> &[u32] {
        self.unknowns.degrees_of_freedom()
    }

    pub(super) fn layout(&self) -> Layout {
        self.unknowns.layout()
    }

    /// Sets the prescribed motions of a state at its load factor.
    pub(super) fn prescribe(&self, state: &mut State) {
        let loads = &self.problem.loads;
        loads.prescribe(state.load_factor, &mut state.displacement);
    }

    /// Result of a converged iteration: an equilibrium, unless added supports carry a load that no bond does.
    pub(super) fn settled(
        &self,
        iterate: Iterate,
        iterations: usize,
        mechanisms: Vec<u32>,
    ) -> Attempt {
        if let Some((dof, force)) = iterate.residual.carried {
            let place = self.place(dof as usize);
            return Attempt::Unbalanced(Unbalanced::LoadOnAddedSupport { place, force });
        }
        if !iterate.stored_energy.is_finite() {
            let energy = iterate.stored_energy;
            return Attempt::Unbalanced(Unbalanced::EnergyOutOfRange { energy });
        }
        Attempt::Balanced(iterate.balanced(iterations, mechanisms))
    }

    /// Reason why an iteration does not converge.
    pub(super) fn unsettled(&self, residual: &Residual, iterations: usize) -> Unbalanced {
        let place = self.place(residual.degree_of_freedom as usize);
        if residual.relative.is_finite() {
            Unbalanced::NotConverged {
                residual: residual.relative,
                iterations,
                place,
            }
        } else {
            Unbalanced::ForceOutOfRange { place }
        }
    }

    pub(super) fn place(&self, dof: usize) -> Place {
        Place {
            point: self.layout().point(dof),
            component: self.layout().component(dof),
        }
    }

    /// Adds a part of a correction (n_unknowns) to the displacements of a state, at ghosts as well.
    pub(super) fn add_correction(&self, state: &mut State, part: f64, correction: &[f64]) {
        for (&dof, value) in self.degrees_of_freedom().iter().zip(correction) {
            state.displacement[dof as usize] += part * value;
        }
        self.halo.update_motions(&mut state.displacement);
    }

    /// Data by which motions are judged.
    pub(super) fn motions(&self) -> Motions<'_> {
        Motions {
            accuracy: &self.accuracy,
            unknowns: &self.unknowns,
            subdomain: self.subdomain(),
            some_negative: self.some_negative(),
        }
    }

    /// Whether some bond has a negative stiffness; collective.
    fn some_negative(&self) -> bool {
        let system = &self.problem.system;
        system.rigidities().some_negative(&system.subdomain)
    }

    /// Points and bonds of the body on this process.
    pub(super) fn subdomain(&self) -> &Subdomain {
        self.halo.subdomain()
    }

    /// Scalar product of two arrays over the unknowns of all processes.
    pub(super) fn dot(&self, one: &[f64], other: &[f64]) -> f64 {
        dot_of_all(self.subdomain(), one, other)
    }

    /// Updates the solver for a breakage and adds its correction to the state; returns whether there was a correction.
    pub(super) fn follow(&mut self, state: &mut State, breakage: &Breakage) -> bool {
        let expansion = self.problem.loads.thermal_strain(state.load_factor);
        let solver = &mut self.solver;
        let correction = solver.follow(breakage, state, expansion, &mut self.costs);
        if let Some(correction) = &correction {
            self.add_correction(state, 1.0, correction);
        }
        correction.is_some()
    }

    /// Correction K du = F - K u of an iterate (NHPD eqs 19 and 20) for the relative residual `sought`, shape (n_unknowns); appends
    /// the points of mechanisms that the solver found.
    pub(super) fn correction(
        &mut self,
        state: &mut State,
        iterate: &Iterate,
        sought: f64,
        mechanisms: &mut Vec<u32>,
    ) -> Result<Vec<f64>, Unbalanced> {
        mechanisms.extend(self.make_ready(state, iterate)?);
        let force = self.out_of_balance(state, iterate);
        let left = self
            .accuracy
            .left(self.loaded(state), iterate.extents, sought);
        self.solve(state, force, left)
    }

    /// Residual forces F - K u of an iterate at the unknowns (NHPD eq. 20), shape (n_unknowns), N and N m.
    pub(super) fn out_of_balance(&self, state: &State, iterate: &Iterate) -> Vec<f64> {
        self.external_less(state, &iterate.internal)
    }

    /// Displacements K^-1 f for forces f, both of shape (n_unknowns), with the stiffness K for which the solver was [made
    /// ready](Self::make_ready).
    pub(super) fn solve(
        &mut self,
        state: &State,
        force: Vec<f64>,
        left: AllowedResidual,
    ) -> Result<Vec<f64>, Unbalanced> {
        // A direct solver finds motions without stiffness by its pivots.
        let given = self.solver.tolerance().map(|_| force.clone());
        let solution = self.solver.solve(state, force, left, &mut self.costs);
        match (solution, given) {
            (Ok(solution), None) => Ok(solution),
            (Ok(solution), Some(force)) => {
                if self.motions().is_resisted(&solution, &force) {
                    Ok(solution)
                } else {
                    Err(self.motions().unresisted(&solution, &force))
                }
            }
            (Err(Unsolved::Indefinite(motion)), Some(force)) => {
                Err(self.motions().unresisted(&motion, &force))
            }
            (Err(Unsolved::Indefinite(_)), None) => Err(Unbalanced::NegativeCurvature),
            (Err(Unsolved::Disagreement), _) => Err(Unbalanced::RanksDisagree),
        }
    }

    /// Displacements K^-1 f for two forces f, see [`solve`](Self::solve); a direct solver finds both in one pass over its factor.
    pub(super) fn solve_both(
        &mut self,
        state: &State,
        forces: [Vec<f64>; 2],
        left: AllowedResidual,
    ) -> Result<[Vec<f64>; 2], Unbalanced> {
        let [one, other] = forces;
        if self.solver.tolerance().is_some() {
            let one = self.solve(state, one, left.clone())?;
            return Ok([one, self.solve(state, other, left)?]);
        }
        let both = (self.solver).solve_both(state, [one, other], left, &mut self.costs);
        both.map_err(|_| Unbalanced::NegativeCurvature)
    }

    /// Measures the deformations, forces, residual and energy of a state.
    pub(super) fn measure(&mut self, state: &State) -> Iterate {
        let start = Instant::now();
        let deformations = self.deformations(state);
        self.costs.bonds += start.elapsed();
        self.measure_deformed(state, deformations)
    }

    /// Deformations of a state (n_bonds).
    pub(super) fn deformations(&self, state: &State) -> Deformations {
        self.problem.system.deformations(
            &state.intact,
            &state.displacement,
            self.problem.loads.thermal_strain(state.load_factor),
        )
    }

    /// Measures the forces, residual and energy of a state with deformations (n_bonds).
    pub(super) fn measure_deformed(
        &mut self,
        state: &State,
        deformations: Deformations,
    ) -> Iterate {
        let start = Instant::now();
        let expansion = self.problem.loads.thermal_strain(state.load_factor);
        let mut swept = (self.problem.system).forces(state.bonds(), deformations, expansion);
        let met = self.contact.met(state, expansion);
        self.contact.add_to(&mut swept, &met, expansion);
        let factor = self.problem.loads.temperature_factor(state.load_factor);
        let energy_of_motion = swept.energy_of_motion(factor);
        self.halo.update_forces(&mut swept.internal.values);
        let BondSweep {
            deformations,
            internal,
            sizes,
            stored_energy,
            expansion_energy,
        } = swept;
        let extents = self.accuracy.extents(&sizes);
        let displacement = self.accuracy.largest_displacement(self.layout(), state);
        let coordinate = (self.contact.surfaces).coordinate(displacement, &met.touching);
        let rounded = Rounded {
            displacement,
            coordinate,
        };
        let out_of_balance = self.external_less(state, &internal);
        let loaded = self.loaded(state);
        let mut residual = (self.accuracy).residual(loaded, extents, rounded, out_of_balance);
        let (on_rigid, of_rigid) = self.on_rigid_bodies(state, &met.touching, coordinate);
        residual.relative = residual.relative.max(of_rigid);
        self.costs.bonds += start.elapsed();
        let of_expansions = factor.powi(2) * expansion_energy.abs();
        let rounding = ROUNDING * self.accuracy.stiffest * displacement.powi(2);
        let has_negative = energy_of_motion < -(rounding + CANCELLED * of_expansions);
        let of_bonds = rounding * state.displacement.len() as f64;
        let (gap, touch) = (OF_GAPS * coordinate, self.accuracy.stiffest_contact());
        let of_gaps = met.touching.largest_work(gap, displacement, touch) / ENERGY;
        Iterate {
            deformations,
            internal,
            stored_energy,
            energy_floor: of_expansions.max(of_bonds).max(of_gaps),
            residual,
            extents,
            negative_energy: Some(energy_of_motion).filter(|_| has_negative),
            met,
            on_rigid,
        }
    }

    /// Residual force on each rigid body with a mass in a state, N, and the largest one over the forces in its sum and the force that
    /// the rounding of gaps between coordinates of a size (m) causes.
    fn on_rigid_bodies(
        &self,
        state: &State,
        touching: &Touching,
        coordinate: f64,
    ) -> (Vec<Vector>, f64) {
        let (mut forces, mut largest) = (Vec::new(), 0.0_f64);
        let loads = self.problem.loads.on_rigid_bodies();
        if loads.is_empty() {
            return (forces, largest);
        }
        let contact = &self.problem.contact;
        let of_contacts = touching.forces_on_rigid_bodies(contact);
        let gap = OF_GAPS / RESIDUAL_TOLERANCE * coordinate;
        for load in loads {
            let pose = state.rigid.get(load.body).copied().unwrap_or_default();
            let displacement = pose.displacement;
            let force: Vector = std::array::from_fn(|axis| {
                load.force[axis] - load.stiffness * displacement[axis]
                    + of_contacts[load.body][axis]
            });
            let own = (contact.contacts.iter()).filter(|it| it.rigid_body == Some(load.body));
            let stiffness: f64 = own.map(|it| it.surfaces.on_rigid_body()[0]).sum();
            let sizes = load.stiffness * norm(displacement) + norm(load.force);
            // Without forces the quotient is no number, and counts as zero.
            largest = largest.max(norm(force) / sizes.max(gap * stiffness));
            forces.push(force);
        }
        (forces, largest)
    }

    /// Forces of the bonds of a state at a thermal strain, without the forces of its closed faces.
    pub(super) fn swept(&self, state: &State, expansion: ThermalStrain<'_>) -> BondSweep {
        let system = &self.problem.system;
        let deformations = system.deformations(&state.intact, &state.displacement, expansion);
        let mut swept = system.forces(state.bonds(), deformations, expansion);
        self.halo.update_forces(&mut swept.internal.values);
        swept
    }

    /// Sets the prescribed motions of a state known to be in equilibrium, and measures it.
    pub(super) fn measured(&mut self, state: &mut State) -> Balanced {
        self.prescribe(state);
        self.measure(state).balanced(0, Vec::new())
    }

    /// Expands values at the unknowns (n_unknowns) to shape (n_degrees_of_freedom), with zeros elsewhere.
    pub(super) fn at_degrees_of_freedom(&self, values: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; self.layout().n_degrees_of_freedom()];
        for (&dof, value) in self.degrees_of_freedom().iter().zip(values) {
            all[dof as usize] = *value;
        }
        self.halo.update_motions(&mut all);
        all
    }

    /// Slope of the energy of an iterate of a state along a correction (n_unknowns), J.
    pub(super) fn slope(&self, state: &State, iterate: &Iterate, correction: &[f64]) -> f64 {
        let force = self.out_of_balance(state, iterate);
        let products = force.iter().zip(correction);
        -products.map(|(force, step)| force * step).sum::<f64>()
    }

    /// External minus internal forces at the unknowns, shape (n_unknowns), N and N m.
    fn external_less(&self, state: &State, internal: &InternalForces) -> Vec<f64> {
        let (dofs, displacement) = (self.degrees_of_freedom(), &state.displacement);
        let loads = &self.problem.loads;
        loads.external_less(state.load_factor, displacement, internal, dofs)
    }

    /// The state together with the loads and unknowns.
    pub(super) fn loaded<'a>(&'a self, state: &'a State) -> Loaded<'a> {
        self.loaded_by(&*self.problem.loads, state)
    }

    /// A state together with loads and the unknowns.
    pub(super) fn loaded_by<'a>(
        &'a self,
        loads: &'a dyn LoadProgram,
        state: &'a State,
    ) -> Loaded<'a> {
        Loaded {
            loads,
            unknowns: &self.unknowns,
            state,
        }
    }

    /// The larger of the largest force at a point in a state and the rounding of the largest force so far, N.
    pub(super) fn largest_force(&self, now: f64) -> f64 {
        now.max(self.accuracy.largest_extents.unloaded_force())
    }

    /// Updates the largest forces so far by the forces of an equilibrium.
    pub(super) fn remember(&mut self, extents: Extents) {
        let largest = &mut self.accuracy.largest_extents;
        *largest = largest.or(extents);
    }
}

impl Equations {
    /// Makes the solver ready for an iterate of a state. Returns the points of mechanisms that are fixed from now on.
    pub(super) fn make_ready(
        &mut self,
        state: &mut State,
        iterate: &Iterate,
    ) -> Result<Vec<u32>, Unbalanced> {
        let Contacts {
            closed, touching, ..
        } = &iterate.met;
        let resisting = self.contact.resisting(closed, touching);
        self.solver.close(resisting, &mut self.costs);
        self.prepare_solver(state)
    }

    /// Makes the solver ready, fixing mechanisms until no pivot vanishes. Returns the numbers in the body of the points that were fixed.
    pub(super) fn prepare_solver(&mut self, state: &mut State) -> Result<Vec<u32>, Unbalanced> {
        let mut held_now = Vec::new();
        loop {
            let vanishing = self.solver.prepare(state, &mut self.costs);
            let vanishing = vanishing.map_err(Unbalanced::NoFactor)?;
            let Some(&first) = vanishing.first() else {
                return Ok(held_now);
            };
            if self.some_negative() {
                return Err(self.vanishing_pivot(first));
            }
            let (subdomain, layout) = (self.subdomain(), self.layout());
            for dof in vanishing {
                let local = subdomain.local_index(dof, layout.components.len());
                if local.is_some_and(|dof| std::mem::replace(&mut state.held[dof], true)) {
                    return Err(self.vanishing_pivot(dof));
                }
                held_now.push(layout.point(dof));
            }
        }
    }

    fn vanishing_pivot(&self, dof: usize) -> Unbalanced {
        let place = self.place(dof);
        let stiffness = self.stiffness.as_ref();
        let is_llt = stiffness.is_some_and(|it| it.choice().factorisation == FactorKind::Llt);
        if is_llt && self.some_negative() {
            Unbalanced::NotPositiveDefinite { place }
        } else {
            Unbalanced::VanishingPivot { place }
        }
    }
}

/// Equilibrium lines: rates of the displacements with the load factor, for the present bonds.
impl Equations {
    /// Rate of the displacements with the load factor, shape (n_degrees_of_freedom), for the bonds of a state under loads at load
    /// factor 1.
    ///
    /// The solution of an iterative solver is judged like the solution of a state, by the forces at each point. The norm of the force is
    /// no measure where a stiff platen moves the body: the force of the platen on a fixed body is many times the force that deforms it.
    ///
    /// # Errors
    ///
    /// If the stiffness has no factor, or an iterative solver does not converge.
    pub(super) fn displacement_rate(
        &mut self,
        state: &mut State,
        loads: &dyn LoadProgram,
    ) -> Result<Vec<f64>, Unbalanced> {
        self.solver.fall(Vec::new());
        self.prepare_solver(state)?;
        let (prescribed, force) = self.rate(state, loads);
        let mut line = at_one(state, prescribed);
        let left = self.accuracy.left_of_line(LINE);
        let solution = self.solve(state, force, left)?;
        self.add_correction(&mut line, 1.0, &solution);
        // Forces of closed faces are in the stiffness only, not among the forces that judge the solution.
        let faces_close = self.problem.may_press();
        let tolerance = self.solver.tolerance().filter(|_| !faces_close);
        let Some(tolerance) = tolerance else {
            return Ok(line.displacement);
        };
        let sought = (LINE * tolerance).max(RESIDUAL_TOLERANCE);
        for solutions in 1.. {
            let forces = self.line_forces(&line, loads, &[]);
            if forces.residual.relative <= sought {
                break;
            }
            if solutions == MOST_SOLUTIONS {
                return Err(self.unsettled(&forces.residual, solutions));
            }
            let at = self.loaded_by(loads, &line);
            let left = self.accuracy.left(at, forces.extents, sought);
            let correction = self.solve(state, forces.out_of_balance, left)?;
            self.add_correction(&mut line, 1.0, &correction);
        }
        Ok(line.displacement)
    }

    /// Prescribed motions at load factor 1 (n_degrees_of_freedom), and the residual forces (n_unknowns) that they and the loads cause
    /// with the bonds of a state.
    pub(super) fn rate(&self, state: &State, loads: &dyn LoadProgram) -> (Vec<f64>, Vec<f64>) {
        let mut prescribed = vec![0.0; state.displacement.len()];
        loads.prescribe(1.0, &mut prescribed);
        let system = &self.problem.system;
        let expansion = loads.thermal_strain(1.0);
        let deformations = system.deformations(&state.intact, &prescribed, expansion);
        let swept = system.forces(state.bonds(), deformations, expansion);
        let dofs = self.degrees_of_freedom();
        let force = loads.external_less(1.0, &prescribed, &swept.internal, dofs);
        (prescribed, force)
    }

    /// Forces of a line under its loads, with some internal forces of contacts by degree of freedom, N and N m.
    pub(super) fn line_forces(
        &self,
        line: &State,
        loads: &dyn LoadProgram,
        of_contacts: &[(usize, f64)],
    ) -> LineForces {
        let mut swept = self.swept(line, loads.thermal_strain(1.0));
        for &(dof, force) in of_contacts {
            swept.internal.values[dof] += force;
            swept.sizes[dof] += force.abs();
        }
        let extents = self.accuracy.extents(&swept.sizes);
        // Rates of gaps are no differences of positions.
        let rounded = Rounded {
            displacement: self.accuracy.largest_displacement(self.layout(), line),
            ..Rounded::default()
        };
        let dofs = self.degrees_of_freedom();
        let out_of_balance = loads.external_less(1.0, &line.displacement, &swept.internal, dofs);
        let at = self.loaded_by(loads, line);
        LineForces {
            residual: (self.accuracy).residual(at, extents, rounded, out_of_balance.clone()),
            extents,
            out_of_balance,
        }
    }

    /// Reason why loads cannot grow along a line: an added support would carry one.
    pub(super) fn load_on_added_support(&self, forces: &LineForces) -> Option<Unbalanced> {
        let (dof, force) = forces.residual.carried?;
        let place = self.place(dof as usize);
        Some(Unbalanced::LoadOnAddedSupport { place, force })
    }
}

/// Forces of a line under its loads at load factor 1.
pub(super) struct LineForces {
    pub(super) extents: Extents,
    /// External minus internal forces at the unknowns, shape (n_unknowns), N and N m.
    pub(super) out_of_balance: Vec<f64>,
    pub(super) residual: Residual,
}

/// State with displacements (n_degrees_of_freedom) at load factor 1, with the bonds and added supports of another state.
pub(super) fn at_one(state: &State, displacement: Vec<f64>) -> State {
    State {
        displacement,
        load_factor: 1.0,
        ..state.clone()
    }
}

impl<S: ?Sized> Equations<S> {
    /// A copy of the equations with another solver of the same stiffness.
    pub(super) fn with_solver<T: ?Sized>(&self, solver: Box<T>) -> Equations<T> {
        Equations {
            solver,
            problem: self.problem.clone(),
            unknowns: self.unknowns.clone(),
            halo: self.halo.clone(),
            stiffness: self.stiffness.clone(),
            choice: self.choice,
            energy_tolerance: self.energy_tolerance,
            accuracy: self.accuracy.clone(),
            contact: self.contact.clone(),
            costs: self.costs,
        }
    }
}

/// Deformations, forces, energy and residual of a state during the iteration.
pub(super) struct Iterate {
    pub(super) deformations: Deformations,
    pub(super) internal: InternalForces,
    pub(super) stored_energy: f64,
    pub(super) energy_floor: f64,
    pub(super) residual: Residual,
    pub(super) extents: Extents,
    pub(super) negative_energy: Option<f64>,
    pub(super) met: Contacts,
    /// Residual forces on rigid bodies with a mass, in the order of the loads on them, N.
    pub(super) on_rigid: Vec<Vector>,
}

impl Iterate {
    /// The iterate as an equilibrium, with its number of iterations and the mechanisms found on the way.
    pub(super) fn balanced(self, iterations: usize, mechanisms: Vec<u32>) -> Balanced {
        Balanced {
            deformations: self.deformations,
            internal: self.internal,
            stored_energy: self.stored_energy,
            energy_floor: self.energy_floor,
            residual: self.residual.relative,
            iterations,
            negative_energy: self.negative_energy,
            mechanisms,
            closed: self.met.closed,
            touching: self.met.touching.into(),
            stresses: OnceLock::new(),
        }
    }
}

/// Method to correct a state until it is in equilibrium.
pub(super) trait Method {
    /// First iterate of a state; a correction that the solver makes with its update for the breakage is the first one.
    fn begin(&mut self, at: &mut Iteration<'_>) -> Iterate {
        at.begin()
    }

    /// Whether an iterate is an equilibrium; an earlier iterate, to which the state returns, may take its place.
    fn is_met(&mut self, at: &mut Iteration<'_>, iterate: &mut Iterate) -> bool;

    /// Records an equilibrium.
    fn settle(&mut self, _at: &mut Iteration<'_>) {}

    /// Whether no further correction is tried.
    fn gives_up(&self, at: &Iteration<'_>) -> bool;

    /// Corrects the state and measures it.
    ///
    /// # Errors
    ///
    /// If there is no correction.
    fn correct(&mut self, at: &mut Iteration<'_>, iterate: &Iterate)
    -> Result<Iterate, Unbalanced>;
}

/// A state on its way to equilibrium after a breakage.
pub(super) struct Iteration<'a> {
    pub(super) equations: &'a mut Equations,
    pub(super) state: &'a mut State,
    pub(super) breakage: &'a Breakage,
    /// Number of corrections so far.
    pub(super) number: usize,
    /// Points of mechanisms that the solver found, which are fixed from now on.
    pub(super) mechanisms: Vec<u32>,
    /// Energy of the iterate before, J; NaN at the first one.
    previous_energy: f64,
}

impl Iteration<'_> {
    /// Sets the prescribed motions, updates the solver for the breakage, and measures the state.
    pub(super) fn begin(&mut self) -> Iterate {
        let (equations, state) = (&mut *self.equations, &mut *self.state);
        equations.prescribe(state);
        self.number = usize::from(equations.follow(state, self.breakage));
        equations.measure(state)
    }

    /// Relative residual to be reached.
    pub(super) fn sought(&self) -> f64 {
        self.equations.accuracy.sought(self.breakage)
    }

    /// Whether the residual of an iterate is within the tolerance; before the first solution it must be zero, as without loads.
    pub(super) fn is_small(&self, iterate: &Iterate, tolerance: f64) -> bool {
        let costs = &self.equations.costs;
        let is_guess = costs.solves == 0 && costs.changes == 0;
        iterate.residual.relative <= if is_guess { 0.0 } else { tolerance }
    }

    /// Whether the energy of an iterate equals the energy of the previous one to the tolerance (NHPD eq. 21), and its residual is at most
    /// `largest_residual`.
    pub(super) fn energy_settled(&self, iterate: &Iterate, largest_residual: f64) -> bool {
        let energy = iterate.stored_energy;
        let change = ((energy - self.previous_energy) / energy).abs();
        change < self.equations.energy_tolerance && iterate.residual.relative <= largest_residual
    }
}

/// Brings a state into equilibrium after a breakage by a method.
///
/// # Errors
///
/// If the observer fails. A missing equilibrium is not an error.
pub(super) fn balance(
    equations: &mut Equations,
    state: &mut State,
    breakage: &Breakage,
    method: &mut dyn Method,
    observer: &mut dyn Observer,
) -> Result<Attempt, ObserverError> {
    let mut at = Iteration {
        equations,
        state,
        breakage,
        number: 0,
        mechanisms: Vec::new(),
        previous_energy: f64::NAN,
    };
    let mut iterate = method.begin(&mut at);
    loop {
        let (residual, energy) = (iterate.residual, iterate.stored_energy);
        if at.number > 0 {
            observer.iteration(at.number, residual.relative, energy)?;
        }
        if method.is_met(&mut at, &mut iterate) {
            method.settle(&mut at);
            at.equations.remember(iterate.extents);
            return Ok(at.equations.settled(iterate, at.number, at.mechanisms));
        }
        if method.gives_up(&at) || !residual.relative.is_finite() {
            let reason = at.equations.unsettled(&residual, at.number);
            return Ok(Attempt::Unbalanced(reason));
        }
        at.previous_energy = energy;
        iterate = match method.correct(&mut at, &iterate) {
            Ok(next) => next,
            Err(reason) => return Ok(Attempt::Unbalanced(reason)),
        };
        at.number += 1;
    }
}
