//! A way to follow a load program, the loop that all ways have in common, and its result with the evaluation of the force-displacement curve.

use serde::{Deserialize, Serialize};

use crate::balanced::Stability;
use crate::costs::Costs;
use crate::error::SetupError;
use crate::history::{LargestOverlap, StepRecord, Termination};
use crate::motion::MotionStop;
use crate::solver::SolverChoice;
use crate::state::State;

/// A way to follow a load program: elastic solutions, load steps, the exact path, or a motion in explicit or implicit steps.
///
/// Who calls [`advance`](Self::advance) by hand sees the body between two rows of the history, and decides when to stop.
pub trait Way {
    /// Goes on by a row of the history: a load step, an event of the exact path, or a row of times.
    ///
    /// # Errors
    ///
    /// Where the run ended, or failed.
    fn advance(&mut self) -> Result<(), Stop>;

    /// The present state of the body, and the records so far: those of its [run](super::Run::now).
    fn now(&self) -> (&State, &[StepRecord]);

    /// The present state of the body.
    fn state(&self) -> &State {
        self.now().0
    }

    /// The records so far.
    fn history(&self) -> &[StepRecord] {
        self.now().1
    }

    /// Gives the next row another load factor, in a controlled stage another share of its motion or energy; whether this way takes one.
    fn set_next_load_factor(&mut self, _load_factor: f64) -> bool {
        false
    }

    /// Result of a run that ended.
    ///
    /// # Errors
    ///
    /// If the observer fails.
    fn outcome(self: Box<Self>, end: Termination) -> Result<Outcome, SetupError>;

    /// Follows the load program to the end of the run.
    ///
    /// # Errors
    ///
    /// If the run fails.
    fn follow(mut self: Box<Self>) -> Result<Outcome, SetupError> {
        loop {
            match self.advance() {
                Ok(()) => {}
                Err(Stop::End(end)) => return self.outcome(end),
                Err(Stop::Failed(error)) => return Err(error),
            }
        }
    }
}

/// Reason why a run does not go on.
#[derive(Debug)]
pub enum Stop {
    /// The run ended.
    End(Termination),
    /// The run failed.
    Failed(SetupError),
}

impl<E: Into<SetupError>> From<E> for Stop {
    fn from(error: E) -> Self {
        Self::Failed(error.into())
    }
}

ligament_model::case_type! {
    /// When to stop before the end of the loading; whichever comes first.
    #[derive(Debug, Clone, Copy, PartialEq)]
    #[case(serde(default))]
    pub struct StopRules {
        /// When the load has fallen to this share of its largest value; not where the load factor is below an earlier one.
        #[range("exclusiveMinimum" = 0, "exclusiveMaximum" = 1)]
        pub load_fraction: Option<f64>,
        /// When the displacement of the first load reaches this, m; in rad, m^3 or K where that is its unit.
        #[range("exclusiveMinimum" = 0)]
        pub displacement: Option<f64>,
        /// When so many bonds are broken.
        #[range("minimum" = 1)]
        pub bonds: Option<usize>,
        /// After so much time, s.
        #[range("exclusiveMinimum" = 0)]
        pub wall_time: Option<f64>,
        /// When the stored energy becomes negative, as it may where Poisson's ratio makes the bonds' shear stiffness negative.
        pub negative_energy: bool,
    }
}

impl StopRules {
    /// Rules for the whole loading, as long as the body is stable.
    pub const NONE: Self = Self {
        load_fraction: None,
        displacement: None,
        bonds: None,
        wall_time: None,
        negative_energy: true,
    };
}

impl From<MotionStop> for StopRules {
    fn from(stop: MotionStop) -> Self {
        Self {
            bonds: stop.bonds,
            wall_time: stop.wall_time,
            ..Self::NONE
        }
    }
}

impl Default for StopRules {
    fn default() -> Self {
        Self::NONE
    }
}

