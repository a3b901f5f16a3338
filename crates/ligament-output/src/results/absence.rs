//! Pairs of points within a horizon that are no bonds.

/// A pair of points, one in the horizon of the other, that is no bond.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AbsentBond {
    /// Points A < B.
    pub ends: [u32; 2],
    /// Bond horizon H, m.
    pub horizon: f64,
    /// The reason why the points are not bonded.
    pub absence: Absence,
}

/// The reason why two points within a horizon are not bonded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Absence {
    /// A pre-crack cut the bond.
    PreCrack,
    /// A hole lies between the points.
    Hole,
}

impl Absence {
    /// The number that stands for the reason in files.
    pub(super) fn number(self) -> i64 {
        match self {
            Self::PreCrack => 1,
            Self::Hole => 2,
        }
    }

    /// The reason that a number in a file stands for; None for a bond.
    pub(super) fn from_number(number: i64) -> Option<Self> {
        [Self::PreCrack, Self::Hole]
            .into_iter()
            .find(|absence| absence.number() == number)
    }
}
