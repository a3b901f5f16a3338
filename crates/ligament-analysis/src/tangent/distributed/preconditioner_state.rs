//! State of a distributed matrix and its preconditioner, apart from their values.

use std::collections::BTreeSet;
use std::io::Read;

use crate::bond_numbers::BondNumbers;
use crate::checkpoint::CheckpointError;
use crate::serial::{Serial, Sink};
use crate::tangent::factor_record::FactorRecord;

/// Origin and performance of a preconditioner, equal on all ranks.
pub(super) struct PreconditionerState {
    /// Bonds and supports from which the preconditioner was built.
    pub(super) preconditioner_of: FactorRecord,
    /// Bonds and supports of the matrix.
    pub(super) matrix_of: FactorRecord,
    /// Points whose columns are outdated.
    pub(super) stale: BTreeSet<u32>,
    /// Whether the preconditioner must be rebuilt.
    pub(super) is_due: bool,
    /// Iterations per decade of residual reduction with the new preconditioner.
    pub(super) pace: Option<f64>,
    /// Iterations in excess of that rate since then.
    pub(super) excess: f64,
}

impl PreconditionerState {
    /// State before the first matrix.
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

    /// Reads the state of all bonds, and keeps the local bonds.
    ///
    /// # Errors
    ///
    /// If the bytes are damaged or belong to another body.
    pub(super) fn read(
        (numbers, n_components): (&BondNumbers, usize),
        from: &mut dyn Read,
    ) -> Result<Self, CheckpointError> {
        let mut making = || FactorRecord::read_local((numbers, n_components), from);
        let (preconditioner_of, matrix_of) = (making()?, making()?);
        let stale: Vec<u32> = Serial::read(from)?;
        let stale = stale
            .into_iter()
            .filter_map(|it| numbers.subdomain().point(it));
        Ok(Self {
            preconditioner_of,
            matrix_of,
            stale: stale.collect(),
            is_due: Serial::read(from)?,
            pace: Serial::read(from)?,
            excess: Serial::read(from)?,
        })
    }

    /// Appends the state with all bonds of the body, see [`BondNumbers::write`].
    pub(super) fn write(&self, numbers: &BondNumbers, out: &mut dyn Sink) {
        self.preconditioner_of.write_all(numbers, out);
        self.matrix_of.write_all(numbers, out);
        let subdomain = numbers.subdomain();
        let stale = self
            .stale
            .iter()
            .map(|&it| [subdomain.number(it)])
            .collect();
        let stale = subdomain.all_gather_list(stale).into_iter();
        let stale: BTreeSet<u32> = stale.map(|[point]| point).collect();
        stale.into_iter().collect::<Vec<u32>>().write(out);
        self.is_due.write(out);
        self.pace.write(out);
        self.excess.write(out);
    }
}
