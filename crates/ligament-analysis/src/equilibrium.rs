//! Equilibrium of the intact bonds by Newton-Raphson (NHPD eqs 19 to 21).

mod anderson;
mod error;
mod secant;
mod unsymmetric;

use std::time::Instant;

use ligament_linalg::{FactorKind, Lu};
use ligament_model::Bonds;
use ligament_model::element::BondDeformation;
use ligament_model::failure::Criteria;
use ligament_model::interface::PointStiffness;
use rayon::prelude::*;

use crate::boundary::Boundary;
use crate::breakage::Breakage;
use crate::connectivity::Fragments;
use crate::connectivity::decremental::Connectivity;
use crate::driver::Problem;
use crate::history::{Observer, ObserverError};
use crate::internal::{self, BondSweep, InternalForces};
use crate::state::State;
use crate::stiffness::{Costs, SolverChoice, Stiffness};
use crate::unknowns::{COMPONENTS, Component, Unknowns};

pub use error::{SetupError, Unbalanced};

/// Residual, relative to the forces that meet at a point, below which a state is in equilibrium.
///
/// With linear bonds one solve gets there; the paper's second iterate, which would only confirm it, is skipped.
const RESIDUAL_TOLERANCE: f64 = 1e-10;

/// Residual above which a solution with a factor that was changed in place is refined once; usually it is some 1e-14, but
/// bodies that barely hang together, and indefinite ones, magnify what rounding adds from breakage to breakage.
const REFINEMENT_TOLERANCE: f64 = 1e-12;

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

/// Newton-Raphson iterations after which a solve is given up; more than a few mean that the factor is worthless.
const ITERATION_LIMIT: usize = 25;

/// The equations of a problem, kept up while its bonds break.
pub struct Equilibrium<'a> {
    system: &'a dyn Bonds,
    criteria: &'a Criteria,
    boundary: &'a Boundary,
    stiffness: Stiffness<'a>,
    /// Relative change of the energy that ends the iteration, NHPD eq. 21.
    energy_tolerance: f64,
    /// Largest stiffness of a point: force and moment for a displacement of size one against its neighbours.
    point_stiffness: PointStiffness,
    /// Largest forces and moments that met at a point while bonds softened: a body that is unloaded keeps their rounding.
    largest_forces: [f64; 2],
    connectivity: Connectivity,
    /// The factor of a stiffness without symmetry, once there is one.
    unsymmetric: Option<Lu>,
}

/// A state in equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub struct Balanced {
    /// Deformation of every bond without what its temperature gives it, shape (n_bonds).
    pub deformations: Vec<BondDeformation>,
    /// Internal forces.
    pub internal: InternalForces,
    /// Energy stored in the intact bonds, J.
    pub stored_energy: f64,
    /// Residual relative to the forces that meet at a point.
    pub residual: f64,
    /// Newton-Raphson iterations.
    pub iterations: usize,
    /// The energy that the motions of the points cost ([`BondSweep::energy_of_motion`], the stored one unless the temperature
    /// changes) where it is negative, beyond rounding, J.
    pub negative_energy: Option<f64>,
    /// Degrees of freedom that turned out to be mechanisms and are held from now on.
    pub mechanisms: Vec<usize>,
}

impl Balanced {
    /// The equilibrium of the same bonds at `factor` times the load factor: everything is proportional to it.
    pub fn scaled(&self, factor: f64) -> Self {
        let deformations = self.deformations.par_iter();
        Self {
            deformations: deformations.map(|it| it.scaled(factor)).collect(),
            internal: InternalForces {
                values: self.internal.values.iter().map(|f| factor * f).collect(),
                force_scale: factor.abs() * self.internal.force_scale,
                moment_scale: factor.abs() * self.internal.moment_scale,
                thermal: factor * self.internal.thermal,
            },
            stored_energy: factor * factor * self.stored_energy,
            iterations: 0,
            mechanisms: Vec::new(),
            ..*self
        }
    }
}

