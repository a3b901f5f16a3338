//! Coordinates in words.

use crate::setup::Position;

/// Coordinates as errors show them.
pub(crate) fn coordinates(position: &[f64]) -> String {
    let coordinates = position.iter().map(|it| format!("{it:.6}"));
    coordinates.collect::<Vec<_>>().join(", ")
}

/// The first D coordinates of a position, or components of a vector.
pub(crate) fn narrowed<const D: usize>(position: Position) -> [f64; D] {
    std::array::from_fn(|axis| position[axis])
}

/// A position in D dimensions with zeros for what it does not have.
pub(crate) fn widened<const D: usize>(position: [f64; D]) -> Position {
    std::array::from_fn(|axis| position.get(axis).copied().unwrap_or(0.0))
}
