//! Largest stable step of explicit integration.
//!
//! Central differences are stable up to dt = 2/omega with the largest eigenfrequency omega of M^-1 K, and with damping beta K from the last half
//! step up to dt = (2/omega) (sqrt(1 + xi^2) - xi), xi = beta omega/2 (Belytschko et al., Nonlinear Finite Elements, section 6.2). Lanczos'
//! method bounds omega from products with the bonds. Bonds that break or soften lower it, so that it is found once.

use ligament_linalg::largest_eigenvalue;

use ligament_model::thermal::ThermalStrain;

use super::{MotionError, MotionProblem, MotionSettings};
use crate::critical_step::CriticalStep;
use crate::internal;
use crate::state::State;

/// Relative residual of omega^2 that is small enough: half of it is lost of the step.
const TOLERANCE: f64 = 1e-3;

/// Largest number of products with the stiffness, each as long as a time step. The residual left after them costs a percent of the step on regular
/// lattices, whose largest frequencies lie close together, and less where few bonds are stiffest.
const PRODUCTS: usize = 30;

/// Displacement over the spacing of the points for the derivative of forces that are not linear in the displacements.
const PROBE: f64 = 1e-7;

/// Largest stable step of a motion, with its damping and the factor on its rotational inertias.
///
/// # Errors
///
/// If no degree of freedom can move, or one that can has no mass.
pub fn critical_step(
    problem: &MotionProblem,
    settings: &MotionSettings,
) -> Result<CriticalStep, MotionError> {
    let masses = problem.masses(settings.rotary_inertia);
    let free = problem.free();
    if free.is_empty() {
        return Err(MotionError::NothingMoves);
    }
    let layout = problem.problem.system.layout;
    let massless = free.iter().find(|&&dof| masses[dof as usize] <= 0.0);
    if let Some(&dof) = massless {
        return Err(MotionError::Massless {
            point: layout.point(dof as usize),
        });
    }
    if has_unstable_rotations(problem) {
        return Err(MotionError::UnstableRotations);
    }
    let root = |dof: u32| masses[dof as usize].sqrt();
    let contact = problem.problem.contact.stiffness(layout);
    let mut product = Product::new(problem, contact.at_degrees_of_freedom);
    let found = largest_eigenvalue(free.len(), TOLERANCE, PRODUCTS, |input, output| {
        product.motions.fill(0.0);
        for (&dof, value) in free.iter().zip(input) {
            product.motions[dof as usize] = value / root(dof);
        }
        product.apply();
        for (&dof, value) in free.iter().zip(output) {
            *value = product.forces[dof as usize] / root(dof);
        }
    });
    let Some(found) = found.filter(|it| it.value > 0.0) else {
        return Err(MotionError::NothingResists);
    };
    let largest = (found.value + found.residual).max(contact.squared_frequency);
    let frequency = largest.sqrt();
    let xi = 0.5 * settings.damping.stiffness * frequency;
    let is_rotation = |dof: u32| layout.component(dof as usize).is_rotation();
    let energies = || {
        let of_mode = found.vector.iter().map(|it| f64::from(it * it));
        free.iter().copied().zip(of_mode)
    };
    let rotating = energies().filter(|it| is_rotation(it.0));
    let most = energies().fold((0, 0.0), |most, it| if it.1 > most.1 { it } else { most });
    Ok(CriticalStep {
        step: 2.0 / frequency * ((1.0 + xi * xi).sqrt() - xi),
        frequency,
        point: layout.point(most.0 as usize),
        component: layout.component(most.0 as usize),
        of_rotations: rotating.map(|it| it.1).sum(),
    })
}

/// Products of the stiffness of the whole body and its restraints with motions.
struct Product<'a> {
    problem: &'a MotionProblem,
    fresh: State,
    /// Motions that are multiplied, shape (n_degrees_of_freedom).
    motions: Vec<f64>,
    /// Forces K u, shape (n_degrees_of_freedom).
    forces: Vec<f64>,
    /// Diagonal matrix that bounds the stiffness of contacts from above, shape (n_degrees_of_freedom); empty without contacts.
    of_contact: Vec<f64>,
}

impl<'a> Product<'a> {
    fn new(problem: &'a MotionProblem, of_contact: Vec<f64>) -> Self {
        let system = &*problem.problem.system;
        let n = system.layout.n_degrees_of_freedom();
        Self {
            problem,
            fresh: State::fresh(system),
            motions: vec![0.0; n],
            forces: vec![0.0; n],
            of_contact,
        }
    }

    fn apply(&mut self) {
        let (system, loads) = (&*self.problem.problem.system, &self.problem.problem.loads);
        let bonds = self.fresh.bonds();
        if system.element.is_linear() {
            system.multiply(bonds, &self.motions, &mut self.forces);
        } else {
            let largest = self
                .motions
                .iter()
                .fold(0.0_f64, |most, it| most.max(it.abs()));
            let spacing = system.spacing.iter().copied().fold(f64::INFINITY, f64::min);
            let small = PROBE * spacing / largest;
            let motions: Vec<f64> = self.motions.iter().map(|it| small * it).collect();
            let swept = internal::sweep(system, bonds, &motions, ThermalStrain::NONE);
            for (force, value) in self.forces.iter_mut().zip(&swept.internal.values) {
                *force = value / small;
            }
        }
        loads
            .restraints()
            .add_forces(&self.motions, &mut self.forces);
        let stiffness = self.of_contact.iter().zip(&self.motions);
        for (force, (stiffness, motion)) in self.forces.iter_mut().zip(stiffness) {
            *force += stiffness * motion;
        }
    }
}

/// Whether points with inertia of rotation turn without bound, because bonds have a negative shear stiffness.
fn has_unstable_rotations(problem: &MotionProblem) -> bool {
    let system = &problem.problem.system;
    let rotates = system.layout.components.iter().any(|it| it.is_rotation());
    rotates && system.rigidities().some_negative_shear(&system.subdomain)
}
