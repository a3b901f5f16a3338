//! The method, second page: from the discrete model to a broken body, or to its modes. The first is [`crate::model`].

use std::io::Read;
use std::sync::Arc;

use ligament_analysis::Observer;
use ligament_analysis::checkpoint::CheckpointError;
use ligament_analysis::distributed_matrix::Communicator;
pub use ligament_analysis::driver::Restored;
use ligament_analysis::driver::{self, Outcome, Problem, Way, motion};
use ligament_analysis::history::{ObserverError, StepRecord, View};
use ligament_analysis::largest_utilisation::LargestUtilisations;
use ligament_analysis::modal::{ModalAnalysis, ModalOutcome};
use ligament_analysis::motion::MotionProblem;
use ligament_analysis::probe::Probe;
use ligament_analysis::refinement_pass::PassRecord;
use rayon::{ThreadPoolBuildError, ThreadPoolBuilder};

use crate::error::{Error, Fault, Field};
use crate::loading::{Loading, Vibration};
use crate::model::Model;
use crate::setup::{Analysis, Setup};

/// Solution of a setup with loads: model, probes and outcome.
#[derive(Debug)]
pub struct Solution {
    /// The discrete model.
    pub model: Model,
    /// Probes, in the order of their values in the records of the outcome.
    pub probes: Arc<[Probe]>,
    /// Outcome of the analysis: history, last state, and why it ended; of a refinement, in the last pass.
    pub outcome: Outcome,
    /// Records of the passes of a refinement.
    pub passes: Vec<PassRecord>,
}

impl Setup {
    /// Builds the model and runs the analysis on the threads of the setup: an elastic solution, or the breakage of bonds up to the end of
    /// the loading or the failure of the body.
    ///
    /// # Errors
    ///
    /// If a field of the setup is wrong, or the equations cannot be set up. The outcome has the end of the analysis.
    ///
    /// Where the near field of the setup grows or its mesh is refined, the observer sees each run from its start.
    pub fn solve(self, observer: &mut (dyn Observer + Send)) -> Result<Solution, Error> {
        let (threads, communicator) = (self.threads(), self.solver.communicator.clone());
        let solve = || {
            let mut setup = self;
            let mut passes = Vec::new();
            loop {
                let model = Model::build(setup, &mut ())?;
                let loading = Loading::new(&model)?;
                let problem = loading.problem(&model);
                let motion = loading.motion(&problem);
                let posed = Posed::new(&problem, motion.as_ref());
                let mut guarded = model.guarded(observer);
                let refines = model.setup.refine.is_some();
                guarded.utilisations =
                    refines.then(|| LargestUtilisations::new(problem.system.ends.len()));
                match follow(posed, &model.setup.analysis, &mut guarded) {
                    Ok(outcome) => {
                        let utilisations = guarded.utilisations.unwrap_or_default();
                        let pass = model.end_pass(&outcome, &utilisations, &passes)?;
                        passes.extend(pass.as_ref().map(|it| it.record));
                        let Some(Ok(refine)) = pass.map(|it| it.next) else {
                            return Ok(Solution {
                                model,
                                probes: loading.probes,
                                outcome,
                                passes,
                            });
                        };
                        setup = model.into_setup();
                        setup.refine = Some(refine);
                    }
                    // Elements near their strength become bonds, and the run begins anew.
                    Err(error) => {
                        let growth = model.growth(error)?;
                        setup = model.into_setup();
                        setup.grow(growth);
                    }
                }
            }
        };
        on_threads(threads, || on_pool(&*communicator, solve))?
    }

    /// Builds the model and finds its natural modes on the threads of the setup.
    ///
    /// # Errors
    ///
    /// If a field of the setup is wrong or its analysis is another, or the equations cannot be set up or solved.
    pub fn modes(self) -> Result<ModalOutcome, Error> {
        let Analysis::Modal(settings) = self.analysis else {
            return Err(other_analysis(&self.analysis, "natural modes"));
        };
        let (threads, communicator) = (self.threads(), self.solver.communicator.clone());
        let find = || {
            let model = Model::build(self, &mut ())?;
            let vibration = Vibration::new(&model)?;
            let analysis = ModalAnalysis::new(&vibration.problem(&model), settings)?;
            Ok(analysis.find()?)
        };
        on_threads(threads, || on_pool(&*communicator, find))?
    }
}

/// A problem of loads, in statics or in motion.
#[derive(Clone, Copy)]
pub enum Posed<'a> {
    /// Equilibrium under loads.
    Statics(&'a Problem),
    /// Motion in time.
    Motion(&'a MotionProblem),
}

impl<'a> Posed<'a> {
    /// The problem in motion, if there is one, otherwise the problem in statics.
    pub fn new(problem: &'a Problem, motion: Option<&'a MotionProblem>) -> Self {
        motion.map_or(Self::Statics(problem), Self::Motion)
    }
}

impl<'a> From<&'a Problem> for Posed<'a> {
    fn from(problem: &'a Problem) -> Self {
        Self::Statics(problem)
    }
}

