//! Rows of the history of a motion, and its progress.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::clock::Clock;
use crate::contact::RigidMotion;
use crate::driver::energies::Energies;
use crate::driver::record::{RunView, StepCounters, largest_ratio, offer};
use crate::driver::run_messages;
use crate::driver::way::{Outcome, Rows, Stop};
use crate::history::{InMotion, LargestOverlap, Observer, StepRecord, Termination};
use crate::motion::MotionStop;
use crate::serial::{Serial, Sink};
use crate::solver::SolverChoice;
use crate::termination::{Growth, Verdict};
use crate::unbalanced::Unbalanced;

/// Share of the work by which the energies may differ, or an energy be negative, before the motion counts as growing without cause.
const GROWN: f64 = 0.02;

/// A body in motion at a row of its history.
pub(super) struct MotionView<'a> {
    pub(super) body: RunView<'a>,
    /// Surfaces that moved through each other unseen in a step so far.
    pub(super) missed: Option<&'a Unbalanced>,
    /// Number of broken bonds.
    pub(super) broken: usize,
    /// Share of the energy by which the kinetic energy of the scheme may be negative in a stable motion.
    pub(super) below_zero: f64,
    /// Energy below which differences are rounding of the places of contacts, J.
    pub(super) rounding: f64,
}

impl MotionView<'_> {
    /// Records the time as a row, and stops where the motion ends there. Before, the motion is offered to the observer as
    /// one that can continue with this row, so that a motion resumed at its end records its last row again; `checkpoint` writes it.
    pub(super) fn record(
        &self,
        progress: &mut Progress,
        stop: (&MotionStop, Instant),
        observer: &mut dyn Observer,
        checkpoint: &dyn Fn(&Progress, &mut dyn Sink),
    ) -> Result<(), Stop> {
        let row = progress.history.len();
        let mut record = self.row(row, progress);
        let Clock { rows, duration, .. } = progress.clock;
        let done = (row == rows).then_some(Termination::TimeReached { time: duration });
        // Energies of the first row are small, and below zero where forces begin suddenly: it ends a motion only where they are no numbers.
        let is_lost = |it: &Termination| matches!(it, Termination::EnergyGrew { growth, .. } if *growth == Growth::NoNumber);
        let end = self.end(&record, stop);
        let end = end.filter(|it| row > 0 || is_lost(it)).or(done);
        let verdict = end.as_ref().map(|it| it.row().verdict);
        record.at_rest = verdict != Some(Verdict::Invalid);
        let RunView {
            problem,
            numbers,
            fragments,
            state,
            ..
        } = self.body;
        let end = offer(observer, numbers, end, &|out| checkpoint(progress, out))?;
        self.body.show(&record, [end.is_some(), true], observer)?;
        if record.at_rest {
            let overlap = &mut progress.overlap;
            self.body.report_overlap(row, overlap, observer)?;
        }
        if !progress.has_turned
            && let Some(message) = run_messages::turned(problem, state, fragments, row)
        {
            progress.has_turned = true;
            observer.message(message)?;
        }
        if let Some(message) = run_messages::energies(problem, &record, progress.history.last()) {
            observer.message(message)?;
        }
        progress.history.push(record);
        end.map_or(Ok(()), |end| Err(Stop::End(end)))
    }

    fn row(&self, row: usize, progress: &Progress) -> StepRecord {
        let RunView {
            problem,
            state,
            balanced,
            ..
        } = self.body;
        let before = progress.history.last();
        let counters = StepCounters {
            step: row,
            broken: self.broken,
            broken_in_step: self.broken - before.map_or(0, |it| it.broken_bonds),
            at_rest: true,
            largest_ratio: largest_ratio(problem, state, balanced),
            ..Default::default()
        };
        let mut record = self.body.record(counters);
        record.motion = Some(progress.motion);
        record.energy_floor = record.energy_floor.max(self.rounding);
        let bodies = problem.contact.rigid_bodies.iter().enumerate();
        for (place, (index, body)) in record.rigid_bodies.iter_mut().zip(bodies) {
            match body.motion {
                RigidMotion::Prescribed { .. } => {
                    place.velocity = body.motion.velocity(state.load_factor);
                }
                RigidMotion::Free { .. } => {
                    let rates = self.body.rates.map(|it| it.rigid[index]);
                    let rates = rates.unwrap_or_default();
                    place.velocity = rates.velocity;
                    place.angular_velocity = rates.angular_velocity;
                }
            }
        }
        record
    }

    /// Reason why the motion ends at a row before its time.
    fn end(
        &self,
        record: &StepRecord,
        (stop, started): (&MotionStop, Instant),
    ) -> Option<Termination> {
        if let Some(missed) = self.missed {
            return Some(Termination::NoEquilibrium {
                step: record.step,
                reason: missed.clone(),
            });
        }
        if let Some(growth) = self.growth(record) {
            let time = record.load_factor;
            return Some(Termination::EnergyGrew { time, growth });
        }
        let bonds = stop.bonds.filter(|&most| self.broken >= most);
        let bonds = bonds.map(|bonds| Termination::BondsBroken { bonds });
        let elapsed = started.elapsed().as_secs_f64();
        let seconds = stop.wall_time.filter(|&most| elapsed >= most);
        bonds.or(seconds.map(|seconds| Termination::WallTime { seconds }))
    }

    /// What grew without cause up to a row; None where nothing did. Energies that are not numbers count as grown.
    fn growth(&self, record: &StepRecord) -> Option<Growth> {
        let motion = record.motion.unwrap_or_default();
        let given = record.external_work.abs().max(motion.initial_energy);
        let given = given.max(record.energy_floor);
        let negative = (motion.taken().into_iter()).find(|(_, energy)| *energy < -GROWN * given);
        if let Some((entry, energy)) = negative {
            let share = energy / given;
            return Some(Growth::Given { entry, share });
        }
        let scale = record.external_work.abs() + motion.initial_energy;
        let scale = scale.max(record.energy_floor);
        let is_heated = self
            .body
            .problem
            .loads
            .temperature_factor(record.load_factor)
            != 0.0;
        let is_stored = is_heated || record.stored_energy >= -GROWN * scale;
        let is_moving = motion.kinetic_energy >= -(self.below_zero + GROWN) * scale;
        let error = record.energy_error();
        let has_energy = self.body.problem.system.element.has_energy();
        let balances = error.is_finite() && (error.abs() <= GROWN || !has_energy);
        let grown = [
            (!error.is_finite(), Growth::NoNumber),
            (!balances, Growth::Balance(error)),
            (!is_stored, Growth::Stored(record.stored_energy)),
            (!is_moving, Growth::Kinetic(motion.kinetic_energy)),
        ];
        grown.into_iter().find(|it| it.0).map(|it| it.1)
    }
}

