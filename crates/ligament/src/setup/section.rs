//! Section of a body: state of the plane and thickness.

use ligament_model::Plane;
use ligament_model::material::Space;

use crate::body::AnyBody;

/// Section of the body: its extent across the dimensions of its points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Section {
    /// A plate or a slice of a long body.
    Plane {
        /// Plane stress or plane strain.
        state: Plane,
        /// Thickness, m.
        thickness: f64,
    },
    /// A solid.
    Solid,
}

impl Section {
    /// The default section of a body: plane stress and 1 m thick, or a solid.
    pub fn usual(body: &AnyBody) -> Self {
        match body {
            AnyBody::Plane(_) => Self::Plane {
                state: Plane::Stress,
                thickness: 1.0,
            },
            AnyBody::Solid(_) => Self::Solid,
        }
    }

    /// The space in which the body deforms.
    pub fn space(&self) -> Space {
        match *self {
            Self::Plane { state, .. } => Space::Plane(state),
            Self::Solid => Space::Solid,
        }
    }

    /// Thickness, m; 1 for a solid.
    pub fn thickness(&self) -> f64 {
        match *self {
            Self::Plane { thickness, .. } => thickness,
            Self::Solid => 1.0,
        }
    }
}
