//! What the limits of bonds in space are made from.

use crate::failure::basis::{LimitEnds, weakest};
use crate::material::{Isotropic, Material};
use crate::scatter::Factors;
use crate::system::BondSystem;

/// Body, materials and law, from which criteria make the limits of the bonds.
#[derive(Debug, Clone)]
pub struct SolidBasis<'a> {
    /// The bonds.
    pub system: &'a BondSystem<3>,
    /// Points whose bonds never fail, shape (n_points).
    pub no_fail: &'a [bool],
    /// The materials.
    pub materials: &'a [Material],
    /// The elastic constants that the law makes of those of each material, shape (n_materials).
    pub constants: Vec<Isotropic>,
    /// Factors by which a property varies at random, where one does.
    pub scatter: Option<&'a Factors>,
}

impl SolidBasis<'_> {
    /// A value of each material, from the constants that the law makes of its own; infinite where it has none, shape
    /// (n_materials).
    pub fn each(&self, value: impl Fn(&Isotropic, &Material) -> Option<f64>) -> Vec<f64> {
        let of_materials = self.constants.iter().zip(self.materials);
        of_materials
            .map(|(constants, material)| value(constants, material).unwrap_or(f64::INFINITY))
            .collect()
    }

    /// The smallest of the values of the materials (n_materials) that have a share in an end of each bond or that it crosses, and
    /// infinity where the bond never fails, shape (n_bonds).
    pub fn weakest(&self, of_materials: &[f64]) -> Vec<f64> {
        let BondSystem { cloud, bonds, .. } = self.system;
        weakest(cloud, bonds, self.no_fail, of_materials)
    }

    pub(super) fn ends(&self) -> LimitEnds<'_> {
        LimitEnds {
            ends: &self.system.bonds.ends,
            horizons: &self.system.bonds.horizon,
            scatter: self.scatter,
            portion: self.system.cloud.portion.as_ref(),
        }
    }
}
