//! Participation of the mass in modes.

use ligament_model::interface::CentralMotions;
use ligament_model::{Bonds, LumpedMass};

use super::masses::{Masses, inner};

/// Mass of a body, and the part of it that can move.
#[derive(Debug, Clone, PartialEq)]
pub struct Moving {
    /// Mass of the whole body, kg.
    pub total: f64,
    /// Centre of mass, in the coordinates of the mesh file, m.
    pub centre: Vec<f64>,
    /// Mass that can move along x and along y, kg, and inertia about the centre, kg m^2, of all free degrees of freedom. The
    /// effective masses of all modes add up to these.
    pub free: Vec<f64>,
    /// Rigid motions of size one along x, along y and about the centre, each of shape (n_degrees_of_freedom).
    motions: Vec<Vec<f64>>,
}

impl Moving {
    /// Mass and centre of the whole body, and its movable mass.
    pub(super) fn new(system: &dyn Bonds, mass: &LumpedMass, masses: &Masses) -> Self {
        let CentralMotions { centre, motions } = system.motions_about_centre(&mass.mass);
        let free = motions.iter().map(|r| inner(masses.of_dof(), r, r));
        Self {
            total: mass.mass.iter().sum(),
            centre,
            free: free.collect(),
            motions,
        }
    }

    /// Participation factors phi^T M r of a normalised shape, for each of the rigid motions r.
    pub(super) fn participation(&self, masses: &Masses, shape: &[f64]) -> Vec<f64> {
        let motions = self.motions.iter();
        motions
            .map(|motion| inner(masses.of_dof(), shape, motion))
            .collect()
    }

    /// Effective masses or inertia from participation factors, over the movable ones; 0 where nothing can move.
    pub fn shares(&self, participation: &[f64]) -> Vec<f64> {
        let effective = participation.iter().map(|factor| factor * factor);
        let shares =
            effective.zip(&self.free).map(
                |(effective, free)| {
                    if *free > 0.0 { effective / free } else { 0.0 }
                },
            );
        shares.collect()
    }
}
