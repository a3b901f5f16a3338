//! A run: the body in its present state with its equations and its record, as all ways through a loading use it.
//!
//! A `Run` breaks bonds, makes records, offers itself for checkpoints and applies stop rules; a run of equilibria computes them with their
//! energies, fixes detached parts and begins the parts of a programme.

use std::cell::Cell;
use std::time::Instant;

use ligament_model::element::BondDeformation;
use ligament_model::failure::CriteriaInState;
use serde::Serialize;

use super::breaks::{self, Breaking, Judged};
use super::checkpoint::{CheckValues, Progress, RestoredRun, WayKind};
use super::energies::Energies;
use super::equations::Equations;
use super::record::{ElasticAnswer, StepCounters, step_record};
use super::run_messages;
use super::start::{Start, begin};
use super::way::{Outcome, Rows, Stop, StopRules};
use crate::balanced::{Attempt, Balanced};
use crate::bond_numbers::sum_over_bonds;
use crate::breakage::Breakage;
use crate::breaking::{FirstToBreak, first_of_all};
use crate::connectivity::AddedSupport;
use crate::equilibrium::{ControlledQuantity, Dissipation, Equilibrium, Target};
use crate::error::SetupError;
use crate::history::{
    BreakRecord, Moment, Observer, ObserverError, Onward, Rates, StepRecord, Termination, View,
};
use crate::internal::InternalForces;
use crate::load_program::{ControlKind, LoadCourse, PartControl};
use crate::problem::Problem;
use crate::result_fields::Solution as BalancedState;
use crate::serial::{self, Serial, Sink};
use crate::softened::SoftenedOfAll;
use crate::softening::Softening;
use crate::state::{Solution, State};
use crate::termination::Verdict;
use crate::unbalanced::Unbalanced;
use crate::user_message::Message;

/// Method of an observer that takes a record and the state of the body.
type ObserverMethod = fn(&mut dyn Observer, &StepRecord, &View<'_>) -> Result<(), ObserverError>;

/// A run: the body in its present state, with its equations, its energies and its record.
///
/// A [`Way`](super::Way) through a load program is made from its steps: an equilibrium, which bonds break in it, a record. Load steps, the exact
/// path, elastic solutions and motions are ways of a run; explicit steps have equations `E` of their own, which solve nothing.
pub struct Run<'a, E = Equilibrium> {
    /// Problem with the loads of the present part of its programme.
    pub(super) problem: Problem,
    pub(super) observer: &'a mut dyn Observer,
    pub(super) equations: E,
    pub(super) state: State,
    pub(super) energies: Energies,
    pub(super) progress: Progress,
    /// Whether a given force acts on a detached part.
    pub(super) collapsed: bool,
    pub(super) stop: StopRules,
    pub(super) started: Instant,
}

impl<'a, E> Run<'a, E> {
    /// A run at the beginning of its loading, with what an elastic solution told.
    pub(super) fn new(
        problem: &Problem,
        (equations, state): (E, State),
        elastic: ElasticAnswer,
        stop: StopRules,
        observer: &'a mut dyn Observer,
    ) -> Self {
        Self {
            problem: problem.clone(),
            observer,
            equations,
            state,
            energies: Energies::unloaded(problem),
            progress: Progress::new(problem, elastic),
            collapsed: false,
            stop,
            started: Instant::now(),
        }
    }

    /// Continues from a checkpoint; also returns the balanced state, and where the run stands on its way.
    pub(super) fn go_on<P>(
        stop: StopRules,
        restored: RestoredRun<P, E>,
        observer: &'a mut dyn Observer,
    ) -> (Self, Balanced, P) {
        let run = Self {
            problem: restored.problem,
            observer,
            equations: restored.equations,
            state: restored.state,
            energies: restored.energies,
            progress: restored.progress,
            collapsed: false,
            stop,
            started: Instant::now(),
        };
        (run, restored.balanced, restored.position)
    }

    /// The present state of the body, and the records so far.
    pub fn now(&self) -> (&State, &[StepRecord]) {
        (&self.state, &self.progress.history)
    }

