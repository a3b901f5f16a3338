//! `softening.csv`: a row where a bond begins to soften, and one where so little of its force is left that a crack is open there.

use ligament_analysis::driver::Problem;
use ligament_analysis::history::{StepRecord, View};
use ligament_analysis::serial;
use ligament_model::BodyGrid;
use ligament_model::failure::Weakened;

use super::columns::{SOFTENED_BY, SOFTENING, names};
use super::tables::{ends, labels_of};
use crate::Error;
use crate::csv::{Table, Value};
use crate::folder::ResultFolder;
use crate::written::Written;

/// The name of the table.
pub(super) const FILE: &str = "softening.csv";

/// Share of the force at the limit below which a bond that softens in opening counts as parted by a crack.
pub const OPEN: f64 = 0.1;

/// Words for the two things that a row tells.
pub(super) const EVENTS: [&str; 2] = ["begins", "opens"];

/// The table of a run whose bonds soften.
pub(super) struct SofteningTable {
    table: Table,
    criteria: Vec<String>,
    softened: SoftenedBonds,
}

/// What was told of the bonds that soften: nothing, that they began to, or that a crack is open there.
#[derive(Debug, Clone, PartialEq)]
pub struct SoftenedBonds {
    /// Number of the things told of each bond, shape (n_bonds).
    told: Vec<u8>,
}

/// A bond with more to tell: its number, the criterion, and how many things were told of it before and are to be told now.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SoftenedBond {
    /// Number of the bond.
    pub bond: usize,
    /// Number of the criterion.
    pub criterion: usize,
    /// Things told before, 0 or 1.
    pub before: u8,
    /// Things to tell: 1 that it began to soften, 2 that a crack is open there, too.
    pub now: u8,
}

/// How far the table is.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SofteningProgress {
    pub(super) written: Written,
    pub(super) of_bonds: Vec<u8>,
}

serial!(SofteningProgress { written, of_bonds });

impl SofteningTable {
    /// Creates the table; none where no bond softens, or processes share the body out.
    pub(super) fn create(
        folder: &ResultFolder,
        problem: &Problem,
        tagged: &str,
    ) -> Result<Option<Self>, Error> {
        if !problem.criteria.soften() || !problem.system.subdomain().is_whole() {
            return Ok(None);
        }
        let columns: Vec<&str> = (names(SOFTENING, false).into_iter())
            .chain(ends(tagged))
            .chain(names(SOFTENED_BY, false))
            .collect();
        Ok(Some(Self {
            table: Table::create(folder.file(FILE), &columns)?,
            criteria: labels_of(problem),
            softened: SoftenedBonds::new(problem.system.ends().len()),
        }))
    }

    /// The table of a run that goes on, cut back to where it was.
    pub(super) fn cut_back(
        folder: &ResultFolder,
        problem: &Problem,
        told: SofteningProgress,
    ) -> Result<Self, Error> {
        let n_columns = SOFTENING.len() + 2 + SOFTENED_BY.len();
        Ok(Self {
            table: Table::cut_back(folder.file(FILE), n_columns, told.written.length)?,
            criteria: labels_of(problem),
            softened: SoftenedBonds {
                told: told.of_bonds,
            },
        })
    }

    /// How far the table is; what it has is safely on the disk when this returns.
    pub(super) fn told(&self) -> Result<SofteningProgress, Error> {
        Ok(SofteningProgress {
            written: self.table.synced()?,
            of_bonds: self.softened.told.clone(),
        })
    }

    /// Adds what happened since the last step, in it the bonds farthest beyond their limits first.
    pub(super) fn step(
        &mut self,
        record: &StepRecord,
        view: &View<'_>,
        grid: &BodyGrid,
    ) -> Result<(), Error> {
        for it in self.softened.step(view) {
            let ends = grid.tags_of(view.system.ends()[it.bond]);
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
    /// Nothing told of so many bonds.
    pub fn new(n_bonds: usize) -> Self {
        Self {
            told: vec![0; n_bonds],
        }
    }

    /// Bonds with news in a state, those farthest beyond their limits first; the news counts as given from then on.
    pub fn step(&mut self, view: &View<'_>) -> Vec<SoftenedBond> {
        let changed = self.changed(view);
        let told = |(bond, criterion, now)| SoftenedBond {
            bond,
            criterion,
            before: std::mem::replace(&mut self.told[bond], now),
            now,
        };
        changed.into_iter().map(told).collect()
    }

    /// Bonds with more to tell than was told, with the criterion and what there is to tell now.
    fn changed(&self, view: &View<'_>) -> Vec<(usize, usize, u8)> {
        let softening = &view.state.softening;
        let mut changed = Vec::new();
        for (criterion, largest) in softening.largest.iter().enumerate() {
            let opens = view.criteria.list[criterion].measure.weakens() == Weakened::Opening;
            for (bond, &largest) in largest.iter().enumerate() {
                if largest <= 1.0 || self.told[bond] == 2 {
                    continue;
                }
                let force = softening.bond(view.criteria, criterion, bond).force;
                let now = 1 + u8::from(opens && force < OPEN);
                if now > self.told[bond] {
                    changed.push((largest, bond, criterion, now));
                }
            }
        }
        let (numbering, ends) = (view.system.numbering(), view.system.ends());
        let in_file = |bond: usize| numbering.ends_in_file(ends[bond]);
        changed.sort_by(|one, other| {
            let tied = || in_file(one.1).cmp(&in_file(other.1));
            other.0.total_cmp(&one.0).then_with(tied)
        });
        // Of a bond that two criteria weaken, what the first says.
        let mut said = vec![false; self.told.len()];
        changed.retain(|it| !std::mem::replace(&mut said[it.1], true));
        changed
            .into_iter()
            .map(|(_, bond, criterion, now)| (bond, criterion, now))
            .collect()
    }
}
