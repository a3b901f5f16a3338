//! How a factor came about: what it was made of, and how it was changed since.
//!
//! Changes in place carry rounding from one to the next, so that a factor made from the bonds as they are now has other bits. To go
//! on with a run bit by bit its factor is made as it was made, and changed as it was changed. That takes a few kilobytes, where the
//! values of the factor would take most of the memory of the run.

use std::sync::Arc;

use ligament_linalg::{Factorisation, RankOne, SymmetricMatrix};
use ligament_model::element::StiffnessFactors;
use ligament_model::{Bonds, UnbrokenBonds};

use crate::bond_numbers::BondNumbers;
use crate::checkpoint::CheckpointError;
use crate::serial;
use crate::serial::{Damaged, Serial};
use crate::state::State;
use crate::stiffness::Stiffness;
use crate::unknowns::Unknowns;

/// Bonds and holds that a factor was made of, and all changes since.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct FactorRecord {
    /// Whether each bond was unbroken, shape (n_bonds).
    pub(super) intact: Vec<bool>,
    /// What was left of softening bonds, shape (n_bonds); empty where none softened.
    pub(super) remaining: Vec<StiffnessFactors>,
    /// Degrees of freedom that were held, and so are cut off from the others, shape (n_degrees_of_freedom).
    pub(super) held: Vec<bool>,
    /// Terms beside those of the bonds: of pairs that were closed, and of what was held without being cut off.
    pub(super) beside: Vec<RankOne>,
    /// Changes in place, in their order.
    pub(super) changes: Vec<Vec<RankOne>>,
}

serial!(FactorRecord {
    intact,
    remaining,
    held,
    beside,
    changes
});

impl FactorRecord {
    /// The beginning of a factor of a state with the degrees of freedom that are cut off, and terms beside those of the bonds.
    pub(super) fn begun(state: &State, held: Vec<bool>, beside: Vec<RankOne>) -> Self {
        Self {
            intact: state.intact.clone(),
            remaining: state.softening.remaining.clone(),
            held,
            beside,
            changes: Vec::new(),
        }
    }

    /// The bonds that the factor was made of.
    pub(super) fn bonds(&self) -> UnbrokenBonds<'_> {
        UnbrokenBonds {
            intact: &self.intact,
            remaining: &self.remaining,
        }
    }

    /// Appends the making with all bonds of the body, see [`BondNumbers::write`].
    pub(super) fn write_all(&self, numbers: &BondNumbers, out: &mut Vec<u8>) {
        numbers.write(&self.intact, true, out);
        numbers.write(&self.remaining, StiffnessFactors::WHOLE, out);
        self.held.write(out);
        self.beside.write(out);
        self.changes.write(out);
    }

    /// Reads a making with the local bonds alone, from that of all bonds.
    ///
    /// # Errors
    ///
    /// If the bytes are damaged or of another body.
    pub(super) fn read_local(
        numbers: &BondNumbers,
        from: &mut &[u8],
    ) -> Result<Self, CheckpointError> {
        Ok(Self {
            intact: numbers.read(from)?,
            remaining: numbers.read(from)?,
            held: Serial::read(from)?,
            beside: Serial::read(from)?,
            changes: Serial::read(from)?,
        })
    }

    /// Whether all is of a body with these unknowns.
    pub(super) fn fits(&self, system: &dyn Bonds, unknowns: &Unknowns) -> bool {
        let n_bonds = system.ends().len();
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

    /// The matrix that the factor was made of.
    pub(super) fn matrix(&self, stiffness: &Stiffness) -> SymmetricMatrix {
        let mut matrix = stiffness.assemble(self.bonds(), &self.held);
        for term in &self.beside {
            matrix.add_outer(term.weight, &term.entries);
        }
        matrix
    }

    /// The factor that comes about so, with the same bits; none where there was none.
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

impl Serial for RankOne {
    fn write(&self, out: &mut Vec<u8>) {
        self.weight.write(out);
        self.entries.write(out);
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        Ok(Self {
            weight: Serial::read(from)?,
            entries: Serial::read(from)?,
        })
    }
}
