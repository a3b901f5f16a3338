//! The corrections of the bonds: factors alpha and Omega.

use ligament_model::correction::{StopRule, Sweeps, patch};
use ligament_model::law::{Calibration, Law, PaperCorrection};

/// Number of bonds above which a model takes the stop rule that does not depend on its size, unless the setup names a rule.
const LARGE_MODEL: usize = 1_000_000;

/// The corrections of the bonds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Correction {
    /// Factor alpha of each bond.
    pub alpha: Alpha,
    /// What surfaces take from the families, given back by a factor Omega of each bond.
    pub surface: Surface,
    /// Body that the correction sees.
    pub domain: CorrectionDomain,
}

/// The factor alpha of a bond.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Alpha {
    /// One.
    None,
    /// Share of the cell inside the horizon.
    PartialVolume,
    /// NHPD's factor by length.
    Length,
}

/// The correction of surfaces and irregular meshes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Surface {
    /// No correction.
    None,
    /// By the volumes of the families.
    Volume,
    /// NHPD's iterative domain correction.
    Domain(Iteration),
    /// Two factors a bond for which every uniform strain is an equilibrium; of bodies with cells.
    Patch(patch::Settings),
}

impl Surface {
    /// Largest ratio of the stiffnesses of materials between which the factors are found ([milder](ligament_model::material::milder)). Where
    /// it is smaller, soft layers between stiffer parts come closer to what they should carry, stiff layers under a pull along them less:
    /// both were measured, on layers of one to four cells.
    pub(crate) fn largest_contrast(&self) -> f64 {
        match self {
            Self::Patch(_) => 10.0,
            Self::Domain(_) => 2.0,
            Self::None | Self::Volume => f64::INFINITY,
        }
    }
}

/// How the domain correction is iterated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Iteration {
    /// Rule that says when the iteration has converged; without one the sum over all bonds decides, or in models of more
    /// than a million bonds their mean.
    pub stop: Option<StopRule>,
    /// Sweeps at most.
    pub max_sweeps: usize,
}

/// The body that the correction sees.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CorrectionDomain {
    /// Before the pre-cracks cut bonds.
    #[default]
    Whole,
    /// After the pre-cracks cut bonds.
    Cracked,
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
    /// The paper's rule: change of a sweep summed over all bonds, which grows with the size of the model.
    pub const SUM: StopRule = StopRule::Sum(1e-3);

    /// Mean change per bond, which makes the energies of a large model as right as the sum does those of a small one.
    pub const MEAN: StopRule = StopRule::Mean(1e-7);

    /// Stop rule and limit for a model of so many bonds.
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
    /// The corrections that the paper of a law takes with it.
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
