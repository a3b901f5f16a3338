//! First step of every driver: fixes detached parts and solves the elastic problem.

use serde::{Deserialize, Serialize};

use super::energies::Energies;
use super::record::{StepCounters, largest_ratio_by, step_record};
use super::run_messages;
use super::way::LoadPoint;
use crate::balanced::{Attempt, Balanced, Stability};
use crate::connectivity::{AddedSupport, Fragments};
use crate::equilibrium::Equilibrium;
use crate::error::SetupError;
use crate::gauges;
use crate::history::{Ahead, Observer, ObserverError, StepRecord, Termination, View};
use crate::problem::Problem;
use crate::state::State;
use crate::user_message::Message;

/// State and elastic solution before the first load step.
#[derive(Clone)]
pub(super) struct Start {
    /// Unloaded body, with its added supports.
    pub(super) unloaded: State,
    pub(super) elastic: ElasticAnswer,
    /// Equilibrium at load factor one, if there is one.
    pub(super) at_one: Option<State>,
    /// Deformed body at load factor one, whose bonds tell the first breakage; none in a programme of stages.
    deformed: Option<Balanced>,
}

/// Results of the elastic solution.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct ElasticAnswer {
    /// Force over displacement of the control load, N/m; NaN where there is no equilibrium or nothing resists the load.
    pub(super) stiffness: f64,
    pub(super) first_break: Option<LoadPoint>,
    pub(super) stability: Option<Stability>,
}

/// Fixes detached parts, and solves once at load factor one for the stiffness, the first breakage and the inertia.
///
/// In a programme of stages the solution is that of the control load alone, which predicts no breakage.
pub(super) fn begin(
    problem: &Problem,
    equilibrium: &mut Equilibrium,
    observer: &mut dyn Observer,
) -> Result<Start, SetupError> {
    let course = problem.loads.course();
    let alone = course.and_then(|it| problem.loads.in_course(it.control_alone()));
    let Some(loads) = alone else {
        return begin_proportional(problem, equilibrium, observer);
    };
    let alone = Problem {
        loads,
        ..problem.clone()
    };
    equilibrium.load_with(alone.loads.clone());
    let mut start = begin_proportional(&alone, equilibrium, observer)?;
    equilibrium.load_with(problem.loads.clone());
    start.elastic.first_break = None;
    start.deformed = None;
    Ok(start)
}

fn begin_proportional(
    problem: &Problem,
    equilibrium: &mut Equilibrium,
    observer: &mut dyn Observer,
) -> Result<Start, SetupError> {
    if let Some(stiffness) = equilibrium.stiffness() {
        let multiplications = stiffness.symbolic().n_multiplications();
        observer.begins(Ahead::Factor { multiplications });
    }
    let mut unloaded = equilibrium.known(State::fresh(&*problem.system));
    let breakage = equilibrium.break_bonds(&mut unloaded, &[]);
    let free = gauges::free_bodies(
        &*problem.system,
        &*problem.loads,
        equilibrium.fragments(),
        &breakage.holds,
    );
    // Contact may hold a free body.
    for body in free.into_iter().filter(|_| problem.contact.is_empty()) {
        observer.message(body.message(problem.system.faces_close))?;
    }
    let mut at_one = State {
        load_factor: 1.0,
        ..unloaded.clone()
    };
    let mut start = Start {
        unloaded,
        elastic: ElasticAnswer::UNKNOWN,
        at_one: None,
        deformed: None,
    };
    // Without an equilibrium the first load step fails too, and reports the reason.
    if let Attempt::Balanced(balanced) =
        equilibrium.balance(&mut at_one, &breakage, &mut NoObserver)?
    {
        report_mechanisms(0, &balanced, observer)?;
        start.unloaded.held.clone_from(&at_one.held);
        start.elastic.stability = stability(problem, equilibrium, &at_one, observer)?;
        if start.elastic.refused(problem).is_some() {
            return Ok(start);
        }
        if let Some(message) = run_messages::closed_notch(problem, &at_one) {
            observer.message(message)?;
        }
        match is_deformed(problem, &at_one, &balanced) {
            true => start.deformed = Some(balanced),
            false => observer.message(
                Message::new(
                    "undeformed",
                    "nothing resists the loads: they move the body as a whole and do not deform it, so that all forces are rounding",
                )
                .with_advice("hold a part of it by a support"),
            )?,
        }
        start.at_one = Some(at_one);
        start.read_off(problem, equilibrium.fragments());
    }
    Ok(start)
}

/// Whether the energy at load factor one exceeds the rounding of its displacements; temperatures may change a free body without
/// energy.
fn is_deformed(problem: &Problem, at_one: &State, balanced: &Balanced) -> bool {
    let temperatures = problem.loads.temperature_change(at_one.load_factor);
    let is_heated = temperatures.iter().any(|change| *change != 0.0);
    let rounding = balanced.energy_floor / at_one.displacement.len() as f64;
    is_heated || rounding == 0.0 || balanced.stored_energy.abs() > rounding
}

