//! Runs a body under loads, from its first state or from a checkpoint, and writes the results into a folder.

use ligament::run::{Posed, Restored, follow};
use ligament::{Loading, Message, Model};
use ligament_analysis::driver::Outcome;
use ligament_case::case::{CaseFile, StressField};
use ligament_model::BodyGrid;
use ligament_output::folder::ResultFolder;
use ligament_output::results::{OutputState, PieceWriter, ResultWriter, WriteRule};
use ligament_output::summary::{self, Build, Summary};

use crate::checkpoints::{Checkpoints, Stops};
use crate::inputs::{Contents, Inputs, unread};
use crate::pieces::Pieces;
use crate::processes::broadcast_path;
use crate::progress::Progress;
use crate::provenance::provenance;
use crate::stages::Stages;
use crate::summary::{Noted, OfPoints, certificate, summary};
use crate::watch::Watch;

/// A body under loads.
pub(crate) struct LoadedBody<'a> {
    pub(crate) case: &'a CaseFile,
    pub(crate) model: &'a Model,
    pub(crate) loading: &'a Loading,
    pub(crate) build: Build,
    pub(crate) requests: Stops<'a>,
}

/// State of a checkpoint from which a run continues.
pub(crate) struct Kept {
    pub(crate) restored: Restored,
    pub(crate) results: OutputState,
    pub(crate) messages: Vec<Message>,
}

impl LoadedBody<'_> {
    /// Runs the analysis on rank 0 from the unloaded body or from a checkpoint's state, and writes all results into the folder.
    pub(crate) fn follow(
        &self,
        folder: &ResultFolder,
        kept: Option<Kept>,
        stages: &mut Stages,
        progress: &mut Progress,
    ) -> anyhow::Result<Summary> {
        let Self {
            case,
            model,
            loading,
            ref build,
            requests,
        } = *self;
        let problem = loading.problem(model);
        let motion = loading.motion(&problem);
        let posed = Posed::new(&problem, motion.as_ref());
        let of_points = OfPoints::new(model);
        let grid = grid(model);
        broadcast_path(&*loading.solver.communicator, Some(folder.path()))?;
        let (fixed, rule) = (&model.fixed, write_rule(case));
        let mut contents = Contents::default();
        let inputs = Inputs::of_course(case, &mut contents).map_err(unread)?;
        let provenance = provenance(build.clone(), case, folder.path(), &mut contents);
        let mut provenance = provenance.map_err(unread)?;
        provenance.resumed = kept.is_some();
        let every = case.case.output.checkpoint_every;
        let checkpoints = Checkpoints::new(folder, inputs.text().to_owned(), every);
        let (writer, messages, restored) = match kept {
            None => {
                let writer = ResultWriter::new(folder, &grid, fixed, rule, &problem)?;
                (writer, Vec::new(), None)
            }
            Some(kept) => {
                let results = kept.results;
                let writer = ResultWriter::cut_back(folder, &grid, fixed, rule, &problem, results)?;
                (writer, kept.messages, Some(kept.restored))
            }
        };
        let watched = (writer, checkpoints);
        let mut watch = Watch::new(watched, requests, progress, model, messages);
        let outcome = stages.time("solution", || self.outcome(posed, restored, &mut watch))?;

        let (messages, first, checkpoints) = watch.into_parts();
        let noted = Noted {
            of_points,
            provenance,
            messages,
            first,
            certificate: certificate(folder.path(), model, &outcome)?,
            stages: stages.done().to_vec(),
        };
        let summary = summary(case, model, &loading.boundary, &outcome, noted);
        summary::write(folder, &summary)?;
        checkpoints.end(&outcome.termination)?;
        Ok(summary)
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
        OfPoints::new(model);
        let (grid, fixed) = (model.body().grid(), &model.fixed);
        let folder = broadcast_path(&*loading.solver.communicator, None)?;
        let writer = || PieceWriter::new(folder, &grid, fixed, write_rule(case), &problem);
        let is_divided = !model.system.subdomain.is_whole();
        let writer = is_divided.then(writer).transpose()?;
        let mut pieces = Pieces::new(writer, requests.is_stopped);
        match restored {
            None => follow(&problem, analysis, &mut pieces)?,
            Some(restored) => restored.resume(&mut pieces)?,
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
        watch: &mut Watch<'_>,
    ) -> anyhow::Result<Outcome> {
        let analysis = &self.model.setup.analysis;
        let guarded = &mut self.model.guarded(watch);
        let outcome = match restored {
            None => follow(posed, analysis, guarded),
            Some(restored) => restored.resume(guarded).map_err(Into::into),
        };
        outcome.map_err(|error| match self.model.growth(error) {
            Ok(growth) => growth.into(),
            Err(error) => self.case.explained(error),
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
        bonds: output.bonds,
        model: output.model,
        material_stress: output.stress.contains(&StressField::Material),
        effective_stress: output.stress.contains(&StressField::Effective),
        virial: output.stress.contains(&StressField::Virial),
        traction: output.stress.contains(&StressField::Traction),
    }
}
