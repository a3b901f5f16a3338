//! Pieces of the result files by ranks other than 0.

use std::path::PathBuf;

use ligament_analysis::driver::Problem;
use ligament_analysis::history::{Observer, ObserverError, StepRecord, View};
use ligament_model::{BodyGrid, ConstantFields};

use super::rule::WriteRule;
use super::{fields_file, model_file, observer_result, point_fields};
use crate::Error;

/// Observer that writes the pieces of a rank other than 0 into the folder of rank 0, whenever the [`super::ResultWriter`] of rank 0 writes
/// a grid: the model and the fields.
pub struct PieceWriter<'a> {
    folder: PathBuf,
    grid: &'a BodyGrid,
    fixed: &'a ConstantFields,
    rule: WriteRule,
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
        })
    }
}

impl Observer for PieceWriter<'_> {
    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        if !self.rule.writes_fields(record, view) {
            return Ok(());
        }
        let path = self.folder.join(fields_file(record, view));
        observer_result(point_fields::write(
            &path,
            self.grid,
            self.fixed,
            self.rule,
            (record, view),
        ))
    }
}
