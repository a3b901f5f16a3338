//! Diagonal entries of a matrix that changes, and what counts as a pivot that vanished.

/// A pivot below this share of its own diagonal entry of the matrix, at its largest since the matrix was factorised, counts
/// as zero: what downdates leave of a zero is rounding, some 1e-14 of that entry.
pub const VANISHING_PIVOT: f64 = 1e-10;

/// A diagonal entry of the matrix.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DiagonalEntry {
    value: f64,
    /// Largest size of the entry since the matrix was factorised: the measure of what rounding left in the factor.
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
