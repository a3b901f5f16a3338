//! Search for the lowest modes.

use std::sync::Arc;
use std::time::Instant;

use ligament_linalg::{
    Eigenpairs, FactorKind, Factorisation, Search, SymmetricMatrix, largest_eigenpairs,
};

use super::masses::Masses;
use super::mode::{Mode, ModeKind, RESIDUAL_TOLERANCE, Rotations};
use super::participation::Moving;
use super::{ModalError, ModalOutcome, ModalProblem, ModalSettings, rigid, shape};
use crate::balanced::Stability;
use crate::costs::Costs;
use crate::error::SetupError;
use crate::solver::{Method, Reason, Unfit};
use crate::state::State;
use crate::stiffness::Stiffness;
use crate::unknowns::Unknowns;
use crate::user_message::Message;

/// Shift over the largest K_ii/M_ii, which is near the largest omega^2.
///
/// The shift sigma makes K + sigma M regular for any rigid motions. It does not affect the result: omega^2 is computed from the
/// bonds. Being far below the lowest elastic omega^2 (at least (size of the points/size of the body)^2 of the largest, less for
/// slender bodies), it hardly changes the spectrum of the inverse; being far above rounding (1e-15), it ensures that the factor
/// exists, and that errors of the solutions lie along the rigid motions, which are removed.
const SHIFT: f64 = 1e-11;

/// omega^2 over the largest K_ii/M_ii up to which a mode is rigid: above the square of the error of a shape (1e-8), below the first
/// bending mode of a beam a thousand points long.
const RIGID: f64 = 1e-14;

/// Relative distance of eigenvalues below which a count cannot separate them.
const CLUSTER: f64 = 1e-5;

/// Largest number of searches for modes that a count shows as missing.
const ATTEMPTS: u64 = 4;

/// Largest number of solutions per mode, and in addition. Some tens per mode are usual.
const SOLUTIONS: [usize; 2] = [200, 1000];

/// Modes found so far.
struct Found {
    /// Rigid motions, then elastic modes, orthonormal with the masses, each of shape (n_degrees_of_freedom).
    shapes: Vec<Vec<f64>>,
    /// Inertia of the stiffness, where it may be indefinite.
    stability: Option<Stability>,
    /// Whether the last count found no missing mode.
    complete: Option<bool>,
}

/// Equations of a body whose modes are computed.
pub struct ModalAnalysis {
    problem: ModalProblem,
    settings: ModalSettings,
    rotations: Rotations,
    stiffness: Stiffness,
    costs: Costs,
    masses: Masses,
    /// Mass of each unknown, shape (n_unknowns).
    of_unknown: Vec<f64>,
    /// Unknowns with mass, and the square roots of their masses.
    massive: Vec<(usize, f64)>,
}

impl ModalAnalysis {
    /// Numbers the unknowns and analyses the sparsity pattern, without factorising.
    pub fn new(problem: &ModalProblem, settings: ModalSettings) -> Result<Self, ModalError> {
        let (system, supports) = (&*problem.system, &problem.supports);
        let unknowns = Unknowns::all_but(system, |dof| supports.held[dof]);
        let has_rotations = !unknowns.rotations_only().is_empty();
        let suitable =
            if has_rotations && system.rigidities().some_negative_shear(&system.subdomain) {
                Rotations::Massless
            } else {
                Rotations::Inertia
            };
        let rotations = settings.rotations.unwrap_or(suitable);
        let masses = Masses::new(&problem.mass, &unknowns, rotations);
        let dofs = unknowns.degrees_of_freedom().iter();
        let of_unknown: Vec<f64> = dofs.map(|&dof| masses.of_dof()[dof as usize]).collect();
        let massive: Vec<(usize, f64)> = (of_unknown.iter().enumerate())
            .filter(|(_, mass)| **mass > 0.0)
            .map(|(unknown, mass)| (unknown, mass.sqrt()))
            .collect();
        if massive.is_empty() {
            return Err(ModalError::NothingMoves);
        }
        let reason = match problem.solver.method {
            Some(Method::Iterative) => return Err(SetupError::NotIterative(Unfit::Modes).into()),
            Some(Method::Direct) => Reason::Named,
            None => Reason::Unfit(Unfit::Modes),
        };
        let unknowns = Arc::new(unknowns);
        let stiffness = Stiffness::new(&problem.system, unknowns, &problem.solver, reason)?;
        Ok(Self {
            problem: problem.clone(),
            settings,
            rotations,
            costs: Costs {
                analysis: stiffness.analysis_time(),
                ..Costs::default()
            },
            stiffness,
            masses,
            of_unknown,
            massive,
        })
    }

