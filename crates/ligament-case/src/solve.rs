//! A case in memory: the pipeline of a run without its files.

use std::sync::Arc;

use anyhow::Context;
use ligament_analysis::Observer;
use ligament_analysis::driver::Outcome;
use ligament_analysis::history::{ObserverError, StepRecord, View};
use ligament_analysis::modal::{ModalAnalysis, ModalOutcome};
use ligament_analysis::probe::Probe;

use crate::body::Body;
use crate::case::CaseFile;
use crate::model::{Model, build_model, model_of};
use crate::progress::{Progress, ProgressMode};
use crate::resolve::{self, Loading, Vibration};
use crate::run::follow;
use crate::stages::Stages;

/// What a case comes to.
#[derive(Debug)]
pub struct Solution {
    /// The discrete model.
    pub model: Model,
    /// The probes; their values stand in the records of the outcome, in this order.
    pub probes: Arc<[Probe]>,
    /// How the run went.
    pub outcome: Outcome,
}

/// Solves a case on its body, or on one that is given instead; nothing is shown and nothing is written.
///
/// # Errors
///
/// If the body cannot be read, a name of the case is not in it, or the problem cannot be set up. How the run ends is in
/// the outcome.
pub fn solve(case: &CaseFile, body: Option<Box<dyn Body>>) -> anyhow::Result<Solution> {
    resolve::on_threads(case, || solve_here(case, body))?
}

/// Solves a case on the threads of the caller.
fn solve_here(case: &CaseFile, body: Option<Box<dyn Body>>) -> anyhow::Result<Solution> {
    let progress = Progress::new(ProgressMode::Quiet);
    let mut stages = Stages::default();
    let model = match body {
        None => build_model(case, &mut stages, &progress)?,
        Some(body) => model_of(case, body, &mut stages, &progress)?,
    };
    let loading = Loading::of(case, &*model.body, &model.system)?;
    let problem = loading.problem(&model.system, &model.criteria);
    let outcome = follow(case, &problem, &mut Unobserved)?;
    Ok(Solution {
        model,
        probes: loading.probes,
        outcome,
    })
}

/// The natural modes of a modal case; nothing is shown and nothing is written.
///
/// # Errors
///
/// If the case is not modal, the body cannot be read, a name of the case is not in it, or the equations cannot be set
/// up.
pub fn modes(case: &CaseFile) -> anyhow::Result<ModalOutcome> {
    resolve::on_threads(case, || modes_here(case))?
}

/// The natural modes, on the threads of the caller.
fn modes_here(case: &CaseFile) -> anyhow::Result<ModalOutcome> {
    let modal = case
        .case
        .modal
        .as_ref()
        .context("the case has no modal analysis")?;
    let progress = Progress::new(ProgressMode::Quiet);
    let model = build_model(case, &mut Stages::default(), &progress)?;
    let vibration = Vibration::of(case, &*model.body, &model.system.cloud)?;
    let analysis = ModalAnalysis::new(&vibration.problem(&model.system), resolve::modal(modal))?;
    Ok(analysis.find()?)
}

/// Watches nothing.
struct Unobserved;

impl Observer for Unobserved {
    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        Ok(())
    }
}