impl ElasticAnswer {
    /// Without a solution.
    pub(super) const UNKNOWN: Self = Self {
        stiffness: f64::NAN,
        first_break: None,
        stability: None,
    };

    /// End of a run where the intact model is unstable, unless the problem allows that.
    pub(super) fn refused(&self, problem: &Problem) -> Option<Termination> {
        let stability = self.stability.filter(Stability::is_unstable)?;
        let Stability { negative, expected } = stability;
        let end = Termination::Unstable { negative, expected };
        (!problem.solver.allows_unstable).then_some(end)
    }
}

/// Inertia of the intact stiffness of a problem, from one factorisation and one solution; None where it cannot be indefinite, or where there
/// is no factor.
///
/// # Errors
///
/// If the equations cannot be set up.
pub fn stability_of(problem: &Problem) -> Result<Option<Stability>, SetupError> {
    let mut equilibrium = Equilibrium::new(problem, f64::INFINITY)?;
    let start = begin(problem, &mut equilibrium, &mut NoObserver)?;
    Ok(start.elastic.stability)
}

impl Start {
    /// Sets the stiffness and first breakage from the elastic solution: everything is proportional to the load factor, except with
    /// true strains and with contacts along the exact path, which predict no breakage.
    pub(super) fn read_off(&mut self, problem: &Problem, fragments: &Fragments) {
        let Some((at_one, balanced)) = self.at_one.as_ref().zip(self.deformed.as_ref()) else {
            return;
        };
        let record = step_record(
            problem,
            problem.solution(at_one, balanced),
            &Energies::unloaded(problem),
            fragments,
            StepCounters::default(),
        );
        self.elastic.stiffness = record.reaction / record.displacement;
        let criteria = problem.criteria_before_softening(at_one, balanced);
        let ratio = largest_ratio_by(&criteria, problem, at_one, balanced);
        let is_bent = problem.contact.is_linear();
        let is_predicted = ratio > 0.0 && problem.system.element.is_linear() && !is_bent;
        self.elastic.first_break = is_predicted.then(|| LoadPoint {
            load_factor: 1.0 / ratio,
            displacement: record.displacement / ratio,
            reaction: record.reaction / ratio,
        });
    }
}

/// Inertia of the intact stiffness where it may be indefinite; notifies the observer where it is not as expected.
fn stability(
    problem: &Problem,
    equilibrium: &Equilibrium,
    state: &State,
    observer: &mut dyn Observer,
) -> Result<Option<Stability>, SetupError> {
    let system = &problem.system;
    if !system.rigidities().some_negative(&system.subdomain) {
        return Ok(None);
    }
    let stability = equilibrium.stability(state)?;
    // A refused model is the end of the run, which says so.
    if let Some(Stability { negative, expected }) = stability
        && negative != expected
        && problem.solver.allows_unstable
    {
        let text = format!(
            "the intact model is unstable: {negative} negative eigenvalues where {expected} are expected; results are not to be trusted \
             (Poisson's ratio too large for this horizon factor)"
        );
        observer.message(Message::new("unstable", text))?;
    }
    Ok(stability)
}

/// Notifies the observer of detached parts.
pub(super) fn report_detached_parts(
    step: usize,
    fragments: &Fragments,
    holds: &[AddedSupport],
    observer: &mut dyn Observer,
) -> Result<(), ObserverError> {
    let mut loose: Vec<u32> = holds.iter().map(|hold| hold.fragment).collect();
    loose.dedup();
    let extent = |fragment: &u32| fragments.extents[*fragment as usize];
    let Some(first) = loose.first() else {
        return Ok(());
    };
    let points: usize = loose.iter().map(|fragment| extent(fragment).n_points).sum();
    let text = format!(
        "a part of {points} points (around {{}}) broke off; its rigid motion is fixed so that the equations stay solvable"
    );
    let message = Message::new("parts-detached", text).of_points([extent(first).first]);
    observer.message(message.in_step(step))
}

/// Notifies the observer of mechanisms that the factorisation found.
pub(super) fn report_mechanisms(
    step: usize,
    balanced: &Balanced,
    observer: &mut dyn Observer,
) -> Result<(), ObserverError> {
    let points = &balanced.mechanisms;
    if points.is_empty() {
        return Ok(());
    }
    let text = format!(
        "fixed {} mechanism(s), motions that no bond resists, at {{all}}",
        points.len()
    );
    let message = Message::new("mechanisms", text).of_points(points.as_slice());
    observer.message(message.in_step(step))
}

/// Observer without effect.
pub(super) struct NoObserver;

impl Observer for NoObserver {
    fn looks(&self, _: usize) -> bool {
        false
    }

    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        Ok(())
    }
}
