//! The CSV tables of a run.

use std::time::Duration;

use ligament_analysis::costs::Costs;
use ligament_analysis::driver::Problem;
use ligament_analysis::history::{BreakRecord, StepRecord, View};
use ligament_analysis::{Bonds, serial};
use ligament_model::BodyGrid;

use crate::Error;
use crate::csv::{Table, Value};
use crate::folder::ResultFolder;
use crate::written::Written;

/// A column of a table: its name, and its value in the row of a record.
type Column<R> = (&'static str, fn(&R) -> Value<'static>);

/// A column of times: its name, and what it takes of the costs of a step.
type Timing = (&'static str, fn(&Costs) -> Duration);

const HISTORY: [Column<StepRecord>; 17] = [
    ("step", |it| it.step.into()),
    ("load_factor", |it| it.load_factor.into()),
    ("displacement", |it| it.displacement.into()),
    ("reaction", |it| it.reaction.into()),
    ("stored_energy", |it| it.stored_energy.into()),
    ("released_energy", |it| it.released_energy.into()),
    ("broken_bonds", |it| it.broken_bonds.into()),
    ("external_work", |it| it.external_work.into()),
    ("energy_error", |it| it.energy_error().into()),
    ("broken_in_step", |it| it.broken_in_step.into()),
    ("largest_ratio", |it| it.largest_ratio.into()),
    ("rounds", |it| it.rounds.into()),
    ("solves", |it| it.solves.into()),
    ("fragments", |it| it.fragments.into()),
    ("at_rest", |it| usize::from(it.at_rest).into()),
    ("negative_eigenvalues", |it| it.negative_eigenvalues.into()),
    ("dissipated_energy", |it| it.dissipated_energy.into()),
];
/// The column of a body whose crack faces close.
const CLOSED: Column<StepRecord> = ("closed_pairs", |it| it.closed_pairs.into());
const ITERATIONS: [&str; 7] = [
    "step",
    "round",
    "iteration",
    "load_factor",
    "residual",
    "stored_energy",
    "broken_bonds",
];
const BREAKS: [Column<BreakRecord>; 6] = [
    ("order", |it| it.order.into()),
    ("step", |it| it.step.into()),
    ("round", |it| it.round.into()),
    ("load_factor", |it| it.load_factor.into()),
    ("displacement", |it| it.displacement.into()),
    ("reaction", |it| it.reaction.into()),
];
/// Columns of the table of times, behind the step.
const TIMINGS: [Timing; 7] = [
    ("assembly_s", |it| it.assembly),
    ("factorisation_s", |it| it.factorisation),
    ("change_s", |it| it.change),
    ("backward_s", |it| it.backward),
    ("solve_s", |it| it.solve),
    ("bonds_s", |it| it.bonds),
    ("connectivity_s", |it| it.connectivity),
];

/// The tables that grow with a run.
pub(super) const FILES: [&str; 4] = ["history.csv", "iterations.csv", "breaks.csv", "timings.csv"];

/// The table of the failure criteria.
pub(super) const CRITERIA_FILE: &str = "criteria.csv";
const CRITERIA: [&str; 3] = ["criterion", "measure", "after"];

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
pub fn labels_of(problem: &Problem) -> Vec<String> {
    criterion_labels(problem.criteria.list.iter().map(|criterion| criterion.name))
}

/// Writes the table of what each criterion looks at and what happens after its limit.
fn write_criteria(
    folder: &ResultFolder,
    problem: &Problem,
    labels: &[String],
) -> Result<(), Error> {
    let mut table = Table::create(folder.file(CRITERIA_FILE), &CRITERIA)?;
    for (criterion, label) in problem.criteria.list.iter().zip(labels) {
        table.append(&[
            label.as_str().into(),
            criterion.measure.word().into(),
            criterion.after.word().into(),
        ])?;
    }
    Ok(())
}

/// Columns of the history that stages add: the stage, and the factor of each load.
fn stage_columns(problem: &Problem) -> Vec<String> {
    let Some(loads) = problem.loads.course() else {
        return Vec::new();
    };
    let names = loads.programme.names.iter();
    let factors = names.map(|name| format!("{name}_factor"));
    std::iter::once("stage".to_owned()).chain(factors).collect()
}

/// How a table is opened, by its place in [`FILES`] and its columns.
type Opening<'a> = &'a dyn Fn(usize, &[&str]) -> Result<Table, Error>;

/// How far the tables of a run are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Progress {
    /// What was written of each of [`FILES`].
    pub(super) of_files: [Written; 4],
    /// Costs up to the last row of times.
    costs: Costs,
}

