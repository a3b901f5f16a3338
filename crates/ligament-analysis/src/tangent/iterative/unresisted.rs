//! Motion without stiffness on which forces do work, by conjugate residuals (Saad 2003, section 6.8) with block Jacobi.
//!
//! Conjugate gradients fail in a body that has become a mechanism: forces along a motion without stiffness have no solution, and
//! the nearly singular coarse stiffness is dominated by rounding. Conjugate residuals minimise the residual force; where a residual
//! r cannot be reduced, M^-1 r is the motion.

use super::conjugate::ITERATION_LIMIT;
use super::operator::Operator;
use super::point_blocks::PointBlocks;
use crate::tangent::UNRESISTED;
use crate::vectors::{dot_of_chunks, weighted_square};

/// Share of the motion M^-1 f of the forces below which the remaining motion is rounding: the body resists all forces.
const ROUNDING: f64 = 1e-14;

/// Motion whose stiffness does not exceed the rounding of the stiffnesses of the points, and on which forces (n_degrees_of_freedom)
/// do work; none where the body balances the forces.
///
/// Only the preconditioned residual z = M^-1 r is iterated: a step subtracts a M^-1 q from z with a = z . K z / q . M^-1 q, and the
/// next q is K z + b q with b = z . K z over its previous value.
pub(super) fn motion(
    operator: &Operator<'_>,
    blocks: &PointBlocks,
    force: &[f64],
) -> Option<Vec<f64>> {
    let mut motion = blocks.conditioned(force);
    let mut pushed = vec![0.0; motion.len()];
    operator.multiply(&motion, &mut pushed);
    let mut pushed_by_search = pushed.clone();
    let mut curvature = dot_of_chunks(&motion, &pushed);
    let at_first = weighted_square(blocks.diagonal(), &motion);
    for _ in 0..ITERATION_LIMIT {
        let of_points = weighted_square(blocks.diagonal(), &motion);
        // A motion that is not a number is none.
        if of_points.is_nan() || of_points <= ROUNDING.powi(2) * at_first {
            return None;
        }
        if curvature <= UNRESISTED * of_points {
            return Some(motion);
        }
        let step = blocks.conditioned(&pushed_by_search);
        let size = curvature / dot_of_chunks(&pushed_by_search, &step);
        for (motion, step) in motion.iter_mut().zip(&step) {
            *motion -= size * step;
        }
        operator.multiply(&motion, &mut pushed);
        let before = curvature;
        curvature = dot_of_chunks(&motion, &pushed);
        for (search, pushed) in pushed_by_search.iter_mut().zip(&pushed) {
            *search = pushed + curvature / before * *search;
        }
    }
    None
}
