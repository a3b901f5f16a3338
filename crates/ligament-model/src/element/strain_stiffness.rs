//! The stiffness of an imaginary element over its strains.

use nalgebra::Matrix3;

/// Entries of a symmetric (3, 3) matrix over (xx, yy, xy): 11, 12, 16, 22, 26, 66.
pub type SymmetricEntries = [f64; 6];

/// Stiffness of a bond over its strains (S_xx, S_yy, S_xy): a density, N/m^6, or with the volumes of its ends the matrix D, J.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrainStiffness {
    /// Entries of the stiffness matrix.
    pub entries: SymmetricEntries,
    /// Fraction of the energy of the bond that belongs to its first end; the rest belongs to the second.
    pub first_share: f64,
}

impl StrainStiffness {
    /// A stiffness with entries that are a factor times as large.
    pub(crate) fn scaled(self, factor: f64) -> Self {
        Self {
            entries: self.entries.map(|entry| factor * entry),
            ..self
        }
    }
}

/// The symmetric matrix of given entries.
pub fn matrix([d11, d12, d16, d22, d26, d66]: SymmetricEntries) -> Matrix3<f64> {
    Matrix3::new(d11, d12, d16, d12, d22, d26, d16, d26, d66)
}

/// The entries of a symmetric matrix.
pub fn entries(matrix: &Matrix3<f64>) -> SymmetricEntries {
    [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)].map(|place| matrix[place])
}

impl StrainStiffness {
    /// Whether every strain stores energy.
    pub(crate) fn is_positive(&self) -> bool {
        matrix(self.entries).cholesky().is_some()
    }

    /// Fraction of the energy of the bond that belongs to its first or its second end.
    pub(crate) fn share(&self, is_first: bool) -> f64 {
        if is_first {
            self.first_share
        } else {
            1.0 - self.first_share
        }
    }
}
