//! The beam-like bond (Gerstle 2007, in the form of MPPD), which is also the law of NHPD eq. 6.

use super::{BondStiffness, Densities, constants};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::material::{Isotropic, Space};

/// Shear stiffness k_t of a bond over its length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShearForm {
    /// One k_t for all lengths, that of [`super::pds`]. With a factor alpha that depends on the length, the ratio of shear to stretch
    /// stays right: NHPD's form in space.
    Constant,
    /// k_t = 12 d/l^2, as a beam of Euler and Bernoulli has: NHPD's form in the plane. In space NHPD's factor alpha, which falls with the
    /// length, makes the shear of the body 1.16 times too strong: nu = .2 becomes .192.
    Falling,
}

impl ShearForm {
    /// The form of NHPD's law.
    pub fn of_nhpd(space: Space) -> Self {
        match space {
            Space::Plane(_) => Self::Falling,
            Space::Solid => Self::Constant,
        }
    }
}

/// Stiffness densities of every bond, NHPD eq. 6, OMPPD eq. 22, in space our own:
///
/// k_n = c, k_t = 12 d / l^2 or constant by its form, k_theta = d / l, with the constants c (N/m^6) and d (N/m^4) of the
/// [table](super::constants).
///
/// d is negative above the Poisson's ratio of central forces. A uniform strain does not see k_theta, which in space bending and torsion share:
/// with k_phi = g/l for torsion the energy of a uniform curvature chi is (pi H^4/60) ((g - d)(tr^2 chi + chi : chi^T) + (g + 4 d) chi : chi),
/// and g = d leaves chi : chi alone.
pub fn stiffness<const D: usize>(
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    materials: &[Isotropic],
    space: Space,
    form: ShearForm,
) -> BondStiffness {
    // What does not depend on the bond.
    let constant = |material| {
        [constants::axial, constants::bending, constants::shear]
            .map(|of| of(material, space, cloud.thickness))
    };
    let constants: Vec<[f64; 3]> = materials.iter().map(constant).collect();
    BondStiffness::from_constants(bonds, cloud, &constants, |[c, d, shear], bond| {
        let (l, h) = (bond.length, bond.horizon);
        let d = d / h.powi(D as i32 - 1);
        Densities {
            axial: c / h.powi(D as i32 + 1),
            shear: match form {
                ShearForm::Constant => shear / h.powi(D as i32 + 1),
                ShearForm::Falling => 12.0 * d / l.powi(2),
            },
            rotational: d / l,
        }
    })
}
