//! `softening.csv`: one row when a bond begins to soften, and one when its force has fallen below each of three shares of its limit.

use ligament_analysis::driver::Problem;
use ligament_analysis::history::{StepRecord, View};
use ligament_model::BodyGrid;
use ligament_model::failure::Weakened;
use serde::{Deserialize, Serialize};

use super::columns::{SOFTENED_BY, SOFTENING, names};
use super::tables::{ends, labels_of};
use crate::Error;
use crate::csv::{Table, Value};
use crate::file_digest::FileDigest;
use crate::folder::ResultFolder;

/// Name of the file.
pub(super) const FILE: &str = "softening.csv";

/// Words for the events of a row.
const EVENTS: [&str; 4] = [BEGINS, "half", "quarter", "opens"];

/// Word for the step in which the force of a bond began to fall.
pub(super) const BEGINS: &str = "begins";

/// Share of the force at the limit below which a bond that softens in opening counts as cracked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CrackedBelow {
    /// Half of the force.
    Half,
    /// A quarter of the force.
    Quarter,
    /// A tenth of the force, below which a crack is called open.
    #[default]
    Tenth,
}

impl CrackedBelow {
    /// All shares, in the order of their events.
    pub const ALL: [Self; 3] = [Self::Half, Self::Quarter, Self::Tenth];

    /// Share of the force at the limit, dimensionless.
    pub fn share(self) -> f64 {
        match self {
            Self::Half => 0.5,
            Self::Quarter => 0.25,
            Self::Tenth => 0.1,
        }
    }

    /// Number of events of a bond whose force has fallen below the share.
    fn n_events(self) -> u8 {
        2 + self as u8
    }

    /// Word of the event.
    pub(super) fn event(self) -> &'static str {
        EVENTS[usize::from(self.n_events() - 1)]
    }
}

/// The table of a run whose bonds soften.
pub(super) struct SofteningTable {
    table: Table,
    criteria: Vec<String>,
    softened: SoftenedBonds,
}

/// Events of the softening bonds that were reported: the beginning of softening, and the shares below which the force fell.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SoftenedBonds {
    /// Number of reported events of each bond, shape (n_bonds).
    n_reported: Vec<u8>,
}

/// A bond with new events.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct NewEvents {
    /// Number of the bond.
    pub bond: usize,
    /// Number of the criterion.
    pub criterion: usize,
    /// Number of events reported before.
    before: u8,
    /// Number of events now: 1 for the beginning of softening, more below the shares of the force.
    now: u8,
}

/// State of the table in a checkpoint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct SofteningProgress {
    pub(super) written: FileDigest,
    pub(super) of_bonds: Vec<u8>,
}

impl SofteningProgress {
    /// Whether the state can belong to a run with `n_bonds` bonds.
    pub(super) fn fits(&self, n_bonds: usize) -> bool {
        let mut events = self.of_bonds.iter();
        self.of_bonds.len() == n_bonds && events.all(|it| usize::from(*it) <= EVENTS.len())
    }
}

impl SofteningTable {
    /// Creates the table; `None` where no bond softens, or the body is divided between processes.
    pub(super) fn create(
        folder: &ResultFolder,
        problem: &Problem,
        tagged: &str,
    ) -> Result<Option<Self>, Error> {
        if !problem.criteria.soften() || !problem.system.subdomain.is_whole() {
            return Ok(None);
        }
        let columns: Vec<&str> = (names(SOFTENING, false).into_iter())
            .chain(ends(tagged))
            .chain(names(SOFTENED_BY, false))
            .collect();
        Ok(Some(Self {
            table: Table::create(folder.file(FILE), &columns)?,
            criteria: labels_of(problem),
            softened: SoftenedBonds::new(problem.system.ends.len()),
        }))
    }

