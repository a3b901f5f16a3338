//! How a run went, and what its force-displacement curve tells.

use crate::balanced::Stability;
use crate::costs::Costs;
use crate::history::{LargestOverlap, StepRecord, Termination};
use crate::serial;
use crate::solver::SolverChoice;
use crate::state::State;

/// How a run went.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Records of all load steps, or of all events.
    pub history: Vec<StepRecord>,
    /// What the records are.
    pub rows: Rows,
    /// The last state; where processes share the body out, with the bonds that this one knows.
    pub state: State,
    /// Broken bonds.
    pub broken_bonds: usize,
    /// Unbroken bonds whose force has begun to fall beyond a limit.
    pub softened_bonds: usize,
    /// The reason why the run ended.
    pub termination: Termination,
    /// Force over displacement of the control load before the first breakage, N/m.
    pub elastic_stiffness: f64,
    /// Where the first bond breaks, if the loading gets there.
    pub first_break: Option<LoadPoint>,
    /// Faces of cracks that passed through each other farthest, if they did so farther than results bear.
    pub overlap: Option<LargestOverlap>,
    /// Inertia of the intact stiffness, where it may be indefinite.
    pub stability: Option<Stability>,
    /// What the equations cost.
    pub costs: Costs,
    /// How the equations were solved.
    pub solver: SolverChoice,
}

/// What the records of a history are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rows {
    /// States at rest under rising loads.
    LoadSteps,
    /// States of the exact path, each just before its bonds break.
    Events,
}

/// A point of the force-displacement curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadPoint {
    /// Displacement of the control load, m.
    pub displacement: f64,
    /// Force of the control load, N.
    pub reaction: f64,
    /// Load factor.
    pub load_factor: f64,
}

serial!(LoadPoint {
    displacement,
    reaction,
    load_factor
});

impl Outcome {
    /// Whether no state under load is at rest: there is nothing but the unloaded body. A run that was stopped may still find one.
    pub fn is_without_equilibrium(&self) -> bool {
        let is_answer = |step: &StepRecord| step.at_rest && step.step > 0;
        let ended_so = matches!(
            self.termination,
            Termination::NoEquilibrium { .. }
                | Termination::NotAtRest { .. }
                | Termination::Collapsed
                | Termination::LostStiffness { .. }
        );
        ended_so && !self.history.iter().any(is_answer)
    }

    /// The record at rest with the largest reaction.
    pub fn peak(&self) -> Option<LoadPoint> {
        let at_rest = self.history.iter().filter(|step| step.at_rest);
        let largest = at_rest.reduce(|best, step| {
            if step.reaction > best.reaction {
                step
            } else {
                best
            }
        });
        largest.map(LoadPoint::from)
    }

    /// The curve that a test with a displacement that only rises shows: the load steps at rest, or of the exact path what
    /// lies beyond all displacements before it.
    ///
    /// Where the exact path comes back from a snap-back, the curve falls at the largest displacement so far, onto the line
    /// through the origin that leads to the next event; in stages, whose lines lead elsewhere, the next event follows as it is.
    pub fn envelope(&self) -> Vec<LoadPoint> {
        let at_rest = self.history.iter().filter(|step| step.at_rest);
        let is_proportional = self.history.iter().all(|step| step.factors.is_empty());
        let points = at_rest.map(LoadPoint::from);
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

    /// The point of the [envelope](Self::envelope) with the largest reaction before the reaction first fell by more than
    /// `drop` of it.
    ///
    /// A body that is split may carry more load again, as the halves of a disk between platens do; this is the strength
    /// of the whole body. It is the peak where the load never falls so far.
    pub fn first_peak(&self, drop: f64) -> Option<LoadPoint> {
        let mut best: Option<LoadPoint> = None;
        for point in self.envelope() {
            match best {
                // A load that another one presses the other way first has not risen yet.
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
    /// The point on the same line through the origin.
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
