//! Record of the bonds, supports and updates from which a factor resulted.
//!
//! Updates in place accumulate rounding, so that a factor of the present bonds differs in its bits. To continue a run bit for bit,
//! its factor is computed from the recorded bonds and updated by the recorded terms. The record takes a few kilobytes, the values
//! of the factor most of the memory of the run.

use std::io::Read;
use std::sync::Arc;

use ligament_linalg::{Factorisation, RankOne, SymmetricMatrix};
use ligament_model::element::StiffnessFactors;
use ligament_model::{Bonds, UnbrokenBonds};
use serde::{Deserialize, Serialize};

use crate::bond_numbers::BondNumbers;
use crate::checkpoint::CheckpointError;
use crate::serial::{Serial, Sink};
use crate::state::State;
use crate::stiffness::Stiffness;
use crate::unknowns::Unknowns;

/// Bonds and supports from which a factor was computed, and all updates since.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct FactorRecord {
    /// Whether each bond was intact, shape (n_bonds).
    pub(super) intact: Vec<bool>,
    /// Remaining stiffness of softening bonds, shape (n_bonds); empty where none softened.
    pub(super) remaining: Vec<StiffnessFactors>,
    /// Fixed degrees of freedom, decoupled from the others, shape (n_degrees_of_freedom).
    pub(super) held: Vec<bool>,
    /// Terms other than bonds: closed pairs, and added supports that are not decoupled.
    pub(super) beside: Vec<RankOne>,
    /// Updates in place, in order.
    pub(super) changes: Vec<Vec<RankOne>>,
}

impl FactorRecord {
    /// Record of a new factor of a state, with its decoupled degrees of freedom and additional terms.
    pub(super) fn begun(state: &State, held: Vec<bool>, beside: Vec<RankOne>) -> Self {
        Self {
            intact: state.intact.clone(),
            remaining: state.softening.remaining.clone(),
            held,
            beside,
            changes: Vec::new(),
        }
    }

    /// Bonds from which the factor was computed.
    pub(super) fn bonds(&self) -> UnbrokenBonds<'_> {
        UnbrokenBonds {
            intact: &self.intact,
            remaining: &self.remaining,
        }
    }

    /// Appends the record with all bonds of the body, see [`BondNumbers::write`].
    pub(super) fn write_all(&self, numbers: &BondNumbers, out: &mut dyn Sink) {
        numbers.write(&self.intact, true, out);
        numbers.write(&self.remaining, StiffnessFactors::WHOLE, out);
        let n_components = self.held.len() / numbers.subdomain().n_points().max(1);
        numbers.write_points((&self.held, n_components), false, out);
        self.beside.write(out);
        self.changes.write(out);
    }

    /// Reads a record of all bonds, and keeps the local bonds.
    ///
    /// # Errors
    ///
    /// If the bytes are damaged or belong to another body.
    pub(super) fn read_local(
        (numbers, n_components): (&BondNumbers, usize),
        from: &mut dyn Read,
    ) -> Result<Self, CheckpointError> {
        Ok(Self {
            intact: numbers.read(true, from)?,
            remaining: numbers.read(StiffnessFactors::WHOLE, from)?,
            held: numbers.read_points(n_components, false, from)?,
            beside: Serial::read(from)?,
            changes: Serial::read(from)?,
        })
    }

    /// Whether the record has the bonds and unknowns of this body.
    pub(super) fn fits(&self, system: &dyn Bonds, unknowns: &Unknowns) -> bool {
        let n_bonds = system.ends.len();
        let n_unknowns = unknowns.len();
        let terms = self.changes.iter().flatten().chain(&self.beside);
        let entries = terms.flat_map(|it| &it.entries);
        self.intact.len() == n_bonds
            && (self.remaining.is_empty() || self.remaining.len() == n_bonds)
            && self.held.len() == unknowns.layout().n_degrees_of_freedom()
            && entries
                .into_iter()
                .all(|(unknown, _)| *unknown < n_unknowns)
    }

    /// Matrix from which the factor was computed.
    pub(super) fn matrix(&self, stiffness: &Stiffness) -> SymmetricMatrix {
        let mut matrix = stiffness.assemble(self.bonds(), &self.held);
        for term in &self.beside {
            matrix.add_outer(term.weight, &term.entries);
        }
        matrix
    }

    /// Computes and updates the factor as recorded, with the same bits; none where the factorisation fails.
    pub(super) fn factor(&self, stiffness: &Arc<Stiffness>) -> Option<Box<dyn Factorisation>> {
        let matrix = self.matrix(stiffness);
        let kind = stiffness.choice().factorisation;
        let mut factor = kind.factorise(stiffness.symbolic(), &matrix).ok()?;
        for terms in &self.changes {
            factor.change(terms, &[]).ok()?;
        }
        Some(factor)
    }
}
