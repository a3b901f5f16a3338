//! State of a run, as all drivers that break bonds use it.
//!
//! A `Path` computes equilibria with their energies, breaks bonds, fixes detached parts, makes records and applies stop rules.

use std::cell::Cell;
use std::time::Instant;

use ligament_model::element::BondDeformation;
use ligament_model::failure::CriteriaInState;

use super::breaks::{Breaking, CriteriaAtDeformations};
use super::course::{CheckValues, Course, Place, Restored};
use super::dissipation;
use super::outcome::{Outcome, Rows};
use super::recorder::{Energies, StepCounters, step_record};
use super::remarks;
use super::start::{Start, begin, report_detached_parts, report_mechanisms};
use super::stop::StopRules;
use crate::balanced::{Attempt, Balanced};
use crate::breakage::Breakage;
use crate::breaking::{FirstToBreak, first_of_all};
use crate::connectivity::AddedSupport;
use crate::equilibrium::Equilibrium;
use crate::error::SetupError;
use crate::history::{
    BreakRecord, Moment, Observer, ObserverError, Onward, StepRecord, Termination, View,
};
use crate::load_program::{ControlKind, LoadCourse};
use crate::problem::Problem;
use crate::serial::{Serial, Sink};
use crate::softened::SoftenedOfAll;
use crate::softening::Softening;
use crate::state::{Solution, State};
use crate::unbalanced::Unbalanced;
use crate::user_message::Message;

/// State of a run.
pub(super) struct Path<'a> {
    /// Problem with the loads of the present part of its programme.
    pub(super) problem: Problem,
    pub(super) observer: &'a mut dyn Observer,
    pub(super) equilibrium: Equilibrium,
    pub(super) state: State,
    pub(super) energies: Energies,
    pub(super) course: Course,
    /// Whether a given force acts on a detached part.
    pub(super) collapsed: bool,
    pub(super) stop: StopRules,
    pub(super) started: Instant,
}

impl<'a> Path<'a> {
    /// Begins with the unloaded body; also returns the equilibrium at load factor one, if there is one.
    pub(super) fn begin(
        problem: &'a Problem,
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
        let path = Self {
            problem: problem.clone(),
            observer,
            equilibrium,
            state: unloaded,
            energies: Energies::unloaded(problem),
            course: Course {
                elastic,
                broken: 0,
                history: Vec::new(),
                peak: 0.0,
                energy_was_negative: false,
                solves,
                negative_eigenvalues: 0,
                part_start: problem
                    .loads
                    .course()
                    .map_or_else(Vec::new, LoadCourse::start),
                part: 0,
                control_start: 0.0,
                largest_force: 0.0,
                overlap: None,
            },
            collapsed: false,
            stop,
            started: Instant::now(),
        };
        (path, at_one)
    }

    /// Refuses loads that cause no deformation; `at_one` is the equilibrium at load factor one, if there is one.
    pub(super) fn require_resistance(&self, at_one: Option<&State>) -> Result<(), SetupError> {
        // Parts that the full load separates may be pressed together by a smaller load.
        let may_press = self.problem.may_press();
        if at_one.is_some() && self.course.elastic.stiffness.is_nan() && !may_press {
            return Err(SetupError::NothingResists);
        }
        Ok(())
    }

    /// Continues from a checkpoint; also returns its equilibrium.
    pub(super) fn go_on(
        stop: StopRules,
        restored: Restored,
        observer: &'a mut dyn Observer,
    ) -> (Self, Balanced) {
        let path = Self {
            problem: restored.problem,
            observer,
            equilibrium: restored.equilibrium,
            state: restored.state,
            energies: restored.energies,
            course: restored.course,
            collapsed: false,
            stop,
            started: Instant::now(),
        };
        (path, restored.balanced)
    }

    /// Enables softening from here on, if the criteria soften.
    pub(super) fn soften(&mut self) {
        let n_bonds = self.problem.system.ends().len();
        self.state.softening = Softening::of_sound_bonds(&self.problem.criteria, n_bonds);
        self.equilibrium.soften();
    }

