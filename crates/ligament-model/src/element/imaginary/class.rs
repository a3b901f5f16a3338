//! Classes of the bonds of a lattice.

/// Class of a bond by its direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BondClass {
    /// H: bond along x.
    Horizontal,
    /// V: bond along y.
    Vertical,
    /// S: bond in any other direction.
    Shear,
}

impl BondClass {
    /// The class of a bond with given direction cosines: points in a row or column of a lattice have equal coordinates to the last bit.
    #[inline]
    pub fn from_direction(direction: [f64; 2]) -> Self {
        match direction {
            [_, 0.0] => Self::Horizontal,
            [0.0, _] => Self::Vertical,
            _ => Self::Shear,
        }
    }
}
