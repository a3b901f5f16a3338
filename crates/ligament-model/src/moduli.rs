//! Elastic constants of the discrete body: what the bonds of a point make of a uniform strain.

use nalgebra::{Matrix3, Vector3};

use crate::element::imaginary::matrix;
use crate::element::ElementKind;
use crate::system::BondSystem;

/// Stiffness C of the family of a point in x and y, (sigma_xx, sigma_yy, sigma_xy) = C (eps_xx, eps_yy, gamma_xy), Pa:
///
/// C = 1/(2 V_A) sum over B of Omega alpha V_A V_B l (k_n s s^T + k_t g g^T)
///
/// with the stretch s and the shear g of a bond for strains of size one; with imaginary elements C = 1/V_A times the sum of its
/// shares of D. The common rotation of the points, where they have one,
/// is free and takes the value that costs least; it does not matter for families that are symmetric. In an infinite lattice
/// this is the stiffness of the body.
pub fn family_stiffness(system: &BondSystem, point: u32) -> Matrix3<f64> {
    let rigidities = &system.rigidities;
    if system.element.has_strains() {
        let family = system.bonds.incidence.at(point).iter();
        let sum = family.fold(Matrix3::zeros(), |sum, &bond| {
            let stiffness = &rigidities.strain[bond as usize];
            let is_first = system.bonds.ends[bond as usize][0] == point;
            sum + stiffness.share(is_first) * matrix(stiffness.entries)
        });
        return sum / system.cloud.volumes[point as usize];
    }
    let mut stiffness = Matrix3::zeros();
    // Of the shear for a common rotation of size one, which is -1 for every bond.
    let mut coupling = Vector3::zeros();
    let mut rotation = 0.0;
    for &bond in system.bonds.incidence.at(point) {
        let bond = bond as usize;
        let [a, b] = system.bonds.direction[bond];
        let stretch = Vector3::new(a * a, b * b, a * b);
        let shear = Vector3::new(-a * b, a * b, 0.5 * (a * a - b * b));
        let (axial_rigidity, shear_rigidity) =
            (rigidities.axial[bond], rigidities.shear[bond]);
        stiffness += axial_rigidity * stretch * stretch.transpose()
            + shear_rigidity * shear * shear.transpose();
        coupling -= shear_rigidity * shear;
        rotation += shear_rigidity;
    }
    if system.element == ElementKind::Beam && rotation != 0.0 {
        stiffness -= coupling * coupling.transpose() / rotation;
    }
    stiffness / (2.0 * system.cloud.volumes[point as usize])
}

/// Engineering constants of a plane stiffness as plane stress would read them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EngineeringConstants {
    /// Young's moduli along x and y, Pa.
    pub young: [f64; 2],
    /// Contraction along y under stress along x.
    pub poisson: f64,
    /// Shear modulus, Pa.
    pub shear_modulus: f64,
}

impl EngineeringConstants {
    /// The constants that belong to a stiffness (3, 3), Pa: reciprocals of the entries of its inverse. None where the
    /// stiffness has no inverse.
    pub fn from_stiffness(stiffness: Matrix3<f64>) -> Option<Self> {
        Self::along(stiffness, 0.0)
    }

    /// The constants that belong to a stiffness (3, 3), Pa, along axes at an angle (rad) to x and y, which take their places.
    pub fn along(stiffness: Matrix3<f64>, angle: f64) -> Option<Self> {
        let compliance = stiffness.try_inverse()?;
        let (s, c) = angle.sin_cos();
        // Stresses of size one along the axes, and strains there from those in x and y.
        let one = Vector3::new(c * c, s * s, c * s);
        let two = Vector3::new(s * s, c * c, -c * s);
        let shear = Vector3::new(-2.0 * c * s, 2.0 * c * s, c * c - s * s);
        let strain = |along: Vector3<f64>, under: Vector3<f64>| along.dot(&(compliance * under));
        Some(Self {
            young: [1.0 / strain(one, one), 1.0 / strain(two, two)],
            poisson: -strain(two, one) / strain(one, one),
            shear_modulus: 1.0 / strain(shear, shear),
        })
    }
}
