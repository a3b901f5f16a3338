//! Strains in space by which energies are compared.

use crate::fixed::EnergyRatio;
use crate::material::Isotropic;

/// Homogeneous strains of size one, for which the energy at a point is compared with the continuum's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SolidStrainMode {
    /// eps_xx = 1.
    UniaxialX,
    /// eps_yy = 1.
    UniaxialY,
    /// eps_zz = 1.
    UniaxialZ,
    /// eps_xx = eps_yy = eps_zz = 1.
    Hydrostatic,
    /// gamma_xy = 1 (eps_xy = 1/2).
    ShearXy,
    /// gamma_xz = 1.
    ShearXz,
    /// gamma_yz = 1.
    ShearYz,
}

impl SolidStrainMode {
    /// All modes, in the order of [`energy_ratios`](super::axes::energy_ratios).
    pub const ALL: [Self; 7] = [
        Self::UniaxialX,
        Self::UniaxialY,
        Self::UniaxialZ,
        Self::Hydrostatic,
        Self::ShearXy,
        Self::ShearXz,
        Self::ShearYz,
    ];

    /// Ratios of energies in the strain (n_points) with the names that results give them.
    pub fn named(self, at_points: Vec<f64>) -> EnergyRatio {
        let (field, strain) = match self {
            Self::UniaxialX => ("energy_ratio_x", "uniaxial x"),
            Self::UniaxialY => ("energy_ratio_y", "uniaxial y"),
            Self::UniaxialZ => ("energy_ratio_z", "uniaxial z"),
            Self::Hydrostatic => ("energy_ratio_hydrostatic", "hydrostatic"),
            Self::ShearXy => ("energy_ratio_shear_xy", "shear xy"),
            Self::ShearXz => ("energy_ratio_shear_xz", "shear xz"),
            Self::ShearYz => ("energy_ratio_shear_yz", "shear yz"),
        };
        EnergyRatio {
            field,
            strain,
            at_points,
        }
    }

    /// s^2 and |gamma|^2 of a bond of direction n under the strain, without rotations: s = n . eps n, |gamma|^2 = |eps n|^2 - s^2.
    pub fn bond_deformation(self, [x, y, z]: [f64; 3]) -> [f64; 2] {
        let (stretch, square): (f64, f64) = match self {
            Self::UniaxialX => (x * x, x * x),
            Self::UniaxialY => (y * y, y * y),
            Self::UniaxialZ => (z * z, z * z),
            Self::Hydrostatic => return [1.0, 0.0],
            Self::ShearXy => (x * y, 0.25 * (x * x + y * y)),
            Self::ShearXz => (x * z, 0.25 * (x * x + z * z)),
            Self::ShearYz => (y * z, 0.25 * (y * y + z * z)),
        };
        let of_stretch = stretch * stretch;
        [of_stretch, square - of_stretch]
    }

    /// Strain energy density of an isotropic continuum, J/m^3: E (1 - nu)/(2 (1 + nu)(1 - 2 nu)) uniaxial, 9 K/2 hydrostatic, G/2 in shear.
    pub fn energy(self, material: &Isotropic) -> f64 {
        let Isotropic { young, poisson } = *material;
        match self {
            Self::UniaxialX | Self::UniaxialY | Self::UniaxialZ => {
                0.5 * young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson))
            }
            Self::Hydrostatic => 1.5 * young / (1.0 - 2.0 * poisson),
            Self::ShearXy | Self::ShearXz | Self::ShearYz => 0.25 * young / (1.0 + poisson),
        }
    }
}
