//! Exact equilibrium path from breakage to breakage.
//!
//! Between two breakages the body is linear, and the load factor at which the next bond reaches its limit is known in closed form:
//! in proportion to the load factor (`proportional`), or along the line A + w B of a part of a programme (`affine`). The bond
//! breaks at fixed load; the new equilibrium is in general not admissible at this load (or admissible beyond it), and the path
//! continues along its line to the next critical load factor, which may be lower. Where surfaces meet, the path is a chain of such
//! lines, each from one contact that opens or closes to the next (`in_contact`). The path thus includes snap-back without a step
//! size. A test under displacement control follows its envelope, [`super::Outcome::envelope`].

mod affine;
mod equilibrium_line;
mod in_contact;
mod proportional;
mod skipping;

use std::io::Read;
use std::mem;

use super::checkpoint::{Restored, RestoredRun, WayKind};
use super::delayed_updates::PartsOfBody;
use super::energies::Energies;
use super::prediction::{self, Prediction};
use super::prepared::Prepared;
use super::record::StepCounters;
use super::run::Run;
use super::way::{Outcome, Rows, Stop, StopRules, Way};
use crate::balanced::{Attempt, Balanced};
use crate::breakage::Breakage;
use crate::contact::LastTouching;
use crate::error::SetupError;
use crate::history::{Observer, StepRecord, Termination};
use crate::problem::Problem;
use crate::state::State;
use equilibrium_line::{EquilibriumLine, Event, Goal};
use skipping::Skipped;

/// Settings of the exact path, with its stop rules. The path ends at load factor one in any case, or with the last stage.
#[derive(Debug, Clone, PartialEq)]
pub struct EventSettings {
    /// Relative distance in s/s_0 from the largest within which bonds break together.
    pub tie_tolerance: f64,
    /// Relative change of the energy that ends Newton-Raphson (NHPD eq. 21).
    pub energy_tolerance: f64,
    /// Rules for a stop before load factor one.
    pub stop: StopRules,
}

/// Begins with the unloaded body, whose criteria must be brittle.
///
/// The history contains the unloaded body, then a record for each event: the state in which its bonds break, just before breakage.
/// The last record is the end of the run, without breakage.
///
/// # Errors
///
/// If the path cannot be followed ([`refuse`]), the equations cannot be set up, nothing resists the loads, or the observer fails.
pub fn begin<'a>(
    problem: &Problem,
    settings: &EventSettings,
    observer: &'a mut dyn Observer,
) -> Result<ExactPath<'a>, SetupError> {
    refuse(problem)?;
    let begun = Run::begin(problem, settings.energy_tolerance, settings.stop, observer)?;
    ExactPath::begun(begun, settings)
}

/// Follows the path from its beginning to the end of the run.
///
/// # Errors
///
/// As in [`begin`], or if the run fails.
pub fn run(
    problem: &Problem,
    settings: &EventSettings,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    Box::new(begin(problem, settings, observer)?).follow()
}

/// Follows the path of a problem that differs from the prepared one in its criteria, to the bits of [`run`].
///
/// # Errors
///
/// If the path cannot be followed, as in [`run`].
pub fn run_from(
    prepared: &Prepared,
    problem: &Problem,
    settings: &EventSettings,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    refuse(problem)?;
    let begun = prepared.begun(problem, settings.stop, observer)?;
    Box::new(ExactPath::begun(begun, settings)?).follow()
}

/// Predicts the first failure on the path.
///
/// # Errors
///
/// If the path cannot be followed, as in [`run`].
pub fn predict(
    problem: &Problem,
    settings: &EventSettings,
    observer: &mut dyn Observer,
) -> Result<Prediction, SetupError> {
    refuse(problem)?;
    let (run, at_one) = Run::begin(problem, settings.energy_tolerance, settings.stop, observer)?;
    if let Some(refused) = Prediction::refused(&run) {
        return Ok(refused);
    }
    run.require_resistance(at_one.as_ref())?;
    prediction::predict(run, at_one, None)
}

