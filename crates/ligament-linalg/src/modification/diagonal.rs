//! Diagonal entries of a matrix under updates, and the rule for a vanishing pivot.

/// Ratio below which a pivot counts as zero, relative to the largest value of its diagonal entry of the matrix since the factorisation:
/// downdates leave rounding of some 1e-14 of that entry in place of a zero.
pub const VANISHING_PIVOT: f64 = 1e-10;

/// A diagonal entry of the matrix.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DiagonalEntry {
    value: f64,
    /// Largest absolute value of the entry since the matrix was factorised, which scales the rounding errors of the factor.
    pub(super) largest: f64,
}

impl DiagonalEntry {
    pub(crate) fn new(value: f64) -> Self {
        let largest = value.abs();
        Self { value, largest }
    }

    pub(super) fn add(&mut self, change: f64) {
        self.value += change;
        self.largest = self.largest.max(self.value.abs());
    }
}