    /// Notifies the observer of the next step and round.
    pub(super) fn enter(&mut self, step: usize, round: usize) -> Result<(), ObserverError> {
        let load_factor = self.state.load_factor;
        self.observer
            .round(step, round, load_factor, self.progress.broken)
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
        if let Some(bonds) = self
            .stop
            .bonds
            .filter(|&bonds| self.progress.broken >= bonds)
        {
            return Some(Termination::BondsBroken { bonds });
        }
        let is_over = |&allowed: &f64| seconds >= allowed;
        (self.stop.wall_time.filter(is_over)).map(|seconds| Termination::WallTime { seconds })
    }
}

impl<E: Equations> Run<'_, E> {
    /// Breaks bonds by criteria and their deformations, by their index among the bonds and their local number, in a state with these internal
    /// forces, in a step and a round; the equations do not know of it yet.
    pub(super) fn break_in_state(
        &mut self,
        bonds: &[u32],
        (criteria, deformation): Judged<'_>,
        internal: &InternalForces,
        at: [usize; 2],
    ) -> Result<(), ObserverError> {
        let [step, round] = at;
        let breaking = Breaking {
            problem: &self.problem,
            numbers: self.equations.numbers(),
            criteria,
            deformation,
            moment: BreakRecord {
                order: self.progress.broken,
                step,
                round,
                ..BreakRecord::default()
            },
        };
        let records = breaking.apply(&mut self.state, internal, bonds);
        self.progress.broken += bonds.len();
        self.observer.broke(&records)
    }

    /// Offers the present balanced state, whose energies are counted, to the observer as one from which the run can continue, with its position on
    /// a way of this kind. Returns the reason why the run ends there: `end`, or a stop by the observer. Collective.
    pub(super) fn offer<P: Serialize>(
        &mut self,
        (kind, position): (WayKind, &P),
        balanced: &Balanced,
        end: Option<Termination>,
    ) -> Result<Option<Termination>, ObserverError> {
        let Self {
            observer,
            equations,
            state,
            energies,
            progress,
            problem,
            ..
        } = self;
        let numbers = equations.numbers();
        let asked = observer.asks(end.as_ref())?;
        let has_taken_part = Cell::new(false);
        let checkpoint = |out: &mut dyn Sink| {
            has_taken_part.set(true);
            serial::write(&(kind, position), out);
            state.write(numbers, out);
            progress.write(out);
            equations.write(out);
            energies.write(out);
            CheckValues::new(problem, balanced).write(out);
        };
        let all_take_part = numbers.subdomain().any(asked) && !numbers.subdomain().is_whole();
        let moment = Moment {
            end: end.as_ref(),
            checkpoint: &checkpoint,
        };
        let onward = observer.moment(&moment)?;
        if all_take_part && !has_taken_part.get() {
            checkpoint(&mut ());
        }
        Ok(end.or_else(|| (onward == Onward::Stop).then_some(Termination::Stopped)))
    }

    /// Record of the present balanced state, with its rates in a motion.
    pub(super) fn row(
        &self,
        (balanced, rates): (&Balanced, Option<Rates<'_>>),
        counters: StepCounters,
    ) -> StepRecord {
        let solution = BalancedState {
            motion: rates,
            ..self.problem.solution(&self.state, balanced)
        };
        let fragments = self.equations.fragments();
        step_record(&self.problem, solution, &self.energies, fragments, counters)
    }

    /// Passes the present balanced state with its record to a method of the observer; without `is_whole` displacements are known at supported
    /// and loaded points alone. Collective.
    fn show(
        &mut self,
        record: &StepRecord,
        (balanced, rates): (&Balanced, Option<Rates<'_>>),
        shown: [bool; 2],
        method: ObserverMethod,
    ) -> Result<(), ObserverError> {
        let [is_last, is_whole] = shown;
        let softened = self.softened();
        let Self {
            problem,
            observer,
            equations,
            state,
            ..
        } = self;
        let criteria = problem.criteria_in(state, balanced);
        let view = View {
            softened,
            system: &*problem.system,
            state,
            balanced,
            loads: &*problem.loads,
            criteria: &criteria,
            fragments: equations.fragments(),
            costs: equations.costs(),
            motion: rates,
            is_last,
            is_whole,
        };
        method(*observer, record, &view)
    }

    /// Adds a record to the history, passes it to the observer and tells what is wrong with it; without `is_whole` displacements are known at
    /// supported and loaded points alone.
    pub(super) fn push(
        &mut self,
        record: StepRecord,
        (balanced, rates): (&Balanced, Option<Rates<'_>>),
        [is_last, is_whole]: [bool; 2],
    ) -> Result<(), ObserverError> {
        let method: ObserverMethod = |observer, record, view| observer.step(record, view);
        self.show(&record, (balanced, rates), [is_last, is_whole], method)?;
        let Self {
            problem,
            observer,
            equations,
            state,
            progress,
            ..
        } = self;
        let fragments = equations.fragments();
        let (step, is_moving) = (record.step, rates.is_some());
        let mut messages = Vec::new();
        if is_whole && (record.at_rest || !is_moving) {
            let largest = &mut progress.overlap;
            messages.push(run_messages::overlap(
                problem, state, fragments, step, largest,
            ));
        }
        if is_moving && !progress.has_turned {
            let turned = run_messages::turned(problem, state, fragments, step);
            progress.has_turned = turned.is_some();
            messages.push(turned);
        }
        let history = &mut progress.history;
        messages.push(run_messages::energies(problem, &record, history.last()));
        if !is_moving {
            messages.push(run_messages::dissipation(&record, history));
        }
        for message in messages.into_iter().flatten() {
            observer.message(message)?;
        }
        history.push(record);
        Ok(())
    }

    /// Numbers of softened bonds in the present state. Collective.
    fn softened(&self) -> SoftenedOfAll {
        let ends = &self.problem.system.ends;
        SoftenedOfAll::in_state(&self.state, self.equations.numbers(), ends)
    }

    /// Result of the run.
    pub fn into_outcome(self, termination: Termination, rows: Rows) -> Outcome {
        Outcome {
            broken_bonds: self.progress.broken,
            softened_bonds: self.softened().bonds,
            history: self.progress.history,
            rows,
            termination,
            elastic_stiffness: self.progress.elastic.stiffness,
            first_break: self.progress.elastic.first_break,
            overlap: self.progress.overlap,
            stability: self.progress.elastic.stability,
            costs: *self.equations.costs(),
            solver: self.equations.choice(),
            state: self.state,
        }
    }
}

impl<'a> Run<'a> {
    /// Begins with the unloaded body; also returns the equilibrium at load factor one, if there is one. Bonds break at their limits until the run
    /// [softens](Self::soften).
    ///
    /// # Errors
    ///
    /// If the equations cannot be set up, or the observer fails.
    pub fn begin(
        problem: &Problem,
        energy_tolerance: f64,
        stop: StopRules,
        observer: &'a mut dyn Observer,
    ) -> Result<(Self, Option<State>), SetupError> {
        let mut equilibrium = Equilibrium::new(problem, energy_tolerance)?;
        let start = begin(problem, &mut equilibrium, observer)?;
        Ok(Self::begun(problem, (equilibrium, start), stop, observer))
    }

    /// Begins with the unloaded body of a start and the equations after it; also returns the equilibrium at load factor one, if there is
    /// one.
    pub(super) fn begun(
        problem: &Problem,
        (equilibrium, start): (Equilibrium, Start),
        stop: StopRules,
        observer: &'a mut dyn Observer,
    ) -> (Self, Option<State>) {
        let Start {
            unloaded,
            elastic,
            at_one,
            ..
        } = start;
        let solves = [equilibrium.costs().solves; 2];
        let mut run = Self::new(problem, (equilibrium, unloaded), elastic, stop, observer);
        run.progress.solves = solves;
        (run, at_one)
    }

    /// Sets the load factor of the next equilibrium.
    pub fn set_load_factor(&mut self, load_factor: f64) {
        self.state.load_factor = load_factor;
    }

    /// Refuses loads that cause no deformation; `at_one` is the equilibrium at load factor one, if there is one.
    pub(super) fn require_resistance(&self, at_one: Option<&State>) -> Result<(), SetupError> {
        // Parts that the full load separates may be pressed together by a smaller load.
        let may_press = self.problem.may_press();
        if at_one.is_some() && self.progress.elastic.stiffness.is_nan() && !may_press {
            return Err(SetupError::NothingResists);
        }
        Ok(())
    }

    /// Enables softening from here on, if the criteria soften.
    pub fn soften(&mut self) {
        let n_bonds = self.problem.system.ends.len();
        self.state.softening = Softening::of_sound_bonds(&self.problem.criteria, n_bonds);
        self.equations.soften();
    }

    /// Equilibrium of the state after the last breakage; a negative energy is no equilibrium if the stop rules refuse it. Without
    /// an equilibrium the state stays unchanged.
    pub(super) fn balance(
        &mut self,
        step: usize,
        breakage: &Breakage,
    ) -> Result<Attempt, SetupError> {
        let before = self.state.solution();
        let mut attempt = self.held_balance(breakage, &before)?;
        let mut is_negative = false;
        if let Attempt::Balanced(Balanced {
            negative_energy: Some(energy),
            ..
        }) = attempt
        {
            is_negative = true;
            if self.stop.negative_energy {
                attempt = Attempt::Unbalanced(Unbalanced::NegativeEnergy { energy });
            }
        }
        if let Attempt::Unbalanced(_) = attempt {
            self.state.return_to(before);
            return Ok(attempt);
        }
        if is_negative && !std::mem::replace(&mut self.progress.energy_was_negative, true) {
            let text = "the stored energy is negative: from here on the body is unstable and the results are not valid";
            let message = Message::new("negative-energy", text);
            self.observer.message(message.in_step(step))?;
        }
        self.progress.solves[0] = self.equations.costs().solves;
        self.progress.negative_eigenvalues = self.equations.negative_eigenvalues();
        Ok(attempt)
    }

    /// The equilibrium of a step and a round after a breakage, with its energies accounted for.
    ///
    /// # Errors
    ///
    /// If there is none, which ends the run, or the observer fails.
    pub fn next_equilibrium(
        &mut self,
        [step, round]: [usize; 2],
        breakage: &Breakage,
    ) -> Result<Balanced, Stop> {
        self.enter(step, round)?;
        match self.balance(step, breakage)? {
            Attempt::Balanced(balanced) => {
                self.account(step, breakage, &balanced)?;
                Ok(balanced)
            }
            Attempt::Unbalanced(reason) => Err(Stop::End(self.without_equilibrium(step, reason))),
        }
    }

    /// Equilibrium of the state after the last breakage. Where a body with broken bonds moves beyond its size, supports that were added
    /// for vanishing pivots may be where the motion without stiffness is small: it gets its support where it is largest, before
    /// others are added, and the reaction there decides whether the body bears its load.
    fn held_balance(
        &mut self,
        breakage: &Breakage,
        before: &Solution,
    ) -> Result<Attempt, SetupError> {
        let held = self.state.held.clone();
        let mut farthest = Vec::new();
        loop {
            let attempt = (self.equations).balance(&mut self.state, breakage, self.observer)?;
            let Attempt::Balanced(mut balanced) = attempt else {
                return Ok(attempt);
            };
            let beyond = if self.is_whole() {
                None
            } else {
                self.equations.beyond_size(&self.state)
            };
            let Some(beyond) = beyond else {
                let layout = self.problem.system.layout;
                let points = farthest.into_iter().map(|dof| layout.point(dof));
                balanced.mechanisms.extend(points);
                return Ok(Attempt::Balanced(balanced));
            };
            farthest.push(beyond);
            self.state.return_to(before.clone());
            self.state.held.clone_from(&held);
            self.equations.hold(&mut self.state, &farthest);
        }
    }

    /// Whether no bond has broken or softened in this run.
    pub(super) fn is_whole(&self) -> bool {
        self.progress.broken == 0 && self.state.softening.remaining.is_empty()
    }

    /// Adds the work and the released energy up to an equilibrium after a breakage, and reports mechanisms.
    ///
    /// # Errors
    ///
    /// If the observer fails.
    pub fn account(
        &mut self,
        step: usize,
        breakage: &Breakage,
        balanced: &Balanced,
    ) -> Result<(), SetupError> {
        let at = (&self.state, balanced);
        self.energies.account(&self.problem, at, breakage);
        (self.energies).add_contact(&self.problem, &self.state, breakage, balanced);
        breaks::soften(&self.problem, &mut self.state);
        if let Some(message) = run_messages::mechanisms(balanced) {
            self.observer.message(message.in_step(step))?;
        }
        Ok(())
    }

    /// Bonds that break first under proportional loading, at deformations (n_bonds).
    pub fn first_to_break(
        &self,
        tie_tolerance: f64,
        deformations: &[BondDeformation],
        criteria: &CriteriaInState<'_>,
    ) -> FirstToBreak {
        let (intact, system) = (&self.state.intact, &self.problem.system);
        let in_file = |bond| system.ends_in_file(bond);
        first_of_all(
            self.equations.numbers(),
            tie_tolerance,
            deformations,
            criteria,
            intact,
            in_file,
        )
    }

    /// Breaks bonds of an equilibrium in a step and a round (from 1), and fixes detached parts.
    ///
    /// # Errors
    ///
    /// If the observer fails.
    pub fn break_bonds(
        &mut self,
        bonds: &[u32],
        balanced: &Balanced,
        at: [usize; 2],
    ) -> Result<Breakage, SetupError> {
        let problem = self.problem.clone();
        let criteria = problem.criteria_in(&self.state, balanced);
        let deformation = |_, bond: usize| balanced.deformations[bond];
        let judged = (&criteria, &deformation as &dyn Fn(usize, usize) -> _);
        self.break_deformed(bonds, judged, &balanced.internal, at)
    }

    /// Breaks bonds by criteria and their deformations, in an equilibrium with these internal forces, in a step and a round,
    /// and fixes detached parts.
    pub(super) fn break_deformed(
        &mut self,
        bonds: &[u32],
        judged: Judged<'_>,
        internal: &InternalForces,
        at: [usize; 2],
    ) -> Result<Breakage, SetupError> {
        self.break_in_state(bonds, judged, internal, at)?;
        let [step, _] = at;
        let breakage = self.equations.break_bonds(&mut self.state, bonds);
        // Where faces close, a detached part may be pressed against others, which the equilibrium decides.
        let may_press = self.problem.may_press();
        self.collapsed |= !may_press && self.loaded_part_is_detached(&breakage.holds);
        let fragments = self.equations.fragments();
        if let Some(message) = run_messages::detached_parts(fragments, &breakage.holds) {
            self.observer.message(message.in_step(step))?;
        }
        Ok(breakage)
    }

    /// Criteria with the limits and measures of the bonds in an equilibrium.
    pub fn criteria(&self, balanced: &Balanced) -> CriteriaInState<'_> {
        self.problem.criteria_in(&self.state, balanced)
    }

    fn loaded_part_is_detached(&self, holds: &[AddedSupport]) -> bool {
        let control = self.problem.loads.control();
        let of_point = &self.equations.fragments().of_point;
        control.kind == ControlKind::Force
            && control.points.iter().any(|&point| {
                holds
                    .iter()
                    .any(|hold| hold.fragment == of_point[point as usize])
            })
    }

    /// Records an equilibrium; the run itself counts broken bonds, solves and negative eigenvalues.
    ///
    /// # Errors
    ///
    /// If the observer fails.
    pub fn record(
        &mut self,
        balanced: &Balanced,
        counters: StepCounters,
        is_last: bool,
    ) -> Result<(), SetupError> {
        self.record_shown(balanced, counters, [is_last, true])
    }

    /// Records an equilibrium that is known only at supported and loaded points.
    pub(super) fn record_observed_points(
        &mut self,
        balanced: &Balanced,
        counters: StepCounters,
    ) -> Result<(), SetupError> {
        self.record_shown(balanced, counters, [false, false])
    }

    /// Whether an observer reads the equilibrium of a step in which so many bonds broke, before others break. Collective.
    pub(super) fn is_seen_between_breakages(
        &mut self,
        step: usize,
        broken: usize,
    ) -> Result<bool, ObserverError> {
        let is_seen = self.observer.looks_between_breakages(step, broken)?;
        Ok(self.problem.system.subdomain.any(is_seen))
    }

    /// Shows the observer an equilibrium between the breakages of a step.
    pub(super) fn show_between_breakages(
        &mut self,
        balanced: &Balanced,
        counters: StepCounters,
    ) -> Result<(), ObserverError> {
        let record = self.counted_row(balanced, counters);
        self.show(
            &record,
            (balanced, None),
            [false, true],
            |observer, record, view| observer.between_breakages(record, view),
        )
    }

    /// Record of an equilibrium with the numbers of broken bonds, solves and negative eigenvalues that the run counts.
    fn counted_row(&self, balanced: &Balanced, counters: StepCounters) -> StepRecord {
        let Progress {
            broken,
            solves: [last, recorded],
            negative_eigenvalues,
            ..
        } = self.progress;
        let counters = StepCounters {
            broken,
            solves: last - recorded,
            negative_eigenvalues,
            ..counters
        };
        self.row((balanced, None), counters)
    }

    fn record_shown(
        &mut self,
        balanced: &Balanced,
        counters: StepCounters,
        shown: [bool; 2],
    ) -> Result<(), SetupError> {
        let record = self.counted_row(balanced, counters);
        let progress = &mut self.progress;
        progress.solves[1] = self.equations.costs().solves;
        progress.peak = progress.peak.max(record.reaction);
        progress.largest_force = progress.largest_force.max(balanced.internal.force_scale);
        self.push(record, (balanced, None), shown)?;
        Ok(())
    }
}

impl Run<'_> {
    /// Begins the part of this index of a programme at the end of the present part.
    pub(super) fn begin_part(&mut self, part: usize) {
        let Some(present) = self.problem.loads.course().filter(|it| it.part != part) else {
            return;
        };
        let start = present.factors(self.state.load_factor);
        let next = LoadCourse::new(present.programme.clone(), part, &start);
        let (begins, _) = next.programme.parts[part].span;
        let Some(loads) = self.problem.loads.in_course(next) else {
            return;
        };
        self.state.load_factor = begins;
        self.energies.begin_part(begins);
        (self.progress.part, self.progress.part_start) = (part, start);
        let control = loads.course().and_then(LoadCourse::control);
        let value = control.map(|it| match it {
            PartControl::Motion(motion) => motion.value(&self.state.displacement),
            PartControl::DissipatedEnergy { .. } => self.dissipated_energy(),
        });
        self.progress.control_start = value.unwrap_or(0.0);
        self.problem.loads = loads.clone();
        self.equations.load_with(loads);
    }

    /// Prescribes the state of the following equilibria at a share of the present part: by its controlling motion or energy, or
    /// else by the load factor of the state.
    pub(super) fn aim(&mut self, share: f64) {
        let loads = &self.problem.loads;
        let control = (loads.course()).and_then(|it| Some((it, it.control()?)));
        let (subdomain, layout) = (&self.problem.system.subdomain, self.problem.system.layout);
        let held = control.and_then(|(course, control)| {
            let start = self.progress.control_start;
            let change = control.end() - start;
            let rate = loads.in_course(course.rate())?;
            let value = start + share * change;
            Some(match control {
                PartControl::Motion(motion) => ControlledQuantity::Motion(Target {
                    subdomain: subdomain.clone(),
                    weights: Target::owned_weights(
                        subdomain,
                        layout,
                        motion.weights.iter().copied(),
                    ),
                    rate,
                    value,
                    change,
                }),
                PartControl::DissipatedEnergy { .. } => ControlledQuantity::Energy(Dissipation {
                    step: change / course.n_steps() as f64,
                    energy: value,
                    rate,
                }),
            })
        });
        self.equations.aim(held);
    }

    /// Energy dissipated by the bonds, J.
    pub(super) fn dissipated_energy(&self) -> f64 {
        let dissipated = self.state.dissipated.iter().copied();
        sum_over_bonds(&*self.problem.system, dissipated)
    }

    /// Whether a motion or energy controls the present part instead of the load factor.
    pub(super) fn is_controlled(&self) -> bool {
        let course = self.problem.loads.course();
        course.and_then(LoadCourse::control).is_some()
    }

    /// Load factor of the control load in a record.
    pub(super) fn control_factor(&self, record: &StepRecord) -> f64 {
        match self.problem.loads.course() {
            Some(loads) => record.factors[loads.programme.control],
            None => record.load_factor,
        }
    }
}