/// Refuses problems whose path is not made of straight lines.
///
/// # Errors
///
/// If bonds soften, or friction acts; in stages, also if crack faces or surfaces meet; in stages and with surfaces that meet, also if a
/// criterion has no closed form along a line.
pub fn refuse(problem: &Problem) -> Result<(), SetupError> {
    if problem.criteria.soften() {
        return Err(SetupError::Softening);
    }
    if problem.has_contact_at_rest()
        && (problem.face_friction > 0.0 || !problem.contact.is_linear())
    {
        return Err(SetupError::ContactOnExactPath);
    }
    let is_staged = problem.loads.course().is_some();
    if is_staged && problem.may_press() {
        return Err(SetupError::ClosingFaces);
    }
    let unknown = problem.criteria.unknown_along_lines();
    match unknown.filter(|_| is_staged || !problem.contact.is_empty()) {
        Some(criterion) => Err(SetupError::UnknownAlongLines {
            criterion: criterion.name,
        }),
        None => Ok(()),
    }
}

/// Restores a run from a checkpoint, to continue as if it had never stopped; the stop rules may differ from those before.
///
/// # Errors
///
/// If the checkpoint is damaged, or belongs to another problem or driver.
pub fn restore(
    problem: &Problem,
    settings: &EventSettings,
    checkpoint: &mut dyn Read,
) -> Result<Restored, SetupError> {
    let with = (problem, settings.energy_tolerance);
    let step = |(step, _): &ToEvent| (*step > 0).then_some(*step);
    let restored = RestoredRun::of_equilibria(WayKind::ExactPath, with, checkpoint, step)?;
    let settings = settings.clone();
    Ok(Restored::new(restored, move |restored, observer| {
        let (run, line, (step, growth)) = Run::go_on(settings.stop, restored, observer);
        Box::new(ExactPath::new(run, &settings, (step, line), growth))
    }))
}

/// Position before an event: its number, and the rate of the displacements with the load factor, shape (n_degrees_of_freedom); empty where they are
/// proportional to it.
type ToEvent = (usize, Vec<f64>);

/// Run along the exact path.
pub struct ExactPath<'a> {
    run: Run<'a>,
    /// Number of the next event.
    step: usize,
    /// Equilibrium on the line to it.
    line: Balanced,
    /// What finds the end of the line.
    goals: Box<dyn EquilibriumLine>,
    tie_tolerance: f64,
    parts: PartsOfBody,
    /// Reason why the run ended before its first event.
    ended: Option<Termination>,
}

/// State before a move along a line.
struct Before {
    load_factor: f64,
    displacement: Vec<f64>,
    surfaces: LastTouching,
    energies: Energies,
}

impl Before {
    fn new(run: &Run<'_>) -> Self {
        Self {
            load_factor: run.state.load_factor,
            displacement: run.state.displacement.clone(),
            surfaces: run.state.surfaces.clone(),
            energies: run.energies.clone(),
        }
    }

    /// Exchanges the stored state and the present one.
    fn swap(&mut self, run: &mut Run<'_>) {
        mem::swap(&mut self.load_factor, &mut run.state.load_factor);
        mem::swap(&mut self.displacement, &mut run.state.displacement);
        mem::swap(&mut self.surfaces, &mut run.state.surfaces);
        mem::swap(&mut self.energies, &mut run.energies);
    }
}