    /// Notifies the observer of the next step and round.
    pub(super) fn enter(&mut self, step: usize, round: usize) -> Result<(), ObserverError> {
        let load_factor = self.state.load_factor;
        self.observer
            .round(step, round, load_factor, self.course.broken)
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
        if is_negative && !std::mem::replace(&mut self.course.energy_was_negative, true) {
            let text = "the stored energy is negative: from here on the body is unstable and the results are not valid";
            let message = Message::new("negative-energy", text);
            self.observer.message(message.in_step(step))?;
        }
        self.course.solves[0] = self.equilibrium.costs().solves;
        self.course.negative_eigenvalues = self.equilibrium.negative_eigenvalues();
        Ok(attempt)
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
            let attempt = (self.equilibrium).balance(&mut self.state, breakage, self.observer)?;
            let Attempt::Balanced(mut balanced) = attempt else {
                return Ok(attempt);
            };
            let beyond = if self.is_whole() {
                None
            } else {
                self.equilibrium.beyond_size(&self.state)
            };
            let Some(beyond) = beyond else {
                let layout = self.problem.system.layout();
                let points = farthest.into_iter().map(|dof| layout.point(dof));
                balanced.mechanisms.extend(points);
                return Ok(Attempt::Balanced(balanced));
            };
            farthest.push(beyond);
            self.state.return_to(before.clone());
            self.state.held.clone_from(&held);
            self.equilibrium.hold(&mut self.state, &farthest);
        }
    }

    /// Whether no bond has broken or softened in this run.
    pub(super) fn is_whole(&self) -> bool {
        self.course.broken == 0 && self.state.softening.remaining.is_empty()
    }

    /// Offers the present equilibrium, whose energies are counted, to the observer. Returns the reason why the run ends there:
    /// `end`, or a stop by the observer.
    pub(super) fn offer(
        &mut self,
        place: &dyn Fn() -> Place,
        balanced: &Balanced,
        end: Option<Termination>,
    ) -> Result<Option<Termination>, SetupError> {
        let Self {
            observer,
            equilibrium,
            state,
            energies,
            course,
            problem,
            ..
        } = self;
        let asked = observer.asks(end.as_ref())?;
        let numbers = equilibrium.numbers();
        let has_taken_part = Cell::new(false);
        let checkpoint = |out: &mut dyn Sink| {
            has_taken_part.set(true);
            place().write(out);
            state.write(numbers, out);
            course.write(out);
            equilibrium.write(out);
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

    /// Adds work and released energy, and reports mechanisms.
    pub(super) fn account(
        &mut self,
        step: usize,
        breakage: &Breakage,
        balanced: &Balanced,
    ) -> Result<(), SetupError> {
        self.energies.add_work(&self.problem, &self.state, balanced);
        self.energies
            .add_released(&self.problem, &self.state, breakage, balanced);
        (self.energies).add_contact(&self.problem, &self.state, breakage, balanced);
        dissipation::soften(&self.problem, &mut self.state);
        report_mechanisms(step, balanced, self.observer)?;
        Ok(())
    }

    /// Bonds that break first under proportional loading, at deformations (n_bonds).
    pub(super) fn first_to_break(
        &self,
        tie_tolerance: f64,
        deformations: &[BondDeformation],
        criteria: &CriteriaInState<'_>,
    ) -> FirstToBreak {
        let (intact, system) = (&self.state.intact, &self.problem.system);
        let in_file = |bond| system.ends_in_file(bond);
        first_of_all(
            self.equilibrium.numbers(),
            tie_tolerance,
            deformations,
            criteria,
            intact,
            in_file,
        )
    }

    /// Breaks bonds of an equilibrium and fixes detached parts.
    pub(super) fn break_bonds(
        &mut self,
        bonds: &[u32],
        balanced: &Balanced,
        step: usize,
        round: usize,
    ) -> Result<Breakage, SetupError> {
        let problem = self.problem.clone();
        let criteria = problem.criteria_in(&self.state, balanced);
        let deformation = |_, bond: usize| balanced.deformations[bond];
        let judged = CriteriaAtDeformations {
            criteria: &criteria,
            deformation: &deformation,
        };
        self.break_deformed(bonds, judged, balanced, step, round)
    }

    /// Breaks bonds by criteria and their deformations, in an equilibrium of which only the forces of the control load are used,
    /// and fixes detached parts.
    pub(super) fn break_deformed(
        &mut self,
        bonds: &[u32],
        judged: CriteriaAtDeformations<'_>,
        balanced: &Balanced,
        step: usize,
        round: usize,
    ) -> Result<Breakage, SetupError> {
        let (displacement, reaction) = self.control(balanced);
        let moment = BreakRecord {
            order: self.course.broken,
            step,
            round,
            load_factor: self.state.load_factor,
            displacement,
            reaction,
            bond: 0,
            ends: [0; 2],
            criterion: 0,
            ratio: 0.0,
            deformation: BondDeformation::default(),
        };
        let numbers = self.equilibrium.numbers();
        let breaking = Breaking {
            ends: self.problem.system.ends(),
            judged,
            moment,
        };
        let records = breaking.records(numbers, bonds);
        self.course.broken += bonds.len();
        self.observer.broke(&records)?;
        for record in &records {
            if let Some(bond) = numbers.local(record.bond) {
                dissipation::break_bond(&self.problem, &mut self.state, bond, record);
            }
        }
        let breakage = self.equilibrium.break_bonds(&mut self.state, bonds);
        // Where faces close, a detached part may be pressed against others, which the equilibrium decides.
        let may_press = self.problem.may_press();
        self.collapsed |= !may_press && self.loaded_part_is_detached(&breakage.holds);
        let fragments = self.equilibrium.fragments();
        report_detached_parts(step, fragments, &breakage.holds, self.observer)?;
        Ok(breakage)
    }

    /// Criteria with the limits and measures of the bonds in an equilibrium.
    pub(super) fn criteria(&self, balanced: &Balanced) -> CriteriaInState<'_> {
        self.problem.criteria_in(&self.state, balanced)
    }

    fn loaded_part_is_detached(&self, holds: &[AddedSupport]) -> bool {
        let control = self.problem.loads.control();
        let of_point = &self.equilibrium.fragments().of_point;
        control.kind == ControlKind::Force
            && control.points.iter().any(|&point| {
                holds
                    .iter()
                    .any(|hold| hold.fragment == of_point[point as usize])
            })
    }

    /// Displacement and force of the control load in an equilibrium, m and N.
    pub(super) fn control(&self, balanced: &Balanced) -> (f64, f64) {
        let (loads, load_factor) = (&self.problem.loads, self.state.load_factor);
        (
            loads.control_displacement(load_factor, &self.state.displacement),
            loads.control_force(load_factor, &balanced.internal),
        )
    }

    /// Records an equilibrium.
    pub(super) fn record(
        &mut self,
        balanced: &Balanced,
        counters: StepCounters,
        is_last: bool,
    ) -> Result<(), SetupError> {
        let record = self.show(balanced, counters, [is_last, true])?;
        let fragments = self.equilibrium.fragments();
        let Course { overlap, .. } = &mut self.course;
        if let Some(message) =
            remarks::overlap(&self.problem, &self.state, fragments, record.step, overlap)
        {
            self.observer.message(message)?;
        }
        self.keep(record)
    }

    /// Records an equilibrium that is known only at supported and loaded points.
    pub(super) fn record_in_passing(
        &mut self,
        balanced: &Balanced,
        counters: StepCounters,
    ) -> Result<(), SetupError> {
        let record = self.show(balanced, counters, [false, false])?;
        self.keep(record)
    }

    /// Record of an equilibrium, passed to the observer.
    fn show(
        &mut self,
        balanced: &Balanced,
        counters: StepCounters,
        [is_last, is_whole]: [bool; 2],
    ) -> Result<StepRecord, SetupError> {
        let counters = StepCounters {
            broken: self.course.broken,
            solves: self.course.solves[0] - self.course.solves[1],
            negative_eigenvalues: self.course.negative_eigenvalues,
            ..counters
        };
        self.course.solves[1] = self.equilibrium.costs().solves;
        let record = step_record(
            &self.problem,
            self.problem.solution(&self.state, balanced),
            &self.energies,
            self.equilibrium.fragments(),
            counters,
        );
        self.course.peak = self.course.peak.max(record.reaction);
        let force = balanced.internal.force_scale;
        self.course.largest_force = self.course.largest_force.max(force);
        let criteria = self.problem.criteria_in(&self.state, balanced);
        let view = View {
            softened: self.softened(),
            system: &*self.problem.system,
            state: &self.state,
            balanced,
            loads: &*self.problem.loads,
            criteria: &criteria,
            fragments: self.equilibrium.fragments(),
            costs: self.equilibrium.costs(),
            motion: None,
            is_last,
            is_whole,
        };
        self.observer.step(&record, &view)?;
        Ok(record)
    }

    /// Adds a record to the history, with messages about its energies.
    fn keep(&mut self, record: StepRecord) -> Result<(), SetupError> {
        let history = &mut self.course.history;
        if let Some(message) = remarks::energies(&self.problem, &record, history.last()) {
            self.observer.message(message)?;
        }
        if let Some(message) = remarks::dissipation(&record, history) {
            self.observer.message(message)?;
        }
        history.push(record);
        Ok(())
    }

    /// Numbers of softened bonds in the present state. Collective.
    fn softened(&self) -> SoftenedOfAll {
        let ends = self.problem.system.ends();
        SoftenedOfAll::in_state(&self.state, self.equilibrium.numbers(), ends)
    }

    /// Result of the run.
    pub(super) fn into_outcome(self, termination: Termination, rows: Rows) -> Outcome {
        Outcome {
            broken_bonds: self.equilibrium.broken_bonds(&self.state),
            softened_bonds: self.softened().bonds,
            history: self.course.history,
            rows,
            termination,
            elastic_stiffness: self.course.elastic.stiffness,
            first_break: self.course.elastic.first_break,
            overlap: self.course.overlap,
            stability: self.course.elastic.stability,
            costs: *self.equilibrium.costs(),
            solver: *self.equilibrium.choice(),
            state: self.state,
        }
    }
}
