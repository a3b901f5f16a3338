//! Shapes of the holes of a lattice, and of parts of a body that form its sets.

mod plane;
mod solid;

pub use plane::{Shape, crosses_itself};
pub use solid::SolidShape;

/// A closed region of the plane or of space, in which cells are removed or selected.
pub trait Region<const D: usize>: Clone + Sync {
    /// The region moved by a vector, m.
    #[must_use]
    fn moved(&self, by: [f64; D]) -> Self;

    /// Whether a point lies in the region or on its rim, or at most `slack` (m) outside of it.
    fn contains(&self, point: [f64; D], slack: f64) -> bool;

    /// Whether the straight line between two points enters the interior of the region deeper than `slack` (m): a line along the rim, or one
    /// that touches it, does not.
    fn is_crossed_by(&self, a: [f64; D], b: [f64; D], slack: f64) -> bool;
}
