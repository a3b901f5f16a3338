//! Largest utilisations of the bonds over a run.

use ligament_model::parallel;
use serde::{Deserialize, Serialize};

use crate::history::View;

/// Number of bonds of a parallel task.
const TASK: usize = 4096;

/// Factor up to which two utilisations count as equal: they have seven digits, and the first of several is kept.
const SAME: f64 = 1.0 + 2e-7;

/// The largest utilisation of each bond over all load steps, or events of the exact path, in which it was intact and the whole body known.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct LargestUtilisations {
    /// Largest utilisations, shape (n_bonds).
    pub of_bonds: Vec<LargestUtilisation>,
    /// Step in which each bond began to soften by the stress around it, -1 for bonds that did not, shape (n_bonds); empty where no criterion
    /// lets bonds begin.
    pub began_in: Vec<i32>,
}

/// The largest utilisation of a bond so far.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct LargestUtilisation {
    /// Measure of a criterion over its limit.
    pub utilisation: f32,
    /// Load step or event.
    pub step: u32,
    /// Number of the criterion.
    pub criterion: u32,
}

impl LargestUtilisations {
    /// Whether the utilisations match a number of bonds and of criteria.
    pub fn fits(&self, n_bonds: usize, n_criteria: usize) -> bool {
        let mut largest = self.of_bonds.iter();
        let has_starts = [0, n_bonds].contains(&self.began_in.len());
        has_starts
            && self.of_bonds.len() == n_bonds
            && largest.all(|it| (it.criterion as usize) < n_criteria)
    }

    /// Utilisations of zero.
    pub fn new(n_bonds: usize) -> Self {
        Self {
            of_bonds: vec![LargestUtilisation::default(); n_bonds],
            began_in: Vec::new(),
        }
    }

    /// Updates the utilisations of the bonds that are intact at the end of a step, and the steps in which bonds began to soften.
    pub fn update(&mut self, step: usize, view: &View<'_>) {
        for begun in view.state.softening.begun() {
            self.began_in
                .resize(self.began_in.len().max(begun.len()), -1);
            for (began_in, begun) in self.began_in.iter_mut().zip(begun) {
                if *began_in < 0 && begun.is_finite() {
                    *began_in = step as i32;
                }
            }
        }
        let (criteria, intact) = (view.criteria, &view.state.intact);
        let deformations = &view.balanced.deformations;
        let parts = self.of_bonds.chunks_mut(TASK).enumerate();
        parallel::for_each(parts, |(part, largest)| {
            let bonds = part * TASK..part * TASK + largest.len();
            let (intact, deformations) = (&intact[bonds.clone()], &deformations[bonds.clone()]);
            for place in 0..criteria.criteria().list.len() {
                let limits = &criteria.limits(place)[bonds.clone()];
                let arrays = intact.iter().zip(deformations).zip(limits);
                for (bond, (largest, ((&is_intact, deformation), &limit))) in
                    bonds.clone().zip(largest.iter_mut().zip(arrays))
                {
                    let measure = criteria.measure(place, bond, deformation);
                    // No division; false for an infinite limit, for which the product is infinite or not a number.
                    if is_intact && measure > SAME * f64::from(largest.utilisation) * limit {
                        *largest = LargestUtilisation {
                            utilisation: (measure / limit) as f32,
                            step: step as u32,
                            criterion: place as u32,
                        };
                    }
                }
            }
        });
    }
}
