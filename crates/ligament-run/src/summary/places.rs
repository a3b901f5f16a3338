//! Where a body gave way first, and what held it at the largest load.

use std::collections::BTreeMap;
use std::fmt;

use ligament::Model;
use ligament_analysis::driver::Outcome;
use ligament_analysis::first_bonds::FirstBond;
use ligament_analysis::history::StepRecord;
use ligament_analysis::{Layout, LoadProgram};
use ligament_output::quantity::place;
use ligament_output::results::criterion_labels;
use serde::Serialize;

/// A bond that broke or began to soften before all others.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BondEvent {
    /// Tags of the ends of the bond.
    pub ends: [u64; 2],
    /// Middle of the bond, m.
    pub place: Vec<f64>,
    /// Load step or event.
    pub step: usize,
    /// Load factor.
    pub load_factor: f64,
    /// Displacement of the first load.
    pub displacement: f64,
    /// Force of the first load.
    pub reaction: f64,
    /// The criterion.
    pub criterion: String,
    /// What tags are of: `node` or `cell`.
    #[serde(skip)]
    tagged: &'static str,
}

/// Resultant of what a group with supports or loads exerts on the body, by names: force_x and force_y, N, and moment, the sum of
/// the moments on its points, N m; in space force_x to force_z and moment_x to moment_z.
pub type Resultant = BTreeMap<&'static str, f64>;

impl BondEvent {
    /// What happened to a bond of a model.
    pub(super) fn new(model: &Model, first: &FirstBond) -> Self {
        let ends = model.system.numbering().ordered(first.ends);
        let criteria = model.criteria.list.iter().map(|it| it.name);
        let mut labels = criterion_labels(criteria);
        Self {
            ends: ends.map(|end| model.body().tag(end)),
            place: model.middle(ends),
            step: first.step,
            load_factor: first.load_factor,
            displacement: first.displacement,
            reaction: first.reaction,
            criterion: labels.swap_remove(first.criterion as usize),
            tagged: model.body().tagged(),
        }
    }
}

impl fmt::Display for BondEvent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [a, b] = self.ends;
        let (tagged, criterion) = (self.tagged, &self.criterion);
        write!(
            f,
            "{tagged}s {a} and {b} at {}, in step {}, by {criterion}",
            place(&self.place),
            self.step
        )
    }
}

/// The resultants of all groups at the record at rest with the largest reaction, by their names as in the history.
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
        let named = of_body.map(|it| (it.force_name(), layout.value(0, *it, force)));
        named.collect()
    };
    groups.zip(forces.map(resultant)).collect()
}