impl<'a> ExactPath<'a> {
    /// The path from the unloaded body; with its equilibrium at load factor one, if there is one.
    fn begun(
        (mut run, at_one): (Run<'a>, Option<State>),
        settings: &EventSettings,
    ) -> Result<Self, SetupError> {
        let unloaded = Balanced::unloaded(&*run.problem.system);
        let line = match run.end_if_unstable()? {
            Some(end) => Err(Stop::End(end)),
            None => first_line(&mut run, at_one),
        };
        let (line, ended) = match line {
            Ok(line) => (line, None),
            Err(Stop::End(end)) => (unloaded, Some(end)),
            Err(Stop::Failed(error)) => return Err(error),
        };
        let path = Self::new(run, settings, (1, line), Vec::new());
        Ok(Self { ended, ..path })
    }

    /// The path from an equilibrium on the line to an event of this number.
    fn new(
        run: Run<'a>,
        settings: &EventSettings,
        (step, line): (usize, Balanced),
        growth: Vec<f64>,
    ) -> Self {
        let loads = &*run.problem.loads;
        let choice = run.equations.choice();
        let tie_tolerance = choice.tie_tolerance(settings.tie_tolerance);
        let goals: Box<dyn EquilibriumLine> = match loads.course() {
            Some(_) => Box::new(affine::Affine::new(tie_tolerance, growth)),
            None if !run.problem.contact.is_empty() => {
                Box::new(in_contact::InContact::new(tie_tolerance, growth))
            }
            None => Box::new(proportional::Proportional::new(tie_tolerance, loads)),
        };
        Self {
            run,
            step,
            line,
            goals,
            tie_tolerance,
            parts: PartsOfBody::default(),
            ended: None,
        }
    }
}

impl Way for ExactPath<'_> {
    fn advance(&mut self) -> Result<(), Stop> {
        if let Some(end) = self.ended.take() {
            return Err(Stop::End(end));
        }
        let (critical, breakage) = match self.pass()? {
            Some(broken) => broken,
            None => self.break_at_end_of_line()?,
        };
        if self.run.collapsed {
            let end = Termination::Collapsed;
            return Err(end_of(&mut self.run, self.step + 1, &critical, end));
        }
        self.line = match self.run.next_equilibrium([self.step, 1], &breakage) {
            Err(Stop::End(end)) => {
                return Err(end_of(&mut self.run, self.step + 1, &critical, end));
            }
            line => line?,
        };
        self.step += 1;
        // Contacts may carry what the bonds do not.
        if self.run.problem.contact.is_empty() && self.run.carries_nothing(&self.line) {
            return Err(self.end(Termination::FellApart));
        }
        Ok(())
    }

    fn now(&self) -> (&State, &[StepRecord]) {
        self.run.now()
    }

    fn outcome(self: Box<Self>, end: Termination) -> Result<Outcome, SetupError> {
        Ok(self.run.into_outcome(end, Rows::Events))
    }
}

