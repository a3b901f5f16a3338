//! Equilibrium of the intact bonds by Newton-Raphson (NHPD eqs 19 to 21).

use std::sync::Arc;
use std::time::{Duration, Instant};

use ligament_linalg::{
    FactorError, FactorKind, Factorisation, Pattern, PatternError, Symbolic, SymmetricMatrix,
};
use ligament_model::BondSystem;
use ligament_model::element::beam::BondDeformation;
use thiserror::Error;

use crate::assembly;
use crate::boundary::Boundary;
use crate::connectivity::{Fragments, Hold};
use crate::history::{Observer, ObserverError};
use crate::internal::{self, InternalForces};
use crate::state::State;
use crate::unknowns::{COMPONENTS, Component, Unknowns};

/// Residual, relative to the forces that meet at a point, below which a state is in equilibrium.
///
/// With linear bonds one solve gets there; the paper's second iterate, which would only confirm it, is skipped.
const RESIDUAL_TOLERANCE: f64 = 1e-9;

/// A residual above this is no equilibrium whatever the energies say.
const LARGEST_RESIDUAL: f64 = 1e-6;

/// What rounding makes of the internal forces of a body that moves freely, relative to the stiffness of a point times the
/// largest displacement. A body that fell apart has no other forces to measure a residual or an energy against.
const ROUNDING: f64 = 1e-14;

/// Newton-Raphson iterations after which a solve is given up; more than a few mean that the factor is worthless.
const ITERATION_LIMIT: usize = 25;

/// A pivot below this share of its own diagonal entry means a mechanism.
const MECHANISM_TOLERANCE: f64 = 1e-10;

/// The equations of a problem: numbering, pattern and factor, kept as long as no bond breaks.
pub struct Equilibrium<'a> {
    system: &'a BondSystem,
    boundary: &'a Boundary,
    unknowns: Unknowns,
    pattern: Arc<Pattern>,
    symbolic: Arc<Symbolic>,
    kind: FactorKind,
    factor: Option<Box<dyn Factorisation>>,
    /// Relative change of the energy that ends the iteration, NHPD eq. 21.
    energy_tolerance: f64,
    /// Largest stiffness of a point: force and moment for a displacement of size one against its neighbours.
    point_stiffness: [f64; 2],
    costs: Costs,
}

/// What the equations have cost so far.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Costs {
    /// Factorisations.
    pub factorisations: usize,
    /// Solves with a factor.
    pub solves: usize,
    /// Time in numbering, pattern and symbolic analysis.
    pub analysis: Duration,
    /// Time in assembly.
    pub assembly: Duration,
    /// Time in factorisation.
    pub factorisation: Duration,
    /// Time in solves.
    pub solve: Duration,
    /// Time in deformations, forces, energies and the choice of bonds.
    pub bonds: Duration,
    /// Time in the search for loose parts.
    pub connectivity: Duration,
}

/// A state in equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub struct Balanced {
    /// Deformation of every bond, shape (n_bonds).
    pub deformations: Vec<BondDeformation>,
    /// Internal forces.
    pub internal: InternalForces,
    /// Energy stored in the intact bonds, J.
    pub stored_energy: f64,
    /// Residual relative to the forces that meet at a point.
    pub residual: f64,
    /// Newton-Raphson iterations.
    pub iterations: usize,
    /// Whether that energy is negative, beyond rounding.
    pub energy_is_negative: bool,
    /// Degrees of freedom that turned out to be mechanisms and are held from now on.
    pub mechanisms: Vec<usize>,
}

/// Why no equilibrium was found: an outcome of the run, not an error.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Unbalanced {
    /// Newton-Raphson did not get there.
    #[error(
        "Newton-Raphson did not converge: residual {residual:.1e} after {iterations} iterations"
    )]
    NotConverged {
        /// Relative residual of the last iterate.
        residual: f64,
        /// Iterations done.
        iterations: usize,
    },
    /// A pivot of the indefinite matrix vanished.
    #[error(
        "the stiffness lost stability: vanishing pivot at point {point}, component {component}"
    )]
    VanishingPivot {
        /// Point index.
        point: u32,
        /// Component name.
        component: &'static str,
    },
    /// The stored energy is negative.
    #[error("the stiffness lost stability: negative stored energy {energy:.3e} J")]
    NegativeEnergy {
        /// Stored energy, J.
        energy: f64,
    },
    /// The matrix could not be factorised.
    #[error("the stiffness has no factor: {0}")]
    NoFactor(FactorError),
}

