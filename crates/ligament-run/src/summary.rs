//! `summary.json` of a run, and the report for the user at its end.

mod certificate;
mod modal;
mod model;
mod motion;
mod solver;

use std::collections::BTreeMap;
use std::io::{self, Write};

use certificate::write_certificate;
use ligament::Model;
use ligament_analysis::driver::{LoadPoint, Outcome, Rows};
use ligament_analysis::first_bonds::{FirstBond, FirstBonds};
use ligament_analysis::history::StepRecord;
use ligament_analysis::{Layout, LoadProgram, Message, ProportionalLoading, Termination};
use ligament_case::case::CaseFile;
use ligament_output::quantity::{between, quantity, zero_if_rounding};
use ligament_output::results::criterion_labels;
use ligament_output::results::passes::RefinementSummary;
use ligament_output::summary::{
    BondEvent, CertificateSummary, INCOMPLETE_RUN_NOTE, OverlapSummary, PathPoint, Provenance,
    Resultant, Spread, StabilitySummary, Stage, Summary, UnitsSummary,
};
use motion::{motion_summary, write_motion};
use solver::solver_summary;

use crate::end::End;
use crate::messages::merged_messages;
use crate::refinement::{unsettled, write_refinement};
use crate::stability;

pub(crate) use certificate::certificate;
pub use modal::{modal_summary, write_modal};
pub use model::{
    PointStatistics, analysis_words, correction_line, family, formulation_line, heading, scatter,
};

/// Decrease of the reaction, relative to its maximum so far, that ends the first rise of the load.
pub const LOAD_DROP: f64 = 0.02;

/// Largest number of warnings shown at the end of a run; small detached parts can give hundreds.
const WARNINGS_SHOWN: usize = 10;

/// Largest ratio of a load to the load of the first breakage that counts as rounding.
const ROUNDING: f64 = 1e-9;

/// Description of the end of a run, with points by their tags and positions.
pub(crate) fn end_text(outcome: &Outcome, model: &Model) -> String {
    match &outcome.termination {
        end @ Termination::Unstable { .. } => stability::end_text(end, model),
        end => end.words(&|point| model.names.place(point)),
    }
}

/// Smallest, mean and largest change of the points' temperature at load factor 1, K.
pub fn temperature_change(boundary: &ProportionalLoading) -> Option<Spread> {
    let changes = &boundary.temperature_change;
    (!changes.is_empty()).then(|| Spread::over(changes.iter().copied()))
}

/// Data of a run for the summary, beside its model and its outcome.
#[derive(Debug, Clone)]
pub struct SummaryData {
    /// Data on the points of the model.
    pub of_points: PointStatistics,
    /// Origin of the results.
    pub provenance: Provenance,
    /// Messages of the run.
    pub messages: Vec<Message>,
    /// First bonds that softened and broke.
    pub first: FirstBonds,
    /// Certificate of a run in statics.
    pub certificate: Option<CertificateSummary>,
    /// Stages of the run with their times.
    pub stages: Vec<Stage>,
    /// Passes of a refinement.
    pub refinement: Option<RefinementSummary>,
}

/// Summary of a run.
pub fn summary(
    case: &CaseFile,
    model: &Model,
    boundary: &ProportionalLoading,
    outcome: &Outcome,
    data: SummaryData,
) -> Summary {
    let (units, history) = (model.setup.units(), &outcome.history);
    let without_equilibrium = outcome.is_without_equilibrium();
    let loaded = |point: Option<LoadPoint>| {
        let point = point.filter(|_| !without_equilibrium);
        point.map(PathPoint::from)
    };
    let last_state_not_at_rest = history.last().is_some_and(|last| !last.at_rest);
    let end = (outcome.termination.row().verdict).end(without_equilibrium, last_state_not_at_rest);
    let of_end =
        (end == End::NoEquilibrium).then(|| Message::new("no-equilibrium", INCOMPLETE_RUN_NOTE));
    let warnings = model.warnings.iter().cloned();
    let unsettled = data.refinement.as_ref().and_then(unsettled);
    Summary {
        model: model::model_summary(case, model, data.of_points),
        temperature_change: temperature_change(boundary),
        units: UnitsSummary {
            displacement: units.displacement.into(),
            force: units.force.into(),
        },
        elastic_stiffness: Some(outcome.elastic_stiffness)
            .filter(|stiffness| stiffness.is_finite()),
        first_break: outcome.first_break.map(PathPoint::from),
        first_softened_bond: data.first.softened.map(|it| bond_event(model, &it)),
        first_broken_bond: data.first.broken.map(|it| bond_event(model, &it)),
        peak: loaded(outcome.peak()),
        reactions_at_peak: resultants_at_peak(boundary, model.system.layout, outcome),
        // The force of a motion rises and falls with its waves.
        first_peak: loaded(outcome.first_peak(LOAD_DROP)).filter(|_| outcome.rows != Rows::Times),
        probes_at_end: probes_at_end(model, outcome),
        broken_bonds: outcome.broken_bonds,
        softened_bonds: (model.criteria.soften()).then_some(outcome.softened_bonds),
        steps: history.len().saturating_sub(1),
        exact_path: outcome.rows == Rows::Events,
        motion: motion_summary(&model.setup.analysis, outcome),
        termination: outcome.termination.name().into(),
        termination_message: end_text(outcome, model),
        without_equilibrium,
        last_state_not_at_rest,
        energy_balance_error: energy_balance_error(outcome),
        certificate: data.certificate,
        refinement: data.refinement,
        overlap: outcome.overlap.map(|it| OverlapSummary {
            depth: it.depth,
            step: it.step,
            between: (model.names.numbering().ordered(it.ends)).map(|end| model.names.place(end)),
        }),
        stability: outcome.stability.map(StabilitySummary::from),
        solver: solver_summary(&outcome.costs, &outcome.solver),
        provenance: Some(data.provenance),
        stages: data.stages,
        warnings: merged_messages(warnings.chain(data.messages).chain(of_end).chain(unsettled)),
    }
}

