//! A driver of one's own through a load program: fatigue. The load is constant; the bond with the largest ratio breaks after N =
//! 1000/ratio^8 cycles, a law of Basquin's form with numbers of this example, where the ratio is its measure over its limit. The next row
//! is the equilibrium after it.

#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

#[path = "watched_plate.rs"]
#[allow(dead_code, reason = "its plate is loaded again and again here")]
mod watched_plate;

use ligament::Loading;
use ligament::analysis::driver::{Breakage, Problem, StepCounters};
use ligament::analysis::driver::{Outcome, Rows, Run, Stop, StopRules, Way};
use ligament::analysis::history::StepRecord;
use ligament::analysis::{SetupError, State, Termination};
use ligament::prelude::*;

struct Fatigue<'a> {
    run: Run<'a>,
    /// Bonds that broke last.
    breakage: Breakage,
    /// Number of cycles so far.
    cycles: f64,
    /// Number of cycles after which the test ends.
    most: f64,
}

impl<'a> Fatigue<'a> {
    fn begin(
        problem: &Problem,
        load_factor: f64,
        observer: &'a mut dyn Observer,
    ) -> Result<Self, SetupError> {
        let (mut run, _) = Run::begin(problem, 1e-4, StopRules::NONE, observer)?;
        run.set_load_factor(load_factor);
        Ok(Self {
            run,
            breakage: Breakage::default(),
            cycles: 0.0,
            most: 1e12,
        })
    }
}

impl Way for Fatigue<'_> {
    fn advance(&mut self) -> Result<(), Stop> {
        let step = self.history().len();
        let balanced = self.run.next_equilibrium([step, 0], &self.breakage)?;
        let criteria = self.run.criteria(&balanced);
        let first = self
            .run
            .first_to_break(1e-8, &balanced.deformations, &criteria);
        let counters = StepCounters {
            step,
            at_rest: true,
            largest_ratio: first.ratio,
            broken_in_step: first.bonds.len(),
            ..StepCounters::default()
        };
        self.run.record(&balanced, counters, false)?;
        self.cycles += 1000.0 / first.ratio.powi(8);
        if self.cycles > self.most || first.bonds.is_empty() {
            return Err(Stop::End(Termination::StepsDone));
        }
        let at = [step, 1];
        self.breakage = self.run.break_bonds(&first.bonds, &balanced, at)?;
        Ok(())
    }

    fn now(&self) -> (&State, &[StepRecord]) {
        self.run.now()
    }

    fn outcome(self: Box<Self>, end: Termination) -> Result<Outcome, SetupError> {
        Ok(self.run.into_outcome(end, Rows::LoadSteps))
    }
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let model = Model::build(watched_plate::plate()?, &mut ())?;
    let problem = Loading::new(&model)?.problem(&model);
    let mut observer = NoObserver;
    let mut way = Fatigue::begin(&problem, 0.3, &mut observer)?;
    let end = loop {
        match way.advance() {
            Ok(()) => {}
            Err(Stop::End(end)) => break end,
            Err(Stop::Failed(error)) => return Err(error.into()),
        }
    };
    let broken = way.state().broken_bonds();
    println!("{:.3e} cycles, {broken} bonds broken: {end}", way.cycles);
    assert!(broken > 100 && way.history().len() > 100);
    Ok(())
}
