//! The extent of a point across the dimensions of its body.

use ligament_model::Plane;
use ligament_model::material::Space;

/// Section of the body: the part of it that a point stands for across its dimensions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Section {
    /// A plate or a slice of a long body.
    Plane {
        /// Plane stress or plane strain.
        state: Plane,
        /// Thickness, m.
        thickness: f64,
    },
    /// A solid, whose points stand for volumes alone.
    Solid,
}

impl Section {
    /// The usual section of bodies in D dimensions: plane stress and 1 m thick, or a solid.
    pub fn usual<const D: usize>() -> Self {
        match D {
            2 => Self::Plane {
                state: Plane::Stress,
                thickness: 1.0,
            },
            _ => Self::Solid,
        }
    }

    /// The space in which the body deforms.
    pub fn space(&self) -> Space {
        match *self {
            Self::Plane { state, .. } => Space::Plane(state),
            Self::Solid => Space::Solid,
        }
    }

    /// Thickness, m; 1 of a solid.
    pub fn thickness(&self) -> f64 {
        match *self {
            Self::Plane { thickness, .. } => thickness,
            Self::Solid => 1.0,
        }
    }
}
