//! The equations of a problem: what all ways to its equilibrium share.

use std::sync::Arc;
use std::time::Instant;

use ligament_linalg::FactorKind;
use ligament_model::element::BondDeformation;
use ligament_model::interface::PointStiffness;

use crate::balanced::{Balanced, Unbalanced};
use crate::breakage::Breakage;
use crate::costs::Costs;
use crate::error::SetupError;
use crate::internal::{self, BondSweep, InternalForces};
use crate::problem::Problem;
use crate::state::State;
use crate::stiffness::Stiffness;
use crate::tangent::TangentSolver;
use crate::tangent::direct::DirectSolver;
use crate::tangent::unsymmetric::UnsymmetricSolver;
use crate::unknowns::{Layout, Unknowns};

/// Residual, relative to the forces that meet at a point, below which a state is in equilibrium.
///
/// With linear bonds one solve gets there; the paper's second iterate, which would only confirm it, is skipped.
pub(super) const RESIDUAL_TOLERANCE: f64 = 1e-10;

/// A residual above this is no equilibrium whatever the energies say.
const LARGEST_RESIDUAL: f64 = 1e-6;

/// What rounding makes of the internal forces of a body that moves freely, relative to the stiffness of a point times the
/// largest displacement. A body that fell apart has no other forces to measure a residual or an energy against.
pub(crate) const ROUNDING: f64 = 1e-14;

/// Part of the energy of the expansions that counts as nothing in the energy of motion of a heated body: that of a body that
/// is held everywhere is the difference of sums over all bonds, of up to 10^7 terms.
const CANCELLED: f64 = 1e-10;

/// Forces below this share of the largest so far are rounding of those, to within [`RESIDUAL_TOLERANCE`].
const UNLOADED: f64 = 1e-5;

/// The equations of a problem and their solver.
pub(super) struct Equations {
    pub(super) problem: Problem,
    pub(super) stiffness: Arc<Stiffness>,
    pub(super) solver: Box<dyn TangentSolver>,
    /// Relative change of the energy that ends the iteration, NHPD eq. 21.
    pub(super) energy_tolerance: f64,
    /// Largest stiffness of a point: force and moment for a displacement of size one against its neighbours.
    point_stiffness: PointStiffness,
    /// Largest forces and moments that met at a point while bonds softened: a body that is unloaded keeps their rounding.
    pub(super) largest_forces: (f64, f64),
    pub(super) costs: Costs,
}

impl Equations {
    /// Numbers the unknowns, analyses the pattern and chooses the solver; nothing is factorised yet.
    pub(super) fn new(problem: &Problem, energy_tolerance: f64) -> Result<Self, SetupError> {
        let (system, loads) = (&problem.system, &problem.loads);
        let unknowns = Unknowns::all_but(&**system, |dof| loads.is_prescribed(dof));
        let stiffness = Arc::new(Stiffness::new(system, unknowns, problem.solver)?);
        let solver: Box<dyn TangentSolver> = if stiffness.choice().unsymmetric {
            Box::new(UnsymmetricSolver::new(stiffness.clone()))
        } else {
            Box::new(DirectSolver::new(stiffness.clone()))
        };
        Ok(Self {
            // Where strains are not those of the displacements, or forces not those of an energy, the residual alone decides.
            energy_tolerance: if system.is_linear() && system.has_energy() {
                energy_tolerance
            } else {
                0.0
            },
            point_stiffness: system.largest_point_stiffness(),
            largest_forces: (0.0, 0.0),
            costs: Costs {
                analysis: stiffness.analysis_time(),
                ..Costs::default()
            },
            problem: problem.clone(),
            stiffness,
            solver,
        })
    }

    /// Degree of freedom of each unknown, ascending.
    pub(super) fn degrees_of_freedom(&self) -> &[u32] {
        self.stiffness.unknowns().degrees_of_freedom()
    }

    fn layout(&self) -> Layout {
        self.stiffness.unknowns().layout()
    }

    /// Gives a state the prescribed motions of its load factor.
    pub(super) fn prescribe(&self, state: &mut State) {
        let loads = &self.problem.loads;
        loads.prescribe(state.load_factor, &mut state.displacement);
    }

    /// Adds a correction (n_unknowns) to the displacements of a state.
    pub(super) fn add_correction(&self, state: &mut State, correction: &[f64]) {
        for (&dof, value) in self.degrees_of_freedom().iter().zip(correction) {
            state.displacement[dof as usize] += value;
        }
    }

    /// Takes a breakage to the solver, and its correction to the state; tells whether there was one.
    pub(super) fn follow(&mut self, state: &mut State, breakage: &Breakage) -> bool {
        let expansion = self.problem.loads.thermal_strain(state.load_factor);
        let solver = &mut self.solver;
        let correction = solver.follow(breakage, state, expansion, &mut self.costs);
        if let Some(correction) = &correction {
            self.add_correction(state, correction);
        }
        correction.is_some()
    }

    /// Whether the energy of an iterate is that of the one before (NHPD eq. 21), and its residual no obstacle.
    pub(super) fn energy_settled(&self, previous_energy: f64, iterate: &Balanced) -> bool {
        let energy = iterate.stored_energy;
        let change = ((energy - previous_energy) / energy).abs();
        change < self.energy_tolerance && iterate.residual <= LARGEST_RESIDUAL
    }

    /// The correction K du = F - K u of an iterate (NHPD eqs 19 and 20), shape (n_unknowns); adds mechanisms that the
    /// factorisation met.
    pub(super) fn correction(
        &mut self,
        state: &mut State,
        iterate: &Balanced,
        mechanisms: &mut Vec<u32>,
    ) -> Result<Vec<f64>, Unbalanced> {
        mechanisms.extend(self.prepare_solver(state)?);
        let force = self.out_of_balance(state, &iterate.internal);
        Ok(self.solver.solve(state, force, &mut self.costs))
    }

