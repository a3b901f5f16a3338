//! Backward substitution of parts from the root of the elimination tree downwards, with siblings in parallel.
//!
//! A part needs only the motions of its ancestors, so that the results equal a sequential substitution.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use ligament_linalg::Factorisation;
use ligament_model::parallel;

use super::division::Division;

/// Least number of values of the factor for a parallel task; their substitution takes some 50 microseconds.
const TASK: usize = 150_000;

/// Work vectors by row of the factor, one for each thread in use.
#[derive(Default)]
pub(super) struct WorkVectors(Mutex<Vec<Vec<f64>>>);

impl WorkVectors {
    /// Runs a function with a work vector (n_rows) of arbitrary values.
    fn with<T>(&self, n_rows: usize, work: impl FnOnce(&mut [f64]) -> T) -> T {
        let rooms = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let free = rooms().pop();
        let mut room = free.unwrap_or_else(|| vec![0.0; n_rows]);
        let done = work(&mut room);
        rooms().push(room);
        done
    }
}

/// A correction after the forward substitution, by row of the factor.
#[derive(Clone, Copy)]
pub(crate) struct ForwardSubstituted<'a> {
    pub(crate) factor: &'a dyn Factorisation,
    pub(crate) by_row: &'a [f64],
    /// Ratio of the load factor of the displacements to the load factor of the correction.
    pub(crate) scale: f64,
}

/// Data for the substitution of parts after a breakage.
#[derive(Clone, Copy)]
pub(super) struct Descent<'a> {
    pub(super) division: &'a Division,
    /// Displacements and rotations before the substitution, shape (n_degrees_of_freedom), m and rad.
    pub(super) displacement: &'a [f64],
    /// Motions of the border of each part at its last substitution.
    pub(super) references: &'a [Vec<f64>],
    pub(super) rooms: &'a WorkVectors,
    pub(super) correction: ForwardSubstituted<'a>,
    /// Whether the breakage was in each part or in its descendants.
    pub(super) broken_in: &'a [bool],
    /// Whether each degree of freedom is fixed, shape (n_degrees_of_freedom).
    pub(super) held: &'a [bool],
}

/// Changes of the motions of a part, by its rows, and of its ancestors.
struct Above<'a> {
    rows: Range<usize>,
    changes: &'a [f64],
    above: Option<&'a Above<'a>>,
}

/// A part with the changes of its motions by its rows.
pub(super) type Changed = (usize, Vec<f64>);

impl Descent<'_> {
    /// Changes of all required parts; the parent of a required part is required too.
    pub(super) fn all(self, is_asked_for: &[bool]) -> Vec<Changed> {
        self.downwards(0, is_asked_for, None)
    }

    /// Changes of one part whose ancestors are up to date.
    pub(super) fn one(self, part: usize) -> Vec<f64> {
        self.part(part, None)
    }

    fn downwards(
        self,
        part: usize,
        is_asked_for: &[bool],
        above: Option<&Above<'_>>,
    ) -> Vec<Changed> {
        let Division { parts, below, .. } = self.division;
        let changes = self.part(part, above);
        let here = Above {
            rows: parts[part].rows.clone(),
            changes: &changes,
            above,
        };
        let below = below[part].iter().copied();
        let below: Vec<usize> = below.filter(|&part| is_asked_for[part]).collect();
        let is_large = |part: &&usize| parts[**part].n_values() > TASK;
        let further = |&part: &usize| self.downwards(part, is_asked_for, Some(&here));
        let further: Vec<Vec<Changed>> = if below.iter().filter(is_large).count() > 1 {
            parallel::map(&below, further)
        } else {
            below.iter().map(further).collect()
        };
        let mut all = vec![(part, changes)];
        all.extend(further.into_iter().flatten());
        all
    }

    /// Changes of one part from the changes of its ancestors, which the displacements do not include yet.
    fn part(self, part: usize, above: Option<&Above<'_>>) -> Vec<f64> {
        let Self {
            division,
            displacement,
            references,
            rooms,
            ..
        } = self;
        let it = &division.parts[part];
        rooms.with(division.degree_of_freedom.len(), |room| {
            let mut above = above;
            for (&row, then) in it.border.iter().zip(&references[part]) {
                let dof = division.degree_of_freedom[row] as usize;
                while let Some(passed) = above.filter(|it| row >= it.rows.end) {
                    above = passed.above;
                }
                let motion = match above {
                    Some(above) if !self.held[dof] => {
                        displacement[dof] + above.changes[row - above.rows.start]
                    }
                    _ => displacement[dof],
                };
                room[row] = motion - then;
            }
            let own = &mut room[it.rows.clone()];
            if self.broken_in[part] {
                let ForwardSubstituted { by_row, scale, .. } = self.correction;
                let by_row = by_row[it.rows.clone()].iter();
                own.iter_mut()
                    .zip(by_row)
                    .for_each(|(own, value)| *own = scale * value);
            } else {
                own.fill(0.0);
            }
            self.correction.factor.solve_backward_part(it, room);
            room[it.rows.clone()].to_vec()
        })
    }
}
