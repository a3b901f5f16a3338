//! A plate with an edge crack, which an observer watches: it counts the bonds as they break, and stops the run after fifty.

#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use ligament::analysis::Termination;
use ligament::analysis::history::{BreakRecord, Moment, ObserverError, Onward, StepRecord, View};
use ligament::prelude::*;

const SIZE: f64 = 0.0025;

/// A plate of 24 by 36 points with a crack from its left edge, pulled by 0.03 mm in 60 steps.
pub(crate) fn plate() -> Result<Setup, Box<dyn std::error::Error>> {
    let position = |k: u32| {
        let [column, row] = [k % 24, k / 24].map(|it| (f64::from(it) + 0.5) * SIZE);
        [column, row - 18.0 * SIZE]
    };
    let n = 24 * 36;
    let points = Points::new(
        (0..n).map(position).collect(),
        vec![SIZE * SIZE; n as usize],
    )?
    .with_group("bottom", 0..3 * 24)?
    .with_group("top", n - 3 * 24..n)?;
    let material = Material {
        tensile_strength: Some(3.81e6),
        ..Material::isotropic(15e9, 0.21)
    };
    let mut setup = Setup::new(points, material, Law::NHPD);
    setup.precracks = vec![PreCrack::along(vec![[-0.01, 0.0], [0.0201, 0.0]])];
    setup.supports = vec![Support::new("bottom", &[Component::X, Component::Y])];
    let up = Displacement {
        y: Some(3e-5),
        ..Displacement::default()
    };
    setup.loads = vec![Load::new("top", Action::Displacement(up))];
    setup.no_fail = vec!["bottom".into(), "top".into()];
    setup.criteria = vec![STRENGTH.into()];
    let steps = (1..=60).map(|step| f64::from(step) / 60.0).collect();
    setup.analysis = Analysis::Stepped(stepped(steps));
    Ok(setup)
}

/// Bonds that have broken so far.
#[derive(Default)]
struct Watch {
    broken: usize,
}

impl Observer for Watch {
    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        self.broken += records.len();
        Ok(())
    }

    fn step(&mut self, record: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        let parts = record.fragments;
        println!(
            "step {}: {:.4e} N, {} bonds broken, {parts} parts",
            record.step, record.reaction, record.broken_bonds
        );
        Ok(())
    }

    fn moment(&mut self, _: &Moment<'_>) -> Result<Onward, ObserverError> {
        Ok(match self.broken {
            0..50 => Onward::Go,
            50.. => Onward::Stop,
        })
    }
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut watch = Watch::default();
    let solution = plate()?.solve(&mut watch)?;
    println!("{}", solution.outcome.termination);
    assert!(watch.broken >= 50);
    assert!(matches!(solution.outcome.termination, Termination::Stopped));
    Ok(())
}