    /// Stiffness of the bonds.
    pub fn stiffness(&self) -> &Stiffness {
        &self.stiffness
    }

    /// Inertia of the rotations.
    pub fn rotations(&self) -> Rotations {
        self.rotations
    }

    /// Computes the modes.
    ///
    /// Rigid motions are known. The other modes belong to the largest eigenvalues 1/(omega^2 + sigma) of M^(1/2) (K + sigma M)^-1
    /// M^(1/2) on the orthogonal complement of the rigid motions; rotations without inertia follow from the same solution. Finally
    /// the eigenvalues below the highest mode are counted by the signs of the pivots of K - tau M (Sylvester's law of inertia), and
    /// missing ones are searched.
    pub fn find(mut self) -> Result<ModalOutcome, ModalError> {
        let start = Instant::now();
        let fresh = State::fresh(&*self.problem.system);
        let matrix = self.stiffness.assemble(fresh.bonds(), &fresh.held);
        self.costs.assembly += start.elapsed();
        let largest = self.largest_ratio(&matrix);
        let rigid_below = RIGID * largest;
        let wanted = self.settings.modes.min(self.massive.len());
        let mut messages = self.messages_before(wanted);

        let ModalProblem {
            system,
            mass,
            supports,
            ..
        } = self.problem.clone();
        let motions = rigid::motions(&*system, &supports, &self.masses, wanted);
        let mut found = Found {
            shapes: motions.shapes,
            stability: None,
            complete: None,
        };
        let is_rigid = |shape: &Vec<f64>| shape::eigenvalue(&*system, shape) <= rigid_below;
        found.shapes.retain(is_rigid);
        if found.shapes.len() < wanted {
            self.find_elastic(&mut found, matrix, largest, wanted, &mut messages)?;
        }
        let moving = Moving::new(&*system, &mass, &self.masses);
        let modes = self.modes(found.shapes, wanted, &moving, rigid_below);
        messages.extend(messages_after(&modes, motions.count, found.stability));
        Ok(ModalOutcome {
            modes,
            rotations: self.rotations,
            rigid_motions: motions.count,
            moving,
            complete: found.complete,
            stability: found.stability,
            messages,
            costs: self.costs,
            solver: *self.stiffness.choice(),
        })
    }

    /// Adds elastic modes to the rigid ones, up to `wanted` in all: alternates searches and counts until none is missing.
    fn find_elastic(
        &mut self,
        found: &mut Found,
        mut matrix: SymmetricMatrix,
        largest: f64,
        wanted: usize,
        messages: &mut Vec<Message>,
    ) -> Result<(), ModalError> {
        let (shift, rigid_below) = (SHIFT * largest, RIGID * largest);
        let kind = self.stiffness.choice().factorisation;
        let (mut at, mut missing) = (0.0, wanted - found.shapes.len());
        for seed in 1..=ATTEMPTS {
            matrix.add_diagonal(shift - at, &self.of_unknown);
            let mut factor = self.factor(&matrix, kind)?;
            let negative = factor.inertia().negative;
            if seed == 1 {
                found.stability = self.stability(negative)?;
            }
            let pairs = self.search(factor.as_mut(), &found.shapes, missing, seed);
            if !pairs.converged {
                let text = format!(
                    "the iteration ended after {} solutions before all modes were exact",
                    pairs.products
                );
                messages.push(Message::new("modes-not-converged", text));
            }
            for vector in &pairs.vectors {
                let shape = self.shape(factor.as_mut(), vector, &found.shapes);
                found.shapes.push(shape);
            }
            drop(factor);

            let mut values = self.eigenvalues(&found.shapes);
            values.sort_by(f64::total_cmp);
            values.truncate(wanted);
            let Some(bound) = below_last_cluster(&values, rigid_below) else {
                return Ok(());
            };
            at = -bound;
            matrix.add_diagonal(at - shift, &self.of_unknown);
            // Without a factor there is no count, and the modes are accepted as found.
            let Ok(counting) = self.factor(&matrix, FactorKind::Ldlt) else {
                return Ok(());
            };
            let below = counting.inertia().negative.saturating_sub(negative);
            let known = values.iter().filter(|value| **value < bound).count();
            missing = below.saturating_sub(known);
            found.complete = Some(missing == 0);
            if missing == 0 {
                return Ok(());
            }
        }
        let text = format!("{missing} modes below the highest were not found");
        messages.push(Message::new("missing-modes", text));
        Ok(())
    }

