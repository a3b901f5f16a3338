//! Stages of a computation, for progress and timing.

use ligament_model::correction::CorrectionReport;

use crate::setup::Correction;

/// Watcher of the stages of a computation; `()` ignores them.
pub trait StageWatcher {
    /// Called at the start of a stage: `points`, `bonds`, `correction`.
    fn begins(&mut self, _stage: &'static str) {}

    /// Called at the end of a stage.
    fn ends(&mut self, _stage: &'static str) {}

    /// Called with a result of the preparation.
    fn found(&mut self, _finding: &Finding<'_>) {}
}

impl StageWatcher for () {}

/// Result of the preparation of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Finding<'a> {
    /// Numbers of points and bonds.
    Bonds {
        /// Number of points.
        points: usize,
        /// Number of bonds, before pre-cracks cut any.
        bonds: usize,
        /// Number of pairs of points that a void of the body separates.
        across_voids: usize,
    },
    /// The correction and the report on its iteration; no report where nothing was iterated.
    Correction(&'a Correction, Option<&'a CorrectionReport>),
}

/// Runs the work of a stage, and notifies the watcher of its start and end.
pub fn stage<T>(watcher: &mut dyn StageWatcher, name: &'static str, work: impl FnOnce() -> T) -> T {
    watcher.begins(name);
    let result = work();
    watcher.ends(name);
    result
}
