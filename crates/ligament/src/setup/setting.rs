//! Settings that are named in messages about a setup.

use std::fmt;

use ligament_model::law::rotational::RotationalStiffness;
use ligament_model::law::{BondLaw, Calibration, Form, Strains, listed};
use ligament_model::scatter::Scattered;

use super::correction::{Alpha, CorrectionDomain, Surface};

/// Actual or recommended value of a field of a [`Setup`](crate::Setup).
#[derive(Debug, Clone, PartialEq)]
pub enum Setting {
    /// One or several bond laws.
    Law(Vec<&'static BondLaw>),
    /// Origin of the constants of the law.
    Calibration(Calibration),
    /// Stiffness against relative rotation.
    RotationalStiffness(RotationalStiffness),
    /// Form of the strains that bonds resist.
    Form(Form),
    /// Distances over which strains are taken.
    Strains(Strains),
    /// Factor alpha of the bonds.
    Alpha(Alpha),
    /// Correction of surfaces.
    Surface(Surface),
    /// Body on which the correction is computed.
    Domain(CorrectionDomain),
    /// Property that varies at random.
    Scattered(Scattered),
    /// A body on a lattice.
    Lattice,
    /// Places with a volume.
    Volumes,
}

impl fmt::Display for Setting {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Law(laws) => formatter.write_str(&listed(laws, BondLaw::constant)),
            Self::Calibration(it) => write!(formatter, "`Calibration::{it:?}`"),
            Self::RotationalStiffness(it) => write!(formatter, "`RotationalStiffness::{it:?}`"),
            Self::Form(it) => write!(formatter, "`Form::{it:?}`"),
            Self::Strains(it) => write!(formatter, "`Strains::{it:?}`"),
            Self::Alpha(it) => write!(formatter, "`Alpha::{it:?}`"),
            Self::Surface(it) => write!(formatter, "`Surface::{it:?}`"),
            Self::Domain(it) => write!(formatter, "`CorrectionDomain::{it:?}`"),
            Self::Scattered(it) => write!(formatter, "`Scattered::{it:?}`"),
            Self::Lattice => formatter.write_str("`LatticeBody`"),
            Self::Volumes => {
                formatter.write_str("`Place::Group`, `Place::Box` or `Place::Everywhere`")
            }
        }
    }
}