/// Writes the report of a run for the user.
pub fn write(summary: &Summary, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{}", heading(&summary.model.title))?;
    writeln!(out, "{}", summary.model.analysis)?;
    writeln!(out, "  {}", summary.model.formulation)?;
    writeln!(
        out,
        "  points {}, bonds {}, volume {}",
        summary.model.points,
        summary.model.bonds,
        quantity(summary.model.volume, "m^3")
    )?;
    if let Some(motion) = &summary.motion {
        write_motion(motion, out)?;
    }
    write_loads(summary, out)?;
    write_first_bonds(summary, out)?;
    let softened = (summary.softened_bonds).map_or(String::new(), |it| {
        format!(", and {it} more that softened,")
    });
    let of_steps = match &summary.motion {
        Some(motion) => format!("{} time steps", motion.time_steps),
        None if summary.exact_path => format!("{} states of the exact path", summary.steps),
        None => format!("{} load steps", summary.steps),
    };
    let broken = match &summary.certificate {
        Some(it) if summary.last_state_not_at_rest => format!(
            "{} up to the last state at rest, and {} more that broke{softened}",
            it.broken_bonds,
            summary.broken_bonds - it.broken_bonds
        ),
        _ => format!("{}{softened}", summary.broken_bonds),
    };
    writeln!(out, "  broken bonds       {broken} in {of_steps}")?;
    if !summary.without_equilibrium {
        writeln!(out, "  energy balance     {}", summary.energy_balance())?;
    }
    if let Some(certificate) = &summary.certificate {
        write_certificate(certificate, out)?;
    }
    if let Some(refinement) = &summary.refinement {
        write_refinement(refinement, &summary.units.force, out)?;
    }
    writeln!(out, "  ended because      {}", summary.termination_message)?;
    if let Some([head, words]) = summary.warning_of_end() {
        writeln!(out, "  {head:<18} {words}")?;
    }
    for warning in summary.warnings.iter().take(WARNINGS_SHOWN) {
        writeln!(out, "  warning: {warning}")?;
    }
    if summary.warnings.len() > WARNINGS_SHOWN {
        let more = summary.warnings.len() - WARNINGS_SHOWN;
        writeln!(out, "  warning: {more} more in summary.json")?;
    }
    Ok(())
}

/// Whether no state under load was in equilibrium: the largest load is within rounding of zero, relative to the load of the first breakage.
fn has_no_equilibrium_under_load(summary: &Summary) -> bool {
    let event = summary.first_softened_bond.as_ref();
    let event = event.or(summary.first_broken_bond.as_ref());
    // A load program has no predicted breakage; the first event of its first step replaces it.
    let in_first_step = event.filter(|it| it.step == 1).map(|it| it.reaction);
    let foreseen = summary.first_break.map(|it| it.reaction).or(in_first_step);
    let foreseen = foreseen.map_or(0.0, f64::abs);
    let held = summary.peak.map_or(0.0, |it| it.reaction.abs());
    held <= ROUNDING * foreseen && foreseen > 0.0
}

/// Writes the lines about the first bonds that softened and broke.
fn write_first_bonds(summary: &Summary, out: &mut dyn Write) -> io::Result<()> {
    for (name, bond) in [
        ("first softened", &summary.first_softened_bond),
        ("first broken", &summary.first_broken_bond),
    ] {
        if let Some(bond) = bond {
            let words = bond.words(summary.motion.is_some());
            writeln!(out, "  {name:<18} {words}")?;
        }
    }
    Ok(())
}

