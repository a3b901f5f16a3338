//! Motions without stiffness, as an iterative solver finds them in a body that has become a mechanism, or in a part of it.
//!
//! A direct solver detects such a motion by a vanishing pivot, fixes one of its degrees of freedom and reads the reaction there.
//! Here the motion itself is known, and the reaction is the work of the forces on it over the motion of the degree of freedom.

use ligament_model::subdomain::Subdomain;

use super::accuracy::Accuracy;
use crate::state::State;
use crate::tangent::UNRESISTED;
use crate::unbalanced::{Place, Unbalanced};
use crate::unknowns::Unknowns;
use crate::vectors::dot_of_all;

/// Data by which motions of a body are judged.
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

    /// Whether the stiffness K resists a solution u of K u = f, both of shape (n_unknowns), by more than the rounding of the
    /// stiffnesses k_i of the points: u . f > 1e-14 sum k_i u_i^2.
    pub(super) fn is_resisted(self, solution: &[f64], force: &[f64]) -> bool {
        let stiffness = &self.accuracy.local_stiffness;
        let dofs = self.unknowns.degrees_of_freedom().iter();
        let pushed: Vec<f64> = (dofs.zip(solution))
            .map(|(&dof, value)| stiffness.at(dof as usize) * value)
            .collect();
        let of_points = self.dot(&pushed, solution);
        of_points == 0.0 || self.dot(solution, force) > UNRESISTED * of_points
    }

    /// Reason why there is no equilibrium under forces f (n_unknowns) where a motion (n_unknowns) has no stiffness. Where the
    /// motion is unknown (all zero), the forces give its direction.
    pub(super) fn unresisted(self, motion: &[f64], force: &[f64]) -> Unbalanced {
        if self.some_negative {
            return Unbalanced::NegativeCurvature;
        }
        let is_known = self.dot(motion, motion) > 0.0;
        let motion = if is_known { motion } else { force };
        let Some((dof, moved)) = self.farthest(motion, |_| true) else {
            return Unbalanced::NegativeCurvature;
        };
        let layout = self.unknowns.layout();
        Unbalanced::LoadOnAddedSupport {
            place: Place {
                point: layout.point(dof),
                component: layout.component(dof),
            },
            force: self.dot(motion, force) / moved,
        }
    }

    /// Degree of freedom (of the body) that a motion (n_unknowns) moves farthest, by stiffness times its square, among the unknowns
    /// that may be taken, and how far; None for no motion.
    fn farthest(self, motion: &[f64], may_take: impl Fn(usize) -> bool) -> Option<(usize, f64)> {
        let stiffness = &self.accuracy.local_stiffness;
        let dofs = self.unknowns.degrees_of_freedom().iter();
        let n_components = self.unknowns.layout().components.len();
        let moved = dofs.map(|&dof| dof as usize).zip(motion);
        let may_be_taken = moved.filter(|(dof, _)| may_take(*dof));
        let farthest = may_be_taken.fold([0.0; 3], |most, (dof, value)| {
            let size = -stiffness.at(dof) * value * value;
            if size < most[0] {
                let in_body = self.subdomain.index_in_body(dof, n_components);
                [size, in_body as f64, *value]
            } else {
                most
            }
        });
        let of_all = self.subdomain.all_reduce_min(Some(farthest));
        let [size, dof, moved] = of_all.unwrap_or(farthest);
        (size != 0.0).then_some((dof as usize, moved))
    }

    /// Degree of freedom (of the body) that moves farthest in a body with broken or softened bonds whose largest displacement exceeds both
    /// its size and the prescribed displacements: nearly no stiffness is left, or supports that were added for a motion without stiffness
    /// are where it is small. None where only added supports are that far.
    pub(super) fn beyond_size(self, state: &State) -> Option<usize> {
        let accuracy = self.accuracy;
        let largest = accuracy.largest_displacement(self.unknowns.layout(), state);
        let limit = accuracy.size_or_prescribed(state);
        // Where bonds have a negative stiffness, the signs of the pivots decide.
        if largest <= limit || self.some_negative {
            return None;
        }
        let dofs = self.unknowns.degrees_of_freedom();
        let motion: Vec<f64> = (dofs.iter())
            .map(|&dof| state.displacement[dof as usize])
            .collect();
        let farthest = self.farthest(&motion, |dof| !state.held[dof]);
        farthest.map(|(dof, _)| dof)
    }
}
