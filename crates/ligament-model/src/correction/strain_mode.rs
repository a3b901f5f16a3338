//! Strains in which energies are compared.

use crate::fixed::EnergyRatio;
use crate::material::Stiffness;
use crate::tensor::{SymTensor, dot};

/// Names of the energy ratios in the uniaxial strains, in results and in text.
const UNIAXIAL: [[&str; 2]; 3] = [
    ["energy_ratio_x", "uniaxial x"],
    ["energy_ratio_y", "uniaxial y"],
    ["energy_ratio_z", "uniaxial z"],
];

/// Names of the energy ratio in the isotropic strain, in the plane and in space.
const ISOTROPIC: [[&str; 2]; 2] = [
    ["energy_ratio_biaxial", "biaxial"],
    ["energy_ratio_hydrostatic", "hydrostatic"],
];

/// Name of the energy ratio in the shear strain of the plane.
const SHEAR: [[&str; 2]; 1] = [["energy_ratio_shear", "shear"]];

/// Names of the energy ratios in the shear strains of space.
const SHEARS: [[&str; 2]; 3] = [
    ["energy_ratio_shear_xy", "shear xy"],
    ["energy_ratio_shear_xz", "shear xz"],
    ["energy_ratio_shear_yz", "shear yz"],
];

/// A homogeneous strain of size one, for which the energy at a point is compared with the energy of the continuum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrainMode<const D: usize> {
    /// Names of the energy ratio in results and in text.
    names: [&'static str; 2],
    /// Strain tensor.
    pub strain: SymTensor<D>,
}

impl<const D: usize> StrainMode<D> {
    /// Uniaxial strains: eps_ii = 1 along each axis.
    pub fn uniaxial() -> [Self; D] {
        std::array::from_fn(|axis| Self {
            names: UNIAXIAL[axis],
            strain: SymTensor::from_fn(|row, column| {
                f64::from(u8::from([row, column] == [axis; 2]))
            }),
        })
    }

    /// All strains: the uniaxial ones, the isotropic one (eps_ii = 1 for all i: biaxial, or hydrostatic) and the shears (gamma_ij = 1).
    pub fn all() -> Vec<Self> {
        let isotropic = Self {
            names: ISOTROPIC[D - 2],
            strain: SymTensor::isotropic(1.0),
        };
        let names: &[[&'static str; 2]] = if D == 2 { &SHEAR } else { &SHEARS };
        let places = SymTensor::<D>::COMPONENTS.iter().filter(|[i, j]| i != j);
        let shears = places.zip(names).map(|(&place, &names)| Self {
            names,
            strain: SymTensor::from_fn(|row, column| match [row, column] == place {
                true => 0.5,
                false => 0.0,
            }),
        });
        let normal = Self::uniaxial().into_iter().chain([isotropic]);
        normal.chain(shears).collect()
    }

    /// Energy ratios in the strain (n_points) with their names in results.
    pub fn named(&self, at_points: Vec<f64>) -> EnergyRatio {
        let [field, strain] = self.names;
        EnergyRatio {
            field,
            strain,
            at_points,
        }
    }

    /// Energy factor k_n s^2 + k_t |gamma|^2 of a bond of direction n under the strain, all rotations zero (NHPD eq. 3): s = n . eps n, and
    /// gamma = eps n - s n with the length of n x eps n.
    pub fn density(&self, n: [f64; D], axial: f64, shear: f64) -> f64 {
        if self.strain == SymTensor::isotropic(1.0) {
            return axial;
        }
        let along = self.strain.times(n);
        let stretch = dot(n, along);
        let mut density = axial * stretch * stretch;
        for &[i, j] in SymTensor::<D>::COMPONENTS {
            if i != j {
                let gamma = n[i] * along[j] - n[j] * along[i];
                density += shear * gamma * gamma;
            }
        }
        density
    }

    /// Strain energy density 1/2 eps C eps of a continuum with a given stiffness, J/m^3 (NHPD eq. 11 for the uniaxial strains).
    pub fn energy(&self, stiffness: &Stiffness) -> f64 {
        let strain: Vec<f64> = self.strain.engineering().collect();
        let rows = strain.iter().enumerate().map(|(row, one)| {
            let stresses = strain.iter().enumerate();
            let stress: f64 = stresses.map(|(k, other)| stiffness[(row, k)] * other).sum();
            one * stress
        });
        0.5 * rows.sum::<f64>()
    }
}
