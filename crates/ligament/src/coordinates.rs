//! Coordinates in words.

/// Coordinates as errors show them.
pub(crate) fn coordinates(position: &[f64]) -> String {
    let coordinates = position.iter().map(|it| format!("{it:.6}"));
    coordinates.collect::<Vec<_>>().join(", ")
}
