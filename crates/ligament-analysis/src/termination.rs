//! Reasons for the end of a run, and the table of their consequences for the results.
//!
//! A new end is a variant of [`Termination`] with its words, and a row of the table `ends!` below. Exit codes, summaries, studies and the table in
//! `docs/commands.md` follow from the row.

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
    #[error(
        "at {time:.4e} s {growth}: it grows without cause, as with too large a time step or an unstable law"
    )]
    EnergyGrew {
        /// Time, s.
        time: f64,
        /// Quantity that grew.
        growth: Growth,
    },
    /// The intact model is unstable, and the problem does not allow that.
    #[error(
        "the intact model is unstable: {negative} negative eigenvalues where {expected} are expected (Poisson's ratio too large for this \
         horizon factor), so that no load was applied"
    )]
    Unstable {
        /// Number of negative eigenvalues of the stiffness.
        negative: usize,
        /// Number that the rotations explain.
        expected: usize,
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
        self.row().is_by_rule
    }

    /// Short name for files.
    pub fn name(&self) -> &'static str {
        self.row().name
    }
}

/// Quantity that grew in a motion without cause.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum Growth {
    /// Energies and work do not balance, by this share of the work.
    #[error("the energies of the motion differ by {0:.1e} from the work")]
    Balance(f64),
    /// Energies are not numbers.
    #[error(
        "the energies of the motion are not numbers, or too large for them (look for a size, stiffness, load or velocity that is out of all \
         proportion)"
    )]
    NoNumber,
    /// An entry of the ledger that takes energy has given it.
    #[error(
        "the energy of {entry} of the motion is {share:.1e} of the energy that it was given, and can only be positive"
    )]
    Given {
        /// Entry of the ledger.
        entry: &'static str,
        /// Energy of the entry, over the larger of the energy at time zero and the work.
        share: f64,
    },
    /// The bonds store a negative energy, J.
    #[error("the bonds of the motion store a negative energy, {0:.3e} J")]
    Stored(f64),
    /// The kinetic energy is negative, J.
    #[error("the kinetic energy of the motion is negative, {0:.3e} J")]
    Kinetic(f64),
}

/// Verdict on the results of a run by its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The loading was completed, or a rule that looks at states at rest ended the run.
    Complete,
    /// A rule ended the run that may do so during breakage as well.
    AskedFor,
    /// The user stopped the run, which can be resumed.
    Stopped,
    /// No equilibrium was found at a load.
    NoEquilibrium,
    /// From here on results cannot be trusted.
    Invalid,
    /// The run ended during breakage.
    Breaking,
}

/// Row of the table of ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Row {
    /// Short name for files.
    pub name: &'static str,
    /// Verdict on the results.
    pub verdict: Verdict,
    /// Whether the run could continue from there, because a rule ended it.
    pub is_by_rule: bool,
}

/// The table of ends, from which `Termination::row` and [`ENDS`] are made: name, verdict, and whether the run could continue.
macro_rules! ends {
    ($($end:pat => $name:literal, $verdict:ident, $is_by_rule:literal;)*) => {
        /// All rows of the table of ends.
        pub const ENDS: &[Row] = &[$(Row {
            name: $name,
            verdict: Verdict::$verdict,
            is_by_rule: $is_by_rule,
        }),*];

        impl Termination {
            /// Row of the table of ends.
            pub fn row(&self) -> Row {
                use Termination::*;
                match self {
                    $($end => Row {
                        name: $name,
                        verdict: Verdict::$verdict,
                        is_by_rule: $is_by_rule,
                    }),*
                }
            }
        }
    };
}

ends! {
    StepsDone => "steps-done", Complete, true;
    FullLoad => "full-load", Complete, false;
    EnergyDissipated { .. } => "energy-dissipated", Complete, false;
    NothingBreaks => "nothing-breaks", Complete, false;
    FellApart => "fell-apart", Complete, false;
    LoadFraction { .. } => "load-fraction", Complete, true;
    DisplacementReached { .. } => "displacement-reached", Complete, true;
    TimeReached { .. } => "time-reached", Complete, false;
    BondsBroken { .. } => "bonds-broken", AskedFor, true;
    WallTime { .. } => "wall-time", AskedFor, true;
    NoEquilibrium { .. } => "no-equilibrium", NoEquilibrium, false;
    Unstable { .. } => "unstable", Invalid, false;
    EnergyGrew { .. } => "energy-grew", Invalid, false;
    Collapsed | LostStiffness { .. } => "collapsed", Breaking, false;
    NotAtRest { .. } => "not-at-rest", Breaking, true;
    Stopped => "stopped", Stopped, true;
}

/// End of a run, by the use of its results.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// The loading was completed, a rule of the case ended the run, or the body separated.
    Done,
    /// A signal stopped the run, which can be resumed.
    Stopped,
    /// No state under load is in equilibrium: there is no result.
    NoResult,
    /// No equilibrium was found at a load, whether or not bonds were breaking; the results end before it.
    NoEquilibrium,
    /// The results cannot be trusted from some state on, and end before it.
    Invalid,
    /// The run ended during breakage, other than by its user or a rule of its case: the load where it ended has no solution.
    NotAtRest,
}

impl Verdict {
    /// End of a run; `without_equilibrium`: no state under load is at rest; `is_breaking`: the last state is not.
    pub fn end(self, without_equilibrium: bool, is_breaking: bool) -> End {
        match self {
            Self::Stopped => End::Stopped,
            Self::NoEquilibrium | Self::Invalid | Self::Breaking if without_equilibrium => {
                End::NoResult
            }
            Self::NoEquilibrium => End::NoEquilibrium,
            Self::Invalid => End::Invalid,
            Self::Breaking => End::NotAtRest,
            Self::Complete if is_breaking => End::NotAtRest,
            Self::Complete | Self::AskedFor => End::Done,
        }
    }

    /// Whether a run that ends so has no result at all if no state under load is at rest.
    pub fn needs_rest(self) -> bool {
        self.end(true, true) == End::NoResult
    }
}

impl End {
    /// Exit code of the program.
    pub fn exit_code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::NoResult | Self::NoEquilibrium | Self::Invalid => 3,
            Self::Stopped => 4,
            Self::NotAtRest => 6,
        }
    }

    /// Whether studies treat the run as failed.
    pub fn is_failure(self) -> bool {
        self.exit_code() == Self::NoResult.exit_code()
    }
}
