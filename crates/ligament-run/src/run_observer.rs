//! Observers of a run: the observer of rank 0 writes the results, shows the progress and collects the messages; the observer of any other
//! rank writes pieces of grids.

use std::time::Instant;

use ligament::setup::Setup;
use ligament::{Body, Message, Model};
use ligament_analysis::Termination;
use ligament_analysis::first_bonds::FirstBonds;
use ligament_analysis::history::{
    Ahead, BreakRecord, Moment, Observer, ObserverError, Onward, StepRecord, View,
};
use ligament_analysis::largest_utilisation::LargestUtilisations;
use ligament_output::results::{PieceWriter, ResultWriter};

use crate::checkpoints::{Checkpoints, IsStopped, StopRequests};
use crate::messages::with_point_names;
use crate::progress::{Progress, StepLine, noun};
use crate::run_time_estimate;

/// Largest number of messages shown during the run; all are in `summary.json`.
const SHOWN: usize = 5;

/// The observer of `ligament run`.
pub(crate) struct RunObserver<'a> {
    writer: ResultWriter<'a>,
    checkpoints: Checkpoints<'a>,
    requests: StopRequests<'a>,
    /// Whether the run stops in the next state.
    stops: bool,
    progress: &'a mut Progress,
    messages: Vec<Message>,
    last: StepLine,
    /// Body with the names of all points, also those of other processes.
    names: &'a dyn Body,
    setup: &'a Setup,
    /// Number of bonds.
    bonds: usize,
}

impl<'a> RunObserver<'a> {
    /// The observer of a run of a model, with a writer, checkpoints, a progress display and the messages of an earlier part of the run.
    pub(crate) fn new(
        (writer, checkpoints): (ResultWriter<'a>, Checkpoints<'a>),
        requests: StopRequests<'a>,
        progress: &'a mut Progress,
        model: &'a Model,
        messages: Vec<Message>,
    ) -> Self {
        let setup = &model.setup;
        let in_time = setup.analysis.is_motion();
        progress.begin_steps(setup.n_steps().map(|steps| steps as u64), noun(in_time));
        let last = StepLine {
            step: 0,
            load_factor: 0.0,
            in_time,
            displacement: None,
            load: None,
            units: setup.units(),
            broken_bonds: 0,
            softened_bonds: None,
            stage: None,
        };
        Self {
            writer,
            checkpoints,
            requests,
            stops: false,
            progress,
            messages,
            last,
            names: &*model.names,
            setup,
            bonds: model.counts.bonds,
        }
    }

    /// Messages, first broken and softened bonds, checkpoints, and largest utilisations of the bonds of the run.
    pub(crate) fn into_parts(
        self,
    ) -> (
        Vec<Message>,
        FirstBonds,
        Checkpoints<'a>,
        Option<LargestUtilisations>,
    ) {
        let first = self.writer.first_bonds();
        let largest = self.writer.into_largest();
        (self.messages, first, self.checkpoints, largest)
    }

    fn require_not_aborted(&self) -> Result<(), ObserverError> {
        match (self.requests.is_aborted)() {
            true => Err(ObserverError("stopped at once".into())),
            false => Ok(()),
        }
    }
}

