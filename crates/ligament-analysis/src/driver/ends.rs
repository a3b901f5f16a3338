//! What ends a run on its way: rules, and a body that carries no load any more.

use super::path::Path;
use crate::balanced::Balanced;
use crate::history::{Notice, ObserverError, Termination};
use crate::load_program::{ControlKind, LoadCourse};
use crate::unbalanced::Unbalanced;

/// Below this fraction of the peak a body carries no load any more: what is left is rounding.
pub(super) const NO_LOAD: f64 = 1e-9;

impl Path<'_> {
    /// Whether the load of an equilibrium is rounding against the largest so far.
    pub(super) fn carries_nothing(&self, balanced: &Balanced) -> bool {
        if let Some(loads) = self.problem.loads.course() {
            return self.carries_no_programme_load(loads, balanced);
        }
        let (_, reaction) = self.control(balanced);
        reaction <= NO_LOAD * self.largest_load()
    }

    /// The largest load so far, N. A body whose first load step breaks it was at rest under none: then the load counts that it would carry
    /// whole, where a motion gives it.
    fn largest_load(&self) -> f64 {
        let (loads, peak) = (&self.problem.loads, self.course.peak);
        if loads.control().kind == ControlKind::Force {
            return peak;
        }
        let given = loads.control_displacement(self.state.load_factor, &self.state.displacement);
        let whole = (self.course.elastic.stiffness * given).abs();
        if peak <= NO_LOAD * whole { whole } else { peak }
    }

    /// The rule that ends the run wherever it is, if one does.
    pub(super) fn interruption(&self) -> Option<Termination> {
        let mut seconds = [self.started.elapsed().as_secs_f64()];
        // All processes stop at the same time, or none does.
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

    /// The end of a run in a step without equilibrium: where bonds broke, or softened, holds that would have to carry a load tell
    /// that the body collapsed under it.
    pub(super) fn without_equilibrium(&self, step: usize, reason: Unbalanced) -> Termination {
        match reason {
            Unbalanced::LoadOnAddedSupport { place, force } if !self.is_whole() => {
                Termination::LostStiffness { step, place, force }
            }
            reason => Termination::NoEquilibrium { step, reason },
        }
    }

    /// What ends the run with an equilibrium that is at rest, however far the body is loaded.
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
        // What fell apart carries again where its faces close.
        let is_over = !self.problem.system.faces_close();
        let carries_nothing = match self.problem.loads.course() {
            None => carried <= NO_LOAD * self.largest_load(),
            Some(course) => self.carries_no_programme_load(course, balanced),
        };
        (is_over && carries_nothing).then_some(Termination::FellApart)
    }

    /// Whether no point of a body carries anything of the loads of a programme that act on it.
    fn carries_no_programme_load(&self, course: &LoadCourse, balanced: &Balanced) -> bool {
        let factors = course.factors(self.state.load_factor);
        let acts = factors.iter().any(|factor| *factor != 0.0);
        // As with one load: what its first load step breaks was at rest under nothing.
        let (at_rest, met) = (self.course.largest_force, self.equilibrium.largest_force());
        let largest = if at_rest <= NO_LOAD * met {
            met
        } else {
            at_rest
        };
        acts && balanced.internal.force_scale <= NO_LOAD * largest
    }

    /// The end of a run whose body carries only a fraction of the largest load so far, in an equilibrium at rest in which it
    /// could carry more.
    pub(super) fn end_by_load_fraction(&self, balanced: &Balanced) -> Option<Termination> {
        let carried = self.load_of_damaged_body(balanced)?;
        let fraction =
            (self.stop.load_fraction).filter(|&fraction| carried <= fraction * self.course.peak)?;
        Some(Termination::LoadFraction { fraction })
    }

    /// The load in an equilibrium, in its own direction, of a body of which bonds broke or softened, N.
    fn load_of_damaged_body(&self, balanced: &Balanced) -> Option<f64> {
        // Bonds that soften take load away before any breaks.
        if self.course.broken == 0
            && (self.state.softening.remaining.is_empty() || self.course.peak == 0.0)
        {
            return None;
        }
        // A load the other way is carried the other way.
        let (_, reaction) = self.control(balanced);
        let factor = self.problem.loads.control_factor(self.state.load_factor);
        Some(if factor < 0.0 { -reaction } else { reaction })
    }

    /// Tells of a way on where a force has passed what a body of which bonds broke or softened carries: a larger one has no equilibrium.
    pub(super) fn report_past_peak(&mut self, end: &Termination) -> Result<(), ObserverError> {
        let is_force = self.problem.loads.control().kind == ControlKind::Force;
        let gave_way = matches!(
            end,
            Termination::NoEquilibrium { .. }
                | Termination::NotAtRest { .. }
                | Termination::Collapsed
                | Termination::LostStiffness { .. }
        );
        if !is_force || self.is_whole() || !gave_way || self.is_controlled() {
            return Ok(());
        }
        let step = self.course.history.last().map_or(0, |it| it.step);
        self.observer.notice(&Notice::PastPeak { step })
    }
}
