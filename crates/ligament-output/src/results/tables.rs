//! The CSV tables of a run.

use ligament_analysis::costs::Costs;
use ligament_analysis::driver::Problem;
use ligament_analysis::history::{BreakRecord, StepRecord, View};
use ligament_analysis::{Bonds, Component};

use crate::Error;
use crate::csv::{Table, Value};
use crate::folder::ResultFolder;

const HISTORY: [&str; 17] = [
    "step",
    "load_factor",
    "displacement",
    "reaction",
    "stored_energy",
    "released_energy",
    "broken_bonds",
    "external_work",
    "energy_error",
    "broken_in_step",
    "largest_ratio",
    "rounds",
    "solves",
    "fragments",
    "at_rest",
    "negative_eigenvalues",
    "dissipated_energy",
];
const ITERATIONS: [&str; 7] = [
    "step",
    "round",
    "iteration",
    "load_factor",
    "residual",
    "stored_energy",
    "broken_bonds",
];
const BREAKS: [&str; 6] = [
    "order",
    "step",
    "round",
    "load_factor",
    "displacement",
    "reaction",
];
const TIMINGS: [&str; 8] = [
    "step",
    "assembly_s",
    "factorisation_s",
    "change_s",
    "backward_s",
    "solve_s",
    "bonds_s",
    "connectivity_s",
];

const CRITERIA: [&str; 3] = ["criterion", "measure", "after"];

/// Names of the failure criteria in results, each different: a second criterion of the same name ends in -2.
pub(super) fn labels<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
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

/// Writes the table of what each criterion looks at and what happens after its limit.
fn write_criteria(
    folder: &ResultFolder,
    problem: &Problem,
    labels: &[String],
) -> Result<(), Error> {
    let mut table = Table::create(folder.file("criteria.csv"), &CRITERIA)?;
    for (criterion, label) in problem.criteria.list.iter().zip(labels) {
        table.append(&[
            label.as_str().into(),
            criterion.measure.word().into(),
            criterion.after.word().into(),
        ])?;
    }
    Ok(())
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
    /// Components of the deformation of a bond that a row has.
    n_components: usize,
}

/// Names of the components of a bond's deformation in results. The relative rotation of the two ends is left out, because no
/// criterion looks at it.
pub(super) fn deformation_names(system: &dyn Bonds) -> &'static [&'static str] {
    told(system.strain_names())
}

/// The strains that results have of those with these names.
pub(super) fn told(names: &'static [&'static str]) -> &'static [&'static str] {
    match names {
        [told @ .., "rotation"] => told,
        all => all,
    }
}

impl Tables {
    /// Creates the tables; `tagged` is what the tags of bonds' ends are of: nodes or cells.
    pub(super) fn create(
        folder: &ResultFolder,
        problem: &Problem,
        tagged: &str,
    ) -> Result<Self, Error> {
        let criteria = labels(problem.criteria.list.iter().map(|criterion| criterion.name));
        write_criteria(folder, problem, &criteria)?;
        let groups = problem.loads.groups().iter();
        let group_columns = groups.flat_map(|group| {
            ["force_x", "force_y", "moment"].map(|c| format!("{}.{c}", group.name))
        });
        let extra: Vec<String> = group_columns
            .chain(problem.probes.iter().map(|probe| probe.name.clone()))
            .collect();
        let history_columns: Vec<&str> = HISTORY
            .into_iter()
            .chain(extra.iter().map(String::as_str))
            .collect();
        let ends = ["a", "b"].map(|end| format!("{tagged}_{end}"));
        let breaks_columns: Vec<&str> = (BREAKS.into_iter())
            .chain(ends.iter().map(String::as_str))
            .chain(["utilisation", "criterion"])
            .chain(deformation_names(&*problem.system).iter().copied())
            .collect();
        Ok(Self {
            history: Table::create(folder.file("history.csv"), &history_columns)?,
            iterations: Table::create(folder.file("iterations.csv"), &ITERATIONS)?,
            breaks: Table::create(folder.file("breaks.csv"), &breaks_columns)?,
            timings: Table::create(folder.file("timings.csv"), &TIMINGS)?,
            criteria,
            n_components: deformation_names(&*problem.system).len(),
            step: 0,
            round: 0,
            load_factor: 0.0,
            broken: 0,
            costs_before: Costs::default(),
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

    pub(super) fn breaks(
        &mut self,
        records: &[BreakRecord],
        tags: &[i64],
        ends: &[[u32; 2]],
    ) -> Result<(), Error> {
        for record in records {
            let [a, b] = ends[record.bond as usize].map(|end| tags[end as usize]);
            let mut row: Vec<Value<'_>> = vec![
                record.order.into(),
                record.step.into(),
                record.round.into(),
                record.load_factor.into(),
                record.displacement.into(),
                record.reaction.into(),
                a.into(),
                b.into(),
                record.ratio.into(),
                self.criteria[record.criterion].as_str().into(),
            ];
            let components = record.deformation.strains().into_iter();
            row.extend(components.take(self.n_components).map(Value::from));
            self.breaks.append(&row)?;
        }
        Ok(())
    }

    pub(super) fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), Error> {
        let mut row: Vec<Value<'_>> = vec![
            record.step.into(),
            record.load_factor.into(),
            record.displacement.into(),
            record.reaction.into(),
            record.stored_energy.into(),
            record.released_energy.into(),
            record.broken_bonds.into(),
            record.external_work.into(),
            record.energy_error().into(),
            record.broken_in_step.into(),
            record.largest_ratio.into(),
            record.rounds.into(),
            record.solves.into(),
            record.fragments.into(),
            usize::from(record.at_rest).into(),
            record.negative_eigenvalues.into(),
            record.dissipated_energy.into(),
        ];
        let layout = view.system.layout();
        let of_groups = record.group_forces.iter().flat_map(|force| {
            // The forces of a group stand as those of one point.
            Component::ALL.map(|component| layout.value(0, component, force))
        });
        row.extend(of_groups.map(Value::from));
        row.extend(record.probes.iter().map(|&value| Value::from(value)));
        self.history.append(&row)?;
        self.time(record.step, view.costs)
    }

    fn time(&mut self, step: usize, costs: &Costs) -> Result<(), Error> {
        let before = std::mem::replace(&mut self.costs_before, *costs);
        let seconds = |now: std::time::Duration, then: std::time::Duration| {
            Value::from((now - then).as_secs_f64())
        };
        self.timings.append(&[
            step.into(),
            seconds(costs.assembly, before.assembly),
            seconds(costs.factorisation, before.factorisation),
            seconds(costs.change, before.change),
            seconds(costs.backward, before.backward),
            seconds(costs.solve, before.solve),
            seconds(costs.bonds, before.bonds),
            seconds(costs.connectivity, before.connectivity),
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::labels;

    #[test]
    fn criteria_of_one_name_are_told_apart() {
        let names = ["tension", "sliding", "tension", "tension"];
        assert_eq!(
            labels(names.into_iter()),
            ["tension", "sliding", "tension-2", "tension-3"]
        );
    }
}
