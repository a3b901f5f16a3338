//! Components of the motion of a point, and where arrays over all points hold them.

use crate::element::UNKNOWNS;

/// A component of the motion of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Component {
    /// Displacement along x, m.
    X,
    /// Displacement along y, m.
    Y,
    /// Rotation, counter-clockwise, rad.
    Rotation,
}

impl Component {
    /// All components in their order at a point.
    pub const ALL: [Self; UNKNOWNS] = [Self::X, Self::Y, Self::Rotation];

    /// Position among the components of a point.
    pub fn index(self) -> usize {
        self as usize
    }

    /// The component at a position of the arrays over (3 n_points).
    #[inline]
    pub fn at(degree_of_freedom: usize) -> Self {
        match degree_of_freedom % UNKNOWNS {
            0 => Self::X,
            1 => Self::Y,
            _ => Self::Rotation,
        }
    }

    /// Whether the component is an angle.
    #[inline]
    pub fn is_rotation(self) -> bool {
        self == Self::Rotation
    }

    /// Name in case files and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Rotation => "rotation",
        }
    }
}
