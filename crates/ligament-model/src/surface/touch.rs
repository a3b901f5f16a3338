//! An integration point of a surface in contact, with its history.

use serde::{Deserialize, Serialize};

use crate::tensor::{dot, norm};

/// A vector of space; in the plane without a third component.
pub type Vector = [f64; 3];

/// An integration point of a surface in contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Touch {
    /// Number of the integration point.
    pub place: u32,
    /// Number of the facet in contact; none for a rigid body.
    pub onto: Option<u32>,
    /// Weights of the corners of this facet at the contact.
    pub weights: Vector,
    /// Vector from the middle of the rigid body to the contact, m.
    pub arm: Vector,
    /// Outward unit normal of the other surface.
    pub normal: Vector,
    /// Overlap -g, m.
    pub overlap: f64,
    /// Overlap -g_0 without a force, m.
    pub offset: f64,
    /// Elastic part s of the sliding, m.
    pub slip: Vector,
    /// Stiffness k A, N/m.
    pub stiffness: f64,
    /// Work done on the contact along the normal that it may return, J; 0 except in explicit steps.
    pub credit: f64,
    /// Area A of the integration point, m^2.
    pub area: f64,
    /// Whether the force counts for the first surface of the pair; otherwise the opposite one does.
    pub is_first: bool,
}

impl Touch {
    /// Depth of the overlap that causes a force, m.
    pub fn depth(&self) -> f64 {
        self.overlap - self.offset
    }

    /// Pressing force along the normal on the surface of the integration point, N.
    pub fn normal_force(&self) -> Vector {
        self.normal.map(|it| self.stiffness * self.depth() * it)
    }

    /// Force of friction on the surface of the integration point, N.
    pub fn friction_force(&self) -> Vector {
        self.slip.map(|it| -self.stiffness * it)
    }

    /// Force on the surface of the integration point, N.
    pub fn force(&self) -> Vector {
        let (normal, friction) = (self.normal_force(), self.friction_force());
        std::array::from_fn(|axis| normal[axis] + friction[axis])
    }

    /// Stored energy, J.
    pub fn energy(&self) -> f64 {
        let depth = self.depth().max(0.0);
        0.5 * self.stiffness * (depth.powi(2) + dot(self.slip, self.slip))
    }
}

/// Elastic part of the sliding that friction can hold at a depth, with the coefficient of friction.
pub(super) fn held_slip<const D: usize>(trial: [f64; D], friction: f64, depth: f64) -> [f64; D] {
    let (most, size) = (friction * depth, norm(trial));
    if size <= most {
        trial
    } else {
        trial.map(|it| it * (most / size))
    }
}
