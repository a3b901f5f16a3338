//! Bonds past their limits that are not broken yet.
//!
//! Of every criterion that softens, a bond remembers the largest e/e_0 so far (its running extreme), and from it comes what is
//! left of its stiffness. What an opened bond lost it lacks in tension, shear and rotation, not in compression; see
//! [`Weakened`].

use ligament_model::Bonds;
use ligament_model::element::{BondDeformation, StiffnessFactors};
use ligament_model::failure::{Criteria, Criterion, Softened, Weakened};
use rayon::prelude::*;

use crate::bond_numbers::BondNumbers;
use crate::checkpoint::CheckpointError;
use crate::serial::Serial;

/// Relative difference below which a bond is as far as it ever was.
const SAME: f64 = 1e-9;

/// State of bonds past their limits; empty where no bond softens.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Softening {
    /// Largest e/e_0 of states of equilibrium, shape (n_bonds) for each criterion; empty for those that do not soften.
    pub largest: Vec<Vec<f64>>,
    /// Largest e/e_0 with the iterate that equilibrium is sought from, shape (n_bonds) for each criterion.
    trial: Vec<Vec<f64>>,
    /// Remaining stiffness for the deformations of the iterate, shape (n_bonds).
    pub remaining: Vec<StiffnessFactors>,
}

impl Softening {
    /// Whether all arrays are those of bonds with these criteria.
    pub(crate) fn fits(&self, criteria: &Criteria, n_bonds: usize) -> bool {
        let lengths = |it: &Self| {
            let of = |lists: &[Vec<f64>]| lists.iter().map(Vec::len).collect::<Vec<usize>>();
            (of(&it.largest), of(&it.trial), it.remaining.len())
        };
        lengths(self) == lengths(&Self::of_sound_bonds(criteria, n_bonds))
    }

    /// Appends the softening of all bonds of the body, see [`BondNumbers::write`].
    pub(crate) fn write(&self, numbers: &BondNumbers, out: &mut Vec<u8>) {
        for lists in [&self.largest, &self.trial] {
            lists.len().write(out);
            lists.iter().for_each(|list| numbers.write(list, 0.0, out));
        }
        numbers.write(&self.remaining, StiffnessFactors::WHOLE, out);
    }

    /// Reads the softening of the local bonds, from that of all.
    ///
    /// # Errors
    ///
    /// If the bytes are damaged or of another body.
    pub(crate) fn read(numbers: &BondNumbers, from: &mut &[u8]) -> Result<Self, CheckpointError> {
        let lists = |from: &mut &[u8]| -> Result<Vec<Vec<f64>>, CheckpointError> {
            let count = usize::read(from)?;
            (0..count).map(|_| numbers.read(from)).collect()
        };
        Ok(Self {
            largest: lists(from)?,
            trial: lists(from)?,
            remaining: numbers.read(from)?,
        })
    }

    /// The state of sound bonds.
    pub fn of_sound_bonds(criteria: &Criteria, n_bonds: usize) -> Self {
        if !criteria.soften() {
            return Self::default();
        }
        let of = |it: &Criterion| vec![0.0; if it.after.is_brittle() { 0 } else { n_bonds }];
        let largest: Vec<Vec<f64>> = criteria.list.iter().map(of).collect();
        Self {
            trial: largest.clone(),
            largest,
            remaining: vec![StiffnessFactors::WHOLE; n_bonds],
        }
    }

