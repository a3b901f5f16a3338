//! Prediction of the first failure from elastic solutions alone: the first bond at its limit, or the reason why no bond reaches it.
//!
//! Up to its first breakage a body is elastic. In proportion to one load factor one solution suffices; in a programme of stages the
//! state follows a straight line from the end of one part to the end of the next, with one solution for each part.

use ligament_model::deformation::Deformations;
use ligament_model::element::BondDeformation;
use ligament_model::failure::CriteriaInState;
use ligament_model::parallel;

use super::run::Run;
use super::start::NoObserver;
use super::way::LoadPoint;
use crate::balanced::{Attempt, Balanced};
use crate::bond_numbers::sum_over_bonds;
use crate::breakage::Breakage;
use crate::error::SetupError;
use crate::history::{ObserverError, Termination};
use crate::load_program::{LoadCourse, Part, PartControl, Programme};
use crate::state::State;
use crate::unbalanced::Unbalanced;
use crate::user_message::Message;

/// Utilisation of a bond that counts as at its limit, since a load step that ends exactly at the first breakage is subject to
/// rounding.
const AT_LIMIT: f64 = 1.0 - 1e-9;

/// Share of the first load step below which a first failure means that a load breaks the body at once.
const AT_ONCE: f64 = 0.1;

/// Relative difference of utilisations below which bonds are tied; the tied bond with the smallest end numbers is reported.
const TIED: f64 = 1e-8;

/// Halvings after which the failure point on a line is known to the last digits.
const HALVINGS: usize = 52;

/// Doublings of an unbounded line after which no bond on it reaches a limit.
const DOUBLINGS: usize = 60;

/// Prediction of the first failure of a run.
#[derive(Debug, Clone, PartialEq)]
pub enum Prediction {
    /// A bond reaches its limit.
    FirstFailure(FirstFailure),
    /// No bond reaches its limit.
    NoFailure {
        /// Largest utilisation of a bond under the loading, below one.
        utilisation: f64,
    },
    /// There is no equilibrium.
    NoEquilibrium {
        /// Index of the part of the programme of stages; 0 without one.
        part: usize,
        /// Reason for the missing equilibrium.
        reason: Unbalanced,
    },
    /// The run ends before its first load, because the intact model is unstable.
    Refused(Termination),
    /// The state is neither proportional to the load nor piecewise linear, so that there is no prediction.
    Nonlinear,
}

impl Prediction {
    /// Prediction for a part of a loading whose end, reached in one step, is no equilibrium: where surfaces moved through each other, the
    /// steps that lead there may see it.
    fn without_equilibrium(part: usize, n_steps: usize, reason: Unbalanced) -> Self {
        match reason {
            Unbalanced::Missed { .. } if n_steps > 1 => Self::Nonlinear,
            reason => Self::NoEquilibrium { part, reason },
        }
    }
}

/// First bond to reach its limit, where it breaks or begins to soften.
#[derive(Debug, Clone, PartialEq)]
pub struct FirstFailure {
    /// Number of the bond; of tied bonds the one with the smallest end numbers.
    pub bond: u32,
    /// Number of the criterion.
    pub criterion: usize,
    /// Point on the force-displacement curve.
    pub point: LoadPoint,
    /// Index of the part of the programme of stages; 0 without one.
    pub part: usize,
    /// Load factor, or the completed share of the stage; None in a stage that ends at a dissipated energy.
    pub share: Option<f64>,
    /// Load step of the failure; None along the exact path.
    pub step: Option<StepOfFailure>,
}

/// The load step in which the first bond reaches its limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StepOfFailure {
    /// Number of the step, from 1.
    pub step: usize,
    /// Total number of steps.
    pub steps: usize,
    /// Number of bonds beyond their limits at the end of the step if none broke.
    pub beyond: usize,
}

impl Prediction {
    /// Prediction of a run whose intact model is unstable, unless the problem allows that.
    pub(super) fn refused(run: &Run<'_>) -> Option<Self> {
        let refused = run.progress.elastic.refused(&run.problem);
        refused.map(Self::Refused)
    }
}

