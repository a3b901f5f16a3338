//! What changes during a run.

use ligament_model::BondSystem;
use ligament_model::element::{BondElement, Element, Remaining};

use crate::softening::Softening;
use crate::unknowns::COMPONENTS;

/// Motion of the points and what is left of the bonds.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Load factor.
    pub load_factor: f64,
    /// Displacements and rotations, shape (3 n_points), m and rad.
    pub displacement: Vec<f64>,
    /// Which bonds are unbroken, shape (n_bonds).
    pub intact: Vec<bool>,
    /// Criterion by which each broken bond broke, shape (n_bonds).
    pub broken_by: Vec<Option<u8>>,
    /// How far unbroken bonds are past their limits; empty where no bond softens.
    pub softening: Softening,
    /// Energy that each bond has taken for good, shape (n_bonds), J.
    pub dissipated: Vec<f64>,
    /// Degrees of freedom held because nothing else would hold them, shape (3 n_points).
    pub held: Vec<bool>,
}

impl State {
    /// The unloaded body with all its bonds.
    pub fn fresh(system: &BondSystem) -> Self {
        let (n, n_bonds) = (COMPONENTS * system.cloud.len(), system.bonds.len());
        Self {
            load_factor: 0.0,
            displacement: vec![0.0; n],
            intact: vec![true; n_bonds],
            broken_by: vec![None; n_bonds],
            softening: Softening::default(),
            dissipated: vec![0.0; n_bonds],
            held: vec![false; n],
        }
    }

    /// Number of broken bonds.
    pub fn broken_bonds(&self) -> usize {
        self.intact.iter().filter(|intact| !**intact).count()
    }

    /// What is left of the bonds.
    pub fn bonds(&self) -> BondsLeft<'_> {
        BondsLeft {
            intact: &self.intact,
            remaining: &self.softening.remaining,
        }
    }
}

/// Which bonds are left, and how much of their stiffness.
#[derive(Debug, Clone, Copy)]
pub struct BondsLeft<'a> {
    /// Which are unbroken, shape (n_bonds).
    pub intact: &'a [bool],
    /// What is left of their stiffness, shape (n_bonds); empty where that is all of it.
    pub remaining: &'a [Remaining],
}

impl<'a> BondsLeft<'a> {
    /// Unbroken bonds (n_bonds) with all of their stiffness.
    pub fn whole(intact: &'a [bool]) -> Self {
        Self {
            intact,
            remaining: &[],
        }
    }

    /// The element of a bond with what is left of it; None if it is broken.
    #[inline(always)]
    pub fn typed_element<E: Element>(self, system: &BondSystem, bond: usize) -> Option<E> {
        if !self.intact[bond] {
            return None;
        }
        let whole = E::of(system, self.intact, bond);
        Some(self.left_of(bond, whole, E::weakened))
    }

    /// The same, of whatever kind it is.
    pub fn element(self, system: &BondSystem, bond: usize) -> Option<BondElement> {
        if !self.intact[bond] {
            return None;
        }
        let whole = BondElement::of(system, self.intact, bond);
        Some(self.left_of(bond, whole, BondElement::weakened))
    }

    #[inline(always)]
    fn left_of<E>(self, bond: usize, whole: E, weakened: impl FnOnce(E, &Remaining) -> E) -> E {
        match self.remaining.get(bond) {
            None => whole,
            Some(remaining) => weakened(whole, remaining),
        }
    }
}
