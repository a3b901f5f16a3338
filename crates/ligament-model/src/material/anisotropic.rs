//! Materials that are given by the stiffness of their plane only.

use nalgebra::Matrix3;

/// Constants of a material without any symmetry in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anisotropic {
    /// Stiffness C of the plane in x and y: (sigma_xx, sigma_yy, sigma_xy) = C (eps_xx, eps_yy, gamma_xy), shape (3, 3), Pa, for the body's
    /// state of the plane, whether stress or strain.
    pub stiffness: Matrix3<f64>,
}

impl Anisotropic {
    /// The material with the constants c_11, c_12, c_16, c_22, c_26 and c_66, Pa.
    pub fn new([c11, c12, c16, c22, c26, c66]: [f64; 6]) -> Self {
        Self {
            stiffness: Matrix3::new(c11, c12, c16, c12, c22, c26, c16, c26, c66),
        }
    }

    /// Whether every strain costs energy, that is, whether C is positive definite.
    pub fn is_stable(&self) -> bool {
        self.stiffness.cholesky().is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The energy of the strain (1, -1, 0) is c_11 + c_22 - 2 c_12: it decides here.
    #[test]
    fn stable_where_every_strain_costs_energy() {
        assert!(Anisotropic::new([2.0, 1.9, 0.1, 2.0, -0.1, 1.0]).is_stable());
        assert!(!Anisotropic::new([2.0, 2.1, 0.1, 2.0, -0.1, 1.0]).is_stable());
        assert!(!Anisotropic::new([2.0, 0.0, 1.5, 2.0, 0.0, 1.0]).is_stable());
    }
}
