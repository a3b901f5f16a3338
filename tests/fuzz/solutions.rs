//! Solutions in checkpoints whose digest is right, of any bytes.

use ligament::run;
use ligament_analysis::Observer;
use ligament_analysis::history::{Moment, ObserverError, Onward, StepRecord, View};
use verification::bench::Bench;

use crate::Target;

const CASE: &str = r#"
lattice = { cells = [8, 4], spacing = 0.01, set = { left = { left = 1 }, right = { right = 1 } } }
material = { young = 1e9, poisson = 0.2, tensile_strength = 1e6, fracture_energy = 100.0 }
model = { law = "nhpd", horizon_factor = 2.2 }
support = [{ group = "left", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "right", displacement = { x = 2e-4 } }]
"#;

const FRACTURES: [&str; 3] = [
    "fracture={ steps = 6, bonds_per_iteration = 1, stop = { bonds = 9 } }",
    "fracture={ control = \"event\", stop = { bonds = 9 } }",
    "fracture={ steps = 6, criterion = [{ kind = \"bond-energy\", limit = 2e-3, after = \"bilinear\" }] }",
];

/// A run by its number in the first byte, and the solution that it is to go on from.
pub(crate) struct Solutions(Vec<Bench>);

impl Solutions {
    pub(crate) fn new() -> Self {
        Self(FRACTURES.map(|it| Bench::new(CASE, &[it])).into())
    }
}

impl Target for Solutions {
    fn name(&self) -> &'static str {
        "solution"
    }

    fn seeds(&self) -> Vec<Vec<u8>> {
        let mut seeds = Vec::new();
        for (number, bench) in (0..).zip(&self.0) {
            let mut all = All::default();
            run::follow(&bench.problem(), &bench.model.setup.analysis, &mut all).unwrap();
            assert!(all.0.len() > 3, "{number}");
            let few = all.0.into_iter().step_by(3);
            seeds.extend(few.map(|solution| [vec![number], solution].concat()));
        }
        seeds
    }

    fn read(&mut self, input: &[u8]) -> bool {
        let Some((number, mut solution)) = input.split_first() else {
            return false;
        };
        let bench = &self.0[usize::from(*number) % self.0.len()];
        let (problem, analysis) = (bench.problem(), &bench.model.setup.analysis);
        let Ok(restored) = run::restore(&problem, analysis, &mut solution) else {
            return false;
        };
        // What it comes to is nobody's concern; some moments are enough.
        restored.resume(&mut Few(4)).is_ok()
    }
}

/// Keeps the solutions of all moments.
#[derive(Default)]
struct All(Vec<Vec<u8>>);

impl Observer for All {
    fn moment(&mut self, moment: &Moment<'_>) -> Result<Onward, ObserverError> {
        self.0.push(moment.bytes());
        Ok(Onward::Go)
    }

    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        Ok(())
    }
}

/// Stops after so many moments.
struct Few(usize);

impl Observer for Few {
    fn moment(&mut self, moment: &Moment<'_>) -> Result<Onward, ObserverError> {
        let _ = moment.bytes();
        self.0 -= 1;
        Ok(if self.0 == 0 {
            Onward::Stop
        } else {
            Onward::Go
        })
    }

    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        Ok(())
    }
}
