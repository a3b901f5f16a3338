//! Prediction of `ligament check` for the first bond at its limit, by the first solutions of a run.

use std::io;

use ligament::Message;
use ligament::foresight::{of_no_fail, predict};
use ligament_analysis::Equilibrium;
use ligament_analysis::driver::{FirstFailure, Prediction, Problem};
use ligament_analysis::history::{Observer, ObserverError, StepRecord, View};
use ligament_case::case::CaseFile;
use ligament_output::quantity::{four_digits, place, quantity};
use ligament_run::memory;
use ligament_run::messages::with_point_names;
use ligament_run::model::Model;
use ligament_run::stability;
use ligament_run::stages::Stages;

use super::report::CheckExtent;
use super::report::Report;

/// Largest number of a factor's multiplications for which the prediction is made by default, some seconds on one processor.
const MOST_MULTIPLICATIONS: f64 = 5e10;

/// Utilisation of a bond below which it counts as rounding.
const ROUNDING: f64 = 1e-12;

/// Largest number of unknowns for which the prediction without a factor is made by default, some seconds on one processor.
const MOST_UNKNOWNS: usize = 300_000;

/// What a run would tell before its first load step.
#[derive(Default)]
pub(super) struct PredictedRun {
    /// Messages of the run.
    pub(super) messages: Vec<Message>,
    /// Reason why the run would end there.
    pub(super) refused: Option<String>,
}

/// Writes the first bond at its limit, and returns what a run would tell before its first load step.
///
/// # Errors
///
/// If a run would be refused.
pub(super) fn write(
    report: &mut Report<'_>,
    case: &CaseFile,
    model: &Model,
    problem: &Problem,
    too_costly: Option<String>,
    stages: &mut Stages,
) -> anyhow::Result<PredictedRun> {
    let analysis = &model.setup.analysis;
    if let Some(reason) = too_costly {
        let name = match analysis.is_fracture() {
            true => "first breakage",
            false => "first solution",
        };
        report.entry(name, format!("not computed: {reason}"))?;
        return Ok(PredictedRun::default());
    }
    let mut messages = Messages::default();
    let prediction = stages.time("first solution", || {
        predict(problem, analysis, &mut messages)
    });
    let prediction = prediction.map_err(|it| case.error_in_case_terms(it))?;
    let no_fail = match &prediction {
        Some(Prediction::FirstFailure(first)) => of_no_fail(model, first.bond),
        _ => None,
    };
    let refused = match prediction {
        Some(Prediction::Refused(end)) => {
            Some(stages.time("stability", || stability::end_text(&end, model)))
        }
        Some(prediction) => {
            write_prediction(report, model, problem, &prediction)?;
            None
        }
        None => None,
    };
    // Free rigid motions are reported with the supports.
    let shown = messages.0.into_iter().filter(|it| it.kind != "free-body");
    let shown = shown.map(|it| with_point_names(it, model.body(), &model.setup));
    let shown = shown.chain(no_fail);
    Ok(PredictedRun {
        messages: shown.collect(),
        refused,
    })
}

/// Reason why the prediction is not made by default, if it is too costly.
pub(super) fn too_costly(
    case: &CaseFile,
    extent: CheckExtent,
    problem: &Problem,
    equilibrium: &Equilibrium,
) -> Option<String> {
    let stiffness = equilibrium.stiffness();
    if memory::check_memory(case, &*problem.system, stiffness).is_err() {
        return Some("the equations need more memory than is available".to_owned());
    }
    if extent == CheckExtent::PatchTest {
        return None;
    }
    let unknowns = equilibrium.unknowns().len();
    match stiffness.map(|it| it.symbolic().n_multiplications()) {
        Some(cost) if cost > MOST_MULTIPLICATIONS => Some(format!(
            "a solution takes {cost:.1e} multiplications, more than {MOST_MULTIPLICATIONS:.0e}; use --patch-test"
        )),
        None if unknowns > MOST_UNKNOWNS => Some(format!(
            "a solution has {unknowns} unknowns, more than {MOST_UNKNOWNS}; use --patch-test"
        )),
        _ => None,
    }
}

fn write_prediction(
    report: &mut Report<'_>,
    model: &Model,
    problem: &Problem,
    prediction: &Prediction,
) -> io::Result<()> {
    let stage = |part: usize| {
        let course = problem.loads.course();
        course.map(|it| format!("stage `{}`", it.programme.stage_name(part)))
    };
    let name = "first breakage";
    match prediction {
        Prediction::FirstFailure(first) => write_first(report, model, first, stage(first.part)),
        Prediction::NoFailure { utilisation } if *utilisation < ROUNDING => {
            report.entry(name, "none: no bond is strained towards its limit")
        }
        Prediction::NoFailure { utilisation } => {
            let words = match stage(0) {
                None => {
                    let times = four_digits(1.0 / utilisation);
                    format!("not reached at full load: it takes {times} times the load")
                }
                Some(_) => format!(
                    "not reached in the stages: the highest utilisation of a bond is {}",
                    four_digits(*utilisation)
                ),
            };
            report.entry(name, words)
        }
        Prediction::NoEquilibrium { part, reason } => {
            let at = stage(*part).map_or(String::new(), |it| format!(" at the end of {it}"));
            let body = model.body();
            let reason = reason.words(&|point| body.place(point));
            report.line(format!(
                "warning: the intact body has no equilibrium under the loads{at}: {reason}"
            ))
        }
        // The reason is the end of the check.
        Prediction::Refused(_) => Ok(()),
        Prediction::Nonlinear => report.entry(name,
            "not predicted, because strains are not proportional to the loads (crack faces close, surfaces meet, strains are true \
             strains, or bonds soften by a stress in stages)",
        ),
    }
}

/// Writes load, load step and bond of the first limit.
fn write_first(
    report: &mut Report<'_>,
    model: &Model,
    first: &FirstFailure,
    stage: Option<String>,
) -> io::Result<()> {
    let criterion = &model.criteria.list[first.criterion];
    let name = match criterion.after.is_brittle() {
        true => "first breakage",
        false => "first softening",
    };
    let of = stage.unwrap_or_else(|| "the load".to_owned());
    let mut at = match first.share {
        Some(share) => format!("at {} of {of}", four_digits(share)),
        None => format!("in {of}"),
    };
    if let Some(step) = first.step {
        at += &format!(", in step {} of {}", step.step, step.steps);
    }
    let units = model.setup.units();
    let load = quantity(first.point.reaction, units.force);
    let moved = quantity(first.point.displacement, units.displacement);
    report.entry(name, format!("{at}: {load} at {moved}"))?;
    let system = &model.system;
    let ends = system.numbering.ordered(system.ends[first.bond as usize]);
    let [one, other] = ends.map(|end| model.body().tag(end));
    let mut bond = format!(
        "{}s {one} and {other} at {}, by {}",
        model.body().tagged(),
        place(&model.middle(ends)),
        criterion.name
    );
    if let Some(step) = first.step {
        let bonds = model.counts.bonds;
        bond += &format!(
            "; {} of {bonds} bonds beyond their limits at the end of the step",
            step.beyond
        );
    }
    report.entry("", bond)
}

/// Observer that collects the messages of a run.
#[derive(Default)]
struct Messages(Vec<Message>);

impl Observer for Messages {
    fn message(&mut self, message: Message) -> Result<(), ObserverError> {
        self.0.push(message);
        Ok(())
    }

    fn looks(&self, _: usize) -> bool {
        false
    }

    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        Ok(())
    }
}
