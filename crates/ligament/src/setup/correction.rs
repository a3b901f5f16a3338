//! The corrections of the bonds: factors alpha and Omega.

use ligament_model::correction::{StopRule, Sweeps, patch};
use ligament_model::law::{Calibration, Law, PaperCorrection};

/// Number of bonds above which the default stop rule is the one that does not depend on the size of the model.
const LARGE_MODEL: usize = 1_000_000;

/// The corrections of the bonds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Correction {
    /// Factor alpha of each bond.
    pub alpha: Alpha,
    /// Correction of the stiffness that families lack at surfaces, by a factor Omega of each bond.
    pub surface: Surface,
    /// Body on which the correction is computed.
    pub domain: CorrectionDomain,
}

ligament_model::case_type! {
    /// The factor alpha of a bond.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Alpha {
        /// 1.
        None,
        /// The share of the cell inside the horizon.
        PartialVolume,
        /// NHPD's factor by length.
        Length,
    }
}

/// Correction for surfaces and irregular meshes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Surface {
    /// No correction.
    None,
    /// Correction by the volumes of the families.
    Volume,
    /// NHPD's iterative domain correction.
    Domain(Iteration),
    /// Two factors for each bond with which every uniform strain is in equilibrium; for bodies with cells.
    Patch(patch::Settings),
}

impl Alpha {
    /// Papers of the factor, by the keys of the references; empty without any.
    pub fn source(self) -> &'static str {
        match self {
            Self::Length => "NHPD",
            Self::None | Self::PartialVolume => "",
        }
    }
}

impl Surface {
    /// Papers of the correction, by the keys of the references; empty without any.
    pub fn source(&self) -> &'static str {
        match self {
            Self::Volume => "Le and Bobaru 2018",
            Self::Domain(_) => "NHPD",
            Self::None | Self::Patch(_) => "",
        }
    }

    /// Largest ratio of the materials' stiffnesses in the computation of the factors ([contrast](ligament_model::material::with_reduced_contrast)). With a
    /// smaller ratio, soft layers between stiffer parts carry a more accurate load, stiff layers under tension along them a less accurate
    /// one, as measured on layers of one to four cells.
    pub(crate) fn largest_contrast(&self) -> f64 {
        match self {
            Self::Patch(_) => 10.0,
            Self::Domain(_) => 2.0,
            Self::None | Self::Volume => f64::INFINITY,
        }
    }
}

/// Iteration of the domain correction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Iteration {
    /// Convergence rule; by default the sum over all bonds, or in models of more than a million bonds their mean.
    pub stop: Option<StopRule>,
    /// Maximum number of sweeps.
    pub max_sweeps: usize,
}

ligament_model::case_type! {
    /// Body on which the correction is computed.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum CorrectionDomain {
        /// Before the pre-cracks cut bonds.
        #[default]
        Whole,
        /// After the pre-cracks cut bonds.
        Cracked,
    }
}

impl Default for Iteration {
    fn default() -> Self {
        Self {
            stop: None,
            max_sweeps: 500,
        }
    }
}

impl Iteration {
    /// The rule of the NHPD paper: change of a sweep summed over all bonds, which grows with the size of the model.
    pub const SUM: StopRule = StopRule::Sum(1e-3);

    /// Mean change per bond, which gives large models the accuracy that the sum gives small ones.
    pub const MEAN: StopRule = StopRule::Mean(1e-7);

    /// Stop rule and limit of sweeps for a model of `n_bonds` bonds.
    pub fn sweeps(&self, n_bonds: usize) -> Sweeps {
        let by_size = if n_bonds > LARGE_MODEL {
            Self::MEAN
        } else {
            Self::SUM
        };
        Sweeps {
            stop: self.stop.unwrap_or(by_size),
            limit: self.max_sweeps,
        }
    }
}

impl Correction {
    /// The corrections in the paper of a law.
    pub fn of_paper(law: &Law) -> Self {
        let (alpha, surface) = match (law.row.correction, law.options.calibration) {
            (PaperCorrection::None, _) => (Alpha::None, Surface::None),
            (PaperCorrection::LengthAndDomain, _) => {
                (Alpha::Length, Surface::Domain(Iteration::default()))
            }
            (PaperCorrection::Volumes, Some(Calibration::Discrete)) => {
                (Alpha::PartialVolume, Surface::None)
            }
            (PaperCorrection::Volumes, Some(Calibration::Integral) | None) => {
                (Alpha::PartialVolume, Surface::Volume)
            }
        };
        Self {
            alpha,
            surface,
            domain: CorrectionDomain::default(),
        }
    }
}
