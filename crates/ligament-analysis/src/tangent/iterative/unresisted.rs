//! The motion that a body does not resist and forces push: conjugate residuals (Saad 2003, section 6.8) with block Jacobi.
//!
//! Conjugate gradients go astray in a body that has become a mechanism: forces along a motion that costs nothing have no solution, and
//! the coarse stiffness, nearly singular, steers by its rounding. Conjugate residuals bring the least force out of balance that there
//! is, and of forces r that no motion balances, M^-1 r is the motion.

use super::conjugate::ITERATION_LIMIT;
use super::operator::Operator;
use super::point_blocks::PointBlocks;
use crate::tangent::UNRESISTED;
use crate::vectors::{dot_of_chunks, weighted_square};

/// Share of the motion M^-1 f of the forces at which what is left of it is rounding: the body resists all of them.
const ROUNDING: f64 = 1e-14;

/// The motion that the stiffness K resists by no more than the rounding of the stiffnesses of the points, and that forces
/// (n_degrees_of_freedom) push; none where it balances them.
///
/// The motions z = M^-1 r of the forces r out of balance are followed alone: a step takes a M^-1 q from z with a = z . K z / q . M^-1 q, and
/// q = K z + b q goes on with b = z . K z over that before.
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
