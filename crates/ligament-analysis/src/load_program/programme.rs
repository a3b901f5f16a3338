//! A programme of loading: stages one after the other, in which every load follows its own factor.

use super::ProportionalLoading;

/// Stages one after the other: every load, displacement and temperature is its value at factor 1 times a factor of its own.
///
/// The factors go along straight lines from one part to the next, so that in each part everything that acts is A + w B.
#[derive(Debug, Clone)]
pub struct Programme {
    /// Names of the loads, the temperature among them.
    pub names: Vec<String>,
    /// Each load by itself at factor 1, with all supports, and all groups of the history; shape (n_loads).
    pub loads: Vec<ProportionalLoading>,
    /// The load that is the temperature.
    pub temperature: Option<usize>,
    /// The load whose displacement and force are the axes of the force-displacement curve.
    pub control: usize,
    /// Names of the stages.
    pub stages: Vec<String>,
    /// The parts of all stages, one after the other.
    pub parts: Vec<Part>,
}

/// A part of a stage, in which all factors go along straight lines.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Index of the stage.
    pub stage: usize,
    /// Load factor at the start and at the end: the shares of the stage that are over, 0 to 1.
    pub span: [f64; 2],
    /// Factor of each load at the end of the part; a load without one keeps what it has, shape (n_loads).
    pub ends: Vec<Option<f64>>,
    /// Equal load steps of the part.
    pub steps: usize,
}

impl Part {
    /// Load factors at the ends of the steps.
    pub fn load_factors(&self) -> Vec<f64> {
        let [begins, ends] = self.span;
        let inner = (1..self.steps).map(|step| step as f64 / self.steps as f64);
        let inner = inner.map(|share| begins + share * (ends - begins));
        inner.chain([ends]).collect()
    }
}

impl Programme {
    /// Name of the stage of a part.
    pub fn stage_name(&self, part: usize) -> &str {
        &self.stages[self.parts[part].stage]
    }
}
