//! What a criterion weakens in a bond that softens.

/// Resistance that a criterion weakens in a bond once its limit is passed and before it breaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Weakened {
    /// Resistance to stretch, shear and rotation; not to shortening, because the faces of the crack touch.
    Opening,
    /// Resistance to shortening, shear and rotation.
    Crushing,
    /// Resistance to shear.
    Sliding,
    /// All resistance, where shear under pressure crushes the material.
    Whole,
}

impl Weakened {
    /// Whether damage of this kind shows in the field of another one: what takes all resistance is a shear failure.
    pub fn shows_as(self, way: Self) -> bool {
        self == way || (self == Self::Whole && way == Self::Sliding)
    }
}
