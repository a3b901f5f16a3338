//! Quantities that every row of the history of a run has.
//!
//! | name | quantity |
//! |---|---|
//! | `probe.NAME` | a probe, whose `-` is `_` here |
//! | `history.rows`, `history.time` | number of rows; time of a motion, load factor of other runs |
//! | `reaction`, `displacement` | of the first load |
//! | `fragments` | number of connected parts |
//! | `motion.friction`, `motion.initial` | energy that friction took, and energy at the start, J |
//! | `contact.N` | force that presses the bodies of the contact N, N |
//! | `rigid.N.u_x`, `rigid.N.force_x` | displacement of the rigid body N and force on it |
//! | `group.N.x` | force of the boundary group N on the body, N |
//! | `velocity.all`, `velocity.beyond` | sum of the velocities along x of all points, or of the points with x > `between`, m/s |

use anyhow::{Context, bail};
use ligament::run::Solution;
use ligament_analysis::history::{BreakRecord, ObserverError, StepRecord, View};
use ligament_analysis::{Component, Observer};

use crate::case_run::Number;

/// First words of the names.
pub(super) const NAMES: [&str; 10] = [
    "probe",
    "history",
    "reaction",
    "displacement",
    "fragments",
    "motion",
    "contact",
    "rigid",
    "group",
    "velocity",
];

/// Value of a quantity in a row.
pub(super) fn value(solution: &Solution, row: &StepRecord, name: &str) -> anyhow::Result<f64> {
    let words: Vec<&str> = name.split('.').collect();
    let component = |values: &[f64], axis: &str| {
        let place = ["x", "y", "z"].iter().position(|it| *it == axis);
        place.and_then(|place| values.get(place)).copied()
    };
    let found = match words[..] {
        ["history", "rows"] => Some(solution.outcome.history.len() as f64),
        ["history", "time"] => Some(row.load_factor),
        ["reaction"] => Some(row.reaction),
        ["displacement"] => Some(row.displacement),
        ["fragments"] => Some(row.fragments as f64),
        ["motion", "friction"] => row.motion.map(|it| it.friction_energy),
        ["motion", "initial"] => row.motion.map(|it| it.initial_energy),
        ["probe", name] => {
            let name = name.replace('_', "-");
            let place = solution.probes.iter().position(|probe| probe.name == name);
            let place = place.with_context(|| format!("the run has no probe `{name}`"))?;
            row.probes.get(place).copied()
        }
        ["contact", number] => row
            .contacts
            .get(number.parse::<usize>()?)
            .map(|it| it.pressing),
        ["group", number, axis] => {
            let force = row.group_forces.get(number.parse::<usize>()?);
            force.and_then(|it| component(it, axis))
        }
        ["rigid", number, of] => {
            let body = row.rigid_bodies.get(number.parse::<usize>()?);
            body.and_then(|it| match of.split_once('_')? {
                ("u", axis) => component(&it.displacement, axis),
                ("force", axis) => component(&it.force, axis),
                _ => None,
            })
        }
        _ => bail!("no quantity of a row is called `{name}`"),
    };
    found.with_context(|| format!("the run has no `{name}`"))
}

/// Collector of breakages and velocities during a run.
pub(super) struct HistoryCollector {
    /// All breakages in their order.
    pub(super) breaks: Vec<BreakRecord>,
    /// Velocities of all degrees of freedom in all rows, where they are needed.
    velocities: Option<Vec<Vec<f64>>>,
}

impl HistoryCollector {
    /// Collects the data that the quantities of these names need.
    pub(super) fn new<'a>(mut names: impl Iterator<Item = &'a str>) -> Self {
        let needs_velocities = names.any(|it| it.starts_with("velocity."));
        Self {
            breaks: Vec::new(),
            velocities: needs_velocities.then(Vec::new),
        }
    }

    /// Values of a quantity in all rows.
    pub(super) fn values(
        &self,
        solution: &Solution,
        name: &str,
        number: Number<'_>,
    ) -> anyhow::Result<Vec<f64>> {
        let Some(part) = name.strip_prefix("velocity.") else {
            let rows = solution.outcome.history.iter();
            return rows.map(|row| value(solution, row, name)).collect();
        };
        let from = match part {
            "all" => f64::NEG_INFINITY,
            "beyond" => number("between")?,
            other => bail!("no velocity of `{other}`"),
        };
        let body = solution.model.plane();
        let (layout, cloud) = (body.topology().layout, &body.cloud);
        let x = |point: u32| cloud.positions[point as usize][0] + cloud.origin[0];
        let sum = |velocities: &Vec<f64>| {
            let points = (0..cloud.len() as u32).filter(|&point| x(point) > from);
            points
                .map(|point| layout.value(point, Component::X, velocities))
                .sum()
        };
        Ok(self.velocities.iter().flatten().map(sum).collect())
    }
}

impl Observer for HistoryCollector {
    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        self.breaks.extend_from_slice(records);
        Ok(())
    }

    fn step(&mut self, _: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        if let Some((all, rates)) = self.velocities.as_mut().zip(view.motion) {
            all.push(rates.velocity.to_vec());
        }
        Ok(())
    }
}
