//! Rule for the contents and the frequency of the output, and the time of a state in it.

use ligament_analysis::driver::Problem;
use ligament_analysis::history::{StepRecord, View};
use ligament_analysis::interface::StressReading;
use ligament_analysis::material_stress::MaterialStress;
use ligament_analysis::result_fields::FieldReading;

use super::stored_state::StoredState;
use crate::vtu::{self, TIME_VALUE};

/// Rule for the contents and the frequency of the output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WriteRule {
    /// Number of load steps between outputs of fields, besides the first and the last; 0: only these two.
    pub fields_every: usize,
    /// Largest number of states between the breakages of a load step that are kept.
    pub during_breakage: usize,
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

/// A state that is written.
#[derive(Clone, Copy)]
pub(super) struct WrittenState<'a> {
    /// Number of the state.
    pub(super) state: StoredState,
    /// Time of the state in the collections: in a motion its time (s), otherwise the number of its row in the history, because loads and
    /// displacements may stay constant or decrease; between breakages after the row before, by the share of all bonds that broke since.
    pub(super) time: f64,
    /// Record of the state.
    pub(super) record: &'a StepRecord,
    /// The state itself.
    pub(super) view: &'a View<'a>,
}

impl<'a> WrittenState<'a> {
    /// The state of a row of the history.
    pub(super) fn of_row(record: &'a StepRecord, view: &'a View<'a>) -> Self {
        Self {
            state: StoredState::end(record.step),
            time: match record.motion {
                Some(_) => record.load_factor,
                None => record.step as f64,
            },
            record,
            view,
        }
    }

    /// A state between the breakages of a load step of a body with so many bonds.
    pub(super) fn between_breakages(
        record: &'a StepRecord,
        view: &'a View<'a>,
        n_bonds: usize,
    ) -> Self {
        let breakages = record.broken_in_step;
        Self {
            state: StoredState::between(record.step, breakages),
            time: record.step as f64 - 1.0 + breakages as f64 / n_bonds as f64,
            record,
            view,
        }
    }

    /// Name of the file of fields.
    pub(super) fn fields_file(&self) -> String {
        let stem = format!("fields_{}", self.state.in_file_name());
        vtu::file_name(&stem, &self.view.system.subdomain)
    }

    /// Field data of the files: the time, then `load_factor`, `displacement` and `reaction` of the record. No field has one of these names,
    /// because readers look for a name in both.
    pub(super) fn field_data(&self) -> [(&'static str, f64); 4] {
        [
            (TIME_VALUE, self.time),
            ("load_factor", self.record.load_factor),
            ("load_displacement", self.record.displacement),
            ("load_reaction", self.record.reaction),
        ]
    }
}

/// Number of bonds of the body. Collective.
pub(super) fn n_bonds_of_body(problem: &Problem) -> usize {
    let (ends, subdomain) = (&problem.system.ends, &problem.system.subdomain);
    subdomain.count(ends.iter().filter(|it| subdomain.owns_bond(**it)).count())
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

    /// Whether the model is written again, with what is known at the end of a run in which bonds can fail.
    pub(super) fn rewrites_model(&self, view: &View<'_>) -> bool {
        let can_fail = !view.criteria.criteria().list.is_empty();
        self.model && view.is_last && view.is_whole && can_fail
    }

    /// Whether fields are written in a step that is not the last one.
    pub fn is_due(&self, step: usize) -> bool {
        match self.fields_every {
            0 => step == 0,
            every => step.is_multiple_of(every),
        }
    }
}
