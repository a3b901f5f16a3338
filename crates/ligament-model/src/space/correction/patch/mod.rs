//! The patch-exact correction in space: two factors a bond, for which a uniform strain is an equilibrium with the right tractions.
//!
//! What it asks for and how the factors are found is that of the [plane](crate::correction::patch). In space a point has 13 equations of
//! forces and 5 of moments (`solid.rs`). A box of tetrahedra with a horizon factor of 3 meets them everywhere, with one of 2 there are
//! fewer factors than equations: then the report says how much is left, and a larger horizon or the correction of
//! [axes](super::axes) is the better choice.

mod forces;
mod solid;
mod waves;

pub use forces::{SolidCellForces, force_in, of_solid_mesh};

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::correction::Correction;
use crate::correction::patch::Settings;
use crate::correction::patch::aggregates::Aggregates;
use crate::correction::patch::dual::{self, Factors};
use crate::correction::patch::equations::Equations;
use crate::law::BondStiffness;
use crate::element::ElementKind;
use solid::SolidEquations;

/// The correction of bonds with uncorrected factors alpha (n_bonds) on points with the forces of their cells: Omega = q_n/alpha, and
/// beside it what shear and rotation have more, q_t/q_n. The factors q are those nearest to given ones times one number for the body
/// (n_bonds).
pub fn correct(
    bonds: &BondSet<3>,
    (cloud, forces): (&PointCloud<3>, &SolidCellForces),
    element: ElementKind,
    stiffness: &BondStiffness,
    (alpha, nearest_to): (Vec<f64>, &[f64]),
    settings: &Settings,
) -> Correction {
    let weight = settings.moment_weight;
    let factors = match element {
        ElementKind::Beam => {
            let equations =
                SolidEquations::<18>::new(bonds, cloud, forces, stiffness, nearest_to, weight);
            minimise(&equations, cloud, settings)
        }
        ElementKind::Spring | ElementKind::Imaginary | ElementKind::TrueStrain | ElementKind::Pairwise => {
            let equations =
                SolidEquations::<13>::new(bonds, cloud, forces, stiffness, nearest_to, weight);
            minimise(&equations, cloud, settings)
        }
    };
    factors.correction(alpha)
}

fn minimise<const N: usize>(
    equations: &SolidEquations<'_, N>,
    cloud: &PointCloud<3>,
    settings: &Settings,
) -> Factors {
    let seats = &equations.pairs().seats;
    let aggregates = Aggregates::new(cloud, seats, SolidEquations::<N>::FORCES);
    dual::minimise(equations, aggregates, settings)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
mod tests;
