//! Reasons for the end of a run.

use thiserror::Error;

use crate::unbalanced::{Place, Unbalanced};

/// Reason for the end of a run.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Termination {
    /// All load steps were completed.
    #[error("all load steps are done")]
    StepsDone,
    /// The exact path reached load factor one.
    #[error("the full load was reached")]
    FullLoad,
    /// The exact path has dissipated the energy of its last stage.
    #[error("the energy of {energy} J was dissipated")]
    EnergyDissipated {
        /// Prescribed energy, J.
        energy: f64,
    },
    /// No bond is stretched, so that no load of this kind breaks another one.
    #[error("no bond is stretched any more, so no load breaks another one")]
    NothingBreaks,
    /// The load fell to the given fraction of its peak.
    #[error("the load fell to {fraction} of its peak")]
    LoadFraction {
        /// Prescribed fraction.
        fraction: f64,
    },
    /// The prescribed displacement was reached.
    #[error("the displacement {displacement} m was reached")]
    DisplacementReached {
        /// Prescribed displacement, m.
        displacement: f64,
    },
    /// The prescribed number of broken bonds was reached.
    #[error("{bonds} bonds were broken")]
    BondsBroken {
        /// Prescribed number of broken bonds.
        bonds: usize,
    },
    /// The allowed wall time was used up.
    #[error("the time limit of {seconds} s was reached")]
    WallTime {
        /// Allowed wall time, s.
        seconds: f64,
    },
    /// The motion reached its end.
    #[error("the end of the motion, {time:?} s, was reached")]
    TimeReached {
        /// Duration, s.
        time: f64,
    },
    /// The energy of a motion grew without cause.
    #[error("{}", grew(*time, *error))]
    EnergyGrew {
        /// Time, s.
        time: f64,
        /// Energy imbalance, relative to the work.
        error: f64,
    },
    /// An entry of the ledger of a motion that takes energy has given it.
    #[error(
        "at {time:.4e} s the energy of {entry} is {share:.1e} of the energy that the motion was given, and should be positive: it comes from \
         nothing, as with too large a time step"
    )]
    EnergyFromNothing {
        /// Time, s.
        time: f64,
        /// Entry of the ledger.
        entry: &'static str,
        /// Energy of the entry, relative to the larger of the energy at time zero and the work.
        share: f64,
    },
    /// The observer stopped the run.
    #[error("the run was stopped")]
    Stopped,
    /// The body fell apart and no longer carries the load.
    #[error("the body fell apart and carries no load")]
    FellApart,
    /// The loaded part became detached.
    #[error("the body collapsed: the loaded part broke off")]
    Collapsed,
    /// The loaded part lost its stiffness, so that no bond carries the load.
    #[error("{}", self.words(&|point| format!("point {point}")))]
    LostStiffness {
        /// Load step.
        step: usize,
        /// Point and component without stiffness.
        place: Place,
        /// Force without a reaction, N or N m.
        force: f64,
    },
    /// A load step needed more rounds of breaking than allowed.
    #[error("bonds were still breaking after {rounds} rounds of load step {step}")]
    NotAtRest {
        /// Load step.
        step: usize,
        /// Allowed number of rounds.
        rounds: usize,
    },
    /// No equilibrium was found.
    #[error("{}", self.words(&|point| format!("point {point}")))]
    NoEquilibrium {
        /// Load step.
        step: usize,
        /// Reason for the missing equilibrium.
        reason: Unbalanced,
    },
}

/// Description of a motion whose energies differ at a time (s) from the work by a share of it, which is no number where they are none.
fn grew(time: f64, error: f64) -> String {
    match error.is_finite() {
        true => format!(
            "at {time:.4e} s the energies of the motion differ by {error:.1e} from the work: it grows without cause, as with too large a time \
             step or an unstable law"
        ),
        false => format!(
            "at {time:.4e} s the energies of the motion are not numbers, or too large for them; look for a size, stiffness, load or velocity that \
             is out of all proportion"
        ),
    }
}

impl Termination {
    /// Description of the end, with names for points.
    pub fn words(&self, name: &dyn Fn(u32) -> String) -> String {
        match self {
            Self::NoEquilibrium {
                step,
                reason: reason @ Unbalanced::Missed { .. },
            } => format!("step {step}: {}", reason.words(name)),
            Self::NoEquilibrium { step, reason } => {
                format!("no equilibrium in load step {step}: {}", reason.words(name))
            }
            Self::LostStiffness { step, place, force } => format!(
                "the body collapsed in step {step}: no remaining bond resists the motion of {} under {force:.3e} {}",
                place.words(name),
                place.unit()
            ),
            other => other.to_string(),
        }
    }

    /// Whether the run could continue from its end, because a rule ended it.
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
            | Self::TimeReached { .. }
            | Self::EnergyGrew { .. }
            | Self::EnergyFromNothing { .. }
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
            Self::TimeReached { .. } => "time-reached",
            Self::EnergyGrew { .. } | Self::EnergyFromNothing { .. } => "energy-grew",
            Self::Stopped => "stopped",
            Self::FellApart => "fell-apart",
            Self::Collapsed | Self::LostStiffness { .. } => "collapsed",
            Self::NotAtRest { .. } => "not-at-rest",
            Self::NoEquilibrium { .. } => "no-equilibrium",
        }
    }
}
