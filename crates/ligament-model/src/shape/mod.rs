//! Shapes: holes of a lattice, and the parts of a body that its sets are.

mod plane;
mod solid;

pub use plane::{Shape, crosses_itself};
pub use solid::SolidShape;

/// A closed region of the plane or of space, by which cells are removed or gathered.
pub trait Region<const D: usize>: Clone + Sync {
    /// The region moved by a vector, m.
    #[must_use]
    fn moved(&self, by: [f64; D]) -> Self;

    /// Whether a point lies in the region or on its rim, or no farther than `slack` outside of it (m).
    fn contains(&self, point: [f64; D], slack: f64) -> bool;

    /// Whether the straight line between two points meets the inside of the region deeper than `slack` (m): a line along the rim or one
    /// that touches it does not.
    fn is_crossed_by(&self, a: [f64; D], b: [f64; D], slack: f64) -> bool;
}
