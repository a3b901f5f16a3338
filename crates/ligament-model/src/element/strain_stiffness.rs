//! The stiffness of an imaginary element over its strains.

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
    /// Fraction of the energy of the bond that belongs to its first or its second end.
    pub(crate) fn share(&self, is_first: bool) -> f64 {
        if is_first {
            self.first_share
        } else {
            1.0 - self.first_share
        }
    }
}
