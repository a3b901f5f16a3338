//! Ends of a run before its last load: stop rules, and a body that carries no load any more.

use super::path::Path;
use super::recorder::StepCounters;
use crate::balanced::{Attempt, Balanced};
use crate::breakage::Breakage;
use crate::error::SetupError;
use crate::history::{ObserverError, Termination};
use crate::load_program::{ControlKind, LoadCourse};
use crate::termination::Verdict;
use crate::unbalanced::Unbalanced;
use crate::user_message::Message;

/// Fraction of the peak load below which a body carries no load, only rounding.
pub(super) const NO_LOAD: f64 = 1e-9;

/// Error of a utilisation over the tolerance of an iterative solver: a body that hangs together by little has a condition of a thousand
/// between its forces and its strains.
const CONDITION: f64 = 1e3;

impl Path<'_> {
    /// Utilisation up to which a bond is not stretched but for rounding, or for what an iterative solver leaves.
    pub(super) fn negligible_utilisation(&self) -> f64 {
        let left = self.equilibrium.tolerance().unwrap_or_default();
        NO_LOAD.max(CONDITION * left)
    }

    /// Whether the load of an equilibrium is rounding relative to the largest load so far.
    pub(super) fn carries_nothing(&self, balanced: &Balanced) -> bool {
        if let Some(loads) = self.problem.loads.course() {
            return self.carries_no_programme_load(loads, balanced);
        }
        let (_, reaction) = self.control(balanced);
        reaction <= NO_LOAD * self.largest_load()
    }

    /// Largest load so far, N. For a body that breaks in its first load step, under a prescribed motion, the load of the intact
    /// body at that motion.
    fn largest_load(&self) -> f64 {
        let (loads, peak) = (&self.problem.loads, self.course.peak);
        if loads.control().kind == ControlKind::Force {
            return peak;
        }
        let given = loads.control_displacement(self.state.load_factor, &self.state.displacement);
        let whole = (self.course.elastic.stiffness * given).abs();
        if peak <= NO_LOAD * whole { whole } else { peak }
    }

    /// End of a run whose intact model is unstable, unless the problem allows that; the unloaded body is its only record.
    pub(super) fn end_if_unstable(&mut self) -> Result<Option<Termination>, SetupError> {
        let Some(end) = self.course.elastic.refused(&self.problem) else {
            return Ok(None);
        };
        self.enter(0, 0)?;
        if let Attempt::Balanced(unloaded) = self.balance(0, &Breakage::default())? {
            let counters = StepCounters {
                at_rest: true,
                ..Default::default()
            };
            self.record(&unloaded, counters, true)?;
        }
        Ok(Some(end))
    }

    /// Stop rule for broken bonds or wall time that applies at present.
    pub(super) fn interruption(&self) -> Option<Termination> {
        let mut seconds = [self.started.elapsed().as_secs_f64()];
        // All processes stop at the same time.
        if self.stop.wall_time.is_some() {
            let communicator = &self.problem.solver.communicator;
            communicator.all_reduce_max(&mut seconds);
        }
        let [seconds] = seconds;
        if let Some(bonds) = self.stop.bonds.filter(|&bonds| self.course.broken >= bonds) {
            return Some(Termination::BondsBroken { bonds });
        }
        let is_over = |&allowed: &f64| seconds >= allowed;
        (self.stop.wall_time.filter(is_over)).map(|seconds| Termination::WallTime { seconds })
    }

    /// Termination by a step without equilibrium: where bonds broke or softened, a load on an added support means that the body
    /// collapsed.
    pub(super) fn without_equilibrium(&self, step: usize, reason: Unbalanced) -> Termination {
        match reason {
            Unbalanced::LoadOnAddedSupport { place, force } if !self.is_whole() => {
                Termination::LostStiffness { step, place, force }
            }
            reason => Termination::NoEquilibrium { step, reason },
        }
    }

    /// Termination by an equilibrium without further breakage, at any load: displacement reached, or body fell apart.
    pub(super) fn end_at_rest(&self, balanced: &Balanced) -> Option<Termination> {
        let (displacement, _) = self.control(balanced);
        if let Some(displacement) = self
            .stop
            .displacement
            .filter(|&wanted| displacement >= wanted)
        {
            return Some(Termination::DisplacementReached { displacement });
        }
        let carried = self.load_of_damaged_body(balanced)?;
        // Separated parts may carry load again where their faces close.
        let is_over = !self.problem.may_press();
        let carries_nothing = match self.problem.loads.course() {
            None => carried <= NO_LOAD * self.largest_load(),
            Some(course) => self.carries_no_programme_load(course, balanced),
        };
        (is_over && carries_nothing).then_some(Termination::FellApart)
    }

    /// Whether no point of a body carries the loads of a programme that act on it.
    fn carries_no_programme_load(&self, course: &LoadCourse, balanced: &Balanced) -> bool {
        let factors = course.factors(self.state.load_factor);
        let acts = factors.iter().any(|factor| *factor != 0.0);
        // Where the first load step breaks the body, the largest force in any state counts instead of that at rest.
        let (at_rest, met) = (self.course.largest_force, self.equilibrium.largest_force());
        let largest = if at_rest <= NO_LOAD * met {
            met
        } else {
            at_rest
        };
        acts && balanced.internal.force_scale <= NO_LOAD * largest
    }

    /// Termination by a load below the stop fraction of the largest load so far, in an equilibrium without further breakage that
    /// could carry more.
    pub(super) fn end_by_load_fraction(&self, balanced: &Balanced) -> Option<Termination> {
        let carried = self.load_of_damaged_body(balanced)?;
        let fraction =
            (self.stop.load_fraction).filter(|&fraction| carried <= fraction * self.course.peak)?;
        Some(Termination::LoadFraction { fraction })
    }

    /// Load of an equilibrium in its own direction, N; None for a body without broken or softened bonds.
    fn load_of_damaged_body(&self, balanced: &Balanced) -> Option<f64> {
        // Softening reduces the load before any bond breaks.
        if self.course.broken == 0
            && (self.state.softening.remaining.is_empty() || self.course.peak == 0.0)
        {
            return None;
        }
        // A negative load has a negative reaction.
        let (_, reaction) = self.control(balanced);
        let factor = self.problem.loads.control_factor(self.state.load_factor);
        Some(if factor < 0.0 { -reaction } else { reaction })
    }

    /// Notifies the observer where a force exceeded the peak load of a body with broken or softened bonds, beyond which there is no
    /// equilibrium.
    pub(super) fn report_past_peak(&mut self, end: &Termination) -> Result<(), ObserverError> {
        let is_force = self.problem.loads.control().kind == ControlKind::Force;
        let verdict = end.row().verdict;
        let gave_way = matches!(verdict, Verdict::NoEquilibrium | Verdict::Breaking);
        if !is_force || self.is_whole() || !gave_way || self.is_controlled() {
            return Ok(());
        }
        let step = self.course.history.last().map_or(0, |it| it.step);
        let message = Message::new("past-peak", "there is no equilibrium at a larger force");
        let advice = "to follow the body past its peak, let a probe control a stage (its `control`), or follow the exact path";
        self.observer
            .message(message.in_step(step).with_advice(advice))
    }
}