/// Fraction of the peak load below which a body carries no load, only rounding.
pub(super) const NO_LOAD: f64 = 1e-9;

/// Error of a utilisation over the tolerance of an iterative solver: a body that hangs together by little has a condition of a thousand
/// between its forces and its strains.
const CONDITION: f64 = 1e3;

impl Run<'_> {
    /// Utilisation up to which a bond is not stretched but for rounding, or for what an iterative solver leaves.
    pub(super) fn negligible_utilisation(&self) -> f64 {
        let left = self.equations.tolerance().unwrap_or_default();
        NO_LOAD.max(CONDITION * left)
    }

    /// Whether the load of an equilibrium is rounding relative to the largest load so far.
    pub(super) fn carries_nothing(&self, balanced: &Balanced) -> bool {
        if let Some(loads) = self.problem.loads.course() {
            return self.carries_no_programme_load(loads, balanced);
        }
        let (_, reaction) = self.problem.control(&self.state, balanced);
        reaction <= NO_LOAD * self.largest_load()
    }

    /// Largest load so far, N. For a body that breaks in its first load step, under a prescribed motion, the load of the intact
    /// body at that motion.
    fn largest_load(&self) -> f64 {
        let (loads, peak) = (&self.problem.loads, self.progress.peak);
        if loads.control().kind == ControlKind::Force {
            return peak;
        }
        let given = loads.control_displacement(self.state.load_factor, &self.state.displacement);
        let whole = (self.progress.elastic.stiffness * given).abs();
        if peak <= NO_LOAD * whole { whole } else { peak }
    }

    /// End of a run whose intact model is unstable, unless the problem allows that; the unloaded body is its only record.
    pub(super) fn end_if_unstable(&mut self) -> Result<Option<Termination>, SetupError> {
        let Some(end) = self.progress.elastic.refused(&self.problem) else {
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
        let (displacement, _) = self.problem.control(&self.state, balanced);
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
        let (at_rest, met) = (self.progress.largest_force, self.equations.largest_force());
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
        let fraction = (self.stop.load_fraction)
            .filter(|&fraction| carried <= fraction * self.progress.peak)?;
        Some(Termination::LoadFraction { fraction })
    }

    /// Load of an equilibrium in its own direction, N; None for a body without broken or softened bonds.
    fn load_of_damaged_body(&self, balanced: &Balanced) -> Option<f64> {
        // Softening reduces the load before any bond breaks.
        if self.progress.broken == 0
            && (self.state.softening.remaining.is_empty() || self.progress.peak == 0.0)
        {
            return None;
        }
        // A negative load has a negative reaction.
        let (_, reaction) = self.problem.control(&self.state, balanced);
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
        let step = self.progress.history.last().map_or(0, |it| it.step);
        let message = Message::new("past-peak", "there is no equilibrium at a larger force");
        let advice = "to follow the body past its peak, let a probe control a stage (its `control`), or follow the exact path";
        self.observer
            .message(message.in_step(step).with_advice(advice))
    }
}
