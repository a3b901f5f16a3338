//! Where a body first gave way: the first bond that broke, and the first that began to soften.

use crate::history::{BreakRecord, Observer, ObserverError, StepRecord, View};
use crate::serial;

/// The first bonds that broke and softened.
///
/// As an observer it keeps them of a run. Softening is seen in the states of equilibrium at the end of load steps: of several bonds that
/// began in one step the one farthest beyond its limit counts.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FirstBonds {
    /// The first bond that broke.
    pub broken: Option<FirstBond>,
    /// The first bond whose force began to fall beyond its limit.
    pub softened: Option<FirstBond>,
}

/// A bond to which something happened first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstBond {
    /// The bond.
    pub bond: u32,
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

serial!(FirstBond {
    bond,
    criterion,
    step,
    load_factor,
    displacement,
    reaction
});
serial!(FirstBonds { broken, softened });

impl Observer for FirstBonds {
    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        if let (None, Some(first)) = (self.broken, records.first()) {
            self.broken = Some(FirstBond {
                bond: first.bond,
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
            self.softened = farthest_softened(view).map(|(criterion, bond)| FirstBond {
                bond,
                criterion,
                step: record.step,
                load_factor: record.load_factor,
                displacement: record.displacement,
                reaction: record.reaction,
            });
        }
        Ok(())
    }
}

/// The criterion and the bond with the largest e/e_0 beyond 1 under a law that softens, the first of several.
fn farthest_softened(view: &View<'_>) -> Option<(u32, u32)> {
    let of_criteria = (0..).zip(&view.state.softening.largest);
    let all = of_criteria.flat_map(|(criterion, largest)| {
        let of_bonds = (0..).zip(largest);
        of_bonds.map(move |(bond, &largest)| (largest, criterion, bond))
    });
    let mut best: Option<(f64, u32, u32)> = None;
    for (largest, criterion, bond) in all {
        if largest > best.map_or(1.0, |it| it.0) {
            best = Some((largest, criterion, bond));
        }
    }
    best.map(|(_, criterion, bond)| (criterion, bond))
}
