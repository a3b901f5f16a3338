//! Strains of a bond that criteria measure.

use serde::{Deserialize, Serialize};

/// Deformation of a bond: the strains of its element, in the order of [`ElementKind::strain_names`](super::ElementKind::strain_names).
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct BondDeformation {
    strains: [f64; 3],
}

impl BondDeformation {
    /// The deformation with strains in the order of their names: for a bond of two points stretch s, shear deformation gamma, rad, and
    /// relative rotation theta_B - theta_A of the ends, rad; zero where the element does not have one.
    #[inline]
    pub const fn new(strains: [f64; 3]) -> Self {
        Self { strains }
    }

    /// The deformation of an imaginary element with the strains (S_xx, S_yy, S_xy).
    #[inline]
    pub const fn of_strain([xx, yy, xy]: [f64; 3]) -> Self {
        Self {
            strains: [xx, xy, yy],
        }
    }

    /// Stretch s of a bond of two points.
    #[inline]
    pub fn stretch(&self) -> f64 {
        self.strains[0]
    }

    /// Shear deformation gamma of a bond of two points, rad.
    #[inline]
    pub fn shear(&self) -> f64 {
        self.strains[1]
    }

    /// Relative rotation theta_B - theta_A of the ends of a bond of two points, rad.
    #[inline]
    pub fn rotation(&self) -> f64 {
        self.strains[2]
    }

    /// The strains (S_xx, S_yy, S_xy) of an imaginary element.
    #[inline]
    pub fn strain(&self) -> [f64; 3] {
        let [xx, xy, yy] = self.strains;
        [xx, yy, xy]
    }

    /// All strains in the order of their names.
    #[inline]
    pub fn strains(&self) -> [f64; 3] {
        self.strains
    }

    /// The deformation times a factor.
    #[inline]
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            strains: self.strains.map(|strain| factor * strain),
        }
    }

    /// The deformation minus another one.
    #[inline]
    pub fn less(&self, other: &Self) -> Self {
        Self {
            strains: std::array::from_fn(|place| self.strains[place] - other.strains[place]),
        }
    }
}
