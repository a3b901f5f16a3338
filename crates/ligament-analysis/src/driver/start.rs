//! First step of every driver: fixes detached parts and solves the elastic problem.

use super::record::ElasticAnswer;
use super::run_messages;
use super::way::LoadPoint;
use crate::balanced::{Attempt, Balanced, Stability};
use crate::equilibrium::Equilibrium;
use crate::error::SetupError;
use crate::gauges;
use crate::history::{Ahead, Observer, ObserverError, StepRecord, View};
use crate::problem::Problem;
use crate::state::State;
use crate::user_message::Message;

/// Opening of a notch, relative to the motion of its faces against each other, below which they slide and neither open nor close.
const SLIDING: f64 = 0.1;

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
    let is_proportional = alone.is_none();
    let loads = alone.unwrap_or_else(|| problem.loads.clone());
    equilibrium.load_with(loads.clone());
    let mut elastic = problem.clone();
    elastic.loads = loads;
    let mut start = solve_elastic(&elastic, equilibrium, observer)?;
    equilibrium.load_with(problem.loads.clone());
    if !is_proportional {
        start.elastic.first_break = None;
        start.deformed = None;
    }
    Ok(start)
}

fn solve_elastic(
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
        if let Some(message) = run_messages::mechanisms(&balanced) {
            observer.message(message.in_step(0))?;
        }
        start.unloaded.held.clone_from(&at_one.held);
        start.elastic.stability = stability(problem, equilibrium, &at_one, observer)?;
        if start.elastic.refused(problem).is_some() {
            return Ok(start);
        }
        if let Some(message) = closed_notch(problem, &at_one) {
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
        start.read_off(problem);
    }
    Ok(start)
}

/// Message about the notch that closes most in an equilibrium, of a body whose bonds may fail and whose faces carry no pressure; notches whose faces
/// slide, or come nearer by no more than the material beside them is shortened, do not close.
fn closed_notch(problem: &Problem, state: &State) -> Option<Message> {
    if problem.criteria.list.is_empty() || problem.may_press() {
        return None;
    }
    let layout = problem.system.layout;
    let openings = problem.notches.iter().map(|notch| {
        let it = notch.opening(layout, &state.displacement);
        let is_more = -it.opening > it.strained.abs().max(SLIDING * it.motion);
        (it.opening, is_more, notch)
    });
    let closed = openings.filter(|(_, closes, _)| *closes);
    let (opening, _, notch) = closed.min_by(|one, other| one.0.total_cmp(&other.0))?;
    let text = format!(
        "the notch between {{at}} and {{at}} closes under the load, by {:.2e} m in the mean at load factor {}, and its faces carry no pressure",
        -opening, state.load_factor
    );
    let message = Message::new("notch-closes", text).of_points(notch.ends[0]);
    Some(message.with_advice("if the load is to open it, turn its sign round"))
}

/// Whether the energy at load factor one exceeds the rounding of its displacements; temperatures may change a free body without
/// energy.
fn is_deformed(problem: &Problem, at_one: &State, balanced: &Balanced) -> bool {
    let temperatures = problem.loads.temperature_change(at_one.load_factor);
    let is_heated = temperatures.iter().any(|change| *change != 0.0);
    let rounding = balanced.energy_floor / at_one.displacement.len() as f64;
    is_heated || rounding == 0.0 || balanced.stored_energy.abs() > rounding
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
    pub(super) fn read_off(&mut self, problem: &Problem) {
        let Some((at_one, balanced)) = self.at_one.as_ref().zip(self.deformed.as_ref()) else {
            return;
        };
        let (displacement, reaction) = problem.control(at_one, balanced);
        self.elastic.stiffness = reaction / displacement;
        let criteria = problem.criteria_before_softening(at_one, balanced);
        let ratio = problem.largest_ratio_by(&criteria, at_one, balanced);
        let is_bent = problem.contact.is_linear();
        let is_predicted = ratio > 0.0 && problem.system.element.is_linear() && !is_bent;
        self.elastic.first_break = is_predicted.then(|| LoadPoint {
            load_factor: 1.0 / ratio,
            displacement: displacement / ratio,
            reaction: reaction / ratio,
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
