//! Initial velocities and quiet edges of a motion.

use super::conditions::{Place, Position};

/// Velocity of a part of the body at time zero.
#[derive(Debug, Clone, PartialEq)]
pub struct InitialVelocity {
    /// Part of the body.
    pub place: Place,
    /// Velocity, m/s.
    pub velocity: Position,
}

/// Part of the outline through which waves leave the body: dashpots from its points to the ground (Lysmer and Kuhlemeyer 1969).
///
/// On an area A with the normal n their force is -C v with C = A rho (c_P n n^T + c_S (I - n n^T)), so that waves along n are not reflected.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct QuietEdge {
    /// Group on the outline.
    pub group: String,
}