serial!(Progress { of_files, costs });

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
    /// Components of the deformation of a bond that a row has.
    n_components: usize,
}

/// Names of the components of a bond's deformation in results. The relative rotation of the two ends is left out, because no
/// criterion looks at it.
pub fn deformation_names(system: &dyn Bonds) -> &'static [&'static str] {
    told(system.strain_names())
}

/// The strains that results have of those with these names.
pub(super) fn told(names: &'static [&'static str]) -> &'static [&'static str] {
    match names {
        [told @ .., "rotation"] => told,
        all => all,
    }
}

/// Names of the columns of the history of a problem.
pub fn history_columns(problem: &Problem) -> Vec<String> {
    let groups = problem.loads.groups().iter();
    let of_body = problem.system.layout().of_body();
    let of_groups = groups.flat_map(|group| {
        let names = of_body.iter().map(|it| it.force_name());
        names.map(|it| format!("{}.{it}", group.name))
    });
    let of_faces = problem.system.faces_close().then(|| CLOSED.0.to_owned());
    (HISTORY.iter().map(|column| column.0.to_owned()))
        .chain(stage_columns(problem))
        .chain(of_faces)
        .chain(of_groups)
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
    if view.system.faces_close() {
        row.push(CLOSED.1(record));
    }
    let layout = view.system.layout();
    let of_groups = record.group_forces.iter().flat_map(|force| {
        // The forces of a group stand as those of one point.
        let of_body = layout.of_body().iter();
        of_body.map(move |component| layout.value(0, *component, force))
    });
    row.extend(of_groups.map(Value::from));
    row.extend(record.probes.iter().map(|&value| Value::from(value)));
    row
}

/// Names of the columns of the table of breakages of a problem; `tagged` is what the tags of bonds' ends are of: nodes or cells.
pub fn break_columns(problem: &Problem, tagged: &str) -> Vec<String> {
    let ends = ["a", "b"].map(|end| format!("{tagged}_{end}"));
    let more = (["utilisation", "criterion"].iter()).chain(deformation_names(&*problem.system));
    (BREAKS.iter().map(|column| column.0.to_owned()))
        .chain(ends)
        .chain(more.map(|&name| name.to_owned()))
        .collect()
}

/// Values of a record in the [columns of the breakages](break_columns): tags of the ends, names of the criteria, and so many
/// components of the deformation.
pub fn break_row<'a>(
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
    /// Creates the tables; `tagged` is what the tags of bonds' ends are of: nodes or cells.
    pub(super) fn create(
        folder: &ResultFolder,
        problem: &Problem,
        tagged: &str,
    ) -> Result<Self, Error> {
        write_criteria(folder, problem, &labels_of(problem))?;
        let create =
            |place: usize, columns: &[&str]| Table::create(folder.file(FILES[place]), columns);
        Self::with(problem, tagged, Costs::default(), &create)
    }

    /// The tables of a run that goes on, cut back to where it was.
    pub(super) fn cut_back(
        folder: &ResultFolder,
        problem: &Problem,
        tagged: &str,
        progress: &Progress,
    ) -> Result<Self, Error> {
        let cut_back = |place: usize, columns: &[&str]| {
            let length = progress.of_files[place].length;
            Table::cut_back(folder.file(FILES[place]), columns.len(), length)
        };
        Self::with(problem, tagged, progress.costs, &cut_back)
    }

    /// How far the tables are; what they have is safely on the disk when this returns.
    pub(super) fn progress(&self) -> Result<Progress, Error> {
        let [history, iterations, breaks, timings] =
            [&self.history, &self.iterations, &self.breaks, &self.timings].map(Table::synced);
        Ok(Progress {
            of_files: [history?, iterations?, breaks?, timings?],
            costs: self.costs_before,
        })
    }

    /// The tables, each opened so.
    fn with(
        problem: &Problem,
        tagged: &str,
        costs_before: Costs,
        table: Opening<'_>,
    ) -> Result<Self, Error> {
        let [history, breaks] = [history_columns(problem), break_columns(problem, tagged)];
        let [history, breaks] =
            [&history, &breaks].map(|names| names.iter().map(String::as_str).collect::<Vec<_>>());
        let timings: Vec<&str> = (["step"].into_iter())
            .chain(TIMINGS.iter().map(|column| column.0))
            .collect();
        Ok(Self {
            history: table(0, &history)?,
            iterations: table(1, &ITERATIONS)?,
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
        let seconds = TIMINGS.map(|(_, of)| (of(costs) - of(&before)).as_secs_f64());
        let row: Vec<Value<'_>> = (std::iter::once(step.into()))
            .chain(seconds.map(Value::from))
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