impl ExactPath<'_> {
    /// Skips events for which nobody needs the whole body; returns a breakage that cannot be applied to delayed parts, with the equilibrium
    /// before it.
    fn pass(&mut self) -> Result<Option<(Balanced, Breakage)>, Stop> {
        if !skipping::may_skip(&self.run, self.step) {
            return Ok(None);
        }
        let Some(body) = self.parts.body(&self.run) else {
            return Ok(None);
        };
        let (run, tie, step) = (&mut self.run, self.tie_tolerance, &mut self.step);
        match skipping::skip(run, &body, tie, step, &self.line)? {
            Skipped::Broke(critical, breakage) => return Ok(Some((critical, breakage))),
            Skipped::Line(Attempt::Balanced(line)) => self.line = line,
            Skipped::Line(Attempt::Unbalanced(reason)) => {
                let end = self.run.without_equilibrium(self.step, reason);
                return Err(self.end(end));
            }
            Skipped::Nothing => return Ok(None),
        }
        match self.run.carries_nothing(&self.line) {
            true => Err(self.end(Termination::FellApart)),
            false => Ok(None),
        }
    }

    /// Follows lines to the next event at which bonds break, and breaks them; returns the critical equilibrium and the breakage.
    fn break_at_end_of_line(&mut self) -> Result<(Balanced, Breakage), Stop> {
        loop {
            let goal = match self.goals.goal(&mut self.run, &self.line) {
                Ok(goal) => goal,
                Err(reason) => {
                    let end = self.run.without_equilibrium(self.step, reason);
                    return Err(self.end(end));
                }
            };
            let before = Before::new(&self.run);
            let critical = (self.goals).follow(&mut self.run, &self.line, goal.load_factor);
            self.run
                .account(self.step, &Breakage::default(), &critical)?;
            if goal.event == Event::ContactChangesBeyond {
                self.line = critical;
                continue;
            }
            let missed = (self.run.equations).missed(&self.run.state, &critical);
            let missed = missed.map(|reason| self.run.without_equilibrium(self.step, reason));
            let end = missed
                .or(goal.end.clone())
                .or_else(|| self.run.interruption())
                .or_else(|| self.run.end_at_rest(&critical))
                .or_else(|| self.run.end_by_load_fraction(&critical));
            let end = self.offer(before, end)?;
            self.record(&goal, &critical, end.is_some())?;
            if let Some(end) = end {
                return Err(Stop::End(end));
            }
            match goal.event {
                Event::Breakage => {
                    let at = [self.step, 1];
                    let breakage = self.run.break_bonds(&goal.bonds, &critical, at)?;
                    return Ok((critical, breakage));
                }
                Event::PartEnds => self.run.begin_part(self.run.progress.part + 1),
                Event::ContactChanges | Event::ContactChangesBeyond => {}
            }
            self.line = critical;
            self.step += 1;
        }
    }

    /// Records the state at the end of a line.
    fn record(
        &mut self,
        goal: &Goal,
        critical: &Balanced,
        is_last: bool,
    ) -> Result<(), SetupError> {
        self.run.enter(self.step, 0)?;
        let breaks = usize::from(!is_last && goal.event == Event::Breakage);
        let counters = StepCounters {
            step: self.step,
            broken_in_step: breaks * goal.bonds.len(),
            rounds: breaks,
            at_rest: !goal.is_held,
            largest_ratio: goal.ratio,
            ..Default::default()
        };
        self.run.record(critical, counters, is_last)
    }

    /// Offers the state before the move along the line to the observer, once it is known whether the run ends there.
    fn offer(
        &mut self,
        mut before: Before,
        end: Option<Termination>,
    ) -> Result<Option<Termination>, SetupError> {
        before.swap(&mut self.run);
        let position = (WayKind::ExactPath, &(self.step, self.goals.growth()));
        let end = self.run.offer(position, &self.line, end)?;
        before.swap(&mut self.run);
        Ok(end)
    }

    /// Ends the run with a last record of the line.
    fn end(&mut self, end: Termination) -> Stop {
        end_of(&mut self.run, self.step, &self.line, end)
    }
}

/// Records the unloaded body, and finds the equilibrium on the line to the first event.
fn first_line(run: &mut Run<'_>, at_one: Option<State>) -> Result<Balanced, Stop> {
    run.require_resistance(at_one.as_ref())?;
    let is_staged = run.problem.loads.course().is_some();
    let begins_unloaded = is_staged || !run.problem.contact.is_empty();
    let nothing = Breakage::default();
    let balance = |run: &mut Run<'_>, step| match run.balance(step, &nothing)? {
        Attempt::Balanced(balanced) => Ok(balanced),
        Attempt::Unbalanced(reason) => Err(Stop::End(Termination::NoEquilibrium { step, reason })),
    };
    let unloaded = balance(run, 0)?;
    let counters = StepCounters {
        at_rest: true,
        ..Default::default()
    };
    run.record(&unloaded, counters, false)?;
    // A missing equilibrium at load factor one is reported by the first event, with its reason.
    match at_one.filter(|_| !begins_unloaded) {
        Some(at_one) => run.state = at_one,
        None if begins_unloaded => {}
        None => run.state.load_factor = 1.0,
    }
    run.enter(1, 0)?;
    balance(run, 1)
}

/// Ends a run with a last record after a breakage; at rest only where the body fell apart.
fn end_of(run: &mut Run<'_>, step: usize, last: &Balanced, end: Termination) -> Stop {
    let counters = StepCounters {
        step,
        at_rest: end == Termination::FellApart,
        largest_ratio: run.problem.largest_ratio(&run.state, last),
        ..Default::default()
    };
    match run.record(last, counters, true) {
        Ok(()) => Stop::End(end),
        Err(error) => Stop::Failed(error),
    }
}
