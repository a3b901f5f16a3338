//! How a run ends.

use thiserror::Error;

use crate::unbalanced::{Place, Unbalanced};

/// How a run ended.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Termination {
    /// All load steps were done.
    #[error("all load steps were done")]
    StepsDone,
    /// The exact path reached load factor one.
    #[error("the full load was reached")]
    FullLoad,
    /// The exact path has dissipated the energy that its last stage is to.
    #[error("the energy of {energy} J was dissipated")]
    EnergyDissipated {
        /// Energy asked for, J.
        energy: f64,
    },
    /// No bond is stretched: no load of this kind breaks another one.
    #[error("no bond is stretched any more: nothing breaks, whatever the load")]
    NothingBreaks,
    /// The load fell to the given fraction of its peak.
    #[error("the load fell to {fraction} of its peak")]
    LoadFraction {
        /// Fraction asked for.
        fraction: f64,
    },
    /// The displacement asked for was reached.
    #[error("the displacement {displacement} m was reached")]
    DisplacementReached {
        /// Displacement asked for, m.
        displacement: f64,
    },
    /// The number of broken bonds asked for was reached.
    #[error("{bonds} bonds were broken")]
    BondsBroken {
        /// Bonds asked for.
        bonds: usize,
    },
    /// The time allowed was used up.
    #[error("the time of {seconds} s was used up")]
    WallTime {
        /// Time allowed, s.
        seconds: f64,
    },
    /// The observer stopped it.
    #[error("it was stopped")]
    Stopped,
    /// The body no longer carries the load: it fell apart.
    #[error("the body fell apart: it carries no load any more")]
    FellApart,
    /// What the load acts on came loose.
    #[error("the body collapsed: the loaded part came loose")]
    Collapsed,
    /// What a load acts on lost its stiffness: no bond would carry it.
    #[error("{}", self.words(&|point| format!("point {point}")))]
    LostStiffness {
        /// Load step.
        step: usize,
        /// Where the body gives way.
        place: Place,
        /// Force that nothing carries, N or N m.
        force: f64,
    },
    /// A load step needed more rounds of breaking than allowed.
    #[error("load step {step} did not come to rest in {rounds} rounds of breaking")]
    NotAtRest {
        /// Load step.
        step: usize,
        /// Rounds allowed.
        rounds: usize,
    },
    /// No equilibrium was found.
    #[error("{}", self.words(&|point| format!("point {point}")))]
    NoEquilibrium {
        /// Load step.
        step: usize,
        /// Why.
        reason: Unbalanced,
    },
}

impl Termination {
    /// The end in words, with names for points.
    pub fn words(&self, name: &dyn Fn(u32) -> String) -> String {
        match self {
            Self::NoEquilibrium { step, reason } => {
                format!("no equilibrium in load step {step}: {}", reason.words(name))
            }
            Self::LostStiffness { step, place, force } => format!(
                "the body collapsed in step {step}: no bond is left that resists the motion of {}, on which {force:.3e} {} act",
                place.words(name),
                place.unit()
            ),
            other => other.to_string(),
        }
    }

    /// Whether the run could go on from there: a rule ended it, not the body.
    pub fn is_by_rule(&self) -> bool {
        match self {
            Self::StepsDone
            | Self::LoadFraction { .. }
            | Self::DisplacementReached { .. }
            | Self::BondsBroken { .. }
            | Self::WallTime { .. }
            | Self::Stopped
            | Self::NotAtRest { .. } => true,
            Self::FullLoad
            | Self::EnergyDissipated { .. }
            | Self::NothingBreaks
            | Self::FellApart
            | Self::Collapsed
            | Self::LostStiffness { .. }
            | Self::NoEquilibrium { .. } => false,
        }
    }

    /// Short name for files.
    pub fn name(&self) -> &'static str {
        match self {
            Self::StepsDone => "steps-done",
            Self::FullLoad => "full-load",
            Self::EnergyDissipated { .. } => "energy-dissipated",
            Self::NothingBreaks => "nothing-breaks",
            Self::LoadFraction { .. } => "load-fraction",
            Self::DisplacementReached { .. } => "displacement-reached",
            Self::BondsBroken { .. } => "bonds-broken",
            Self::WallTime { .. } => "wall-time",
            Self::Stopped => "stopped",
            Self::FellApart => "fell-apart",
            Self::Collapsed | Self::LostStiffness { .. } => "collapsed",
            Self::NotAtRest { .. } => "not-at-rest",
            Self::NoEquilibrium { .. } => "no-equilibrium",
        }
    }
}
