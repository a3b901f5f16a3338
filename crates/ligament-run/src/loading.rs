//! Runs a body under loads, from its first state or from a checkpoint, and writes the results into a folder.

use ligament::run::{Posed, Restored, follow};
use ligament::setup::Refine;
use ligament::{Loading, Message, Model};
use ligament_analysis::driver::Outcome;
use ligament_analysis::refinement_pass::PassRecord;
use ligament_case::case::{CaseFile, StressField};
use ligament_model::BodyGrid;
use ligament_output::folder::ResultFolder;
use ligament_output::results::{OutputState, PieceWriter, ResultWriter, WriteRule};
use ligament_output::summary::{self, Build, Provenance, Summary};

use crate::checkpoints::{Checkpoints, StopRequests};
use crate::inputs::{FileIdentities, Inputs, unreadable_file};

use crate::processes::broadcast_path;
use crate::progress::Progress;
use crate::provenance::provenance;
use crate::refinement;
use crate::run_observer::{PieceObserver, RunObserver};
use crate::stages::Stages;
use crate::summary::{PointStatistics, SummaryData, certificate, summary};

/// A body under loads.
pub(crate) struct LoadedBody<'a> {
    pub(crate) case: &'a CaseFile,
    pub(crate) model: &'a Model,
    pub(crate) loading: &'a Loading,
    pub(crate) build: Build,
    pub(crate) requests: StopRequests<'a>,
    /// Records of the passes of a refinement before this run.
    pub(crate) earlier: &'a [PassRecord],
}

/// State of a checkpoint from which a run continues.
pub(crate) struct RestoredRun {
    pub(crate) restored: Restored,
    pub(crate) results: OutputState,
    pub(crate) messages: Vec<Message>,
}

impl LoadedBody<'_> {
    /// Runs the analysis on rank 0 from the unloaded body or from a checkpoint's state, and writes all results into the folder.
    pub(crate) fn follow(
        &self,
        folder: &ResultFolder,
        restored_run: Option<RestoredRun>,
        stages: &mut Stages,
        progress: &mut Progress,
    ) -> anyhow::Result<(Summary, Option<Refine>)> {
        let Self {
            case,
            model,
            loading,
            requests,
            earlier,
            ..
        } = *self;
        let problem = loading.problem(model);
        let motion = loading.motion(&problem);
        let posed = Posed::new(&problem, motion.as_ref());
        let of_points = PointStatistics::new(model);
        let grid = grid(model);
        broadcast_path(&*loading.solver.communicator, Some(folder.path()))?;
        let (fixed, rule) = (&model.fixed, write_rule(case));
        let (inputs, provenance) = self.inputs(folder, restored_run.is_some())?;
        refinement::write_start(folder, model, earlier)?;
        let every = case.case.output.checkpoint_every;
        let checkpoints = Checkpoints::new(folder, inputs.text().to_owned(), every);
        let (writer, messages, restored) = match restored_run {
            None => {
                let writer = ResultWriter::new(folder, &grid, fixed, rule, &problem)?;
                (writer, Vec::new(), None)
            }
            Some(restored_run) => {
                let results = restored_run.results;
                let writer = ResultWriter::resume(folder, &grid, fixed, rule, &problem, results)?;
                (writer, restored_run.messages, Some(restored_run.restored))
            }
        };
        let writers = (writer, checkpoints);
        let mut observer = RunObserver::new(writers, requests, progress, model, messages);
        let outcome = stages.time("solution", || self.outcome(posed, restored, &mut observer))?;

        let (messages, first, checkpoints, largest) = observer.into_parts();
        let ended = refinement::end_pass(folder, (case, model), &outcome, largest, earlier)?;
        let (refinement, next) = ended.unzip();
        let data = SummaryData {
            of_points,
            provenance,
            messages,
            first,
            certificate: certificate(folder.path(), model, &outcome)?,
            stages: stages.done().to_vec(),
            refinement,
        };
        let summary = summary(case, model, &loading.boundary, &outcome, data);
        summary::write(folder, &summary)?;
        checkpoints.end(&outcome.termination)?;
        Ok((summary, next.flatten()))
    }

    /// The inputs of the run, and where its results come from.
    fn inputs(&self, folder: &ResultFolder, resumed: bool) -> anyhow::Result<(Inputs, Provenance)> {
        let mut contents = FileIdentities::default();
        let inputs = Inputs::determining_inputs(self.case, &mut contents);
        let inputs = inputs.map_err(unreadable_file)?;
        let found = provenance(self.build.clone(), self.case, folder.path(), &mut contents);
        let found = found.map_err(unreadable_file)?;
        Ok((inputs, Provenance { resumed, ..found }))
    }
}

impl LoadedBody<'_> {
    /// Runs the analysis on a rank other than 0, from the unloaded body or from a restored run, and writes this process's pieces of grids
    /// into the folder of rank 0. The counterpart on rank 0 is [`LoadedBody::follow`].
    pub(crate) fn follow_beside(&self, restored: Option<Restored>) -> anyhow::Result<()> {
        let Self {
            case,
            model,
            loading,
            requests,
            ..
        } = *self;
        let problem = loading.problem(model);
        let analysis = &model.setup.analysis;
        PointStatistics::new(model);
        let (grid, fixed) = (model.body().grid(), &model.fixed);
        let folder = broadcast_path(&*loading.solver.communicator, None)?;
        let writer = || PieceWriter::new(folder, &grid, fixed, write_rule(case), &problem);
        let is_divided = !model.system.subdomain.is_whole();
        let writer = is_divided.then(writer).transpose()?;
        let mut observer = PieceObserver::new(writer, requests.is_stopped);
        match restored {
            None => follow(&problem, analysis, &mut observer)?,
            Some(restored) => restored.resume(&mut observer)?,
        };
        Ok(())
    }
}

impl LoadedBody<'_> {
    /// Outcome of a problem, from the unloaded body or from a restored run.
    ///
    /// # Errors
    ///
    /// The [growth](ligament::near_growth::Growth) of the near field where it has to grow, and errors of the case, the equations and the observer.
    fn outcome(
        &self,
        posed: Posed<'_>,
        restored: Option<Restored>,
        observer: &mut RunObserver<'_>,
    ) -> anyhow::Result<Outcome> {
        let analysis = &self.model.setup.analysis;
        let guarded = &mut self.model.guarded(observer);
        let outcome = match restored {
            None => follow(posed, analysis, guarded),
            Some(restored) => restored.resume(guarded).map_err(Into::into),
        };
        outcome.map_err(|error| match self.model.growth(error) {
            Ok(growth) => growth.into(),
            Err(error) => self.case.error_in_case_terms(error),
        })
    }
}

/// The grid of the body on this process, with the tags of all points where the process has only a part of the body.
fn grid(model: &Model) -> BodyGrid {
    let is_whole = model.system.subdomain.is_whole();
    BodyGrid {
        of_body: (!is_whole).then(|| model.names.point_tags()),
        ..model.body().grid()
    }
}

/// The rule by which the results of a case are written.
pub fn write_rule(case: &CaseFile) -> WriteRule {
    let output = &case.case.output;
    WriteRule {
        fields_every: output.fields_every.unwrap_or_default() as usize,
        during_breakage: output.during_breakage as usize,
        bonds: output.bonds,
        model: output.model,
        utilisations: case.case.refine.is_some(),
        material_stress: output.stress.contains(&StressField::Material),
        effective_stress: output.stress.contains(&StressField::Effective),
        virial: output.stress.contains(&StressField::Virial),
        traction: output.stress.contains(&StressField::Traction),
    }
}
