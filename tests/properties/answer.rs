//! What a case comes to, in arrays that images of it can be compared with.

use std::collections::BTreeMap;

use ligament::prelude::*;
use ligament_analysis::history::{BreakRecord, ObserverError, StepRecord, View};
use ligament_model::correction::CorrectionReport;
use verification::numbers::{by_point, deviation, largest};

use super::image::Image;

/// Step and round of a breakage, with the ends of the bonds that broke then.
type Round = ((usize, usize), Vec<[u32; 2]>);

/// What a case comes to.
pub(crate) struct Answer {
    /// Positions of the points.
    positions: Vec<[f64; 2]>,
    /// Motion of the points at the end.
    motion: Vec<[f64; 3]>,
    /// Forces and moments of the groups in all steps.
    forces: Vec<[f64; 3]>,
    /// Stored, released and dissipated energy, and work, in all steps.
    energies: Vec<f64>,
    /// Load factors of all steps.
    load_factors: Vec<f64>,
    /// Breakages in their order.
    pub(crate) rounds: Vec<Round>,
    /// What the patch correction leaves of its equations, as a root mean square; 0 without one.
    pub(crate) left: f64,
    /// Why the run ended.
    pub(crate) end: &'static str,
}

/// Keeps the bonds that break.
#[derive(Default)]
struct Breaks(Vec<BreakRecord>);

impl Observer for Breaks {
    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        self.0.extend_from_slice(records);
        Ok(())
    }

    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        Ok(())
    }
}

impl Answer {
    pub(crate) fn new(setup: Setup) -> Self {
        let mut breaks = Breaks::default();
        let solution = setup.solve(&mut breaks).unwrap();
        let system = solution.model.plane();
        let layout = system.topology().layout;
        let history = &solution.outcome.history;
        let of_group = |force: &Vec<f64>| Component::ALL.map(|it| layout.value(0, it, force));
        let energies = |step: &StepRecord| {
            [
                step.stored_energy,
                step.released_energy,
                step.dissipated_energy,
                step.external_work,
            ]
        };
        let mut rounds: BTreeMap<(usize, usize), Vec<[u32; 2]>> = BTreeMap::new();
        for record in &breaks.0 {
            let ends = system.topology().ends[record.bond as usize];
            let of_round = rounds.entry((record.step, record.round)).or_default();
            of_round.push(ends);
        }
        let report = solution.model.correction.as_ref();
        Self {
            left: report
                .and_then(CorrectionReport::patch)
                .map_or(0.0, |it| it.left),
            positions: solution.model.setup.body.geometry().positions().to_vec(),
            motion: by_point(layout, &solution.outcome.state.displacement),
            forces: (history.iter().flat_map(|step| &step.group_forces))
                .map(of_group)
                .collect(),
            energies: history.iter().flat_map(energies).collect(),
            load_factors: history.iter().map(|step| step.load_factor).collect(),
            rounds: rounds.into_iter().collect(),
            end: solution.outcome.termination.name(),
        }
    }

    pub(crate) fn n_broken(&self) -> usize {
        self.rounds.iter().map(|round| round.1.len()).sum()
    }

    /// The point of this answer at the image of each point of another.
    fn points_at(&self, other: &Self, image: &Image) -> Vec<usize> {
        let nearest = |&position: &[f64; 2]| {
            let [x, y] = image.place(position);
            let far = |point: &usize| {
                let [a, b] = self.positions[*point];
                (a - x).hypot(b - y)
            };
            let all = 0..self.positions.len();
            all.min_by(|one, other| far(one).total_cmp(&far(other)))
                .unwrap()
        };
        let points: Vec<usize> = other.positions.iter().map(nearest).collect();
        let mut sorted = points.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..self.positions.len()));
        points
    }

    /// Largest deviations of this answer from the image of another: of displacements, rotations, forces, moments, energies and load
    /// factors, each over its largest.
    pub(crate) fn deviations(&self, other: &Self, image: &Image) -> [f64; 6] {
        let points = self.points_at(other, image);
        let found: Vec<[f64; 3]> = points.iter().map(|&point| self.motion[point]).collect();
        let motion: Vec<[f64; 3]> = other.motion.iter().map(|it| image.motion(*it)).collect();
        let forces: Vec<[f64; 3]> = other.forces.iter().map(|it| image.load(*it)).collect();
        let size = largest(self.positions.as_flattened().iter().copied());
        let energies: Vec<f64> = other.energies.iter().map(|e| image.energy() * e).collect();
        [
            of_vectors(&found, &motion),
            of_turns(&found, &motion, largest(vectors(&motion)) / size),
            of_vectors(&self.forces, &forces),
            of_turns(&self.forces, &forces, largest(vectors(&forces)) * size),
            deviation(&self.energies, &energies),
            deviation(&self.load_factors, &other.load_factors),
        ]
    }

    /// Whether the images of the bonds that broke in another answer broke in this one, in the same steps and rounds.
    pub(crate) fn broke_like(&self, other: &Self, image: &Image) -> bool {
        let points = self.points_at(other, image);
        let sorted = |bonds: &mut Vec<[u32; 2]>| {
            for ends in bonds.iter_mut() {
                ends.sort_unstable();
            }
            bonds.sort_unstable();
        };
        let mut expected = other.rounds.clone();
        for (_, bonds) in &mut expected {
            for ends in bonds.iter_mut() {
                *ends = ends.map(|end| points[end as usize] as u32);
            }
            sorted(bonds);
        }
        let mut found = self.rounds.clone();
        found.iter_mut().for_each(|(_, bonds)| sorted(bonds));
        found == expected
    }
}

fn vectors(all: &[[f64; 3]]) -> Vec<f64> {
    all.iter().flat_map(|&[x, y, _]| [x, y]).collect()
}

fn of_vectors(found: &[[f64; 3]], expected: &[[f64; 3]]) -> f64 {
    deviation(&vectors(found), &vectors(expected))
}

/// Deviation of rotations or moments over the largest, or over `least`: a rotation that moves the body less than the rest does, or a
/// moment with an arm below its size, may be rounding.
fn of_turns(found: &[[f64; 3]], expected: &[[f64; 3]], least: f64) -> f64 {
    let difference = largest(found.iter().zip(expected).map(|(a, b)| a[2] - b[2]));
    if difference == 0.0 {
        return 0.0;
    }
    difference / largest(expected.iter().map(|it| it[2]).chain([least]))
}
