//! Motions that nothing resists: what a solver that iterates meets in a body that has become a mechanism, or in a part of it.
//!
//! An exact solver finds such a motion by a vanishing pivot, holds one degree of freedom of it and reads the force on that hold. Here
//! the motion itself is known, and that force is the work of the forces on it, over how far the degree of freedom moves in it.

use ligament_model::subdomain::Subdomain;

use super::accuracy::Accuracy;
use crate::load_program::LoadProgram;
use crate::state::State;
use crate::tangent::UNRESISTED;
use crate::unbalanced::{Place, Unbalanced};
use crate::unknowns::Unknowns;
use crate::vectors::dot_of_all;

/// What motions of a body are judged by.
#[derive(Clone, Copy)]
pub(super) struct Measure<'a> {
    pub(super) accuracy: &'a Accuracy,
    pub(super) unknowns: &'a Unknowns,
    pub(super) subdomain: &'a Subdomain,
    /// Whether some bonds have a negative stiffness.
    pub(super) some_negative: bool,
}

impl Measure<'_> {
    fn dot(self, one: &[f64], other: &[f64]) -> f64 {
        dot_of_all(self.subdomain, one, other)
    }

    /// Whether the stiffness K resists a solution u of K u = f, both of shape (n_unknowns), by more than the rounding of the stiffnesses of
    /// the points: u . f above 1e-14 sum k_i u_i^2.
    pub(super) fn is_resisted(self, solution: &[f64], force: &[f64]) -> bool {
        let stiffness = &self.accuracy.local_stiffness;
        let dofs = self.unknowns.degrees_of_freedom().iter();
        let pushed: Vec<f64> = (dofs.zip(solution))
            .map(|(&dof, value)| stiffness.at(dof as usize) * value)
            .collect();
        let of_points = self.dot(&pushed, solution);
        of_points == 0.0 || self.dot(solution, force) > UNRESISTED * of_points
    }

    /// Why there is no equilibrium under forces f (n_unknowns) where a motion (n_unknowns) is not resisted. Where the motion is not known
    /// (all zero), the forces tell the way.
    pub(super) fn unresisted(self, motion: &[f64], force: &[f64]) -> Unbalanced {
        if self.some_negative {
            return Unbalanced::NegativeCurvature;
        }
        let is_known = self.dot(motion, motion) > 0.0;
        let motion = if is_known { motion } else { force };
        let stiffness = &self.accuracy.local_stiffness;
        let dofs = self.unknowns.degrees_of_freedom().iter();
        let farthest = dofs.zip(motion).fold([0.0; 3], |most, (&dof, value)| {
            let size = -stiffness.at(dof as usize) * value * value;
            if size < most[0] {
                [size, f64::from(dof), *value]
            } else {
                most
            }
        });
        let of_all = self.subdomain.all_reduce_min(Some(farthest));
        let [size, dof, moved] = of_all.unwrap_or(farthest);
        if size == 0.0 {
            return Unbalanced::NegativeCurvature;
        }
        let (layout, dof) = (self.unknowns.layout(), dof as usize);
        Unbalanced::LoadOnAddedSupport {
            place: Place {
                point: layout.point(dof),
                component: layout.component(dof),
            },
            force: self.dot(motion, force) / moved,
        }
    }

    /// The largest motion of a body of which something broke or softened, where it is larger than the body itself and what is prescribed to
    /// it: what is left resists the loads by next to nothing, as a hinge that rounding alone keeps stiff. The force is that of the loads and
    /// reactions along the motion, as if it were held.
    pub(super) fn beyond_size(self, loads: &dyn LoadProgram, state: &State) -> Option<Unbalanced> {
        let accuracy = self.accuracy;
        let largest = accuracy.largest_displacement(self.unknowns.layout(), state);
        let limit = accuracy.size.max(accuracy.largest_prescribed(state));
        // Where bonds have a negative stiffness the signs of the pivots tell.
        if largest <= limit || self.some_negative {
            return None;
        }
        let dofs = self.unknowns.degrees_of_freedom();
        let motion: Vec<f64> = (dofs.iter())
            .map(|&dof| state.displacement[dof as usize])
            .collect();
        let force = loads.forces(state.load_factor, dofs);
        Some(self.unresisted(&motion, &force))
    }
}
