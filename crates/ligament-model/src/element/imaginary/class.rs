//! The classes of the bonds of a lattice.

/// The class of a bond.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BondClass {
    /// Along x.
    Horizontal,
    /// Along y.
    Vertical,
    /// Any other.
    Shear,
}

impl BondClass {
    /// The class of a bond with these direction cosines: rows and columns of a lattice have equal coordinates to the last
    /// bit.
    #[inline]
    pub fn from_direction(direction: [f64; 2]) -> Self {
        match direction {
            [_, 0.0] => Self::Horizontal,
            [0.0, _] => Self::Vertical,
            _ => Self::Shear,
        }
    }
}
