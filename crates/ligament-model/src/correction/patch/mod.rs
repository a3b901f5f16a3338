//! The patch-exact correction: two factors a bond, for which a uniform strain is an equilibrium with the right tractions.
//!
//! The energy correction of NHPD makes the energies of two uniform strains right at every point, but not the forces: under a uniform strain
//! the points of an irregular mesh are not in equilibrium, and the strain of the body is not uniform. A mesh determines the forces of a
//! uniform strain eps: with linear shape functions N_P on its cells
//!
//! f_P(eps) = sum over the cells c at P of V_c sigma_c grad N_P, sigma_c = C_c : eps,
//!
//! zero inside a homogeneous body, the consistent traction on its outline, the jump at an interface. Each bond has two positive factors, q_n
//! of its axial and q_t of its shear and rotational stiffness, instead of alpha Omega, for which at every point and for every uniform strain
//!
//! forces of the bonds = f_P(eps), moments of the bonds = 0.
//!
//! These equations G q = f are fewer than the factors: the factors are those nearest to given ones (`reference.rs`).
//!
//! | file | content |
//! |---|---|
//! | `forces.rs`, `lattice_forces.rs` | f of meshes and of lattices |
//! | `equations.rs`, `rows.rs`, `harmonics.rs` | G, as sums over the bonds; its rows, and the harmonics in them |
//! | `reference.rs`, `lines.rs` | reference factors; shares of the points in the bonds, and energies by them |
//! | `pairs.rs` | order of the sums over the bonds |
//! | `dual.rs` | iteration for the factors by Newton steps |
//! | `newton.rs` | direction of a Newton step |
//! | `aggregates.rs` | coarse space of the direction |
//!
//! In the plane a point has 6 equations of forces and 2 of moments, in space 13 and 5. A box of tetrahedra with a horizon factor of 3
//! satisfies them everywhere; with one of 2 there are fewer factors than equations: then the report gives the residual, and a larger horizon
//! or the [correction of energies](super::domain) is the better choice.
//!
//! Related: micromoduli of a family fitted to the stiffness, point by point (Prakash 2019); weights of each point that are exact for
//! polynomials (Trask 2019), for which w_AB and w_BA differ, so that neither an energy nor a symmetric stiffness exists.

mod aggregates;
mod dual;
mod equations;
mod forces;
mod harmonics;
mod lattice_forces;
mod lines;
mod newton;
mod pairs;
mod reference;
mod rows;
mod settings;

pub use dual::Report;
pub use forces::{CellForces, Points, forces_of_mesh, forces_of_solid_mesh};
pub(crate) use forces::{gradients, uniform_strains};
pub use lattice_forces::forces_of_lattice;
pub(crate) use lattice_forces::{blocks, gradient as block_gradient};
pub use lines::energy_ratios;
pub use reference::reference;
pub use settings::{Reference, Settings};

use super::{Correction, CorrectionReport};
use crate::bonds::BondSet;
use crate::law::BondStiffness;
use dual::Factors;
use rows::Rows;

/// The correction of bonds with uncorrected factors alpha (n_bonds): Omega = q_n/alpha, and the ratio q_t/q_n for shear and rotation. The
/// factors q are those nearest to given ones times one number for the body (n_bonds).
pub fn correct<const D: usize>(
    bonds: &BondSet<D>,
    points: &Points<'_, D>,
    stiffness: &BondStiffness,
    (alpha, nearest_to): (Vec<f64>, &[f64]),
    settings: &Settings,
) -> Correction {
    let factors = match (D, points.turn) {
        (2, false) => nearest::<D, 6>,
        (2, true) => nearest::<D, 8>,
        (_, false) => nearest::<D, 13>,
        (_, true) => nearest::<D, 18>,
    };
    factors(bonds, points, stiffness, nearest_to, settings).correction(alpha)
}

/// Factors nearest to given ones (n_bonds) that satisfy N equations a point.
fn nearest<const D: usize, const N: usize>(
    bonds: &BondSet<D>,
    points: &Points<'_, D>,
    stiffness: &BondStiffness,
    nearest_to: &[f64],
    settings: &Settings,
) -> Factors {
    let weight = settings.moment_weight;
    let rows = Rows::<D, N>::new(bonds, points, stiffness, nearest_to, weight);
    dual::minimise(&rows, points.cloud, settings)
}

impl Factors {
    /// The correction of bonds with uncorrected factors alpha (n_bonds).
    fn correction(self, alpha: Vec<f64>) -> Correction {
        let omega = self.axial.iter().zip(&alpha);
        let ratio = self.shear.iter().zip(&self.axial);
        Correction {
            domain_factor: omega.map(|(factor, alpha)| factor / alpha).collect(),
            shear_ratio: ratio.map(|(shear, axial)| shear / axial).collect(),
            length_factor: alpha,
            report: Some(CorrectionReport::Patch(self.report)),
        }
    }
}
