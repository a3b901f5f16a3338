//! Rule for the contents and the frequency of the output, and the time of a state in it.

use ligament_analysis::history::{StepRecord, View};
use ligament_analysis::interface::StressReading;
use ligament_analysis::material_stress::MaterialStress;
use ligament_analysis::result_fields::FieldReading;

use crate::vtu::TIME_VALUE;

/// Rule for the contents and the frequency of the output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WriteRule {
    /// Number of load steps between outputs of fields, besides the first and the last; 0: only these two.
    pub fields_every: usize,
    /// Whether to write the bonds as well.
    pub bonds: bool,
    /// Whether to write the model, by which a bond can be explained later.
    pub model: bool,
    /// Whether the largest utilisations of the bonds are followed in runs without a model too.
    pub utilisations: bool,
    /// Whether the fields have the stress that the materials carry, with its principal values.
    pub material_stress: bool,
    /// Whether the fields have the effective stress, with its principal values.
    pub effective_stress: bool,
    /// Whether the fields have the virial stress.
    pub virial: bool,
    /// Whether the fields have the traction on planes through the points.
    pub traction: bool,
}

/// Time of a state in the collections: in a motion its time (s), otherwise the number of its row in the history, because loads and
/// displacements may stay constant or decrease.
pub(super) fn time(record: &StepRecord) -> f64 {
    match record.motion {
        Some(_) => record.load_factor,
        None => record.step as f64,
    }
}

/// Field data of the files of a state: its time, then `load_factor`, `displacement` and `reaction` of its row in the history. No field has
/// one of these names, because readers look for a name in both.
pub(super) fn field_data(record: &StepRecord) -> [(&'static str, f64); 4] {
    [
        (TIME_VALUE, time(record)),
        ("load_factor", record.load_factor),
        ("load_displacement", record.displacement),
        ("load_reaction", record.reaction),
    ]
}

impl WriteRule {
    /// Whether the rule includes a field, given by its reading.
    pub(super) fn includes(&self, reading: &FieldReading) -> bool {
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