/// Writes the lines about temperature, stiffness and characteristic loads.
fn write_loads(summary: &Summary, out: &mut dyn Write) -> io::Result<()> {
    let UnitsSummary {
        displacement: along,
        force,
    } = &summary.units;
    if let Some(Spread { min, mean, max }) = summary.temperature_change {
        writeln!(
            out,
            "  temperature change {}, mean {}",
            between([min, max], "K"),
            quantity(mean, "K")
        )?;
    }
    if let Some(stiffness) = summary.elastic_stiffness {
        let stiffness = quantity(stiffness, &summary.units.stiffness());
        writeln!(out, "  elastic stiffness  {stiffness}")?;
    }
    let broke = summary.broken_bonds > 0 || summary.softened_bonds.is_some_and(|it| it > 0);
    let of_breaking = |point: Option<PathPoint>| point.filter(|_| broke);
    let onset = match summary.softened_bonds {
        Some(_) => "first softening",
        None => "first breakage",
    };
    if broke && !summary.without_equilibrium && has_no_equilibrium_under_load(summary) {
        writeln!(
            out,
            "  largest load       none: the body broke in the first load step"
        )?;
        return Ok(());
    }
    let points = [
        (onset, summary.first_break),
        ("first peak", of_breaking(summary.first_peak)),
        ("largest load", summary.peak),
    ];
    let largest = |of: fn(PathPoint) -> f64| {
        let sizes = points.iter().filter_map(|it| it.1).map(of);
        sizes.fold(0.0_f64, |largest, it| largest.max(it.abs()))
    };
    let (most, farthest) = (largest(|it| it.reaction), largest(|it| it.displacement));
    for (name, point) in points {
        if let Some(PathPoint {
            displacement,
            reaction,
            load_factor,
        }) = point.filter(|it| summary.motion.is_none() || it.reaction != 0.0)
        {
            let load = quantity(zero_if_rounding(reaction, most), force);
            let at = match summary.motion {
                Some(_) => quantity(load_factor, "s"),
                None => quantity(zero_if_rounding(displacement, farthest), along),
            };
            writeln!(out, "  {name:<18} {load} at {at}")?;
        }
    }
    Ok(())
}

/// Summary of the first breakage or softening in a model.
fn bond_event(model: &Model, first: &FirstBond) -> BondEvent {
    let ends = model.names.numbering().ordered(first.ends);
    let criteria = model.criteria.list.iter().map(|it| it.name);
    let mut labels = criterion_labels(criteria);
    BondEvent {
        ends: ends.map(|end| model.names.tag(end)),
        place: model.middle(ends),
        step: first.step,
        load_factor: first.load_factor,
        displacement: first.displacement,
        reaction: first.reaction,
        criterion: labels.swap_remove(first.criterion as usize),
        tagged: model.names.tagged(),
    }
}

/// Largest energy that the ledger misses over the largest energy put in.
fn energy_balance_error(outcome: &Outcome) -> f64 {
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    let put_in = largest(&mut outcome.at_rest().map(StepRecord::energy_put_in));
    let missing = largest(&mut outcome.at_rest().map(|step| step.missing_energy().abs()));
    if put_in > 0.0 { missing / put_in } else { 0.0 }
}

/// Values of the probes in the last state.
fn probes_at_end(model: &Model, outcome: &Outcome) -> BTreeMap<String, f64> {
    let names = model.setup.probes.iter().map(|probe| probe.name.clone());
    let values = outcome.history.last().into_iter().flat_map(|it| &it.probes);
    let named = names.zip(values.copied());
    named.filter(|(_, value)| value.is_finite()).collect()
}

/// Resultants of the groups, by their names in the history, at the record with the largest reaction and no bond left to break.
fn resultants_at_peak(
    loads: &dyn LoadProgram,
    layout: Layout,
    outcome: &Outcome,
) -> BTreeMap<String, Resultant> {
    let at_rest = outcome.history.iter().filter(|record| record.at_rest);
    let higher = |best: &'_ StepRecord, record: &'_ StepRecord| record.reaction > best.reaction;
    let peak = at_rest.reduce(|best, record| if higher(best, record) { record } else { best });
    let groups = loads.groups().iter().map(|group| group.name.clone());
    let forces = peak.iter().flat_map(|record| &record.group_forces);
    let resultant = |force: &Vec<f64>| -> Resultant {
        let of_body = layout.of_body().iter();
        let named = of_body.map(|it| (it.force_name().into(), layout.value(0, *it, force)));
        named.collect()
    };
    groups.zip(forces.map(resultant)).collect()
}
