//! A run that stops, leaves a checkpoint, and goes on from it: with the bits of a run that never stopped.

#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

#[path = "watched_plate.rs"]
#[allow(dead_code, reason = "its plate is broken here, without its watch")]
mod watched_plate;

use ligament::Loading;
use ligament::analysis::history::{Moment, ObserverError, Onward, StepRecord, View};
use ligament::prelude::*;
use ligament::run::{follow, restore};

/// An observer that stops the run after some steps and keeps its checkpoint, which a program would write to a file.
struct Pause {
    steps: usize,
    checkpoint: Vec<u8>,
}

impl Observer for Pause {
    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        self.steps = self.steps.saturating_sub(1);
        Ok(())
    }

    fn moment(&mut self, moment: &Moment<'_>) -> Result<Onward, ObserverError> {
        if self.steps > 0 {
            return Ok(Onward::Go);
        }
        self.checkpoint = moment.bytes();
        Ok(Onward::Stop)
    }
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let model = Model::build(watched_plate::plate()?, &mut ())?;
    let problem = Loading::new(&model)?.problem(&model);
    let analysis = &model.setup.analysis;
    let whole = follow(&problem, analysis, &mut NoObserver)?;

    let mut pause = Pause {
        steps: 30,
        checkpoint: Vec::new(),
    };
    let first = follow(&problem, analysis, &mut pause)?;
    println!("{} in {} bytes", first.termination, pause.checkpoint.len());

    let restored = restore(&problem, analysis, &mut pause.checkpoint.as_slice())?;
    let second = restored.resume(&mut NoObserver)?;
    println!("{}", second.termination);
    let broken = [&first, &second, &whole].map(|it| it.state.broken_bonds());
    println!(
        "bonds broken: {}, then {}; without a stop {}",
        broken[0], broken[1], broken[2]
    );
    assert!(broken[0] < broken[1] && second.state.displacement == whole.state.displacement);
    Ok(())
}
