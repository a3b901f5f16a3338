//! Sections of bodies in the plane.

use ligament_model::Plane;

/// Section of the body: what a point of the plane stands for across it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Section {
    /// A plate or a slice of a long body.
    Plane {
        /// Plane stress or plane strain.
        state: Plane,
        /// Thickness, m.
        thickness: f64,
    },
}