    /// Deformations, forces, residual and energy of a state.
    pub(super) fn measure(&mut self, state: &State) -> Balanced {
        let start = Instant::now();
        let deformations = self.deformations(state);
        self.costs.bonds += start.elapsed();
        self.measure_deformed(state, deformations)
    }

    /// Deformations of a state (n_bonds).
    pub(super) fn deformations(&self, state: &State) -> Vec<BondDeformation> {
        self.problem.system.deformations(
            &state.intact,
            &state.displacement,
            self.problem.loads.thermal_strain(state.load_factor),
        )
    }

    /// Forces, residual and energy of a state with deformations (n_bonds).
    pub(super) fn measure_deformed(
        &mut self,
        state: &State,
        deformations: Vec<BondDeformation>,
    ) -> Balanced {
        let start = Instant::now();
        let swept = self.problem.system.forces(
            state.bonds(),
            deformations,
            self.problem.loads.thermal_strain(state.load_factor),
        );
        let energy_of_motion = swept.energy_of_motion(state.load_factor);
        let BondSweep {
            deformations,
            internal,
            stored_energy,
            expansion_energy,
        } = swept;
        let residual = self.relative_residual(state, &internal);
        self.costs.bonds += start.elapsed();
        let cancelled = CANCELLED * state.load_factor.powi(2) * expansion_energy.abs();
        let of_rounding = self.energy_of_rounding(state) + cancelled;
        Balanced {
            deformations,
            internal,
            stored_energy,
            residual,
            iterations: 0,
            negative_energy: Some(energy_of_motion).filter(|energy| *energy < -of_rounding),
            mechanisms: Vec::new(),
        }
    }

    /// F - K u at the unknowns (NHPD eq. 20), shape (n_unknowns).
    fn out_of_balance(&self, state: &State, internal: &InternalForces) -> Vec<f64> {
        let dofs = self.degrees_of_freedom();
        let mut force = self.problem.loads.forces(state.load_factor, dofs);
        for (value, &dof) in force.iter_mut().zip(dofs) {
            *value -= internal.values[dof as usize];
        }
        force
    }

    /// F - K u, but where the state is held, relative to the forces that meet at a point.
    fn relative_residual(&self, state: &State, internal: &InternalForces) -> f64 {
        let mut residual = self.out_of_balance(state, internal);
        for (value, &dof) in residual.iter_mut().zip(self.degrees_of_freedom()) {
            if state.held[dof as usize] {
                *value = 0.0;
            }
        }
        // A load that no bond carries yet would be measured against nothing.
        let largest_load = self.problem.loads.largest_force(state.load_factor);
        let (force, moment) = self.forces_of_rounding(state);
        let scales = InternalForces {
            values: Vec::new(),
            force_scale: (internal.force_scale)
                .max(largest_load)
                .max(force / RESIDUAL_TOLERANCE)
                .max(UNLOADED * self.largest_forces.0),
            moment_scale: (internal.moment_scale)
                .max(moment / RESIDUAL_TOLERANCE)
                .max(UNLOADED * self.largest_forces.1),
            thermal: internal.thermal,
        };
        internal::relative_residual(&residual, self.stiffness.unknowns(), &scales)
    }

    /// Force and moment at a point that are rounding of the displacements, N and N m.
    fn forces_of_rounding(&self, state: &State) -> (f64, f64) {
        let displacement = self.largest_displacement(state);
        let PointStiffness { force, moment } = self.point_stiffness;
        let rounding = |stiffness: f64| ROUNDING * stiffness * displacement;
        (rounding(force), rounding(moment))
    }

    fn largest_displacement(&self, state: &State) -> f64 {
        let displacements = self.layout().displacements(&state.displacement);
        displacements.fold(0.0, |largest, value| largest.max(value.abs()))
    }

    /// Energy that is rounding of the displacements, J.
    fn energy_of_rounding(&self, state: &State) -> f64 {
        self.forces_of_rounding(state).0 * self.largest_displacement(state)
    }

    /// Makes the solver ready; mechanisms that turn up are held, and the solver made ready again. Gives their points.
    fn prepare_solver(&mut self, state: &mut State) -> Result<Vec<u32>, Unbalanced> {
        let mut held_now = Vec::new();
        loop {
            let vanishing = self.solver.prepare(state, &mut self.costs);
            let vanishing = vanishing.map_err(Unbalanced::NoFactor)?;
            let Some(&first) = vanishing.first() else {
                return Ok(held_now);
            };
            if self.problem.system.some_negative() {
                return Err(self.vanishing_pivot(first));
            }
            for unknown in vanishing {
                let dof = self.degrees_of_freedom()[unknown] as usize;
                if std::mem::replace(&mut state.held[dof], true) {
                    return Err(self.vanishing_pivot(unknown));
                }
                held_now.push(self.layout().point(dof));
            }
        }
    }

    fn vanishing_pivot(&self, unknown: usize) -> Unbalanced {
        let dof = self.degrees_of_freedom()[unknown] as usize;
        let point = self.layout().point(dof);
        let component = self.layout().component(dof).name();
        let is_llt = self.stiffness.choice().factorisation == FactorKind::Llt;
        if is_llt && self.problem.system.some_negative() {
            Unbalanced::NotPositiveDefinite { point, component }
        } else {
            Unbalanced::VanishingPivot { point, component }
        }
    }
}
