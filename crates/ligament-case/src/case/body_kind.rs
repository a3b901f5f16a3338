//! Bodies in the plane and solids.

/// A body in the plane, or a solid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodyKind {
    /// Body in the plane of x and y.
    Plane,
    /// Solid in space.
    Solid,
}
