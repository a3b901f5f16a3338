//! The CSV tables of a run.

use ligament_analysis::Bonds;
use ligament_analysis::costs::Costs;
use ligament_analysis::driver::Problem;
use ligament_analysis::history::{BreakRecord, StepRecord, View};
use ligament_model::BodyGrid;
use serde::{Deserialize, Serialize};

use super::columns::{
    BREAKS, CLOSING, CONTACT, CONTACTS, CRITERIA, ENDS, FAILURE, HISTORY, ITERATIONS, MOTION,
    RIGID_BODIES, Reading, STAGES, STEP, TIMINGS, names, readings,
};
use crate::Error;
use crate::csv::{Table, Value};
use crate::file_digest::FileDigest;
use crate::folder::ResultFolder;

/// Names of the tables that grow during a run.
pub(super) const FILES: [&str; 4] = ["history.csv", "iterations.csv", "breaks.csv", "timings.csv"];

/// Name of the table of the failure criteria.
pub(super) const CRITERIA_FILE: &str = "criteria.csv";

/// Names of the failure criteria in results, each different: a second criterion of the same name ends in -2.
pub fn criterion_labels<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut labels: Vec<String> = Vec::new();
    let mut seen: Vec<&str> = Vec::new();
    for name in names {
        seen.push(name);
        labels.push(match seen.iter().filter(|other| **other == name).count() {
            1 => name.to_owned(),
            count => format!("{name}-{count}"),
        });
    }
    labels
}

/// Names of the failure criteria of a problem in results.
pub(super) fn labels_of(problem: &Problem) -> Vec<String> {
    criterion_labels(problem.criteria.list.iter().map(|criterion| criterion.name))
}

/// Writes the table of the criteria's measures and laws after the limit.
fn write_criteria(
    folder: &ResultFolder,
    problem: &Problem,
    labels: &[String],
) -> Result<(), Error> {
    let mut table = Table::create(folder.file(CRITERIA_FILE), &names(CRITERIA, false))?;
    for (criterion, label) in problem.criteria.list.iter().zip(labels) {
        table.append(&[
            label.as_str().into(),
            criterion.measure.word().into(),
            criterion.after.text().as_str().into(),
        ])?;
    }
    Ok(())
}

/// Columns of the history for stages: the stage, and the factor of each load.
fn stage_columns(problem: &Problem) -> Vec<String> {
    let Some(loads) = problem.loads.course() else {
        return Vec::new();
    };
    let [stage, factor] = [0, 1].map(|it| STAGES[it].name);
    let loads = loads.programme.names.iter();
    let factors = loads.map(|name| factor.replace("LOAD", name));
    std::iter::once(stage.to_owned()).chain(factors).collect()
}

/// Function that opens a table, given by its index in [`FILES`] and its columns.
type OpenTable<'a> = &'a dyn Fn(usize, &[&str]) -> Result<Table, Error>;

/// State of the tables of a run in a checkpoint.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct TablesProgress {
    /// Length and digest of each of [`FILES`].
    pub(super) of_files: [FileDigest; 4],
    /// Costs up to the last row of timings.
    costs: Costs,
}

pub(super) struct Tables {
    history: Table,
    iterations: Table,
    breaks: Table,
    timings: Table,
    /// Names of the failure criteria.
    criteria: Vec<String>,
    step: usize,
    round: usize,
    load_factor: f64,
    broken: usize,
    costs_before: Costs,
    /// Number of components of a bond's deformation in a row.
    n_components: usize,
}

/// Names of the components of a bond's deformation in results, without the relative rotation of the ends, which enters no criterion.
pub(super) fn deformation_names(system: &dyn Bonds) -> &'static [&'static str] {
    stored_names(system.element.strain_names())
}

/// Names of the stored components of a bond's deformation: all names but a last `rotation`.
pub(super) fn stored_names(names: &'static [&'static str]) -> &'static [&'static str] {
    match names {
        [stored @ .., "rotation"] => stored,
        all => all,
    }
}

/// Names of the columns of a contact or a rigid body with a given name.
fn names_of_body<R>(columns: &'static [Reading<R>], name: &str, in_space: bool) -> Vec<String> {
    let of_it = |column: &Reading<R>| match column.0.name.split_once('.') {
        Some((_, quantity)) => format!("{name}.{quantity}"),
        None => column.0.name.to_owned(),
    };
    readings(columns, in_space).map(of_it).collect()
}

