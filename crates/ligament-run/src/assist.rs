//! The part of the processes beside the first in a run of several: each computes with its own part of the body and writes its pieces of
//! fields and model. The first alone reads what was stored, tells, and writes all else.

use anyhow::{Context, ensure};
use ligament::Model;
use ligament::run::{follow, on_threads, restore, resume as resume_run};
use ligament::setup::Analysis;
use ligament_analysis::Termination;
use ligament_analysis::history::{Moment, Observer, ObserverError, Onward, StepRecord, View};
use ligament_analysis::ranks::Together;
use ligament_analysis::serial::Serial;
use ligament_case::case::CaseFile;
use ligament_output::folder::RESOLVED_CASE;
use ligament_output::results::PieceWriter;

use crate::checkpoints::IsStopped;
use crate::end::StoppedBeforeSolution;
use crate::loading::write_rule;
use crate::model::build_model_on;
use crate::progress::{Progress, ProgressMode};
use crate::ranks::{any_stopped, hear_folder, loading};
use crate::stages::Stages;
use crate::{resume, run};

/// Message of a process that has no other one to assist.
const ALONE: &str = "there is no other process to assist";

/// The observer of a process beside the first: it writes its pieces, and stops when one was asked to.
struct Beside<'a> {
    ranks: Together,
    is_stopped: IsStopped<'a>,
    /// Whether the run stops in the next moment.
    stops: bool,
    pieces: Option<PieceWriter<'a>>,
}

impl Observer for Beside<'_> {
    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        let pieces = self.pieces.as_mut();
        pieces.map_or(Ok(()), |it| it.step(record, view))
    }

    fn asks(&mut self, end: Option<&Termination>) -> Result<bool, ObserverError> {
        self.stops = end.is_none() && any_stopped(Some(self.ranks), self.is_stopped);
        Ok(false)
    }

    fn moment(&mut self, _: &Moment<'_>) -> Result<Onward, ObserverError> {
        Ok(if self.stops { Onward::Stop } else { Onward::Go })
    }
}

/// Where a process beside the first begins.
enum Begin {
    /// With the unloaded body.
    Unloaded,
    /// With what the first process tells it to.
    AsTold,
}

impl run::Request<'_> {
    /// Computes what the first process computes, and writes nothing. Natural modes are the business of the first alone.
    ///
    /// # Errors
    ///
    /// If something is wrong with the case, or there are no other processes.
    pub fn assist(&self) -> anyhow::Result<()> {
        on_threads(self.case.threads(), || {
            assist(self.case, self.ranks, self.is_stopped, &Begin::Unloaded)
        })?
    }
}

impl resume::Request<'_> {
    /// Computes what the first process computes when it goes on with a run, and writes nothing.
    ///
    /// # Errors
    ///
    /// If something is wrong with the case, or there are no other processes.
    pub fn assist(&self) -> anyhow::Result<()> {
        let folder = hear_folder(self.ranks.context(ALONE)?)?;
        let mut case = CaseFile::load(&folder.join(RESOLVED_CASE), self.settings)?;
        let threads = &mut case.case.solver.threads;
        *threads = self.threads.or(*threads);
        on_threads(case.threads(), || {
            assist(&case, self.ranks, self.is_stopped, &Begin::AsTold)
        })?
    }
}

fn assist(
    case: &CaseFile,
    ranks: Option<Together>,
    is_stopped: IsStopped<'_>,
    begin: &Begin,
) -> anyhow::Result<()> {
    let ranks = ranks.context(ALONE)?;
    let (mut stages, progress) = (Stages::default(), Progress::new(ProgressMode::Quiet));
    let model = build_model_on(case, Some(ranks), &mut stages, &progress)?;
    compute(case, &model, (ranks, is_stopped), begin)
}

fn compute(
    case: &CaseFile,
    model: &Model,
    (ranks, is_stopped): (Together, IsStopped<'_>),
    begin: &Begin,
) -> anyhow::Result<()> {
    let analysis = &model.setup.analysis;
    if matches!(analysis, Analysis::Modal(_)) {
        return Ok(());
    }
    let loading = loading(case, model, Some(ranks))?;
    let problem = loading.problem(model);
    let solution: Option<Vec<u8>> = match begin {
        Begin::Unloaded => {
            ensure!(!any_stopped(Some(ranks), is_stopped), StoppedBeforeSolution);
            None
        }
        Begin::AsTold => {
            let mut bytes = Vec::new();
            ranks.0.broadcast(&mut bytes);
            Serial::read(&mut bytes.as_slice())?
        }
    };
    let restored = solution.map(|it| restore(&problem, analysis, &it));
    let restored = restored.transpose()?;
    let (grid, fixed) = (model.body().grid(), &model.fixed);
    let (folder, rule) = (hear_folder(ranks)?, write_rule(case, analysis));
    let shared = || PieceWriter::new(folder, &grid, fixed, rule, &problem);
    let pieces = model.system.portion().map(|_| shared()).transpose()?;
    let mut beside = Beside {
        ranks,
        is_stopped,
        stops: false,
        pieces,
    };
    match restored {
        None => follow(&problem, analysis, &mut beside)?,
        Some(restored) => resume_run(analysis, restored, &mut beside)?,
    };
    Ok(())
}