    /// The table of a resumed run, truncated to its state in the checkpoint.
    pub(super) fn resume(
        folder: &ResultFolder,
        problem: &Problem,
        progress: SofteningProgress,
    ) -> Result<Self, Error> {
        let n_columns = SOFTENING.len() + 2 + SOFTENED_BY.len();
        Ok(Self {
            table: Table::open_truncated(folder.file(FILE), n_columns, progress.written.length)?,
            criteria: labels_of(problem),
            softened: SoftenedBonds {
                n_reported: progress.of_bonds,
            },
        })
    }

    /// Syncs the table to disk and returns its state.
    pub(super) fn progress(&self) -> Result<SofteningProgress, Error> {
        Ok(SofteningProgress {
            written: self.table.sync()?,
            of_bonds: self.softened.n_reported.clone(),
        })
    }

    /// Adds the events since the last step, first the events of the bonds farthest beyond their limits.
    pub(super) fn step(
        &mut self,
        record: &StepRecord,
        view: &View<'_>,
        grid: &BodyGrid,
    ) -> Result<(), Error> {
        for it in self.softened.step(view) {
            let ends = grid.tags_of(view.system.ends[it.bond]);
            for event in &EVENTS[usize::from(it.before)..usize::from(it.now)] {
                self.table.append(&[
                    record.step.into(),
                    record.load_factor.into(),
                    record.displacement.into(),
                    record.reaction.into(),
                    Value::Text(event),
                    ends[0].into(),
                    ends[1].into(),
                    Value::Text(&self.criteria[it.criterion]),
                ])?;
            }
        }
        Ok(())
    }
}

impl SoftenedBonds {
    /// A record of `n_bonds` bonds without events.
    pub(super) fn new(n_bonds: usize) -> Self {
        Self {
            n_reported: vec![0; n_bonds],
        }
    }

    /// Bonds with new events in a state, first the bonds farthest beyond their limits; the events then count as reported.
    pub(super) fn step(&mut self, view: &View<'_>) -> Vec<NewEvents> {
        let changed = self.unreported_events(view);
        let n_reported = |(bond, criterion, now)| NewEvents {
            bond,
            criterion,
            before: std::mem::replace(&mut self.n_reported[bond], now),
            now,
        };
        changed.into_iter().map(n_reported).collect()
    }

    /// Bonds with unreported events: index of the bond, index of the criterion, and number of events.
    fn unreported_events(&self, view: &View<'_>) -> Vec<(usize, usize, u8)> {
        let softening = &view.state.softening;
        let mut changed = Vec::new();
        for (criterion, largest) in softening.largest.iter().enumerate() {
            let weakened = view.criteria.criteria().list[criterion].measure.weakens();
            let opens = matches!(weakened, Weakened::Opening | Weakened::Whole);
            for (bond, &largest) in largest.iter().enumerate() {
                if largest <= 1.0 || usize::from(self.n_reported[bond]) == EVENTS.len() {
                    continue;
                }
                let force = softening
                    .bond(view.criteria.criteria(), criterion, bond)
                    .force;
                let below = CrackedBelow::ALL
                    .iter()
                    .filter(|it| opens && force < it.share());
                let now = 1 + below.count() as u8;
                if now > self.n_reported[bond] {
                    changed.push((largest, bond, criterion, now));
                }
            }
        }
        let (numbering, ends) = (&view.system.numbering, &view.system.ends);
        let in_file = |bond: usize| numbering.ends_in_file(ends[bond]);
        changed.sort_by(|one, other| {
            let tied = || in_file(one.1).cmp(&in_file(other.1));
            other.0.total_cmp(&one.0).then_with(tied)
        });
        // For a bond that two criteria weaken, only the first entry is kept.
        let mut is_listed = vec![false; self.n_reported.len()];
        changed.retain(|it| !std::mem::replace(&mut is_listed[it.1], true));
        changed
            .into_iter()
            .map(|(_, bond, criterion, now)| (bond, criterion, now))
            .collect()
    }
}
