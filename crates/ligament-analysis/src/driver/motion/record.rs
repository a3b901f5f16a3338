//! Rows of the history of a motion.

use super::body::Body;
use super::explicit::Explicit;
use super::restored::Restored;
use crate::driver::outcome::{Outcome, Rows};
use crate::driver::recorder::{StepCounters, largest_ratio, step_record};
use crate::driver::remarks;
use crate::error::SetupError;
use crate::history::{Moment, Onward, StepRecord, Termination, View};
use crate::result_fields::Solution;
use crate::softened::SoftenedOfAll;
use crate::solver::SolverChoice;

/// Share of the work by which the energies may differ, or an energy be negative, before the motion counts as growing without cause.
const GROWN: f64 = 0.02;

impl Explicit<'_> {
    /// Records the present time as a row, and returns the reason why the motion ends there, if it does.
    pub(super) fn record(&mut self, row: usize) -> Result<Option<Termination>, SetupError> {
        self.progress.motion.kinetic_energy = self.kinetic_energy();
        let record = self.row(row);
        let end = self.end(&record);
        let is_last = end.is_some() || row == self.progress.clock.rows;
        self.show(&record, is_last)?;
        let Body {
            problem,
            state,
            connectivity,
            ..
        } = &self.body;
        let fragments = connectivity.fragments();
        let overlap = &mut self.progress.overlap;
        if let Some(notice) = remarks::overlap(problem, state, fragments, row, overlap) {
            self.observer.notice(&notice)?;
        }
        let last = self.progress.history.last();
        if let Some(notice) = remarks::energies(problem, &record, last) {
            self.observer.notice(&notice)?;
        }
        self.progress.history.push(record);
        self.offer(end)
    }

    fn row(&self, row: usize) -> StepRecord {
        let Body {
            problem,
            state,
            balanced,
            broken,
            connectivity,
            ..
        } = &self.body;
        let before = self.progress.history.last();
        let counters = StepCounters {
            step: row,
            broken: *broken,
            broken_in_step: broken - before.map_or(0, |it| it.broken_bonds),
            at_rest: true,
            largest_ratio: largest_ratio(problem, state, balanced),
            ..Default::default()
        };
        let velocity = self.velocities.at_time(self.inertia.step());
        let solution = Solution {
            motion: Some(self.velocities.rates(&velocity)),
            ..problem.solution(state, balanced)
        };
        let fragments = connectivity.fragments();
        StepRecord {
            motion: Some(self.progress.motion),
            ..step_record(problem, solution, &self.energies, fragments, counters)
        }
    }

    /// Passes a record to the observer.
    fn show(&mut self, record: &StepRecord, is_last: bool) -> Result<(), SetupError> {
        let Body {
            problem,
            numbers,
            connectivity,
            state,
            balanced,
            costs,
            ..
        } = &self.body;
        let system = &*problem.system;
        let criteria = problem.criteria_in(state, balanced);
        let velocity = self.velocities.at_time(self.inertia.step());
        let view = View {
            system,
            state,
            balanced,
            loads: &*problem.loads,
            criteria: &criteria,
            fragments: connectivity.fragments(),
            costs,
            softened: SoftenedOfAll::in_state(state, numbers, system.ends()),
            is_last,
            motion: Some(self.velocities.rates(&velocity)),
            is_whole: true,
        };
        self.observer.step(record, &view)?;
        Ok(())
    }

    /// Reason why the motion ends at a row before its time.
    fn end(&self, record: &StepRecord) -> Option<Termination> {
        let scale = record.external_work.abs() + self.progress.motion.initial_energy;
        let floor = -GROWN * scale.max(record.energy_floor);
        let is_heated = self
            .body
            .problem
            .loads
            .temperature_factor(record.load_factor)
            != 0.0;
        let lowest = match is_heated {
            true => self.progress.motion.kinetic_energy,
            false => record
                .stored_energy
                .min(self.progress.motion.kinetic_energy),
        };
        let error = record.energy_error();
        let has_energy = self.body.problem.system.has_energy();
        let is_sound =
            error.is_finite() && (error.abs() <= GROWN || !has_energy) && lowest >= floor;
        if !is_sound {
            let time = record.load_factor;
            return Some(Termination::EnergyGrew { time, error });
        }
        let stop = &self.settings.stop;
        let bonds = stop.bonds.filter(|&most| self.body.broken >= most);
        let bonds = bonds.map(|bonds| Termination::BondsBroken { bonds });
        let elapsed = self.started.elapsed().as_secs_f64();
        let seconds = stop.wall_time.filter(|&most| elapsed >= most);
        bonds.or(seconds.map(|seconds| Termination::WallTime { seconds }))
    }

    /// Offers the present time to the observer as one from which the motion can continue. Returns the reason why the motion ends there.
    fn offer(&mut self, end: Option<Termination>) -> Result<Option<Termination>, SetupError> {
        self.observer.asks(end.as_ref())?;
        let Self {
            body,
            velocities,
            energies,
            progress,
            contacts,
            observer,
            ..
        } = self;
        let checkpoint =
            || Restored::write(body, velocities, energies, (progress, contacts.as_ref()));
        let moment = Moment {
            end: end.as_ref(),
            checkpoint: &checkpoint,
        };
        let onward = observer.moment(&moment)?;
        Ok(end.or_else(|| (onward == Onward::Stop).then_some(Termination::Stopped)))
    }

    /// Result of the motion.
    pub(super) fn into_outcome(self, termination: Termination) -> Outcome {
        let Body {
            state,
            numbers,
            problem,
            broken,
            costs,
            ..
        } = self.body;
        let softened = SoftenedOfAll::in_state(&state, &numbers, problem.system.ends());
        Outcome {
            history: self.progress.history,
            rows: Rows::Times,
            broken_bonds: broken,
            softened_bonds: softened.bonds,
            termination,
            elastic_stiffness: f64::NAN,
            first_break: None,
            overlap: self.progress.overlap,
            stability: None,
            costs,
            solver: SolverChoice::Explicit(self.choice),
            state,
        }
    }
}
