//! The patch-exact correction: two factors a bond, for which a uniform strain is an equilibrium with the right tractions.
//!
//! The energy correction of NHPD makes the energies of two uniform strains right at every point, and nothing makes the forces
//! right: under a uniform strain the points of an irregular mesh are not in equilibrium, and the body does something else than
//! strain uniformly. A mesh knows the forces of a uniform strain eps: with linear shape functions N_P on its cells
//!
//! f_P(eps) = sum over the cells c at P of V_c sigma_c grad N_P, sigma_c = C_c : eps,
//!
//! zero inside a homogeneous body, the consistent traction on its outline, the jump at an interface. Each bond gets two positive
//! factors, q_n of its axial and q_t of its shear and rotational stiffness, in the place of alpha Omega, for which at every point
//! and for every uniform strain
//!
//! forces of the bonds = f_P(eps), moments of the bonds = 0.
//!
//! These equations G q = f are fewer than the factors: the factors are those nearest to the uncorrected ones (`dual.rs`).
//!
//! Related: micromoduli of a family fitted to the stiffness, point by point (Prakash 2019); weights of each point that are exact
//! for polynomials (Trask, You, Yu and Parks 2019), for which w_AB and w_BA differ, so that there is neither an energy nor a
//! symmetric stiffness.

mod dual;
mod equations;
mod forces;
mod members;

pub use dual::Report;
pub use forces::{CellForces, of_lattice, of_mesh};

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::law::BondStiffness;
use equations::PlaneEquations;

/// Settings of the correction.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Smallest factor over the uncorrected one.
    pub lowest: f64,
    /// Largest factor over the uncorrected one.
    pub highest: f64,
    /// Weight of the equations of moments against those of forces.
    pub moment_weight: f64,
    /// Regularisations r of the outer steps: each lets go where the equations cannot be met, and the next takes its bias away.
    pub regularisation: Vec<f64>,
    /// Reduction of the residual in an outer step.
    pub reduction: f64,
    /// Root mean square of the scaled residual below which the equations count as met.
    pub tolerance: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            lowest: 0.02,
            highest: 20.0,
            moment_weight: 0.1,
            regularisation: vec![1e-2, 1e-3, 1e-4, 1e-4],
            reduction: 0.1,
            tolerance: 1e-5,
        }
    }
}

/// Factors of the bonds, and how well they meet the equations.
#[derive(Debug, Clone, PartialEq)]
pub struct PatchFactors {
    /// Factors q_n of the axial stiffness, shape (n_bonds).
    pub axial: Vec<f64>,
    /// Factors q_t of the shear and the rotational stiffness, shape (n_bonds).
    pub shear: Vec<f64>,
    /// Largest force that is left at each point under the strains of size one, over the size of its own terms, shape (n_points).
    pub residual: Vec<f64>,
    /// The factor c_0 of the whole body.
    pub body_factor: f64,
    /// The iteration.
    pub report: Report,
}

/// The factors of all bonds with uncorrected factors alpha (n_bonds), for bonds whose points turn or not.
pub fn factors(
    bonds: &BondSet,
    cloud: &PointCloud,
    stiffness: &BondStiffness,
    alpha: &[f64],
    forces: &CellForces,
    turns_points: bool,
    settings: &Settings,
) -> PatchFactors {
    if turns_points {
        let equations = PlaneEquations::<9>::new(
            bonds,
            cloud,
            stiffness,
            alpha,
            forces,
            settings.moment_weight,
        );
        dual::minimise(&equations, settings)
    } else {
        let equations = PlaneEquations::<6>::new(
            bonds,
            cloud,
            stiffness,
            alpha,
            forces,
            settings.moment_weight,
        );
        dual::minimise(&equations, settings)
    }
}
