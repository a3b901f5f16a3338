//! Stages of a computation, for those who show or time them.

use ligament_model::correction::CorrectionReport;

use crate::setup::Correction;

/// Watcher of the stages of a computation; `()` if nobody need know.
pub trait StageWatcher {
    /// Tells that a stage begins: `points`, `bonds`, `correction`.
    fn begins(&mut self, _stage: &'static str) {}

    /// Tells that a stage has ended.
    fn ends(&mut self, _stage: &'static str) {}

    /// Tells what the preparation has found.
    fn found(&mut self, _finding: &Finding<'_>) {}
}

impl StageWatcher for () {}

/// What the preparation of a model has found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Finding<'a> {
    /// Points and bonds.
    Bonds {
        /// Number of points.
        points: usize,
        /// Number of bonds, before pre-cracks cut any.
        bonds: usize,
        /// Number of pairs of points that a void of the body parts.
        across_voids: usize,
    },
    /// The correction, and how it went; none where nothing was iterated.
    Correction(&'a Correction, Option<&'a CorrectionReport>),
}

/// Does a stage, and tells of its beginning and its end.
pub fn stage<T>(watcher: &mut dyn StageWatcher, name: &'static str, work: impl FnOnce() -> T) -> T {
    watcher.begins(name);
    let result = work();
    watcher.ends(name);
    result
}