/// Names of the columns of the history of a problem.
pub fn history_columns(problem: &Problem) -> Vec<String> {
    let groups = problem.loads.groups().iter();
    let of_body = problem.system.layout.of_body();
    let of_groups = groups.flat_map(|group| {
        let names = of_body.iter().map(|it| it.force_name());
        names.map(|it| format!("{}.{it}", group.name))
    });
    let closing = CLOSING.iter().filter(|_| problem.system.faces_close);
    let contact = CONTACT.iter().filter(|_| problem.has_contact_at_rest());
    let motion = MOTION.iter().filter(|_| problem.loads.is_in_time());
    let in_space = problem.system.layout.is_in_space();
    let contacts = problem.contact.contacts.iter().map(|it| &it.name);
    let contacts = contacts.flat_map(|it| names_of_body(CONTACTS, it, in_space));
    let rigid = problem.contact.rigid_bodies.iter().map(|it| &it.name);
    let rigid = rigid.flat_map(|it| names_of_body(RIGID_BODIES, it, in_space));
    (HISTORY.iter().map(|it| it.0.name.to_owned()))
        .chain(stage_columns(problem))
        .chain(closing.map(|it| it.0.name.to_owned()))
        .chain(contact.map(|it| it.0.name.to_owned()))
        .chain(motion.map(|it| it.0.name.to_owned()))
        .chain(of_groups)
        .chain(contacts)
        .chain(rigid)
        .chain(problem.probes.iter().map(|probe| probe.name.clone()))
        .collect()
}

/// Values of a record in the [columns of the history](history_columns).
pub fn history_row<'a>(record: &StepRecord, view: &View<'a>) -> Vec<Value<'a>> {
    let mut row: Vec<Value<'_>> = HISTORY.iter().map(|column| column.1(record)).collect();
    if let Some(loads) = view.loads.course() {
        let stage = loads.programme.stage_name(record.part);
        row.push(stage.into());
        row.extend(record.factors.iter().map(|&factor| Value::from(factor)));
    }
    let closing = CLOSING.iter().filter(|_| view.system.faces_close);
    row.extend(closing.map(|column| column.1(record)));
    if let Some(contact) = &record.contact {
        row.extend(CONTACT.iter().map(|column| column.1(contact)));
    }
    if let Some(motion) = &record.motion {
        let moment = (record.load_factor, *motion);
        row.extend(MOTION.iter().map(|column| column.1(&moment)));
    }
    let layout = view.system.layout;
    let of_groups = record.group_forces.iter().flat_map(|force| {
        // The resultant of a group has the layout of one point.
        let of_body = layout.of_body().iter();
        of_body.map(move |component| layout.value(0, *component, force))
    });
    row.extend(of_groups.map(Value::from));
    let in_space = layout.is_in_space();
    for contact in &record.contacts {
        row.extend(readings(CONTACTS, in_space).map(|column| column.1(contact)));
    }
    for body in &record.rigid_bodies {
        row.extend(readings(RIGID_BODIES, in_space).map(|column| column.1(body)));
    }
    row.extend(record.probes.iter().map(|&value| Value::from(value)));
    row
}

/// Names of the columns of the table of breakages of a problem; `tagged` is the kind of the tags of bonds' ends, nodes or cells.
pub(super) fn break_columns(problem: &Problem, tagged: &str) -> Vec<String> {
    let breaks = BREAKS.iter().map(|it| it.0.name);
    let strains = deformation_names(&*problem.system).iter().copied();
    (breaks
        .chain(ends(tagged))
        .chain(names(FAILURE, false))
        .chain(strains))
    .map(str::to_owned)
    .collect()
}

/// Names of the columns of the ends of a bond; `tagged` is the kind of their tags, nodes or cells.
pub(super) fn ends(tagged: &str) -> impl Iterator<Item = &'static str> {
    let names = ENDS.iter().map(|it| it.name);
    names.filter(move |it| it.starts_with(tagged))
}

/// Values of a record in the [columns of the breakages](break_columns), from the tags of the ends, the names of the criteria, and the
/// number of components of the deformation.
pub(super) fn break_row<'a>(
    record: &BreakRecord,
    ends: [i64; 2],
    criteria: &'a [String],
    n_components: usize,
) -> Vec<Value<'a>> {
    let mut row: Vec<Value<'_>> = BREAKS.iter().map(|column| column.1(record)).collect();
    row.extend(ends.map(Value::from));
    row.push(record.ratio.into());
    row.push(criteria[record.criterion].as_str().into());
    let components = record.deformation.strains().into_iter();
    row.extend(components.take(n_components).map(Value::from));
    row
}

