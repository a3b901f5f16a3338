//! Pieces of the result files by ranks other than 0.

use std::path::PathBuf;

use ligament_analysis::driver::Problem;
use ligament_analysis::history::{Observer, ObserverError, StepRecord, View};
use ligament_model::{BodyGrid, ConstantFields};

use super::rule::{WriteRule, WrittenState, n_bonds_of_body};
use super::{model_file, observer_result, point_fields};
use crate::Error;

/// Observer that writes the pieces of a rank other than 0 into the folder of rank 0, whenever the [`super::ResultWriter`] of rank 0 writes
/// a grid: the model and the fields.
pub struct PieceWriter<'a> {
    folder: PathBuf,
    grid: &'a BodyGrid,
    fixed: &'a ConstantFields,
    rule: WriteRule,
    problem: Problem,
    /// Number of bonds of the body.
    n_bonds: usize,
}

impl<'a> PieceWriter<'a> {
    /// Writes the piece of the model, and returns the writer for a new or a resumed run.
    ///
    /// # Errors
    ///
    /// If the piece of the model cannot be written, by this process or another one.
    pub fn new(
        folder: PathBuf,
        grid: &'a BodyGrid,
        fixed: &'a ConstantFields,
        rule: WriteRule,
        problem: &Problem,
    ) -> Result<Self, Error> {
        if rule.model {
            model_file::write(&folder, grid, fixed, problem, None)?;
        }
        Ok(Self {
            folder,
            grid,
            fixed,
            rule,
            problem: problem.clone(),
            n_bonds: n_bonds_of_body(problem),
        })
    }

    fn write(&self, written: WrittenState<'_>) -> Result<(), ObserverError> {
        let path = self.folder.join(written.fields_file());
        observer_result(point_fields::write(
            &path, self.grid, self.fixed, self.rule, written,
        ))
    }
}

impl Observer for PieceWriter<'_> {
    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        if self.rule.writes_fields(record, view) {
            self.write(WrittenState::of_row(record, view))?;
        }
        if self.rule.rewrites_model(view) {
            let (folder, grid, fixed) = (&self.folder, self.grid, self.fixed);
            let at_end = Some((view.state, None));
            observer_result(model_file::write(
                folder,
                grid,
                fixed,
                &self.problem,
                at_end,
            ))?;
        }
        Ok(())
    }

    fn between_breakages(
        &mut self,
        record: &StepRecord,
        view: &View<'_>,
    ) -> Result<(), ObserverError> {
        let written = WrittenState::between_breakages(record, view, self.n_bonds);
        self.write(written)
    }
}
