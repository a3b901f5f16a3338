//! First broken or softened bonds, and reactions at the largest load, for the summary.

use std::collections::BTreeMap;

use ligament::Model;
use ligament_analysis::driver::Outcome;
use ligament_analysis::first_bonds::FirstBond;
use ligament_analysis::history::StepRecord;
use ligament_analysis::{Layout, LoadProgram};
use ligament_output::results::criterion_labels;
use ligament_output::summary::{BondEvent, Resultant};

/// Summary of the first breakage or softening in a model.
pub(super) fn bond_event(model: &Model, first: &FirstBond) -> BondEvent {
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
/// Resultants of the groups, by their names in the history, at the record with the largest reaction and no bond left to break.
pub(super) fn resultants_at_peak(
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
