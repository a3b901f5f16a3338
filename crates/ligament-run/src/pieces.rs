//! The observer of ranks other than 0.

use ligament_analysis::Termination;
use ligament_analysis::history::{Moment, Observer, ObserverError, Onward, StepRecord, View};
use ligament_output::results::PieceWriter;

use crate::checkpoints::IsStopped;

/// The observer of a rank other than 0, which writes its pieces of grids and stops together with all other processes.
pub(crate) struct Pieces<'a> {
    is_stopped: IsStopped<'a>,
    /// Whether the run stops in the next state.
    stops: bool,
    /// Writer of pieces; none where the body is not divided and rank 0 writes whole grids.
    writer: Option<PieceWriter<'a>>,
}

impl<'a> Pieces<'a> {
    /// The observer of a run, with a writer where the body is divided.
    pub(crate) fn new(writer: Option<PieceWriter<'a>>, is_stopped: IsStopped<'a>) -> Self {
        Self {
            is_stopped,
            stops: false,
            writer,
        }
    }
}

impl Observer for Pieces<'_> {
    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        let writer = self.writer.as_mut();
        writer.map_or(Ok(()), |it| it.step(record, view))
    }

    fn asks(&mut self, end: Option<&Termination>) -> Result<bool, ObserverError> {
        self.stops = end.is_none() && (self.is_stopped)();
        Ok(false)
    }

    fn moment(&mut self, _: &Moment<'_>) -> Result<Onward, ObserverError> {
        Ok(if self.stops { Onward::Stop } else { Onward::Go })
    }
}