impl Observer for RunObserver<'_> {
    fn begins(&mut self, ahead: Ahead) {
        if let Some(words) = run_time_estimate::announcement(ahead, self.bonds) {
            self.progress.stage(&words);
        }
    }

    fn round(
        &mut self,
        step: usize,
        round: usize,
        load_factor: f64,
        broken: usize,
    ) -> Result<(), ObserverError> {
        self.last = StepLine {
            step: step as u64,
            load_factor,
            broken_bonds: broken as u64,
            ..self.last.clone()
        };
        if step > 0 && round > 0 {
            self.progress.round(&self.last);
        }
        self.require_not_aborted()?;
        self.writer.round(step, round, load_factor, broken)
    }

    fn iteration(
        &mut self,
        iteration: usize,
        residual: f64,
        stored_energy: f64,
    ) -> Result<(), ObserverError> {
        self.require_not_aborted()?;
        self.writer.iteration(iteration, residual, stored_energy)
    }

    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        self.writer.broke(records)
    }

    fn message(&mut self, message: Message) -> Result<(), ObserverError> {
        let message = with_point_names(message, self.names, self.setup);
        let is_new = |it: &Message| !it.tells_the_same(&message);
        if self.messages.len() < SHOWN && self.messages.iter().all(is_new) {
            self.progress.stage(&message.to_string());
        }
        self.messages.push(message);
        Ok(())
    }

    fn asks(&mut self, end: Option<&Termination>) -> Result<bool, ObserverError> {
        self.stops = end.is_none() && (self.requests.is_stopped)();
        let stops = self.stops.then_some(&Termination::Stopped);
        self.checkpoints.decide(stops.or(end));
        Ok(self.checkpoints.is_due())
    }

    fn moment(&mut self, moment: &Moment<'_>) -> Result<Onward, ObserverError> {
        if self.checkpoints.is_due() {
            let start = Instant::now();
            let results = self.writer.output_state().map_err(observer_error)?;
            let (checkpoints, solution) = (&mut self.checkpoints, moment.checkpoint);
            let written = checkpoints.write(start, solution, &results, &self.messages);
            written.map_err(observer_error)?;
        }
        Ok(if self.stops { Onward::Stop } else { Onward::Go })
    }

    fn looks(&self, step: usize) -> bool {
        self.writer.looks(step)
    }

    fn looks_between_breakages(
        &mut self,
        step: usize,
        broken: usize,
    ) -> Result<bool, ObserverError> {
        self.writer.looks_between_breakages(step, broken)
    }

    fn between_breakages(
        &mut self,
        record: &StepRecord,
        view: &View<'_>,
    ) -> Result<(), ObserverError> {
        self.writer.between_breakages(record, view)
    }

    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        self.last = StepLine {
            step: record.step as u64,
            load_factor: record.load_factor,
            in_time: record.motion.is_some(),
            displacement: Some(record.displacement),
            load: Some(record.reaction),
            units: self.last.units,
            broken_bonds: record.broken_bonds as u64,
            softened_bonds: (view.criteria.criteria().soften())
                .then(|| view.softened_bonds() as u64),
            stage: (view.loads.course()).map(|it| it.programme.stage_name(record.part).to_owned()),
        };
        if record.step > 0 {
            self.progress.step(&self.last);
        }
        self.writer.step(record, view)
    }
}

fn observer_error(error: ligament_output::Error) -> ObserverError {
    ObserverError(Box::new(error))
}

/// The observer of a rank other than 0, which writes its pieces of grids and stops together with all other processes.
pub(crate) struct PieceObserver<'a> {
    is_stopped: IsStopped<'a>,
    /// Whether the run stops in the next state.
    stops: bool,
    /// Writer of pieces; none where the body is not divided and rank 0 writes whole grids.
    writer: Option<PieceWriter<'a>>,
}

impl<'a> PieceObserver<'a> {
    /// The observer of a run, with a writer where the body is divided.
    pub(crate) fn new(writer: Option<PieceWriter<'a>>, is_stopped: IsStopped<'a>) -> Self {
        Self {
            is_stopped,
            stops: false,
            writer,
        }
    }
}

impl Observer for PieceObserver<'_> {
    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        let writer = self.writer.as_mut();
        writer.map_or(Ok(()), |it| it.step(record, view))
    }

    fn between_breakages(
        &mut self,
        record: &StepRecord,
        view: &View<'_>,
    ) -> Result<(), ObserverError> {
        let writer = self.writer.as_mut();
        writer.map_or(Ok(()), |it| it.between_breakages(record, view))
    }

    fn asks(&mut self, end: Option<&Termination>) -> Result<bool, ObserverError> {
        self.stops = end.is_none() && (self.is_stopped)();
        Ok(false)
    }

    fn moment(&mut self, _: &Moment<'_>) -> Result<Onward, ObserverError> {
        Ok(if self.stops { Onward::Stop } else { Onward::Go })
    }
}
