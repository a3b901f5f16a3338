//! Kind of analysis: an elastic solution, the breakage of bonds, natural modes, or a motion in time.

use ligament_analysis::breaking::{BreakingRule, TIE_TOLERANCE};
use ligament_analysis::driver::StopRules;
use ligament_analysis::driver::event::EventSettings;
use ligament_analysis::driver::stepped::SteppedSettings;
use ligament_analysis::modal::ModalSettings;
use ligament_analysis::motion::MotionSettings;

pub use ligament_analysis::problem::ELASTIC_ENERGY_TOLERANCE;

/// Kind of analysis.
#[derive(Debug, Clone, PartialEq)]
pub enum Analysis {
    /// One elastic solution at load factor 1.
    Elastic {
        /// Relative change of energy below which the solution is in equilibrium.
        energy_tolerance: f64,
    },
    /// Breakage of bonds under load steps: in each step bonds break until none exceeds its limit.
    Stepped(SteppedSettings),
    /// The exact path from breakage to breakage, which may snap back, up to load factor 1.
    Event(EventSettings),
    /// Natural frequencies and modes.
    Modal(ModalSettings),
    /// Motion in time under loads that depend on time, in which bonds break where there are criteria.
    Motion(MotionSettings),
}

impl Default for Analysis {
    fn default() -> Self {
        Self::Elastic {
            energy_tolerance: ELASTIC_ENERGY_TOLERANCE,
        }
    }
}

impl Analysis {
    /// Name of the analysis in results.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Elastic { .. } => "static",
            Self::Stepped(_) | Self::Event(_) => "fracture",
            Self::Modal(_) => "modal",
            Self::Motion(_) => "motion",
        }
    }

    /// Whether bonds may break.
    pub fn is_fracture(&self) -> bool {
        matches!(self, Self::Stepped(_) | Self::Event(_) | Self::Motion(_))
    }

    /// Whether the body moves in time.
    pub fn is_motion(&self) -> bool {
        matches!(self, Self::Motion(_))
    }
}

/// Settings of load steps with these load factors; at most five bonds break between two solutions.
pub fn stepped(load_factors: Vec<f64>) -> SteppedSettings {
    SteppedSettings {
        load_factors,
        refine_first_break: 0,
        rule: BreakingRule::default(),
        energy_tolerance: ELASTIC_ENERGY_TOLERANCE,
        round_limit: 10_000,
        stop: StopRules::NONE,
    }
}

/// Settings of an analysis of the exact path, without a reason to stop before load factor 1.
pub fn event() -> EventSettings {
    EventSettings {
        tie_tolerance: TIE_TOLERANCE,
        energy_tolerance: ELASTIC_ENERGY_TOLERANCE,
        stop: StopRules::NONE,
    }
}
