//! Watches a run: writes its results, shows its progress and keeps its notices.

use ligament_analysis::COMPONENTS;
use ligament_analysis::history::{BreakRecord, Notice, Observer, ObserverError, StepRecord, View};
use ligament_output::results::{MeshCells, ResultWriter};

use crate::case::{Control, Fracture, Steps};
use crate::gauges;
use crate::progress::{Progress, StepLine};

/// Notices that are shown while the run goes on, and nodes that a notice lists; all are in `summary.json`.
const SHOWN: usize = 5;

/// The observer of `ligament run`.
pub struct Watch<'a> {
    writer: ResultWriter<'a>,
    progress: &'a mut Progress,
    notices: Vec<String>,
    last: StepLine,
    cells: &'a MeshCells,
}

impl<'a> Watch<'a> {
    /// Watches with a writer and a progress display.
    pub fn new(
        writer: ResultWriter<'a>,
        progress: &'a mut Progress,
        cells: &'a MeshCells,
        fracture: Option<&Fracture>,
    ) -> Self {
        let total = match fracture.map(|fracture| &fracture.control) {
            None => Some(1),
            Some(Control::Stepped(stepping)) => Some(match &stepping.steps {
                Steps::Uniform(count) => u64::from(*count),
                Steps::Factors(factors) => factors.len() as u64,
            }),
            Some(Control::Event) => None,
        };
        progress.begin_steps(total);
        let last = StepLine {
            step: 0,
            load_factor: 0.0,
            displacement: None,
            load: None,
            broken_bonds: 0,
        };
        Self {
            writer,
            progress,
            notices: Vec::new(),
            last,
            cells,
        }
    }

    /// What the user should know of the run.
    pub fn into_notices(self) -> Vec<String> {
        self.notices
    }

    /// A notice with points given by their node tags.
    fn words(&self, notice: &Notice) -> String {
        let tag = |point: usize| self.cells.node_tags.get(point).copied().unwrap_or_default();
        match notice {
            Notice::FreeBody(body) => gauges::words(body, self.cells),
            Notice::CameLoose {
                step,
                points,
                motions,
                first,
            } => format!(
                "step {step}: {points} points came loose, {motions} rigid motions of theirs are held from now on \
                 (first at node {})",
                tag(*first as usize)
            ),
            Notice::Mechanisms {
                step,
                degrees_of_freedom,
            } => {
                let nodes: Vec<String> = degrees_of_freedom
                    .iter()
                    .take(SHOWN)
                    .map(|dof| tag(dof / COMPONENTS).to_string())
                    .collect();
                format!(
                    "step {step}: {} mechanism(s) without stiffness held, at node(s) {}",
                    degrees_of_freedom.len(),
                    nodes.join(", ")
                )
            }
            Notice::Unstable { .. } | Notice::NegativeEnergy { .. } => notice.to_string(),
        }
    }
}

impl Observer for Watch<'_> {
    fn round(
        &mut self,
        step: usize,
        round: usize,
        load_factor: f64,
        broken: usize,
    ) -> Result<(), ObserverError> {
        self.last = StepLine {
            step: step as u64,
            load_factor,
            broken_bonds: broken as u64,
            ..self.last
        };
        if step > 0 && round > 0 {
            self.progress.round(&self.last);
        }
        self.writer.round(step, round, load_factor, broken)
    }

    fn iteration(
        &mut self,
        iteration: usize,
        residual: f64,
        stored_energy: f64,
    ) -> Result<(), ObserverError> {
        self.writer.iteration(iteration, residual, stored_energy)
    }

    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        self.writer.broke(records)
    }

    fn notice(&mut self, notice: &Notice) -> Result<(), ObserverError> {
        let words = self.words(notice);
        if self.notices.len() < SHOWN {
            self.progress.stage(&words);
        }
        self.notices.push(words);
        Ok(())
    }

    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        self.last = StepLine {
            step: record.step as u64,
            load_factor: record.load_factor,
            displacement: Some(record.displacement),
            load: Some(record.reaction),
            broken_bonds: record.broken_bonds as u64,
        };
        if record.step > 0 {
            self.progress.step(&self.last);
        }
        self.writer.step(record, view)
    }
}
