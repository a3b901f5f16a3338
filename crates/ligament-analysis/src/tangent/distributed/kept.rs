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

    /// Reads what was kept, with the local bonds alone.
    ///
    /// # Errors
    ///
    /// If the bytes are damaged or of another body.
    pub(super) fn read(numbers: &BondNumbers, from: &mut &[u8]) -> Result<Self, CheckpointError> {
        let mut making = || FactorRecord::read_local(numbers, from);
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

    /// Appends what it takes to make it again, with all bonds of the body, see [`BondNumbers::write`].
    pub(super) fn write(&self, numbers: &BondNumbers, out: &mut Vec<u8>) {
        self.preconditioner_of.write_all(numbers, out);
        self.matrix_of.write_all(numbers, out);
        let stale = self.stale.iter().map(|&point| [point]).collect();
        let stale = numbers.subdomain().all_gather_list(stale).into_iter();
        let stale: BTreeSet<u32> = stale.map(|[point]| point).collect();
        stale.into_iter().collect::<Vec<u32>>().write(out);
        self.is_due.write(out);
        self.pace.write(out);
        self.excess.write(out);
    }
}