impl Run<'_> {
    /// Notifies the observer of loads that break the body at once, without meaningful results, if the first bond reaches its limit
    /// early in the first load step. The step ends at load factor `load_factor`, in stages at that share of a controlling motion.
    /// The equilibrium at load factor one, in stages of the control load alone, is `at_one`.
    pub(super) fn report_first_step(
        &mut self,
        at_one: &State,
        load_factor: f64,
    ) -> Result<(), SetupError> {
        let first = self.progress.elastic.first_break;
        let (share, balanced, times) = match first.map(|it| it.load_factor / load_factor) {
            Some(share) if (0.0..AT_ONCE).contains(&share) => {
                let balanced = self.equations.measured(&mut at_one.clone());
                (share, balanced, load_factor)
            }
            Some(_) => return Ok(()),
            None => match self.first_step_of_stages(load_factor)? {
                // A programme begins with the unloaded body.
                Some(balanced) => {
                    let utilisation = self.problem.largest_ratio(&self.state, &balanced);
                    (1.0 / utilisation, balanced, 1.0)
                }
                None => return Ok(()),
            },
        };
        if !(0.0..AT_ONCE).contains(&share) {
            return Ok(());
        }
        let criteria = self
            .problem
            .criteria_before_softening(&self.state, &balanced);
        let criteria = criteria.on_line(None, times);
        let deformations = balanced.deformations.scaled(times);
        let is_beyond = |(bond, deformation)| criteria.utilisation(bond, deformation) >= AT_LIMIT;
        let of_bonds = deformations.iter().enumerate();
        let of_bonds = of_bonds.map(|it| f64::from(u8::from(is_beyond(it))));
        let system = &*self.problem.system;
        let text = format!(
            "the body breaks at once: its first bond reaches its limit at {share:.4} of the first load step, at whose end {} of {} bonds would be \
             beyond theirs",
            sum_over_bonds(system, of_bonds),
            sum_over_bonds(system, system.ends.iter().map(|_| 1.0))
        );
        let message = Message::new("breaks-at-once", text);
        let advice = "the loads are too large, or the steps too few (SI units: m, N, Pa)";
        Ok(self.observer.message(message.with_advice(advice))?)
    }

    /// Elastic equilibrium at the end of the first load step of a programme of stages, not counted as a solve; None where the step
    /// does not end at an elastic solution.
    fn first_step_of_stages(
        &mut self,
        load_factor: f64,
    ) -> Result<Option<Balanced>, ObserverError> {
        let course = self.problem.loads.course();
        let control = course.map(LoadCourse::control);
        let is_by_energy = matches!(control, Some(Some(PartControl::DissipatedEnergy { .. })));
        let can_fail = !self.problem.criteria.list.is_empty();
        if course.is_none() || is_by_energy || !can_fail || !self.problem.system.element.is_linear()
        {
            return Ok(None);
        }
        let mut state = self.state.clone();
        self.aim(load_factor);
        if !self.is_controlled() {
            state.load_factor = load_factor;
        }
        let nothing = Breakage::default();
        let attempt = (self.equations).balance(&mut state, &nothing, &mut NoObserver)?;
        self.equations.aim(None);
        self.progress.solves = [self.equations.costs().solves; 2];
        Ok(match attempt {
            Attempt::Balanced(balanced) => Some(balanced),
            Attempt::Unbalanced(_) => None,
        })
    }
}

/// Predicts the first failure of a run that has begun; `at_one` is its equilibrium at load factor one, and `steps` are the load
/// factors of its load steps, None along the exact path.
pub(super) fn predict(
    run: Run<'_>,
    at_one: Option<State>,
    steps: Option<&[f64]>,
) -> Result<Prediction, SetupError> {
    let system = &run.problem.system;
    // The stress at which bonds begin to soften is proportional to a load that grows, and to no other.
    let list = &run.problem.criteria.list;
    let begins_by_stress = list.iter().any(|it| it.starting().is_some());
    let turns_back = steps.is_some_and(|it| it.iter().any(|factor| *factor < 0.0));
    let is_bent = run.problem.contact.is_linear();
    let is_linear = system.element.is_linear() && !(begins_by_stress && turns_back) && !is_bent;
    match run.problem.loads.course() {
        _ if !is_linear => Ok(Prediction::Nonlinear),
        None => in_proportion(run, at_one, steps),
        Some(_) if system.faces_close || begins_by_stress => Ok(Prediction::Nonlinear),
        Some(course) => {
            let programme = course.programme.clone();
            in_stages(run, &programme, steps.is_some())
        }
    }
}

