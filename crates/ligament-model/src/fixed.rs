//! What the preparation of a model finds and an analysis does not change.

use crate::scatter::Factors;

/// Fields of points and bonds that an analysis does not change, beside those of the bond system.
#[derive(Debug, Clone, PartialEq)]
pub struct ConstantFields {
    /// Horizons, shape (n_points), m.
    pub horizon: Vec<f64>,
    /// Share of its bonds that pre-cracks cut, shape (n_points).
    pub precrack_share: Vec<f64>,
    /// Energy density over the continuum's in uniform strains: in the plane uniaxial x, uniaxial y, biaxial and shear.
    pub energy_ratios: Vec<EnergyRatio>,
    /// Omega of each bond, shape (n_bonds).
    pub domain_factor: Vec<f64>,
    /// Factors of the shear stiffness over Omega, shape (n_bonds); empty where all are 1.
    pub shear_ratio: Vec<f64>,
    /// What the patch correction leaves of the equations of each point, shape (n_points); empty without it.
    pub patch_residual: Vec<f64>,
    /// Points whose bonds never fail, shape (n_points).
    pub no_fail: Vec<bool>,
    /// Factors by which a property varies at random, where one does.
    pub scatter: Option<Factors>,
    /// Pairs within a horizon that are no bonds, in the order of their ends.
    pub absent: Vec<AbsentBond>,
}

/// Energy density of the bonds in a uniform strain over the continuum's.
#[derive(Debug, Clone, PartialEq)]
pub struct EnergyRatio {
    /// Name of the field in results: `energy_ratio_x`.
    pub field: &'static str,
    /// The strain in words: `uniaxial x`.
    pub strain: &'static str,
    /// Ratio at each point, shape (n_points).
    pub at_points: Vec<f64>,
}

/// A pair of points, one in the horizon of the other, that is no bond.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AbsentBond {
    /// Points A < B.
    pub ends: [u32; 2],
    /// Bond horizon H, m.
    pub horizon: f64,
    /// What separates them.
    pub absence: Absence,
}

/// Why two points within a horizon are not bonded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Absence {
    /// A pre-crack cut the bond.
    PreCrack,
    /// The straight line between them leaves the body: a hole, slot or notch lies there.
    Void,
}

impl Absence {
    /// The number that stands for the reason in files.
    pub fn number(self) -> i64 {
        match self {
            Self::PreCrack => 1,
            Self::Void => 2,
        }
    }

    /// The reason that a number in a file stands for; None for a bond.
    pub fn from_number(number: i64) -> Option<Self> {
        [Self::PreCrack, Self::Void]
            .into_iter()
            .find(|absence| absence.number() == number)
    }
}
