//! How near bonds came to their limits.

use ligament_analysis::history::View;
use rayon::prelude::*;

use crate::vtu::Field;

/// Bonds that make a task worth while.
const TASK: usize = 4096;

/// The largest utilisation of each bond over all load steps, or events of the exact path, in which it was intact.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Largest {
    of_bonds: Vec<Seen>,
}

/// The largest utilisation of a bond so far.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Seen {
    utilisation: f32,
    step: u32,
    criterion: u32,
}

/// The arrays of a file.
pub(super) struct Columns {
    utilisation: Vec<f32>,
    step: Vec<i64>,
    criterion: Vec<i64>,
}

impl Largest {
    pub(super) fn new(n_bonds: usize) -> Self {
        Self {
            of_bonds: vec![Seen::default(); n_bonds],
        }
    }

    /// Looks at the bonds that are intact at the end of a step. The first of equal criteria counts, and the first of equal steps.
    pub(super) fn see(&mut self, step: usize, view: &View<'_>) {
        let (criteria, intact) = (&view.criteria.list, &view.state.intact);
        let deformations = &view.balanced.deformations;
        (self.of_bonds.par_iter_mut().enumerate())
            .with_min_len(TASK)
            .filter(|(bond, _)| intact[*bond])
            .for_each(|(bond, seen)| {
                for (criterion, it) in (0..).zip(criteria) {
                    let utilisation = it.utilisation(bond, &deformations[bond]) as f32;
                    if utilisation > seen.utilisation {
                        *seen = Seen {
                            utilisation,
                            step: step as u32,
                            criterion,
                        };
                    }
                }
            });
    }

    /// As arrays, with `n_absent` entries for what is no bond at their end.
    pub(super) fn columns(&self, n_absent: usize) -> Columns {
        let nothing = Seen {
            utilisation: f32::NAN,
            ..Default::default()
        };
        let all = || {
            self.of_bonds
                .iter()
                .chain(std::iter::repeat_n(&nothing, n_absent))
        };
        Columns {
            utilisation: all().map(|it| it.utilisation).collect(),
            step: all().map(|it| i64::from(it.step)).collect(),
            criterion: all().map(|it| i64::from(it.criterion)).collect(),
        }
    }
}

impl Columns {
    pub(super) fn fields(&self) -> [Field<'_>; 3] {
        [
            Field::single("largest_utilisation", &self.utilisation),
            Field::integer("step_of_largest", &self.step),
            Field::integer("criterion_of_largest", &self.criterion),
        ]
    }
}
