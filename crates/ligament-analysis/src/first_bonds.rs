//! First failure of a body: the first bond that broke, and the first that began to soften.

use serde::{Deserialize, Serialize};

use crate::history::{BreakRecord, Observer, ObserverError, StepRecord, View};

/// The first bonds that broke and softened.
///
/// As an observer it records them in a run. Softening is detected in the equilibria at the ends of load steps: of several bonds
/// that began to soften in one step, the one farthest beyond its limit counts.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct FirstBonds {
    /// The first bond that broke.
    pub broken: Option<FirstBond>,
    /// The first bond whose force began to fall beyond its limit.
    pub softened: Option<FirstBond>,
}

/// First bond to break or soften, with its load step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FirstBond {
    /// Global number of the bond.
    pub bond: u32,
    /// Ends A < B of the bond.
    pub ends: [u32; 2],
    /// Number of the criterion.
    pub criterion: u32,
    /// Load step or event.
    pub step: usize,
    /// Load factor.
    pub load_factor: f64,
    /// Displacement of the control load, m.
    pub displacement: f64,
    /// Force of the control load, N.
    pub reaction: f64,
}

impl Observer for FirstBonds {
    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        if let (None, Some(first)) = (self.broken, records.first()) {
            self.broken = Some(FirstBond {
                bond: first.bond,
                ends: first.ends,
                criterion: first.criterion as u32,
                step: first.step,
                load_factor: first.load_factor,
                displacement: first.displacement,
                reaction: first.reaction,
            });
        }
        Ok(())
    }

    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        if self.softened.is_none() {
            self.softened = view.farthest_softened().map(|farthest| FirstBond {
                bond: farthest.bond,
                ends: farthest.ends,
                criterion: farthest.criterion,
                step: record.step,
                load_factor: record.load_factor,
                displacement: record.displacement,
                reaction: record.reaction,
            });
        }
        Ok(())
    }
}