/// Predicts the first failure in proportion to one load factor.
fn in_proportion(
    mut run: Run<'_>,
    at_one: Option<State>,
    steps: Option<&[f64]>,
) -> Result<Prediction, SetupError> {
    let balanced = match at_full_load(&mut run, at_one)? {
        Attempt::Balanced(balanced) => balanced,
        Attempt::Unbalanced(reason) => {
            let n_steps = steps.map_or(1, <[f64]>::len);
            return Ok(Prediction::without_equilibrium(0, n_steps, reason));
        }
    };
    let factors = steps.unwrap_or(&[1.0]);
    let criteria = run.problem.criteria_before_softening(&run.state, &balanced);
    let (displacement, reaction) = run.problem.control(&run.state, &balanced);
    let along = balanced.deformations;
    // Faces that close under a load are open under the opposite one.
    let reversed = factors.iter().position(|factor| *factor < 0.0);
    let open = reversed.filter(|_| run.problem.may_press());
    let told = open.unwrap_or(factors.len());
    let forward = Nearest::new(&run, &criteria, &along);
    let backward =
        reversed.map(|_| Nearest::new(&run, &criteria.on_line(None, -1.0), &along.scaled(-1.0)));
    let nearest = |factor: f64| match &backward {
        Some(backward) if factor < 0.0 => backward,
        _ => &forward,
    };
    let utilisation = |factor: f64| factor.abs() * nearest(factor).utilisation;
    let mut of_steps = factors[..told].iter();
    let Some(index) = of_steps.position(|&factor| utilisation(factor) >= AT_LIMIT) else {
        let largest = factors.iter().map(|&it| utilisation(it));
        let utilisation = largest.fold(0.0, f64::max);
        return Ok(match open {
            Some(_) => Prediction::Nonlinear,
            None => Prediction::NoFailure { utilisation },
        });
    };
    let first = nearest(factors[index]);
    let load_factor = factors[index].signum() / first.utilisation;
    Ok(Prediction::FirstFailure(FirstFailure {
        bond: first.bond,
        criterion: first.criterion,
        point: LoadPoint {
            displacement: load_factor * displacement,
            reaction: load_factor * reaction,
            load_factor,
        },
        part: 0,
        share: Some(load_factor),
        step: steps.map(|_| StepOfFailure {
            step: index + 1,
            steps: factors.len(),
            beyond: beyond(
                &criteria.on_line(None, factors[index]),
                &along.scaled(factors[index]),
            ),
        }),
    }))
}

/// Equilibrium at load factor one, from its state if that is known.
fn at_full_load(run: &mut Run<'_>, at_one: Option<State>) -> Result<Attempt, SetupError> {
    let Some(state) = at_one else {
        run.state.load_factor = 1.0;
        return run.balance(0, &Breakage::default());
    };
    run.state = state;
    Ok(Attempt::Balanced(run.equations.measured(&mut run.state)))
}

/// Predicts the first failure in a programme of stages.
fn in_stages(
    mut run: Run<'_>,
    programme: &Programme,
    has_steps: bool,
) -> Result<Prediction, SetupError> {
    let nothing = Breakage::default();
    let mut largest: f64 = 0.0;
    let mut here = match run.balance(0, &nothing)? {
        Attempt::Balanced(balanced) => balanced,
        Attempt::Unbalanced(reason) => return Ok(Prediction::NoEquilibrium { part: 0, reason }),
    };
    // The stresses of an equilibrium stay those with the loads of the part in which they are asked for first.
    run.criteria(&here);
    for (index, part) in programme.parts.iter().enumerate() {
        let start = run.problem.control(&run.state, &here);
        run.begin_part(index);
        let goes_on = aim_at_end(&mut run, part);
        let there = match run.balance(0, &nothing)? {
            Attempt::Balanced(balanced) => balanced,
            Attempt::Unbalanced(reason) => {
                let n_steps = if has_steps { part.steps } else { 1 };
                return Ok(Prediction::without_equilibrium(index, n_steps, reason));
            }
        };
        let [criteria_here, criteria] = [&here, &there].map(|it| run.criteria(it));
        let line = Line::new([&here, &there], [&criteria_here, &criteria]);
        let Some(share) = line.first_failure(goes_on) else {
            largest = largest.max(utilisation(&criteria, &there.deformations));
            here = there;
            continue;
        };
        let first = Nearest::new(&run, &line.criteria(share), &line.at(share));
        let end = run.problem.control(&run.state, &there);
        let on_way = |start: f64, end: f64| start + share * (end - start);
        let (begins, ends) = part.span;
        let steps_before: usize = programme.parts[..index].iter().map(|it| it.steps).sum();
        let step = (share * part.steps as f64 * AT_LIMIT).ceil().max(1.0);
        let is_counted = has_steps && !goes_on;
        return Ok(Prediction::FirstFailure(FirstFailure {
            bond: first.bond,
            criterion: first.criterion,
            point: LoadPoint {
                displacement: on_way(start.0, end.0),
                reaction: on_way(start.1, end.1),
                load_factor: on_way(begins, run.state.load_factor),
            },
            part: index,
            share: (!goes_on).then(|| on_way(begins, ends)),
            step: is_counted.then(|| StepOfFailure {
                step: steps_before + step as usize,
                steps: programme.parts.iter().map(|it| it.steps).sum(),
                beyond: line.beyond(step / part.steps as f64),
            }),
        }));
    }
    Ok(Prediction::NoFailure {
        utilisation: largest,
    })
}

