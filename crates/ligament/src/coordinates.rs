//! Formatting and conversion of coordinates.

use crate::setup::Position;

/// Coordinates (m) as text for errors.
pub(crate) fn coordinates(position: &[f64]) -> String {
    let coordinates = position.iter().map(|it| format!("{it:.6}"));
    coordinates.collect::<Vec<_>>().join(", ")
}

/// The first D coordinates of a position, or components of a vector.
pub(crate) fn narrowed<const D: usize>(position: Position) -> [f64; D] {
    std::array::from_fn(|axis| position[axis])
}

/// Coordinates of a point in D dimensions.
pub(crate) fn in_dimensions<const D: usize>(position: &[f64]) -> [f64; D] {
    std::array::from_fn(|axis| position[axis])
}