impl<'a> From<&'a MotionProblem> for Posed<'a> {
    fn from(problem: &'a MotionProblem) -> Self {
        Self::Motion(problem)
    }
}

/// Begins to solve a problem, or to follow its loading or its motion; the caller advances the run row by row of the history.
///
/// # Errors
///
/// If the analysis is of natural modes or does not fit the problem, or the equations cannot be set up.
pub fn begin<'a>(
    posed: impl Into<Posed<'a>>,
    analysis: &'a Analysis,
    observer: &'a mut dyn Observer,
) -> Result<Box<dyn Way + 'a>, Error> {
    let problem = match (posed.into(), analysis) {
        (Posed::Motion(problem), Analysis::Motion(settings)) => {
            return Ok(motion::begin(problem, settings, observer)?);
        }
        (Posed::Motion(_), _) => return Err(other_analysis(analysis, "a motion")),
        (Posed::Statics(problem), _) => problem,
    };
    Ok(match analysis {
        Analysis::Elastic { energy_tolerance } => Box::new(driver::elastic::begin(
            problem,
            *energy_tolerance,
            observer,
        )?),
        Analysis::Stepped(settings) => {
            Box::new(driver::stepped::begin(problem, settings, observer)?)
        }
        Analysis::Event(settings) => Box::new(driver::event::begin(problem, settings, observer)?),
        Analysis::Modal(_) | Analysis::Motion(_) => {
            return Err(other_analysis(analysis, "the response to loads"));
        }
    })
}

/// Solves a problem, or follows its loading up to failure or its motion up to the end.
///
/// # Errors
///
/// As in [`begin`], or if the run fails.
pub fn follow<'a>(
    posed: impl Into<Posed<'a>>,
    analysis: &'a Analysis,
    observer: &'a mut dyn Observer,
) -> Result<Outcome, Error> {
    Ok(begin(posed, analysis, observer)?.follow()?)
}

/// The run of a checkpoint, which [`Restored::resume`] continues, bitwise identical to an uninterrupted run.
///
/// # Errors
///
/// If the checkpoint is damaged or not of this problem and analysis, or the analysis breaks no bonds.
pub fn restore<'a>(
    posed: impl Into<Posed<'a>>,
    analysis: &Analysis,
    checkpoint: &mut dyn Read,
) -> Result<Restored, Error> {
    let problem = match (posed.into(), analysis) {
        (Posed::Motion(problem), Analysis::Motion(settings)) => {
            return Ok(motion::restore(problem, settings, checkpoint)?);
        }
        (Posed::Motion(_), _) => return Err(other_analysis(analysis, "a motion")),
        (Posed::Statics(problem), _) => problem,
    };
    Ok(match analysis {
        Analysis::Stepped(settings) => driver::stepped::restore(problem, settings, checkpoint)?,
        Analysis::Event(settings) => driver::event::restore(problem, settings, checkpoint)?,
        Analysis::Elastic { .. } | Analysis::Modal(_) | Analysis::Motion(_) => {
            return Err(without_fracture());
        }
    })
}

fn without_fracture() -> Error {
    ligament_analysis::SetupError::Checkpoint(CheckpointError::NoFracture).into()
}

fn other_analysis(found: &Analysis, wanted: &'static str) -> Error {
    let fault = Fault::OtherAnalysis {
        found: found.name(),
        wanted,
    };
    Field::whole("analysis").error(fault).into()
}

/// Runs `work` on a number of threads, or without a number on the caller's threads.
///
/// # Errors
///
/// If the threads cannot be started.
pub fn on_threads<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> T + Send,
) -> Result<T, ThreadPoolBuildError> {
    match threads {
        None => Ok(work()),
        Some(count) => {
            let pool = ThreadPoolBuilder::new().num_threads(count);
            Ok(pool.build()?.install(work))
        }
    }
}

/// Runs `work` on a thread of the pool where this process is alone: from a thread outside the pool, each short loop would wait for two changes of
/// threads. One of several processes stays on the thread that exchanges messages.
pub fn on_pool<T: Send>(communicator: &dyn Communicator, work: impl FnOnce() -> T + Send) -> T {
    match communicator.size() {
        1 => rayon::scope(|_| work()),
        _ => work(),
    }
}

/// An observer that records nothing: the outcome has the history.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoObserver;

impl Observer for NoObserver {
    fn looks(&self, _: usize) -> bool {
        false
    }

    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        Ok(())
    }
}
