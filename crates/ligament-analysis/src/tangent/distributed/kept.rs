//! What several ranks keep of a matrix and its preconditioner beside their values.

use std::collections::BTreeSet;
use std::mem;

use crate::bond_numbers::BondNumbers;
use crate::checkpoint::CheckpointError;
use crate::serial::{Damaged, Serial};
use crate::tangent::making::Making;

/// What a preconditioner came from and how it serves: the same on all ranks.
pub(super) struct Kept {
    /// What the preconditioner was made of.
    pub(super) preconditioner_of: Making,
    /// What the matrix is of.
    pub(super) matrix_of: Making,
    /// Points whose columns are out of date.
    pub(super) stale: BTreeSet<u32>,
    /// Whether the preconditioner is to be made anew.
    pub(super) is_due: bool,
    /// Iterations a decade with the preconditioner as it was new.
    pub(super) pace: Option<f64>,
    /// Iterations beyond that since.
    pub(super) excess: f64,
}

impl Kept {
    /// Nothing is made yet.
    pub(super) fn new() -> Self {
        Self {
            preconditioner_of: Making::default(),
            matrix_of: Making::default(),
            stale: BTreeSet::new(),
            is_due: true,
            pace: None,
            excess: 0.0,
        }
    }

    /// Takes of the bonds of all processes those that are known here.
    ///
    /// # Errors
    ///
    /// If they are those of another body.
    pub(super) fn take_known(&mut self, numbers: &BondNumbers) -> Result<(), CheckpointError> {
        for making in [&mut self.preconditioner_of, &mut self.matrix_of] {
            *making = mem::take(making).of_known(numbers)?;
        }
        Ok(())
    }

    /// What all processes know of it, with their bonds on rank 0, in a body of some points.
    pub(super) fn of_all(&self, numbers: &BondNumbers, n_points: usize) -> Self {
        let mut stale = vec![0.0; n_points];
        for &point in &self.stale {
            stale[point as usize] = 1.0;
        }
        numbers.portion().largest(&mut stale);
        let marked = (0..).zip(stale).filter(|(_, mark)| *mark > 0.0);
        Self {
            preconditioner_of: self.preconditioner_of.of_all(numbers),
            matrix_of: self.matrix_of.of_all(numbers),
            stale: marked.map(|it| it.0).collect(),
            ..*self
        }
    }
}

impl Serial for Kept {
    fn write(&self, out: &mut Vec<u8>) {
        self.preconditioner_of.write(out);
        self.matrix_of.write(out);
        self.stale.iter().copied().collect::<Vec<u32>>().write(out);
        self.is_due.write(out);
        self.pace.write(out);
        self.excess.write(out);
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        let preconditioner_of = Serial::read(from)?;
        let matrix_of = Serial::read(from)?;
        let stale: Vec<u32> = Serial::read(from)?;
        Ok(Self {
            preconditioner_of,
            matrix_of,
            stale: stale.into_iter().collect(),
            is_due: Serial::read(from)?,
            pace: Serial::read(from)?,
            excess: Serial::read(from)?,
        })
    }
}
