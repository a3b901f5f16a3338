//! State of the written results at a checkpoint, for resuming the run.

use ligament_analysis::driver::Problem;
use ligament_analysis::first_bonds::FirstBonds;
use ligament_analysis::largest_utilisation::LargestUtilisations;
use serde::{Deserialize, Serialize};

use super::between_breakages::StatesBetweenBreakages;
use super::softening_table::{self, SofteningProgress};
use super::stored_state::{BONDS, FIELDS, RIGID, StoredState};
use super::tables::{FILES, TablesProgress};
use crate::file_digest::FileDigest;
use crate::folder::{Kind, ResultFolder};

/// State of the written results of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct OutputState {
    pub(super) tables: TablesProgress,
    pub(super) softening: Option<SofteningProgress>,
    pub(super) first: FirstBonds,
    /// Times and names of the field files.
    pub(super) fields: Vec<(f64, String)>,
    /// Times and names of the files of bonds.
    pub(super) bonds: Vec<(f64, String)>,
    /// The kept states between breakages.
    pub(super) between: StatesBetweenBreakages,
    /// Ends of the broken bonds with the steps.
    pub(super) breaks: Vec<([u32; 2], u32)>,
    pub(super) largest: Option<LargestUtilisations>,
    /// Names of the completed files, with their contents' lengths and digests.
    pub(super) whole: Vec<(String, FileDigest)>,
}

impl OutputState {
    /// Whether the state matches a problem.
    pub fn fits(&self, problem: &Problem) -> bool {
        let (n_bonds, n_criteria) = (problem.system.ends.len(), problem.criteria.list.len());
        let n_points = problem.system.subdomain.n_all() as u32;
        let is_bond = |ends: &[u32; 2]| ends.iter().all(|&end| end < n_points);
        let mut bonds = self.breaks.iter();
        // The number of processes may change between checkpoint and resumption.
        let n_bonds = problem.system.subdomain.is_whole().then_some(n_bonds);
        let mut largest = self.largest.iter();
        let mut first = [self.first.broken, self.first.softened]
            .into_iter()
            .flatten();
        let softening = self.softening.as_ref();
        bonds.all(|(ends, _)| is_bond(ends))
            && largest.all(|it| n_bonds.is_none_or(|n_bonds| it.fits(n_bonds, n_criteria)))
            && first.all(|it| is_bond(&it.ends) && (it.criterion as usize) < n_criteria)
            && softening.is_none_or(|progress| n_bonds.is_none_or(|it| progress.fits(it)))
    }

    /// Reason why a run cannot be resumed with the files of its folder; `None` if it can.
    pub fn mismatch(&self, folder: &ResultFolder) -> Option<String> {
        let series = self.fields.iter().chain(&self.bonds);
        let whole = self.whole.iter().map(|(name, _)| name);
        let mut named = series.map(|(_, name)| name).chain(whole);
        if let Some(foreign) = named.find(|name| !(Kind::RUN.owns)(name)) {
            return Some(format!("{foreign} is no name of a file of a run"));
        }
        let tables = FILES.iter().copied().zip(self.tables.of_files);
        let softening = self.softening.iter();
        let softening = softening.map(|progress| (softening_table::FILE, progress.written));
        // Of the states between breakages some are dropped later.
        let may_be_dropped = |name: &str| {
            let state = [FIELDS, BONDS, RIGID].map(|stem| StoredState::of_file(name, stem));
            let mut between = state.into_iter().flatten();
            between.any(|it| it.breakages().is_some()) && !folder.file(name).exists()
        };
        let whole = self.whole.iter().map(|(name, it)| (name.as_str(), *it));
        let whole = whole.filter(|(name, _)| !may_be_dropped(name));
        let mut all = tables.chain(softening).chain(whole);
        all.find_map(|(name, written)| written.mismatch(&folder.file(name)))
    }
}
