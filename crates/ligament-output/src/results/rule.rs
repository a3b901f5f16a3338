//! Rules of what is written, and how often.

use ligament_analysis::ControlKind;
use ligament_analysis::history::{StepRecord, View};
use ligament_analysis::interface::StressReading;

/// Rules of what is written, and how often.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WriteRule {
    /// Fields at every so many load steps, besides the first and the last; 0: only these two.
    pub fields_every: usize,
    /// Whether to write the bonds as well.
    pub bonds: bool,
    /// Whether to write the model, by which a bond can be explained later.
    pub model: bool,
    /// Whether the fields have the virial stress.
    pub virial: bool,
    /// Whether the fields have the traction on planes through the points.
    pub traction: bool,
    /// The quantity that stands for time in the collections.
    pub time: Time,
}

/// The quantity that stands for the time of an output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Time {
    /// The applied displacement, or the applied load where the load is given.
    Load,
    /// The number of the row of the history, for a path on which displacement and load go back.
    Step,
}

impl WriteRule {
    /// Whether the fields have a stress.
    pub(super) fn has(&self, stress: StressReading) -> bool {
        match stress {
            StressReading::Virial => self.virial,
            StressReading::Traction => self.traction,
        }
    }

    /// Whether fields are written in the state of a record.
    pub fn writes_fields(&self, record: &StepRecord, view: &View<'_>) -> bool {
        view.is_last || self.is_due(record.step)
    }

    /// Whether fields are written in a step wherever the run ends.
    pub fn is_due(&self, step: usize) -> bool {
        match self.fields_every {
            0 => step == 0,
            every => step.is_multiple_of(every),
        }
    }
}

impl Time {
    pub(super) fn value(self, record: &StepRecord, view: &View<'_>) -> f64 {
        match (self, view.loads.control().kind) {
            (Self::Step, _) => record.step as f64,
            (Self::Load, ControlKind::Displacement | ControlKind::Temperature) => {
                record.displacement
            }
            (Self::Load, ControlKind::Force) => record.reaction,
        }
    }
}
