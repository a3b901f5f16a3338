//! Rule for the contents and the frequency of the output.

use ligament_analysis::ControlKind;
use ligament_analysis::history::{StepRecord, View};
use ligament_analysis::interface::StressReading;
use ligament_analysis::material_stress::MaterialStress;
use ligament_analysis::result_fields::FieldReading;

/// Rule for the contents and the frequency of the output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WriteRule {
    /// Number of load steps between outputs of fields, besides the first and the last; 0: only these two.
    pub fields_every: usize,
    /// Whether to write the bonds as well.
    pub bonds: bool,
    /// Whether to write the model, by which a bond can be explained later.
    pub model: bool,
    /// Whether the fields have the stress that the materials carry, with its principal values.
    pub material_stress: bool,
    /// Whether the fields have the effective stress, with its principal values.
    pub effective_stress: bool,
    /// Whether the fields have the virial stress.
    pub virial: bool,
    /// Whether the fields have the traction on planes through the points.
    pub traction: bool,
    /// Quantity used as time in the collections.
    pub time: Time,
}

/// Quantity used as the time of an output; in a motion that is the time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Time {
    /// The applied displacement, or the applied load where the load is given.
    Load,
    /// The number of the row of the history, for a path on which displacement and load go back.
    Step,
}

impl WriteRule {
    /// Whether a field with a reading is written.
    pub(super) fn has(&self, reading: &FieldReading) -> bool {
        match reading {
            FieldReading::MaterialStress(MaterialStress::Carried, ..) => self.material_stress,
            FieldReading::MaterialStress(MaterialStress::Effective, ..) => self.effective_stress,
            FieldReading::Stress(StressReading::Virial) => self.virial,
            FieldReading::Stress(StressReading::Traction) => self.traction,
            _ => true,
        }
    }

    /// Whether fields are written at a record.
    pub fn writes_fields(&self, record: &StepRecord, view: &View<'_>) -> bool {
        view.is_last || self.is_due(record.step)
    }

    /// Whether fields are written in a step that is not the last one.
    pub fn is_due(&self, step: usize) -> bool {
        match self.fields_every {
            0 => step == 0,
            every => step.is_multiple_of(every),
        }
    }
}

impl Time {
    pub(super) fn value(self, record: &StepRecord, view: &View<'_>) -> f64 {
        if record.motion.is_some() {
            return record.load_factor;
        }
        match (self, view.loads.control().kind) {
            (Self::Step, _) => record.step as f64,
            (Self::Load, ControlKind::Force) => record.reaction,
            (Self::Load, _) => record.displacement,
        }
    }
}