/// How many negative eigenvalues the stiffness has, and how many it should have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stability {
    /// Negative eigenvalues of the stiffness.
    pub negative: usize,
    /// Those of its rotation block: an intact model that is stable has no others.
    pub expected: usize,
}

impl<'a> Equilibrium<'a> {
    /// Numbers the unknowns and analyses the pattern; nothing is factorised yet.
    pub fn of(problem: &Problem<'a>, energy_tolerance: f64) -> Result<Self, SetupError> {
        let Problem {
            system,
            criteria,
            boundary,
            ..
        } = *problem;
        Ok(Self {
            system,
            criteria,
            boundary,
            stiffness: Stiffness::new(
                system,
                Unknowns::of_problem(system, boundary),
                problem.solver,
            )?,
            // With true strains the energy settles before they are those of the displacements: the residual decides.
            energy_tolerance: if system.is_linear() {
                energy_tolerance
            } else {
                0.0
            },
            point_stiffness: system.largest_point_stiffness(),
            largest_forces: [0.0; 2],
            connectivity: Connectivity::new(system),
            unsymmetric: None,
        })
    }

    /// The unknowns.
    pub fn unknowns(&self) -> &Unknowns {
        self.stiffness.unknowns()
    }

    /// The stiffness of the intact bonds.
    pub fn stiffness(&self) -> &Stiffness<'a> {
        &self.stiffness
    }

    /// What was chosen to solve the equations.
    pub fn choice(&self) -> &SolverChoice {
        self.stiffness.choice()
    }

    /// The connected parts of the body.
    pub fn fragments(&self) -> &Fragments {
        self.connectivity.fragments()
    }

    /// What the equations have cost so far.
    pub fn costs(&self) -> &Costs {
        &self.stiffness.costs
    }

    /// Negative eigenvalues of the stiffness; 0 where it is known to be positive definite.
    pub fn negative_eigenvalues(&self) -> usize {
        let factor = self.stiffness.factor();
        factor.map_or(0, |factor| factor.inertia().negative)
    }

    /// Adds the time since `start` to the work on bonds.
    pub(crate) fn count_bond_work(&mut self, start: Instant) {
        self.stiffness.costs.bonds += start.elapsed();
    }

    /// Breaks bonds: takes them out of the state and holds what came loose.
    ///
    /// To be called before the first solution, with whatever bonds the state lacks, and then with every bond that breaks; the
    /// next equilibrium is that after the breakage.
    pub fn break_bonds(&mut self, state: &mut State, bonds: &[u32]) -> Breakage {
        let expansion = self.boundary.thermal_strain_at(state.load_factor);
        let mut breakage = Breakage::new(self.system, expansion, state, bonds);
        let start = Instant::now();
        for &bond in bonds {
            state.intact[bond as usize] = false;
        }
        self.connectivity
            .bonds_broke(self.system, &state.intact, bonds);
        let (prescribed, held) = (&self.boundary.prescribed, &state.held);
        let unknowns = self.stiffness.unknowns();
        breakage.holds = self.connectivity.missing_holds(
            self.system,
            |dof| prescribed[dof].is_some() || held[dof],
            |dof| unknowns.number(dof).is_some(),
        );
        for hold in &breakage.holds {
            state.held[hold.degree_of_freedom] = true;
        }
        self.stiffness.costs.connectivity += start.elapsed();
        breakage
    }

    /// Brings the state into equilibrium at its load factor, after the last breakage; an empty one where none came since the
    /// last equilibrium.
    ///
    /// The outer result is an observer's failure, the inner one tells whether there is an equilibrium.
    pub fn balance(
        &mut self,
        state: &mut State,
        breakage: &Breakage,
        observer: &mut dyn Observer,
    ) -> Result<Result<Balanced, Unbalanced>, ObserverError> {
        if !state.softening.remaining.is_empty() {
            return self.balance_secants(state, breakage, observer);
        }
        if !self.system.has_energy() {
            return self.balance_unsymmetric(state, observer);
        }
        self.prescribe(state);
        let mut mechanisms = Vec::new();
        let mut previous_energy = f64::NAN;
        let mut iterations = 0;
        if let Some(correction) = self.stiffness.follow(breakage, state, self.boundary) {
            self.add_correction(state, &correction);
            iterations = 1;
        }
        loop {
            let mut balanced = self.measure(state);
            if iterations > 0 {
                observer.iteration(iterations, balanced.residual, balanced.stored_energy)?;
            }
            let Balanced {
                residual,
                stored_energy: energy,
                ..
            } = balanced;
            let change = ((energy - previous_energy) / energy).abs();
            let is_changed = self.stiffness.is_changed();
            let energy_settled =
                !is_changed && change < self.energy_tolerance && residual <= LARGEST_RESIDUAL;
            let tolerance = if is_changed && iterations == 1 {
                REFINEMENT_TOLERANCE
            } else {
                RESIDUAL_TOLERANCE
            };
            if residual <= tolerance || energy_settled {
                (balanced.iterations, balanced.mechanisms) = (iterations, mechanisms);
                return Ok(Ok(balanced));
            }
            if iterations == ITERATION_LIMIT {
                return Ok(Err(Unbalanced::NotConverged {
                    residual,
                    iterations,
                }));
            }
            // One refinement may be needed after many changes; if it is not enough, the factor is worn out.
            if is_changed && iterations >= 2 {
                self.stiffness.forget();
            }
            let correction = match self.correction(state, &balanced, &mut mechanisms) {
                Ok(correction) => correction,
                Err(unbalanced) => return Ok(Err(unbalanced)),
            };
            self.add_correction(state, &correction);
            previous_energy = energy;
            iterations += 1;
        }
    }

    /// The correction K du = F - K u of an iterate (NHPD eqs 19 and 20), shape (n_unknowns); adds mechanisms that the
    /// factorisation met.
    fn correction(
        &mut self,
        state: &mut State,
        iterate: &Balanced,
        mechanisms: &mut Vec<usize>,
    ) -> Result<Vec<f64>, Unbalanced> {
        mechanisms.extend(self.factorise_if_stale(state)?);
        let (boundary, internal) = (self.boundary, &iterate.internal);
        let force = |dof| boundary.force[dof] * state.load_factor - internal.values[dof];
        Ok(self.stiffness.solve(state, force))
    }

    /// Deformations, forces, residual and energy of a state.
    fn measure(&mut self, state: &State) -> Balanced {
        let start = Instant::now();
        let deformations = self.deformations(state);
        self.count_bond_work(start);
        self.measure_deformed(state, deformations)
    }

    /// Deformations of a state (n_bonds).
    fn deformations(&self, state: &State) -> Vec<BondDeformation> {
        self.system.deformations(
            &state.intact,
            &state.displacement,
            self.boundary.thermal_strain_at(state.load_factor),
        )
    }

    /// Forces, residual and energy of a state with deformations (n_bonds).
    fn measure_deformed(&mut self, state: &State, deformations: Vec<BondDeformation>) -> Balanced {
        let start = Instant::now();
        let swept = self.system.forces(
            state.bonds(),
            deformations,
            self.boundary.thermal_strain_at(state.load_factor),
        );
        let energy_of_motion = swept.energy_of_motion(state.load_factor);
        let BondSweep {
            deformations,
            internal,
            stored_energy,
            expansion_energy,
        } = swept;
        let residual_forces = self.residual_forces(state, &internal);
        let residual = self.relative_residual(state, &residual_forces, &internal);
        self.count_bond_work(start);
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

    /// Inertia of the stiffness and of its rotation block for the state's bonds, once the state was balanced.
    pub fn stability(&self, state: &State) -> Result<Option<Stability>, SetupError> {
        let Some(factor) = self.stiffness.factor() else {
            return Ok(None);
        };
        Ok(Some(Stability {
            negative: factor.inertia().negative,
            expected: self.stiffness.negative_rotations(state)?,
        }))
    }

    fn prescribe(&self, state: &mut State) {
        for (dof, value) in self.boundary.prescribed.iter().enumerate() {
            if let Some(value) = value {
                state.displacement[dof] = value * state.load_factor;
            }
        }
    }

    /// F - K u at the unknowns (NHPD eq. 20), zero where held, shape (n_unknowns).
    fn residual_forces(&self, state: &State, internal: &InternalForces) -> Vec<f64> {
        self.unknowns()
            .degrees_of_freedom()
            .iter()
            .map(|&dof| {
                let dof = dof as usize;
                let external = self.boundary.force[dof] * state.load_factor;
                if state.held[dof] {
                    0.0
                } else {
                    external - internal.values[dof]
                }
            })
            .collect()
    }

    fn relative_residual(&self, state: &State, residual: &[f64], internal: &InternalForces) -> f64 {
        // A load that no bond carries yet would be measured against nothing.
        let largest_load = self
            .boundary
            .force
            .iter()
            .fold(0.0_f64, |largest, force| largest.max(force.abs()));
        let mut scales = InternalForces {
            values: Vec::new(),
            ..*internal
        };
        let [force, moment] = self.forces_of_rounding(state);
        scales.force_scale = scales
            .force_scale
            .max(largest_load * state.load_factor.abs())
            .max(force / RESIDUAL_TOLERANCE)
            .max(UNLOADED * self.largest_forces[0]);
        scales.moment_scale = (scales.moment_scale)
            .max(moment / RESIDUAL_TOLERANCE)
            .max(UNLOADED * self.largest_forces[1]);
        internal::relative_residual(residual, self.unknowns().degrees_of_freedom(), &scales)
    }

    /// Force and moment at a point that are rounding of the displacements, N and N m.
    fn forces_of_rounding(&self, state: &State) -> [f64; 2] {
        let displacement = largest_displacement(state);
        let PointStiffness { force, moment } = self.point_stiffness;
        [force, moment].map(|stiffness| ROUNDING * stiffness * displacement)
    }

    /// Energy that is rounding of the displacements, J.
    fn energy_of_rounding(&self, state: &State) -> f64 {
        self.forces_of_rounding(state)[0] * largest_displacement(state)
    }

    fn add_correction(&self, state: &mut State, correction: &[f64]) {
        let degrees_of_freedom = self.stiffness.unknowns().degrees_of_freedom();
        for (&dof, value) in degrees_of_freedom.iter().zip(correction) {
            state.displacement[dof as usize] += value;
        }
    }

    /// Factorises unless the factor is up to date; mechanisms found by their pivots are held, and the rest factorised
    /// again.
    fn factorise_if_stale(&mut self, state: &mut State) -> Result<Vec<usize>, Unbalanced> {
        let mut held_now = Vec::new();
        loop {
            let vanishing = self.stiffness.make(state).map_err(Unbalanced::NoFactor)?;
            let Some(&first) = vanishing.first() else {
                return Ok(held_now);
            };
            if self.system.some_negative() {
                return Err(self.vanishing_pivot(first));
            }
            for unknown in vanishing {
                let dof = self.unknowns().degrees_of_freedom()[unknown] as usize;
                if std::mem::replace(&mut state.held[dof], true) {
                    return Err(self.vanishing_pivot(unknown));
                }
                held_now.push(dof);
            }
        }
    }

    fn vanishing_pivot(&self, unknown: usize) -> Unbalanced {
        let dof = self.unknowns().degrees_of_freedom()[unknown] as usize;
        let point = (dof / COMPONENTS) as u32;
        let component = Component::at(dof).name();
        let is_llt = self.choice().factorisation == FactorKind::Llt;
        if is_llt && self.system.some_negative() {
            Unbalanced::NotPositiveDefinite { point, component }
        } else {
            Unbalanced::VanishingPivot { point, component }
        }
    }
}

fn largest_displacement(state: &State) -> f64 {
    state
        .displacement
        .chunks(COMPONENTS)
        .flat_map(|motion| &motion[..Component::Rotation.index()])
        .fold(0.0, |largest: f64, value| largest.max(value.abs()))
}