/// Result of a motion.
pub(super) fn outcome(
    now: &MotionView<'_>,
    progress: Progress,
    solver: SolverChoice,
    termination: Termination,
) -> Outcome {
    Outcome {
        history: progress.history,
        rows: Rows::Times,
        broken_bonds: now.broken,
        softened_bonds: now.body.softened().bonds,
        termination,
        elastic_stiffness: f64::NAN,
        first_break: None,
        overlap: progress.overlap,
        stability: None,
        costs: *now.body.costs,
        solver,
        state: now.body.state.clone(),
    }
}

/// First byte of the checkpoint of an explicit motion; checkpoints of statics begin with 0 or 1.
pub(super) const EXPLICIT: u8 = 2;

/// First byte of the checkpoint of an implicit motion.
pub(super) const IMPLICIT: u8 = 3;

/// Progress of a motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Progress {
    pub(super) clock: Clock,
    /// Energies and number of time steps.
    pub(super) motion: InMotion,
    /// Forces of damping at the time (n_degrees_of_freedom), N and N m; empty where nothing damps.
    pub(super) damping_forces: Vec<f64>,
    /// Time at which the body last lost its balance, s, with the number of bonds broken before.
    pub(super) moving_since: (f64, usize),
    pub(super) history: Vec<StepRecord>,
    /// Largest overlap of crack faces so far.
    pub(super) overlap: Option<LargestOverlap>,
    /// Whether a part has turned beyond small angles.
    pub(super) has_turned: bool,
}

impl Progress {
    pub(super) fn at_start(clock: Clock) -> Self {
        Self {
            clock,
            motion: InMotion::default(),
            damping_forces: Vec::new(),
            moving_since: (0.0, 0),
            history: Vec::new(),
            overlap: None,
            has_turned: false,
        }
    }

    /// Appends the bytes of a motion under a scheme, from which it continues with the same bits; `write` appends its state.
    pub(super) fn write_all(
        &self,
        energies: &Energies,
        scheme: u8,
        write: &dyn Fn(&mut dyn Sink),
        out: &mut dyn Sink,
    ) {
        scheme.write(out);
        self.write(out);
        write(out);
        energies.write(out);
    }
}
