//! Strains by which energies are compared.

use nalgebra::Vector3;

use crate::fixed::EnergyRatio;
use crate::material::{Elasticity, Plane};

/// Homogeneous strains of size one, for which the energy at a point is compared with the continuum's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StrainMode {
    /// eps_xx = 1.
    UniaxialX,
    /// eps_yy = 1.
    UniaxialY,
    /// eps_xx = eps_yy = 1.
    Biaxial,
    /// gamma_xy = 1 (eps_xy = 1/2).
    Shear,
}

impl StrainMode {
    /// All modes, in the order of [`energy_ratios`](super::domain::energy_ratios).
    pub const ALL: [Self; 4] = [Self::UniaxialX, Self::UniaxialY, Self::Biaxial, Self::Shear];

    /// Ratios of energies in the strain (n_points) with the names that results give them.
    pub fn named(self, at_points: Vec<f64>) -> EnergyRatio {
        let (field, strain) = match self {
            Self::UniaxialX => ("energy_ratio_x", "uniaxial x"),
            Self::UniaxialY => ("energy_ratio_y", "uniaxial y"),
            Self::Biaxial => ("energy_ratio_biaxial", "biaxial"),
            Self::Shear => ("energy_ratio_shear", "shear"),
        };
        EnergyRatio {
            field,
            strain,
            at_points,
        }
    }

    /// Stretch s and shear gamma of a bond of direction (a, b) under the strain, all rotations zero (NHPD eq. 3).
    pub fn bond_deformation(self, [a, b]: [f64; 2]) -> (f64, f64) {
        match self {
            Self::UniaxialX => (a * a, -a * b),
            Self::UniaxialY => (b * b, a * b),
            Self::Biaxial => (1.0, 0.0),
            Self::Shear => (a * b, 0.5 * (a * a - b * b)),
        }
    }

    /// The strains (eps_xx, eps_yy, gamma_xy).
    pub fn strain(self) -> [f64; 3] {
        match self {
            Self::UniaxialX => [1.0, 0.0, 0.0],
            Self::UniaxialY => [0.0, 1.0, 0.0],
            Self::Biaxial => [1.0, 1.0, 0.0],
            Self::Shear => [0.0, 0.0, 1.0],
        }
    }

    /// Strain energy density 1/2 eps C eps of the continuum, J/m^3 (NHPD eq. 11 for the uniaxial ones).
    pub fn energy(self, material: &Elasticity, plane: Plane) -> f64 {
        let strain = Vector3::from(self.strain());
        0.5 * strain.dot(&(material.plane_stiffness(plane) * strain))
    }
}