impl Tables {
    /// Creates the tables; `tagged` is the kind of the tags of bonds' ends, nodes or cells.
    pub(super) fn create(
        folder: &ResultFolder,
        problem: &Problem,
        tagged: &str,
    ) -> Result<Self, Error> {
        write_criteria(folder, problem, &labels_of(problem))?;
        let create =
            |place: usize, columns: &[&str]| Table::create(folder.file(FILES[place]), columns);
        Self::open_all(problem, tagged, Costs::default(), &create)
    }

    /// The tables of a resumed run, truncated to their state in the checkpoint.
    pub(super) fn resume(
        folder: &ResultFolder,
        problem: &Problem,
        tagged: &str,
        progress: &TablesProgress,
    ) -> Result<Self, Error> {
        let resume = |place: usize, columns: &[&str]| {
            let length = progress.of_files[place].length;
            Table::open_truncated(folder.file(FILES[place]), columns.len(), length)
        };
        Self::open_all(problem, tagged, progress.costs, &resume)
    }

    /// Syncs the tables to disk and returns their state.
    pub(super) fn progress(&self) -> Result<TablesProgress, Error> {
        let [history, iterations, breaks, timings] =
            [&self.history, &self.iterations, &self.breaks, &self.timings].map(Table::sync);
        Ok(TablesProgress {
            of_files: [history?, iterations?, breaks?, timings?],
            costs: self.costs_before,
        })
    }

    /// The tables, each opened by `table`.
    fn open_all(
        problem: &Problem,
        tagged: &str,
        costs_before: Costs,
        table: OpenTable<'_>,
    ) -> Result<Self, Error> {
        let [history, breaks] = [history_columns(problem), break_columns(problem, tagged)];
        let [history, breaks] =
            [&history, &breaks].map(|names| names.iter().map(String::as_str).collect::<Vec<_>>());
        let timings: Vec<&str> = (STEP.iter())
            .chain(TIMINGS.iter().map(|it| &it.0))
            .map(|column| column.name)
            .collect();
        Ok(Self {
            history: table(0, &history)?,
            iterations: table(1, &names(ITERATIONS, false))?,
            breaks: table(2, &breaks)?,
            timings: table(3, &timings)?,
            criteria: labels_of(problem),
            n_components: deformation_names(&*problem.system).len(),
            step: 0,
            round: 0,
            load_factor: 0.0,
            broken: 0,
            costs_before,
        })
    }

    pub(super) fn enter_round(
        &mut self,
        step: usize,
        round: usize,
        load_factor: f64,
        broken: usize,
    ) {
        (self.step, self.round, self.load_factor, self.broken) = (step, round, load_factor, broken);
    }

    pub(super) fn iteration(
        &mut self,
        iteration: usize,
        residual: f64,
        stored_energy: f64,
    ) -> Result<(), Error> {
        self.iterations.append(&[
            self.step.into(),
            self.round.into(),
            iteration.into(),
            self.load_factor.into(),
            residual.into(),
            stored_energy.into(),
            self.broken.into(),
        ])
    }

    pub(super) fn breaks(&mut self, records: &[BreakRecord], grid: &BodyGrid) -> Result<(), Error> {
        for record in records {
            let ends = grid.tags_of(record.ends);
            let row = break_row(record, ends, &self.criteria, self.n_components);
            self.breaks.append(&row)?;
        }
        Ok(())
    }

    pub(super) fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), Error> {
        self.history.append(&history_row(record, view))?;
        self.time(record.step, view.costs)
    }

    fn time(&mut self, step: usize, costs: &Costs) -> Result<(), Error> {
        let before = std::mem::replace(&mut self.costs_before, *costs);
        let seconds = TIMINGS.iter().map(|(_, of)| of(costs) - of(&before));
        let row: Vec<Value<'_>> = (std::iter::once(step.into()))
            .chain(seconds.map(|it| it.as_secs_f64().into()))
            .collect();
        self.timings.append(&row)
    }
}

#[cfg(test)]
mod tests {
    use super::criterion_labels;

    #[test]
    fn criteria_of_one_name_are_told_apart() {
        let names = ["tension", "sliding", "tension", "tension"];
        assert_eq!(
            criterion_labels(names.into_iter()),
            ["tension", "sliding", "tension-2", "tension-3"]
        );
    }
}