    /// Largest K_ii/M_ii.
    fn largest_ratio(&self, matrix: &SymmetricMatrix) -> f64 {
        let ratio =
            |&(unknown, root): &(usize, f64)| matrix.diagonal(unknown).abs() / (root * root);
        self.massive.iter().map(ratio).fold(0.0, f64::max)
    }

    fn factor(
        &mut self,
        matrix: &SymmetricMatrix,
        kind: FactorKind,
    ) -> Result<Box<dyn Factorisation>, ModalError> {
        let start = Instant::now();
        let factor = kind.factorise(self.stiffness.symbolic(), matrix);
        self.costs.factorisation += start.elapsed();
        self.costs.factorisations += 1;
        factor.map_err(|reason| ModalError::NoFactor { reason })
    }

    /// Lowest modes orthogonal to known shapes.
    fn search(
        &mut self,
        factor: &mut dyn Factorisation,
        known: &[Vec<f64>],
        count: usize,
        seed: u64,
    ) -> Eigenpairs {
        let start = Instant::now();
        let known: Vec<Vec<f64>> = known.iter().map(|shape| self.weighted(shape)).collect();
        let n = self.massive.len();
        let search = Search {
            count: count.min(n - known.len().min(n)),
            tolerance: self.settings.tolerance,
            limit: SOLUTIONS[0] * count + SOLUTIONS[1],
            seed,
        };
        let mut solution = vec![0.0; self.of_unknown.len()];
        let pairs = largest_eigenpairs(n, search, |input, output| {
            output.copy_from_slice(input);
            remove(&known, output);
            solution.fill(0.0);
            for (&(unknown, root), value) in self.massive.iter().zip(&*output) {
                solution[unknown] = root * value;
            }
            factor.solve_in_place(&mut solution);
            for (&(unknown, root), value) in self.massive.iter().zip(&mut *output) {
                *value = root * solution[unknown];
            }
            remove(&known, output);
        });
        self.costs.solves += pairs.products;
        self.costs.solve += start.elapsed();
        pairs
    }

    /// Product M^(1/2) phi at the unknowns with mass.
    fn weighted(&self, shape: &[f64]) -> Vec<f64> {
        let dofs = self.stiffness.unknowns().degrees_of_freedom();
        let value = |&(unknown, root): &(usize, f64)| root * shape[dofs[unknown] as usize];
        self.massive.iter().map(value).collect()
    }

    /// Shape of an eigenvector y: (K + sigma M)^-1 M^(1/2) y with all rotations, normalised.
    fn shape(
        &mut self,
        factor: &mut dyn Factorisation,
        vector: &[f64],
        others: &[Vec<f64>],
    ) -> Vec<f64> {
        let start = Instant::now();
        let mut solution = vec![0.0; self.of_unknown.len()];
        for (&(unknown, root), value) in self.massive.iter().zip(vector) {
            solution[unknown] = root * value;
        }
        factor.solve_in_place(&mut solution);
        let mut shape = vec![0.0; self.masses.of_dof().len()];
        let dofs = self.stiffness.unknowns().degrees_of_freedom();
        for (&dof, value) in dofs.iter().zip(&solution) {
            shape[dof as usize] = *value;
        }
        self.masses.remove(others, &mut shape);
        self.masses.normalise(&mut shape);
        self.costs.solves += 1;
        self.costs.solve += start.elapsed();
        shape
    }

    fn eigenvalues(&mut self, shapes: &[Vec<f64>]) -> Vec<f64> {
        let start = Instant::now();
        let system = &*self.problem.system;
        let values = shapes.iter();
        let values = values
            .map(|shape| shape::eigenvalue(system, shape))
            .collect();
        self.costs.bonds += start.elapsed();
        values
    }

