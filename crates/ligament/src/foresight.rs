//! Prediction of the first bond at its limit from the first solutions of a run.

use ligament_analysis::driver::{self, Prediction, Problem};
use ligament_analysis::{Message, Observer, Termination};

use crate::error::Error;
use crate::model::Model;
use crate::run::follow;
use crate::setup::Analysis;

/// Predicts the first bond at its limit under an analysis of loads; `None` for an elastic analysis, in which no bond breaks.
///
/// The observer receives the messages of a run before its first load step.
///
/// # Errors
///
/// If the equations cannot be set up, nothing resists the loads, or the analysis is of natural modes or a motion.
pub fn predict(
    problem: &Problem,
    analysis: &Analysis,
    observer: &mut dyn Observer,
) -> Result<Option<Prediction>, Error> {
    Ok(match analysis {
        Analysis::Stepped(settings) => Some(driver::stepped::predict(problem, settings, observer)?),
        Analysis::Event(settings) => Some(driver::event::predict(problem, settings, observer)?),
        Analysis::Elastic { .. } | Analysis::Modal(_) | Analysis::Motion(_) => {
            let outcome = follow(problem, analysis, observer)?;
            let part = outcome.history.last().map_or(0, |it| it.part);
            match outcome.termination {
                Termination::NoEquilibrium { reason, .. } => {
                    Some(Prediction::NoEquilibrium { part, reason })
                }
                end @ Termination::Unstable { .. } => Some(Prediction::Refused(end)),
                _ => None,
            }
        }
    })
}

/// Refuses, without a solution, problems that the analysis cannot treat.
///
/// # Errors
///
/// If the problem cannot be followed along its exact path.
pub fn refuse(problem: &Problem, analysis: &Analysis) -> Result<(), Error> {
    match analysis {
        Analysis::Event(_) => Ok(driver::event::refuse(problem)?),
        Analysis::Elastic { .. }
        | Analysis::Stepped(_)
        | Analysis::Modal(_)
        | Analysis::Motion(_) => Ok(()),
    }
}

/// Share of the bonds across a section that never fail above which a crack does not come through it unnoticed.
const MOST_UNBROKEN: f64 = 0.1;

/// Warning about bonds that never fail in the section through the first bond at its limit that has the fewest bonds across it, where a crack
/// would run: their share of the bonds across it, weighted with the volumes of both ends. Sections lie across the axes and half way between them.
pub fn of_no_fail(model: &Model, first: u32) -> Option<Message> {
    let middle = model.middle(model.system.ends[first as usize]);
    let sections = directions(middle.len()).into_iter();
    let sections = sections.map(|direction| bonds_across(model, &middle, &direction));
    let fewer = |one: [f64; 2], it: [f64; 2]| if it[0] < one[0] { it } else { one };
    let [all, unbroken] = sections.reduce(fewer)?;
    let share = unbroken / all;
    (share > MOST_UNBROKEN).then(|| {
        let text = format!(
            "{:.0} % of the bonds across the smallest section through the first bond at its limit never fail, because `no_fail` reaches a horizon \
             beyond its points: they keep carrying load when all others are broken",
            100.0 * share
        );
        Message::new("no-fail-reach", text)
            .with_advice("take a smaller place for no_fail, or a finer mesh there")
    })
}

/// Directions along the axes and half way between them, without their opposites.
fn directions(dimensions: usize) -> Vec<Vec<f64>> {
    let signs = |number: usize| -> Vec<f64> {
        let digit = |axis: usize| (number / 3_usize.pow(axis as u32) % 3) as f64 - 1.0;
        (0..dimensions).map(digit).collect()
    };
    let count = 3_usize.pow(dimensions as u32);
    // The number in the middle has no direction, and those before it are opposites.
    (count / 2 + 1..count).map(signs).collect()
}

/// Weights of the bonds across a section through a place at right angles to a direction: of all, and of those that never fail.
fn bonds_across(model: &Model, place: &[f64], direction: &[f64]) -> [f64; 2] {
    let body = model.body();
    let side = |point: u32| -> f64 {
        let way = body.position(point).into_iter().zip(place);
        way.zip(direction)
            .map(|((it, from), cosine)| (it - from) * cosine)
            .sum()
    };
    let sides: Vec<f64> = (0..body.n_points() as u32).map(side).collect();
    let mut sums = [0.0; 2];
    for ends in model.system.ends.iter() {
        let [a, b] = ends.map(|it| it as usize);
        if sides[a] * sides[b] < 0.0 {
            let weight = model.system.volumes[a] * model.system.volumes[b];
            sums[0] += weight;
            if model.fixed.no_fail[a] || model.fixed.no_fail[b] {
                sums[1] += weight;
            }
        }
    }
    sums
}
