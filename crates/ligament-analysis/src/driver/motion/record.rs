//! Rows of the history of a motion.

use serde::Serialize;

use super::clock::Clock;
use crate::balanced::Balanced;
use crate::contact::RigidMotion;
use crate::driver::checkpoint::WayKind;
use crate::driver::equations::Equations;
use crate::driver::record::StepCounters;
use crate::driver::run::Run;
use crate::driver::way::Stop;
use crate::history::{Rates, StepRecord, Termination};
use crate::load_program::ControlKind;
use crate::termination::{Growth, Verdict};
use crate::unbalanced::Unbalanced;

/// Share of the work by which the energies may differ, or an energy be negative, before the motion counts as growing without cause.
const GROWN: f64 = 0.02;

/// A body in motion at a row of its history.
pub(super) struct RowInTime<'a> {
    pub(super) clock: &'a Clock,
    pub(super) balanced: &'a Balanced,
    pub(super) rates: Rates<'a>,
    /// Surfaces that moved through each other unseen in a step so far.
    pub(super) missed: Option<&'a Unbalanced>,
    /// Share of the energy by which the kinetic energy of the scheme may be negative in a stable motion.
    pub(super) below_zero: f64,
    /// Energy below which differences are rounding of the places of contacts, J.
    pub(super) rounding: f64,
}

impl<E: Equations> Run<'_, E> {
    /// Records the present time as a row, and stops where the motion ends there. Before, the motion is offered to the observer as one that can
    /// continue with this row, from its position on a way of this kind, so that a motion resumed at its end records its last row again.
    pub(super) fn record_in_time<P: Serialize>(
        &mut self,
        now: &RowInTime<'_>,
        position: (WayKind, &P),
    ) -> Result<(), Stop> {
        let row = self.progress.history.len();
        let mut record = self.row_in_time(row, now);
        let Clock { rows, duration, .. } = *now.clock;
        let done = (row == rows).then_some(Termination::TimeReached { time: duration });
        // Energies of the first row are small, and below zero where forces begin suddenly: it ends a motion only where they are no numbers.
        let is_lost = |it: &Termination| matches!(it, Termination::EnergyGrew { growth, .. } if *growth == Growth::NoNumber);
        let end = self.end_in_time(&record, now);
        let end = end.filter(|it| row > 0 || is_lost(it)).or(done);
        let verdict = end.as_ref().map(|it| it.row().verdict);
        record.at_rest = verdict != Some(Verdict::Invalid);
        let end = self.offer(position, now.balanced, end)?;
        let seen = (now.balanced, Some(now.rates));
        self.push(record, seen, [end.is_some(), true])?;
        end.map_or(Ok(()), |end| Err(Stop::End(end)))
    }

    fn row_in_time(&self, row: usize, now: &RowInTime<'_>) -> StepRecord {
        let (problem, state) = (&self.problem, &self.state);
        let before = self.progress.history.last();
        let broken = self.progress.broken;
        let counters = StepCounters {
            step: row,
            broken,
            broken_in_step: broken - before.map_or(0, |it| it.broken_bonds),
            at_rest: true,
            largest_ratio: problem.largest_ratio(state, now.balanced),
            ..Default::default()
        };
        let mut record = self.row((now.balanced, Some(now.rates)), counters);
        record.energy_floor = record.energy_floor.max(now.rounding);
        let bodies = problem.contact.rigid_bodies.iter().enumerate();
        for (place, (index, body)) in record.rigid_bodies.iter_mut().zip(bodies) {
            match body.motion {
                RigidMotion::Prescribed { .. } => {
                    place.velocity = body.motion.velocity(state.load_factor);
                }
                RigidMotion::Free { .. } => {
                    let rates = now.rates.rigid[index];
                    place.velocity = rates.velocity;
                    place.angular_velocity = rates.angular_velocity;
                }
            }
        }
        let control = problem.loads.control();
        if let ControlKind::FreeBody(body) = control.kind {
            let way = record.rigid_bodies[body].displacement.iter();
            record.displacement = way
                .zip(&control.shape)
                .map(|(it, cosine)| it * cosine)
                .sum();
        }
        record
    }

    /// Reason why the motion ends at a row before its time.
    fn end_in_time(&self, record: &StepRecord, now: &RowInTime<'_>) -> Option<Termination> {
        if let Some(missed) = now.missed {
            return Some(Termination::NoEquilibrium {
                step: record.step,
                reason: missed.clone(),
            });
        }
        if let Some(growth) = self.growth(record, now.below_zero) {
            let time = record.load_factor;
            return Some(Termination::EnergyGrew { time, growth });
        }
        self.interruption()
    }

    /// What grew without cause up to a row; None where nothing did. Energies that are not numbers count as grown.
    fn growth(&self, record: &StepRecord, below_zero: f64) -> Option<Growth> {
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
        let is_heated = self.problem.loads.temperature_factor(record.load_factor) != 0.0;
        let is_stored = is_heated || record.stored_energy >= -GROWN * scale;
        let is_moving = motion.kinetic_energy >= -(below_zero + GROWN) * scale;
        let error = record.energy_error();
        let has_energy = self.problem.system.element.has_energy();
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