    /// Lowest modes, sorted.
    fn modes(
        &mut self,
        shapes: Vec<Vec<f64>>,
        wanted: usize,
        moving: &Moving,
        rigid_below: f64,
    ) -> Vec<Mode> {
        let values = self.eigenvalues(&shapes);
        let start = Instant::now();
        let mut numbered: Vec<(f64, Vec<f64>)> = values.into_iter().zip(shapes).collect();
        // Rigid motions keep their order in spite of the rounding of their zero eigenvalues.
        let rank = |value: f64| {
            if value.abs() <= rigid_below {
                0.0
            } else {
                value
            }
        };
        numbered.sort_by(|one, other| rank(one.0).total_cmp(&rank(other.0)));
        numbered.truncate(wanted);
        let (system, unknowns) = (&*self.problem.system, self.stiffness.unknowns());
        let modes = numbered.into_iter().map(|(_, mut shape)| {
            self.masses.normalise(&mut shape);
            shape::mode(system, unknowns, &self.masses, moving, shape, rigid_below)
        });
        let modes = modes.collect();
        self.costs.bonds += start.elapsed();
        modes
    }

    fn stability(&self, negative: usize) -> Result<Option<Stability>, ModalError> {
        let system = &*self.problem.system;
        if !system.rigidities().some_negative(&system.subdomain) {
            return Ok(None);
        }
        let expected = self.stiffness.negative_rotations(&State::fresh(system))?;
        Ok(Some(Stability { negative, expected }))
    }

    fn messages_before(&self, found: usize) -> Vec<Message> {
        let mut messages = Vec::new();
        if self.settings.rotations.is_none() && self.rotations == Rotations::Massless {
            messages.push(Message::new(
                "massless-rotations",
                "bonds have a negative shear stiffness (large Poisson's ratio): the rotations of the points have no inertia, they follow the \
                 displacements",
            ));
        }
        let wanted = self.settings.modes;
        if found < wanted {
            let text = format!("the body has {found} modes with mass, {wanted} were asked for");
            messages.push(Message::new("fewer-modes", text));
        }
        messages
    }
}

/// Messages that follow from the modes.
fn messages_after(
    modes: &[Mode],
    rigid_motions: usize,
    stability: Option<Stability>,
) -> Vec<Message> {
    let mut messages = Vec::new();
    if let Some(Stability { negative, expected }) = stability
        && negative != expected
    {
        let text = format!(
            "the intact model is not stable: {negative} negative eigenvalues, {expected} expected from the rotations; motions with a negative \
             omega^2 are left out"
        );
        messages.push(Message::new("unstable-modes", text));
    }
    let rigid = modes.iter().filter(|mode| mode.kind == ModeKind::Rigid);
    let found = rigid.count();
    let has_mechanisms = found > rigid_motions;
    if found == modes.len() {
        let why = if has_mechanisms {
            "it has mechanisms"
        } else {
            "ask for more modes"
        };
        let text = format!(
            "all {found} modes cost no energy, and the body has {rigid_motions} rigid motions: {why}"
        );
        messages.push(Message::new("rigid-modes-only", text));
    } else if found != rigid_motions {
        let why = match has_mechanisms {
            true => "the body has mechanisms",
            false => "some rigid motions cost energy in this model",
        };
        let text = format!(
            "{found} modes cost no energy, {rigid_motions} rigid motions were expected: {why}"
        );
        messages.push(Message::new("rigid-motions", text));
    }
    let inexact = modes.iter().enumerate();
    let inexact = inexact.filter(|(_, mode)| mode.residual > RESIDUAL_TOLERANCE);
    messages.extend(inexact.map(|(index, mode)| {
        let text = format!(
            "mode {} has a residual of {:.1e}, more than {RESIDUAL_TOLERANCE:.0e}",
            index + 1,
            mode.residual
        );
        Message::new("inexact-mode", text)
    }));
    messages
}

/// Bound just below the highest of sorted eigenvalues and the eigenvalues within rounding of it; none where this bound is rigid.
fn below_last_cluster(values: &[f64], rigid_below: f64) -> Option<f64> {
    let mut lowest = *values.last().filter(|value| **value > rigid_below)?;
    for &value in values.iter().rev() {
        if value < (1.0 - CLUSTER) * lowest {
            break;
        }
        lowest = value;
    }
    Some((1.0 - 0.5 * CLUSTER) * lowest)
}

/// Removes the components of a vector along other orthonormal vectors.
fn remove(others: &[Vec<f64>], vector: &mut [f64]) {
    for other in others {
        let along: f64 = other.iter().zip(&*vector).map(|(a, b)| a * b).sum();
        for (value, other) in vector.iter_mut().zip(other) {
            *value -= along * other;
        }
    }
}
