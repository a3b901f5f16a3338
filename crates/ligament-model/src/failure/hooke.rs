//! Moduli of the stresses around a bond, by Hooke's law.

use crate::material::{Isotropic, Plane, Space};
use crate::stress::point_strain::StrainAround;

/// Moduli of a bond over the modulus E' of a strain along the bond alone. With them the stresses on the plane across the bond are
///
/// sigma_n/E' = s + (lambda/E') (tr(eps) - n . eps n), tau/E' = (2 mu/E') (eps n - (n . eps n) n),
///
/// with the own stretch s of the bond and the strain eps of the points ([`crate::stress::point_strain`]), by Hooke's law:
///
/// | | E' | lambda/E' | 2 mu/E' |
/// |---|---|---|---|
/// | plane stress | E/(1 - nu^2) | nu | 1 - nu |
/// | plane strain, space | E (1 - nu)/((1 + nu)(1 - 2 nu)) | nu/(1 - nu) | (1 - 2 nu)/(1 - nu) |
///
/// The strain n . eps n in the place of s would blunt notches and stop cracks: it knows nothing of what is between the ends. Where the
/// bonds of neither end span the space a bond is a bar, sigma_n = E s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moduli {
    /// lambda/E'.
    pub lateral: f64,
    /// 2 mu/E'.
    pub shear: f64,
    /// E/E' of a bar.
    pub bar: f64,
    /// E', Pa.
    pub along: f64,
}

/// Stress on the plane across a bond over the modulus E' of its [`Moduli`]; linear in the motion.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StressAcross {
    /// sigma_n/E'.
    pub normal: f64,
    /// tau/E'; in the plane without its third component.
    pub shear: [f64; 3],
}

impl StressAcross {
    /// The sum of the stress and `factor` times another one.
    #[inline]
    pub(super) fn plus(&self, other: &Self, factor: f64) -> Self {
        let shear = self.shear.iter().zip(&other.shear);
        let mut sum = Self {
            normal: self.normal + factor * other.normal,
            shear: [0.0; 3],
        };
        let sums = sum.shear.iter_mut().zip(shear);
        sums.for_each(|(sum, (one, other))| *sum = one + factor * other);
        sum
    }

    /// The stress times a factor.
    #[inline]
    pub(super) fn scaled(&self, factor: f64) -> Self {
        Self {
            normal: factor * self.normal,
            shear: self.shear.map(|it| factor * it),
        }
    }
}

impl Moduli {
    /// Moduli from the coefficients of a measure of [stress](super::Measure::takes_stress), with which these begin.
    pub fn from_coefficients(coefficients: &[f64]) -> Self {
        match *coefficients {
            [lateral, shear, bar, along, ..] => Self {
                lateral,
                shear,
                bar,
                along,
            },
            _ => Self::BAR,
        }
    }

    /// The moduli as [coefficients](Self::from_coefficients) of a measure.
    pub(super) fn coefficients(&self) -> [f64; 4] {
        [self.lateral, self.shear, self.bar, self.along]
    }

    /// Stress across a bond from its own stretch and the strain of the points around it; the stress of a bar if the strain is not known.
    #[inline]
    pub fn stress_across(&self, stretch: f64, around: Option<StrainAround>) -> StressAcross {
        match around {
            Some(around) => StressAcross {
                normal: stretch + self.lateral * around.lateral,
                shear: around.shear.map(|it| self.shear * it),
            },
            None => StressAcross {
                normal: self.bar * stretch,
                shear: [0.0; 3],
            },
        }
    }

    /// Moduli of a bar without Poisson's effect.
    pub(super) const BAR: Self = Self {
        lateral: 0.0,
        shear: 1.0,
        bar: 1.0,
        along: 1.0,
    };

    /// Moduli of a material in a space.
    pub fn new(material: &Isotropic, space: Space) -> Self {
        let nu = plane_stress_constants(material, space).poisson;
        let along = modulus(material, space);
        Self {
            lateral: nu,
            shear: 1.0 - nu,
            bar: material.bar_constants(space).young / along,
            along,
        }
    }
}

/// Modulus E' of a strain along one direction alone, Pa.
pub fn modulus(material: &Isotropic, space: Space) -> f64 {
    let Isotropic { young, poisson: nu } = plane_stress_constants(material, space);
    young / (1.0 - nu * nu)
}

/// The constants with which the equations of plane stress describe strains in a plane, and in space.
fn plane_stress_constants(material: &Isotropic, space: Space) -> Isotropic {
    material.in_plane(match space {
        Space::Plane(plane) => plane,
        Space::Solid => Plane::Strain,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
mod tests {
    use super::*;
    use crate::material::Elasticity;

    /// Hooke's law of a strain in the plane and in space is what the moduli say: sigma_n = E' (s + q), tau = E' (2 mu/E') gamma/2.
    #[test]
    fn stresses_are_those_of_hooke() {
        let material = Isotropic {
            young: 30.0,
            poisson: 0.2,
        };
        for space in [
            Space::Plane(Plane::Stress),
            Space::Plane(Plane::Strain),
            Space::Solid,
        ] {
            let moduli = Moduli::new(&material, space);
            let stiffness = Elasticity::Isotropic(material).stiffness_in(space).unwrap();
            let (along, across, shear) = (0.3, -0.1, 0.07);
            let normal = stiffness[(0, 0)] * along + stiffness[(0, 1)] * across;
            let modulus = modulus(&material, space);
            assert!((modulus * (along + moduli.lateral * across) - normal).abs() < 1e-12);
            let sheared = stiffness[(2, 2)] * 2.0 * shear;
            assert!((modulus * moduli.shear * shear - sheared).abs() < 1e-12);
        }
    }
}