/// Result of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Records of all load steps, or of all events.
    pub history: Vec<StepRecord>,
    /// Kind of the records.
    pub rows: Rows,
    /// Last state; on a divided body, with the local bonds of this process.
    pub state: State,
    /// Number of broken bonds.
    pub broken_bonds: usize,
    /// Number of unbroken bonds that have begun to soften.
    pub softened_bonds: usize,
    /// Reason why the run ended.
    pub termination: Termination,
    /// Force over displacement of the control load before the first breakage, N/m.
    pub elastic_stiffness: f64,
    /// Point at which the first bond breaks, if the loading reaches it.
    pub first_break: Option<LoadPoint>,
    /// Largest overlap of crack faces, if it exceeds the limit for valid results.
    pub overlap: Option<LargestOverlap>,
    /// Inertia of the intact stiffness, where it may be indefinite.
    pub stability: Option<Stability>,
    /// Costs of the equations.
    pub costs: Costs,
    /// Solver of the equations.
    pub solver: SolverChoice,
}

/// Kind of the records of a history.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rows {
    /// Equilibrium states at the ends of load steps.
    LoadSteps,
    /// States of the exact path, each just before its bonds break.
    Events,
    /// States at times of a motion.
    Times,
}

/// A point of the force-displacement curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LoadPoint {
    /// Displacement of the control load, m.
    pub displacement: f64,
    /// Force of the control load, N.
    pub reaction: f64,
    /// Load factor.
    pub load_factor: f64,
}

impl Outcome {
    /// Whether the run ended without any equilibrium of the loaded body; false for a run that was stopped, which may still reach
    /// one.
    pub fn is_without_equilibrium(&self) -> bool {
        let needs_rest = self.termination.row().verdict.needs_rest();
        needs_rest && !self.at_rest().any(|it| it.step > 0)
    }

    /// Records whose numbers are results: those at rest.
    pub fn at_rest(&self) -> impl DoubleEndedIterator<Item = &StepRecord> {
        self.history.iter().filter(|it| it.at_rest)
    }

    /// Record at rest with the largest reaction.
    pub fn peak(&self) -> Option<LoadPoint> {
        let largest = self.at_rest().reduce(|best, step| {
            if step.reaction > best.reaction {
                step
            } else {
                best
            }
        });
        largest.map(LoadPoint::from)
    }

    /// Curve of a test with increasing displacement: the load steps at rest, or the points of the exact path beyond all
    /// displacements before them.
    ///
    /// Where the exact path returns from a snap-back, the curve drops at the largest displacement so far onto the line through the
    /// origin to the next event; in stages, whose lines do not pass through the origin, the next event follows directly.
    pub fn envelope(&self) -> Vec<LoadPoint> {
        let is_proportional = self.history.iter().all(|step| step.factors.is_empty());
        let points = self.at_rest().map(LoadPoint::from);
        if self.rows == Rows::LoadSteps {
            return points.collect();
        }
        let mut curve: Vec<LoadPoint> = Vec::new();
        for point in points {
            match curve.last() {
                Some(last) if point.displacement <= last.displacement => {}
                Some(last) if last.displacement > 0.0 && is_proportional => {
                    curve.push(point.scaled(last.displacement / point.displacement));
                    curve.push(point);
                }
                _ => curve.push(point),
            }
        }
        curve
    }

    /// Point of the [envelope](Self::envelope) with the largest reaction before the reaction first fell by more than the fraction
    /// `drop`.
    ///
    /// A body that is split may carry more load again, as the halves of a disk between platens do; this point is the strength of
    /// the whole body. It is the peak where the load never falls that far.
    pub fn first_peak(&self, drop: f64) -> Option<LoadPoint> {
        let mut best: Option<LoadPoint> = None;
        for point in self.envelope() {
            match best {
                // A negative reaction, due to another load, is no peak.
                Some(peak)
                    if peak.reaction > 0.0 && point.reaction < (1.0 - drop) * peak.reaction =>
                {
                    break;
                }
                Some(peak) if point.reaction <= peak.reaction => {}
                _ => best = Some(point),
            }
        }
        best
    }
}

impl LoadPoint {
    /// Point on the line through the origin, scaled by a factor.
    fn scaled(self, factor: f64) -> Self {
        Self {
            displacement: factor * self.displacement,
            reaction: factor * self.reaction,
            load_factor: factor * self.load_factor,
        }
    }
}

impl From<&StepRecord> for LoadPoint {
    fn from(step: &StepRecord) -> Self {
        Self {
            displacement: step.displacement,
            reaction: step.reaction,
            load_factor: step.load_factor,
        }
    }
}