    /// Takes the deformations of an iterate (n_bonds): decides what is left of the bonds now.
    ///
    /// A bond within its largest deformation keeps what it has; beyond, it follows its law, and at the end of its law it waits
    /// for its turn to break ([`AfterLimit::extreme`](ligament_model::failure::AfterLimit::extreme)). Where
    /// `is_one_way` the extremes of the iterates count as well, as in a body that loses its bonds faster than it is loaded.
    pub fn follow(
        &mut self,
        criteria: &Criteria,
        intact: &[bool],
        deformations: &[BondDeformation],
        is_one_way: bool,
    ) {
        for ((criterion, largest), trial) in
            criteria.list.iter().zip(&self.largest).zip(&mut self.trial)
        {
            if largest.is_empty() {
                continue;
            }
            trial.par_iter_mut().enumerate().for_each(|(bond, trial)| {
                let utilisation = criterion.utilisation(bond, &deformations[bond]);
                let floor = if is_one_way { *trial } else { largest[bond] };
                if intact[bond] {
                    let extreme = criterion.after.extreme(bond, utilisation);
                    *trial = extreme.map_or(floor, |it| floor.max(it));
                }
            });
        }
        let trial = &self.trial;
        (self.remaining.par_iter_mut().enumerate()).for_each(|(bond, remaining)| {
            if intact[bond] {
                let is_open = deformations[bond].stretch() >= 0.0;
                *remaining = remaining_of(criteria, trial, bond, is_open);
            }
        });
    }

    /// The iterate is in equilibrium: its extremes count from now on.
    pub fn settle(&mut self) {
        for (largest, trial) in self.largest.iter_mut().zip(&self.trial) {
            largest.copy_from_slice(trial);
        }
    }

    /// Energy that softening would have taken from an unbroken bond at a deformation, J.
    pub(crate) fn dissipated_at(
        &self,
        system: &dyn Bonds,
        criteria: &Criteria,
        bond: usize,
        deformation: &BondDeformation,
    ) -> f64 {
        let of = |(criterion, largest): (&Criterion, &Vec<f64>)| {
            let largest = *largest.get(bond)?;
            let utilisation = criterion.utilisation(bond, deformation);
            let now = criterion.after.extreme(bond, utilisation);
            let kappa = now.map_or(largest, |it| largest.max(it));
            let taken = criterion.after.at(bond, kappa).dissipated;
            (taken != 0.0).then(|| taken * system.energy_at_limit(criterion, bond))
        };
        let both = criteria.list.iter().zip(&self.largest);
        both.filter_map(of).sum()
    }

    /// Whether an unbroken bond softens farther at a deformation and any larger one of its kind: whether it is as far as it ever was.
    pub(crate) fn goes_on(
        &self,
        criteria: &Criteria,
        bond: usize,
        deformation: &BondDeformation,
    ) -> bool {
        let mut both = criteria.list.iter().zip(&self.largest);
        both.any(|(criterion, largest)| {
            let Some(&largest) = largest.get(bond) else {
                return false;
            };
            let extreme = criterion
                .after
                .extreme(bond, criterion.utilisation(bond, deformation));
            extreme.is_some_and(|it| it > 1.0 && it >= largest * (1.0 - SAME))
        })
    }

    /// The bond under a criterion that softens, by its extreme in equilibrium; sound for one that does not.
    pub fn bond(&self, criteria: &Criteria, criterion: usize, bond: usize) -> Softened {
        match self.largest.get(criterion).and_then(|it| it.get(bond)) {
            None => Softened::SOUND,
            Some(&largest) => criteria.list[criterion].after.at(bond, largest),
        }
    }
}

/// What the largest utilisations leave of a bond, the weakest of all criteria.
fn remaining_of(
    criteria: &Criteria,
    largest: &[Vec<f64>],
    bond: usize,
    is_open: bool,
) -> StiffnessFactors {
    let [mut opening, mut crushing, mut sliding] = [1.0_f64; 3];
    for (criterion, largest) in criteria.list.iter().zip(largest) {
        let Some(&largest) = largest.get(bond) else {
            continue;
        };
        if largest <= 1.0 {
            continue;
        }
        let secant = criterion.after.at(bond, largest).secant;
        let weakest = match criterion.measure.weakens() {
            Weakened::Opening => &mut opening,
            Weakened::Crushing => &mut crushing,
            Weakened::Sliding => &mut sliding,
        };
        *weakest = weakest.min(secant);
    }
    StiffnessFactors {
        axial: if is_open { opening } else { crushing },
        shear: opening.min(crushing).min(sliding),
        rotational: opening.min(crushing),
    }
}
