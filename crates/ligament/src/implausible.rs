//! Messages about implausible values and rare properties.

use std::f64::consts::TAU;

use thiserror::Error;

use crate::coordinates::coordinates;

/// Strength over Young's modulus, and stretch of a bond at its limit, that no material reaches: the theoretical strength of crystals is E/10
/// to E/15 (Orowan 1949).
pub(crate) const LARGEST_STRAIN: f64 = 0.1;

/// Fracture energy over Young's modulus that no material is below, m: half of what two surfaces cost that take E a/20 each, at a distance of
/// atoms a of 0.2 nm (Orowan 1949).
pub(crate) const LEAST_ENERGY: f64 = 1e-11;

/// An implausible value or choice in a setup.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Implausible {
    /// A Young's modulus far below the moduli of solids.
    #[error(
        "Young's modulus of {material} is {young} Pa, less than 1 MPa: moduli are in Pa (25 GPa is 25e9)"
    )]
    Soft {
        /// Description of the material.
        material: String,
        /// Young's modulus, the smaller one of a material with axes, Pa.
        young: f64,
    },
    /// A strength that is implausibly large for the stiffness.
    #[error(
        "the {property} of {material} is {:.4} of its Young's modulus, and no material is as strong as a tenth: strengths and moduli are \
         in Pa (3 MPa is 3e6)", strength / young
    )]
    Strong {
        /// Description of the material.
        material: String,
        /// Key of the strength.
        property: &'static str,
        /// The strength, Pa.
        strength: f64,
        /// Young's modulus, the larger one of a material with axes, Pa.
        young: f64,
    },
    /// A limit of a bond beyond small strains.
    #[error(
        "by the criterion \"{criterion}\" bonds reach their limits at {limit:.4}, and strains of more than {LARGEST_STRAIN} are not small: \
         a limit is a strain, strengths are in Pa, a fracture energy is in J/m^2 (0.1 N/mm is 100 J/m^2)"
    )]
    LargeLimit {
        /// Name of the criterion.
        criterion: &'static str,
        /// The smallest limit of a bond.
        limit: f64,
    },
    /// A fracture energy below the energy of two surfaces.
    #[error(
        "the fracture energy of {material} is {energy} J/m^2, less than new surfaces cost in any solid as stiff (E times 0.01 nm, {:.4} \
         J/m^2): it is in J/m^2 (0.1 N/mm is 100 J/m^2)", LEAST_ENERGY * young
    )]
    LowEnergy {
        /// Description of the material.
        material: String,
        /// Fracture energy, J/m^2.
        energy: f64,
        /// Young's modulus, Pa.
        young: f64,
    },
    /// A softening zone shorter than the distance between points.
    #[error(
        "the characteristic length of {material}, E G_c/F_t^2, is {length:.3e} m, less than the distance of points, {spacing:.3e} m: the \
         softening zone is smaller than the spacing; check the units of fracture_energy (J/m^2) and strength (Pa), or take a finer body"
    )]
    ShortLength {
        /// Description of the material.
        material: String,
        /// Characteristic length, m.
        length: f64,
        /// Smallest distance of a point to its nearest neighbour, m.
        spacing: f64,
    },
    /// A softening zone far longer than the body.
    #[error(
        "the characteristic length of {material}, E G_c/F_t^2, is {length:.3e} m, more than ten times the body ({body:.3e} m): no crack in \
         it can soften completely; check the units of fracture_energy (J/m^2) and strength (Pa)"
    )]
    LongLength {
        /// Description of the material.
        material: String,
        /// Characteristic length, m.
        length: f64,
        /// Longer side of the box around the body, m.
        body: f64,
    },
    /// An angle that appears to be in degrees.
    #[error(
        "{what} is {angle} rad, more than a whole turn: angles are in rad (45 degrees are 0.7854)"
    )]
    Angle {
        /// Description of the angle.
        what: String,
        /// The angle, rad.
        angle: f64,
    },
    /// A thickness that is not given.
    #[error(
        "the thickness of the body is not given, so the forces are those of a body 1 m thick; set `thickness`, in m"
    )]
    NoThickness,
    /// Pre-cracks that cut no bond.
    #[error(
        "{} no bond: the body, which reaches from ({}) to ({}) m, does not lie on both sides of it; are the coordinates in \
         m?", numbered(cracks), coordinates(&corners[0]), coordinates(&corners[1])
    )]
    CutsNothing {
        /// Indices of the pre-cracks, one or more, ascending.
        cracks: Vec<usize>,
        /// Corners of the box around the body, m.
        corners: [Vec<f64>; 2],
    },
    /// Criteria without a bond that may fail.
    #[error(
        "no bond can fail, because every bond has an end in a [[no_fail]] part; are its coordinates in m?"
    )]
    NothingFails,
}

/// A property that is rare but usually intended.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Note {
    /// A body that widens under tension.
    #[error(
        "Poisson's ratio of {material} is negative ({poisson}): a body of it widens where it is pulled"
    )]
    Auxetic {
        /// Description of the material.
        material: String,
        /// Poisson's ratio.
        poisson: f64,
    },
}

/// Pre-cracks by their numbers from 1, with a verb: "pre-crack 2 cuts".
fn numbered(cracks: &[usize]) -> String {
    let numbers: Vec<String> = cracks.iter().map(|it| (it + 1).to_string()).collect();
    match numbers.as_slice() {
        [only] => format!("pre-crack {only} cuts"),
        several => format!("pre-cracks {} cut", several.join(", ")),
    }
}

impl Implausible {
    /// The remark on an angle, rad, if it is more than a turn.
    pub fn of_angle(what: String, angle: f64) -> Option<Self> {
        (angle.abs() > TAU * (1.0 + 1e-9)).then_some(Self::Angle { what, angle })
    }
}
