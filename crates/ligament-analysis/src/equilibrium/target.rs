//! A motion with a prescribed value and the load factor as an unknown, as in a test controlled by the opening of a crack.
//!
//! With a correction du_r by the residual forces and the rate u_B of the displacements with the load factor, a motion c . u with
//! the prescribed value c* changes the load factor by
//!
//! d_lambda = (c* - c . u - c . du_r)/(c . u_B),
//!
//! and du = du_r + d_lambda u_B brings the motion to c* (Batoz and Dhatt 1979).

use std::sync::Arc;

use ligament_model::layout::Layout;
use ligament_model::subdomain::Subdomain;

use crate::load_program::LoadProgram;
use crate::unbalanced::Unbalanced;

/// Largest deviation of a motion from its value, relative to its change in its stage.
const MISSED: f64 = 1e-9;

/// Rate of the controlled motion with the load factor, relative to the largest rate of a displacement, below which the load does
/// not move it.
const UNMOVED: f64 = 1e-12;

/// A motion and its prescribed value.
#[derive(Debug, Clone)]
pub(crate) struct Target {
    /// Loads that grow with the load factor, at load factor 1.
    pub(crate) rate: Arc<dyn LoadProgram>,
    pub(crate) subdomain: Subdomain,
    /// Degrees of freedom of owned points and their weights in the motion, which is a sum over all processes.
    pub(crate) weights: Vec<(u32, f64)>,
    /// The value of the motion, m or rad.
    pub(crate) value: f64,
    /// Change of the motion in its stage, m or rad.
    pub(crate) way: f64,
}

impl Target {
    /// Selects the weights at owned points.
    pub(crate) fn owned_weights(
        subdomain: &Subdomain,
        layout: Layout,
        weights: impl Iterator<Item = (u32, f64)>,
    ) -> Vec<(u32, f64)> {
        let is_owned = |dof| subdomain.owns(layout.point(dof as usize));
        weights.filter(|&(dof, _)| is_owned(dof)).collect()
    }

    /// The motion, m or rad, of displacements of shape (n_degrees_of_freedom).
    pub(super) fn motion(&self, displacement: &[f64]) -> f64 {
        let terms = self.weights.iter();
        let terms = terms.map(|&(dof, weight)| weight * displacement[dof as usize]);
        self.subdomain.sum(terms.sum())
    }

    /// Whether displacements (n_degrees_of_freedom) have the prescribed value of the motion.
    pub(super) fn is_met(&self, displacement: &[f64]) -> bool {
        let missing = self.value - self.motion(displacement);
        missing.abs() <= MISSED * self.way.abs()
    }

    /// Change of the load factor that brings the motion to its value, from the displacements, their correction and their rate with
    /// the load factor, all of shape (n_degrees_of_freedom).
    ///
    /// # Errors
    ///
    /// If the load does not move the controlled motion.
    pub(super) fn load_change(
        &self,
        displacement: &[f64],
        moved: &[f64],
        growth: &[f64],
    ) -> Result<f64, Unbalanced> {
        let here = growth.iter().fold(0.0_f64, |size, it| size.max(it.abs()));
        let largest = self.subdomain.max(here);
        let gained = self.motion(growth);
        let missing = self.value - self.motion(displacement) - self.motion(moved);
        let change = missing / gained;
        if gained.abs() <= UNMOVED * largest || !change.is_finite() {
            return Err(Unbalanced::Unmoved);
        }
        Ok(change)
    }
}
