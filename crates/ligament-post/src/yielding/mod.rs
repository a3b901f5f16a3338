//! First yield of a family of bonds under a uniform strain: effect of the directions of the bonds on a failure criterion.
//!
//! The bond whose direction is worst for a criterion fails first. The family has bonds in some directions only, so that the load at first
//! yield depends on the orientation of the strain to them (MPPD section 4). With U(Theta) the largest utilisation of the bonds under a
//! strain whose first principal axis is rotated by Theta, the load factor at first yield is 1/U(Theta); with U_th the largest utilisation
//! of a family that has its weakest bonds in every direction, the error is
//!
//! e(Theta) = U_th/U(Theta) - 1.
//!
//! | module | content |
//! |---|---|
//! | [`family`] | utilisation, errors and the worst orientation of a family of bonds |
//! | [`lattice`] | the directions of the bonds of a regular lattice |
//! | [`theory`] | worst direction of a criterion, for U_th |
//! | [`margin`] | the different error measure of MPPD Tables 8 and 9 |
//! | [`locus`] | loci of first yield over all strains, theoretical and effective |
//! | [`field`] | anisotropy of every family of a body |
//!
//! All points rotate with the body: the sliding of a bond follows from the strain alone.

pub mod family;
pub mod field;
pub mod lattice;
pub mod locus;
pub mod margin;
pub mod theory;

pub use family::{Family, WorstOrientation};

use ligament_model::element::BondDeformation;

/// A uniform strain by its principal stretches; the second axis is a quarter turn ahead of the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalStretches {
    /// Principal stretch s_1.
    pub first: f64,
    /// Principal stretch s_2.
    pub second: f64,
}

impl PrincipalStretches {
    /// The strains s_1 and s_2.
    pub const fn new(first: f64, second: f64) -> Self {
        Self { first, second }
    }

    /// Mean (s_1 + s_2)/2.
    pub fn mean(&self) -> f64 {
        0.5 * (self.first + self.second)
    }

    /// Deviator |s_1 - s_2|/2.
    pub fn deviator(&self) -> f64 {
        0.5 * (self.first - self.second).abs()
    }

    /// The strain multiplied by a factor.
    pub fn scaled(&self, factor: f64) -> Self {
        Self::new(factor * self.first, factor * self.second)
    }

    /// Deformation of a bond at the angle x to the first axis, from cos 2x and sin 2x (MPPD eq. 68):
    ///
    /// s = (s_1 + s_2)/2 + (s_1 - s_2)/2 cos 2x, gamma = -(s_1 - s_2)/2 sin 2x.
    #[inline]
    pub fn along(&self, [cosine, sine]: [f64; 2]) -> BondDeformation {
        let half_difference = 0.5 * (self.first - self.second);
        let stretch = self.mean() + half_difference * cosine;
        BondDeformation::new([stretch, -half_difference * sine, 0.0])
    }
}

/// The 101 orientations sampled in MPPD, 0 to 90 degrees in steps of 0.9, rad.
pub fn printed_orientations() -> impl Iterator<Item = f64> + Clone {
    (0..=100u32).map(|k| (0.9 * f64::from(k)).to_radians())
}
