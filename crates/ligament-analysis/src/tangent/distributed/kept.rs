//! What several ranks keep of a matrix and its preconditioner beside their values.

use std::collections::BTreeSet;

use crate::bond_numbers::BondNumbers;
use crate::checkpoint::CheckpointError;
use crate::serial::Serial;
use crate::tangent::making::FactorRecord;

/// What a preconditioner came from and how it serves: the same on all ranks.
pub(super) struct PreconditionerState {
    /// What the preconditioner was made of.
    pub(super) preconditioner_of: FactorRecord,
    /// What the matrix is of.
    pub(super) matrix_of: FactorRecord,
    /// Points whose columns are out of date.
    pub(super) stale: BTreeSet<u32>,
    /// Whether the preconditioner is to be made anew.
    pub(super) is_due: bool,
    /// Iterations a decade with the preconditioner as it was new.
    pub(super) pace: Option<f64>,
    /// Iterations beyond that since.
    pub(super) excess: f64,
}

impl PreconditionerState {
    /// Nothing is made yet.
    pub(super) fn new() -> Self {
        Self {
            preconditioner_of: FactorRecord::default(),
            matrix_of: FactorRecord::default(),
            stale: BTreeSet::new(),
            is_due: true,
            pace: None,
            excess: 0.0,
        }
    }

    /// Reads what was kept, of bonds those that are known here where processes share the body out.
    ///
    /// # Errors
    ///
    /// If the bytes are damaged or of another body.
    pub(super) fn read_known(
        numbers: Option<&BondNumbers>,
        from: &mut &[u8],
    ) -> Result<Self, CheckpointError> {
        let mut making = || match numbers {
            None => Ok(FactorRecord::read(from)?),
            Some(numbers) => FactorRecord::read_known(numbers, from),
        };
        let (preconditioner_of, matrix_of) = (making()?, making()?);
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

    /// Appends what it takes to make it again.
    pub(super) fn write(&self, out: &mut Vec<u8>) {
        self.preconditioner_of.write(out);
        self.matrix_of.write(out);
        self.stale.iter().copied().collect::<Vec<u32>>().write(out);
        self.is_due.write(out);
        self.pace.write(out);
        self.excess.write(out);
    }

    /// What all processes know of it, with their bonds on rank 0.
    pub(super) fn of_all(&self, numbers: &BondNumbers) -> Self {
        let stale: Vec<_> = self.stale.iter().map(|&point| [f64::from(point)]).collect();
        let stale = numbers.portion().concatenated(&stale).into_iter();
        Self {
            preconditioner_of: self.preconditioner_of.of_all(numbers),
            matrix_of: self.matrix_of.of_all(numbers),
            stale: stale.map(|[point]| point as u32).collect(),
            ..*self
        }
    }
}