/// Prescribes the end of a part that has just begun; returns whether the part ends at a dissipated energy, which no elastic
/// solution does: then its end is at the load that it names.
fn aim_at_end(run: &mut Run<'_>, part: &Part) -> bool {
    let dissipates = matches!(part.control, Some(PartControl::DissipatedEnergy { .. }));
    if dissipates {
        run.equations.aim(None);
    } else {
        run.aim(1.0);
    }
    if !matches!(part.control, Some(PartControl::Motion(_))) {
        run.state.load_factor = part.span.1;
    }
    dissipates
}

/// Deformations and criteria on the straight line from one equilibrium to another.
struct Line<'a> {
    here: Deformations,
    slopes: Deformations,
    /// Criteria in both equilibria.
    criteria: [&'a CriteriaInState<'a>; 2],
}

impl<'a> Line<'a> {
    fn new([here, there]: [&Balanced; 2], criteria: [&'a CriteriaInState<'a>; 2]) -> Self {
        Self {
            here: here.deformations.clone(),
            slopes: there.deformations.ahead(&here.deformations, -1.0),
            criteria,
        }
    }

    fn at(&self, share: f64) -> Deformations {
        self.here.ahead(&self.slopes, share)
    }

    fn criteria(&self, share: f64) -> CriteriaInState<'a> {
        let [here, there] = self.criteria;
        there.on_line(Some(here), share)
    }

    /// Number of the bonds that are at their limits or beyond at a share of the line.
    fn beyond(&self, share: f64) -> usize {
        beyond(&self.criteria(share), &self.at(share))
    }

    /// Share of the line at which the first bond reaches its limit, at most 1 unless `goes_on`; None where none does.
    ///
    /// A measure is convex along a line, so that from an admissible state there is one point where the largest utilisation passes
    /// one, which bisection finds.
    fn first_failure(&self, goes_on: bool) -> Option<f64> {
        let fails = |share: f64| utilisation(&self.criteria(share), &self.at(share)) >= AT_LIMIT;
        let mut doublings =
            (0..=if goes_on { DOUBLINGS } else { 0 }).map(|it| 2_f64.powi(it as i32));
        let [mut low, mut high] = [0.0, doublings.find(|share| fails(*share))?];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if fails(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        Some(high)
    }
}

/// Bond nearest to its limit.
struct Nearest {
    utilisation: f64,
    bond: u32,
    criterion: usize,
}

impl Nearest {
    fn new(run: &Run<'_>, criteria: &CriteriaInState<'_>, deformations: &Deformations) -> Self {
        let of_bonds = parallel::values(deformations.len(), 0.0, |bond| {
            criteria.utilisation(bond, &deformations[bond])
        });
        let utilisation = of_bonds.iter().copied().fold(0.0, f64::max);
        let is_tied = |bond: &u32| of_bonds[*bond as usize] >= (1.0 - TIED) * utilisation;
        let tied = (0..of_bonds.len() as u32).filter(is_tied);
        let bond = tied.min_by_key(|bond| run.problem.system.ends_in_file(*bond));
        let bond = bond.unwrap_or_default();
        let of_criterion = |index: usize| {
            let deformation = deformations.get(bond as usize);
            deformation.map_or(0.0, |it: &BondDeformation| {
                criteria.utilisation_by(index, bond as usize, it)
            })
        };
        let criteria = (0..criteria.criteria().list.len()).rev();
        let worst =
            criteria.max_by(|one, other| of_criterion(*one).total_cmp(&of_criterion(*other)));
        Self {
            utilisation,
            bond,
            criterion: worst.unwrap_or_default(),
        }
    }
}

/// Largest utilisation of a bond at deformations (n_bonds).
fn utilisation(criteria: &CriteriaInState<'_>, deformations: &Deformations) -> f64 {
    parallel::largest(deformations.len(), |bond| {
        criteria.utilisation(bond, &deformations[bond])
    })
}

/// Number of bonds at or beyond their limits at deformations (n_bonds).
fn beyond(criteria: &CriteriaInState<'_>, deformations: &Deformations) -> usize {
    let is_beyond = |bond: &usize| criteria.utilisation(*bond, &deformations[*bond]) >= AT_LIMIT;
    let of_ranges = parallel::of_ranges(deformations.len(), |it| it.filter(is_beyond).count());
    of_ranges.iter().sum()
}
