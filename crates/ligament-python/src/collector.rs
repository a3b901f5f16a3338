//! The observer that collects history, breakages and fields, and reports progress.

use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::mpsc::Sender;

use ligament_analysis::driver::Problem;
use ligament_analysis::first_bonds::FirstBonds;
use ligament_analysis::history::{
    BreakRecord, Moment, Notice, Observer, ObserverError, Onward, StepRecord, View,
};
use ligament_model::BodyGrid;
use ligament_output::results::{
    PointFields, SoftenedBonds, WriteRule, break_columns, break_row, deformation_names,
    history_columns, history_row, labels_of, point_fields,
};

use crate::table::Table;

/// Progress of a run: step, load factor, displacement and force of the control load, number of broken bonds.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Progress {
    pub(crate) step: usize,
    pub(crate) load_factor: f64,
    pub(crate) displacement: f64,
    pub(crate) reaction: f64,
    pub(crate) broken_bonds: usize,
}

/// Number of the user's requests to stop: the first ends the run at the next state, the second immediately.
#[derive(Debug, Default)]
pub(crate) struct Stop(AtomicU8);

impl Stop {
    /// Adds a request to stop.
    pub(crate) fn ask(&self) {
        self.0.fetch_add(1, Ordering::Relaxed);
    }

    /// Whether there were at least `times` requests.
    pub(crate) fn asked(&self, times: u8) -> bool {
        self.0.load(Ordering::Relaxed) >= times
    }
}

/// The observer of a run in memory.
pub(crate) struct Collector<'a> {
    pub(crate) kept: Kept,
    rule: WriteRule,
    grid: &'a BodyGrid,
    ends: &'a [[u32; 2]],
    criteria: Vec<String>,
    n_components: usize,
    told: Option<SoftenedBonds>,
    progress: Sender<Progress>,
    stop: &'a Stop,
}

/// Collected results of a run.
pub(crate) struct Kept {
    pub(crate) history: Table,
    pub(crate) breaks: Table,
    pub(crate) fields: Vec<(usize, PointFields)>,
    pub(crate) notices: Vec<String>,
    pub(crate) first: FirstBonds,
    /// Ends of the broken bonds, in the order of breaking.
    pub(crate) broken: Vec<[u32; 2]>,
    /// Ends of the softening bonds that opened, with the step.
    pub(crate) opened: Vec<([u32; 2], usize)>,
    /// Step in which each bond broke, -1 for intact bonds, shape (n_bonds).
    pub(crate) step_of_breaking: Vec<i64>,
}

impl<'a> Collector<'a> {
    /// An observer of a problem on a body.
    pub(crate) fn new(
        problem: &Problem,
        (grid, ends): (&'a BodyGrid, &'a [[u32; 2]]),
        rule: WriteRule,
        progress: Sender<Progress>,
        stop: &'a Stop,
    ) -> Self {
        Self {
            kept: Kept {
                history: Table::new(history_columns(problem)),
                breaks: Table::new(break_columns(problem, grid.tagged)),
                fields: Vec::new(),
                notices: Vec::new(),
                first: FirstBonds::default(),
                broken: Vec::new(),
                opened: Vec::new(),
                step_of_breaking: vec![-1; ends.len()],
            },
            rule,
            grid,
            ends,
            criteria: labels_of(problem),
            n_components: deformation_names(&*problem.system).len(),
            told: (problem.criteria.soften()).then(|| SoftenedBonds::new(ends.len())),
            progress,
            stop,
        }
    }

    fn unless_stopped(&self) -> Result<(), ObserverError> {
        match self.stop.asked(2) {
            true => Err(ObserverError("stopped at once".into())),
            false => Ok(()),
        }
    }
}

impl Observer for Collector<'_> {
    fn round(&mut self, _: usize, _: usize, _: f64, _: usize) -> Result<(), ObserverError> {
        self.unless_stopped()
    }

    fn iteration(&mut self, _: usize, _: f64, _: f64) -> Result<(), ObserverError> {
        self.unless_stopped()
    }

    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        self.kept.first.broke(records)?;
        for record in records {
            let ends = self.ends[record.bond as usize];
            let row = break_row(
                record,
                self.grid.tags_of(ends),
                &self.criteria,
                self.n_components,
            );
            self.kept.breaks.append(&row);
            self.kept.broken.push(ends);
            self.kept.step_of_breaking[record.bond as usize] = record.step as i64;
        }
        Ok(())
    }

    fn notice(&mut self, notice: &Notice) -> Result<(), ObserverError> {
        self.kept.notices.push(notice.to_string());
        Ok(())
    }

    fn moment(&mut self, moment: &Moment<'_>) -> Result<Onward, ObserverError> {
        let stops = moment.end.is_none() && self.stop.asked(1);
        Ok(if stops { Onward::Stop } else { Onward::Go })
    }

    fn looks(&self, step: usize) -> bool {
        self.rule.is_due(step) || self.told.is_some()
    }

    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        let kept = &mut self.kept;
        kept.first.step(record, view)?;
        kept.history.append(&history_row(record, view));
        for it in self.told.iter_mut().flat_map(|told| told.step(view)) {
            if it.opens() {
                kept.opened.push((self.ends[it.bond], record.step));
            }
        }
        if self.rule.writes_fields(record, view) {
            let fields = point_fields(self.rule, view);
            kept.fields.push((record.step, fields));
        }
        // The receiver may be closed after the user's interrupt.
        let _ = self.progress.send(Progress {
            step: record.step,
            load_factor: record.load_factor,
            displacement: record.displacement,
            reaction: record.reaction,
            broken_bonds: record.broken_bonds,
        });
        Ok(())
    }
}