/// What stops an analysis with an error.
#[derive(Debug, Error)]
pub enum SetupError {
    /// The system of equations could not be set up.
    #[error("the pattern of the stiffness matrix is broken: {0}")]
    Pattern(#[from] PatternError),
    /// The symbolic analysis failed.
    #[error(transparent)]
    Analysis(#[from] FactorError),
    /// An observer could not do its part.
    #[error(transparent)]
    Observer(#[from] ObserverError),
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
    pub fn new(
        system: &'a BondSystem,
        boundary: &'a Boundary,
        energy_tolerance: f64,
    ) -> Result<Self, SetupError> {
        let start = Instant::now();
        let unknowns = Unknowns::of_problem(system, boundary);
        let pattern = Arc::new(assembly::pattern(system, &unknowns)?);
        let symbolic = Arc::new(Symbolic::analyse(pattern.clone())?);
        // Without a positive shear stiffness positive definiteness is not to be counted on.
        let definite = system.shear_rigidity.iter().all(|&rigidity| rigidity > 0.0);
        let kind = if definite {
            FactorKind::Llt
        } else {
            FactorKind::Ldlt
        };
        let costs = Costs {
            analysis: start.elapsed(),
            ..Costs::default()
        };
        Ok(Self {
            system,
            boundary,
            unknowns,
            pattern,
            symbolic,
            kind,
            factor: None,
            energy_tolerance,
            point_stiffness: largest_point_stiffness(system),
            costs,
        })
    }

    /// The unknowns.
    pub fn unknowns(&self) -> &Unknowns {
        &self.unknowns
    }

    /// Which factorisation is used.
    pub fn kind(&self) -> FactorKind {
        self.kind
    }

    /// Structure of the factor.
    pub fn symbolic(&self) -> &Symbolic {
        &self.symbolic
    }

    /// What the equations have cost so far.
    pub fn costs(&self) -> &Costs {
        &self.costs
    }

    /// Negative eigenvalues of the stiffness that was factorised last; 0 where it is known to be positive definite.
    pub fn negative_eigenvalues(&self) -> usize {
        match (&self.factor, self.kind) {
            (Some(factor), FactorKind::Ldlt) => factor.inertia().negative,
            _ => 0,
        }
    }

    /// Adds the time since `start` to the work on bonds.
    pub(crate) fn count_bond_work(&mut self, start: Instant) {
        self.costs.bonds += start.elapsed();
    }

    /// Breaks bonds, forgets the factor, and holds what came loose. Returns the parts and the new holds.
    pub fn break_bonds(&mut self, state: &mut State, bonds: &[u32]) -> (Fragments, Vec<Hold>) {
        let start = Instant::now();
        for &bond in bonds {
            state.intact[bond as usize] = false;
        }
        self.factor = None;
        let fragments = Fragments::find(self.system, &state.intact);
        let prescribed = &self.boundary.prescribed;
        let is_fixed: Vec<bool> = prescribed
            .iter()
            .zip(&state.held)
            .map(|(value, held)| value.is_some() || *held)
            .collect();
        let can_hold: Vec<bool> = (0..is_fixed.len())
            .map(|dof| self.unknowns.number(dof).is_some())
            .collect();
        let holds = fragments.missing_holds(self.system, &is_fixed, &can_hold);
        for hold in &holds {
            state.held[hold.degree_of_freedom] = true;
        }
        self.costs.connectivity += start.elapsed();
        (fragments, holds)
    }

    /// Brings the state into equilibrium at its load factor.
    ///
    /// The outer result is an observer's failure, the inner one tells whether there is an equilibrium.
    pub fn balance(
        &mut self,
        state: &mut State,
        observer: &mut dyn Observer,
    ) -> Result<Result<Balanced, Unbalanced>, ObserverError> {
        self.prescribe(state);
        let mut mechanisms = Vec::new();
        let mut previous_energy = f64::NAN;
        let mut iterations = 0;
        loop {
            let (residual_forces, mut balanced) = self.measure(state);
            if iterations > 0 {
                observer.iteration(iterations, balanced.residual, balanced.stored_energy)?;
            }
            let Balanced {
                residual,
                stored_energy: energy,
                ..
            } = balanced;
            let change = ((energy - previous_energy) / energy).abs();
            let energy_settled = change < self.energy_tolerance && residual <= LARGEST_RESIDUAL;
            if residual <= RESIDUAL_TOLERANCE || energy_settled {
                (balanced.iterations, balanced.mechanisms) = (iterations, mechanisms);
                return Ok(Ok(balanced));
            }
            if iterations == ITERATION_LIMIT {
                return Ok(Err(Unbalanced::NotConverged {
                    residual,
                    iterations,
                }));
            }
            match self.factorise_if_stale(state) {
                Ok(found) => mechanisms.extend(found),
                Err(unbalanced) => return Ok(Err(unbalanced)),
            }
            self.add_correction(state, residual_forces);
            previous_energy = energy;
            iterations += 1;
        }
    }

    /// Deformations, forces, residual and energy of a state, and F - K u at the unknowns.
    fn measure(&mut self, state: &State) -> (Vec<f64>, Balanced) {
        let start = Instant::now();
        let deformations = internal::deformations(self.system, &state.displacement);
        let internal = internal::internal_forces(self.system, &state.intact, &deformations);
        let residual_forces = self.residual_forces(state, &internal);
        let residual = self.relative_residual(state, &residual_forces, &internal);
        let stored_energy = internal::stored_energy(self.system, &state.intact, &deformations);
        self.costs.bonds += start.elapsed();
        let energy_is_negative = stored_energy < -self.energy_of_rounding(state);
        let mechanisms = Vec::new();
        (
            residual_forces,
            Balanced {
                deformations,
                internal,
                stored_energy,
                residual,
                iterations: 0,
                energy_is_negative,
                mechanisms,
            },
        )
    }

    /// Inertia of the stiffness and of its rotation block for the state's bonds, once the state was balanced.
    pub fn stability(&self, state: &State) -> Result<Option<Stability>, SetupError> {
        let Some(factor) = &self.factor else {
            return Ok(None);
        };
        let rotations = self.unknowns.rotations_only();
        let pattern = Arc::new(assembly::pattern(self.system, &rotations)?);
        let block = assembly::assemble(
            self.system,
            &rotations,
            &pattern,
            &state.intact,
            &state.held,
        );
        let symbolic = Arc::new(Symbolic::analyse(pattern)?);
        let expected = FactorKind::Ldlt
            .factorise(&symbolic, &block)?
            .inertia()
            .negative;
        Ok(Some(Stability {
            negative: factor.inertia().negative,
            expected,
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
        self.unknowns
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
            .max(force / RESIDUAL_TOLERANCE);
        scales.moment_scale = scales.moment_scale.max(moment / RESIDUAL_TOLERANCE);
        internal::relative_residual(residual, self.unknowns.degrees_of_freedom(), &scales)
    }

    /// Force and moment at a point that are rounding of the displacements, N and N m.
    fn forces_of_rounding(&self, state: &State) -> [f64; 2] {
        let displacement = largest_displacement(state);
        self.point_stiffness
            .map(|stiffness| ROUNDING * stiffness * displacement)
    }

    /// Energy that is rounding of the displacements, J.
    fn energy_of_rounding(&self, state: &State) -> f64 {
        self.forces_of_rounding(state)[0] * largest_displacement(state)
    }

    fn add_correction(&mut self, state: &mut State, mut correction: Vec<f64>) {
        let start = Instant::now();
        if let Some(factor) = &mut self.factor {
            factor.solve_in_place(&mut correction);
        }
        for (&dof, value) in self.unknowns.degrees_of_freedom().iter().zip(correction) {
            state.displacement[dof as usize] += value;
        }
        self.costs.solves += 1;
        self.costs.solve += start.elapsed();
    }

    /// Factorises unless the factor is up to date; mechanisms found by their pivots are held, and the rest factorised
    /// again.
    fn factorise_if_stale(&mut self, state: &mut State) -> Result<Vec<usize>, Unbalanced> {
        let mut held_now = Vec::new();
        while self.factor.is_none() {
            let start = Instant::now();
            let matrix = assembly::assemble(
                self.system,
                &self.unknowns,
                &self.pattern,
                &state.intact,
                &state.held,
            );
            self.costs.assembly += start.elapsed();
            let start = Instant::now();
            let factor = self.kind.factorise(&self.symbolic, &matrix);
            self.costs.factorisation += start.elapsed();
            self.costs.factorisations += 1;
            let mechanisms = match &factor {
                Ok(factor) => vanishing_pivots(factor.as_ref(), &matrix),
                Err(
                    FactorError::ZeroPivot { unknown }
                    | FactorError::NotPositiveDefinite { unknown },
                ) => vec![*unknown],
                Err(other) => return Err(Unbalanced::NoFactor(other.clone())),
            };
            if let Some(&unknown) = mechanisms.first() {
                if self.system.has_negative_stiffness() {
                    return Err(self.vanishing_pivot(unknown));
                }
                for unknown in mechanisms {
                    let dof = self.unknowns.degrees_of_freedom()[unknown] as usize;
                    if std::mem::replace(&mut state.held[dof], true) {
                        return Err(self.vanishing_pivot(unknown));
                    }
                    held_now.push(dof);
                }
            } else {
                self.factor = factor.ok();
            }
        }
        Ok(held_now)
    }

    fn vanishing_pivot(&self, unknown: usize) -> Unbalanced {
        let dof = self.unknowns.degrees_of_freedom()[unknown] as usize;
        let point = (dof / COMPONENTS) as u32;
        Unbalanced::VanishingPivot {
            point,
            component: Component::of(dof).name(),
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

/// Largest sums over the bonds of a point of (|axial| + |shear rigidity|)/l^2 and of (|shear| + |rotational rigidity|)/l.
fn largest_point_stiffness(system: &BondSystem) -> [f64; 2] {
    let mut largest = [0.0_f64; 2];
    for point in 0..system.cloud.len() as u32 {
        let mut sum = [0.0; 2];
        for &bond in system.bonds.incidence.of(point) {
            let element = system.element(bond as usize);
            let shear = element.shear_rigidity.abs();
            sum[0] += (element.axial_rigidity.abs() + shear) / element.length.powi(2);
            sum[1] += (shear + element.rotational_rigidity.abs()) / element.length;
        }
        largest = [0, 1].map(|k| largest[k].max(sum[k]));
    }
    largest
}

fn vanishing_pivots(factor: &dyn Factorisation, matrix: &SymmetricMatrix) -> Vec<usize> {
    let pivots = factor.pivots();
    (0..pivots.len())
        .filter(|&i| pivots[i].abs() < MECHANISM_TOLERANCE * matrix.diagonal(i).abs())
        .collect()
}
