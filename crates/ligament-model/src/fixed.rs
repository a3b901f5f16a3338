//! Fields of the model preparation that an analysis does not change.

use crate::scatter::Factors;

/// Constant fields of points and bonds beside the arrays of the bond system.
#[derive(Debug, Clone, PartialEq)]
pub struct ConstantFields {
    /// Horizons, shape (n_points), m.
    pub horizon: Vec<f64>,
    /// Fraction of the bonds of each point that pre-cracks cut, shape (n_points).
    pub precrack_share: Vec<f64>,
    /// Ratio of the energy density to the continuum's in uniform strains: in the plane uniaxial x, uniaxial y, biaxial and shear.
    pub energy_ratios: Vec<EnergyRatio>,
    /// Factor Omega of each bond, shape (n_bonds).
    pub domain_factor: Vec<f64>,
    /// Ratio of the factor of the shear stiffness to Omega, shape (n_bonds); empty where all are 1.
    pub shear_ratio: Vec<f64>,
    /// Residual of the equations of the patch correction at each point, shape (n_points); empty without it.
    pub patch_residual: Vec<f64>,
    /// Points whose bonds never fail, shape (n_points).
    pub no_fail: Vec<bool>,
    /// Number of the material of each cell in the order of the case, from 1, shape (n_cells); empty where the body has one material.
    pub material_of_cell: Vec<i64>,
    /// Name of each interface between materials, and whether each bond crosses it, shape (n_bonds).
    pub interfaces: Vec<(String, Vec<bool>)>,
    /// Random factors of each property that varies; empty where none does.
    pub scatter: Vec<Factors>,
    /// Pairs within a horizon that are not bonded, in the order of their ends.
    pub absent: Vec<AbsentBond>,
}

/// Ratio of the energy density of the bonds in a uniform strain to the continuum's.
#[derive(Debug, Clone, PartialEq)]
pub struct EnergyRatio {
    /// Name of the field in results: `energy_ratio_x`.
    pub field: &'static str,
    /// Name of the strain in text: `uniaxial x`.
    pub strain: &'static str,
    /// Ratio at each point, shape (n_points).
    pub at_points: Vec<f64>,
}

/// A pair of points, at least one of which lies in the horizon of the other, without a bond.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AbsentBond {
    /// Points A < B.
    pub ends: [u32; 2],
    /// Bond horizon H, m.
    pub horizon: f64,
    /// Reason of the absence.
    pub absence: Absence,
}

/// Why two points within a horizon are not bonded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Absence {
    /// A pre-crack cut the bond.
    PreCrack,
    /// The straight line between them leaves the body: a hole, slot, notch or crack of the mesh lies there.
    Void,
}

impl Absence {
    /// Number of the reason in files.
    pub fn number(self) -> i64 {
        match self {
            Self::PreCrack => 1,
            Self::Void => 2,
        }
    }

    /// Reason for a number in a file; `None` for a bond.
    pub fn from_number(number: i64) -> Option<Self> {
        [Self::PreCrack, Self::Void]
            .into_iter()
            .find(|absence| absence.number() == number)
    }
}
