//! Softening of unbroken bonds beyond their limits.
//!
//! For every softening criterion, the largest e/e_0 of a bond so far (its running extreme) determines its remaining stiffness. An
//! opened bond loses stiffness in tension, shear and rotation, not in compression; see [`Weakened`].

use std::borrow::Cow;
use std::io::Read;

use ligament_model::Bonds;
use ligament_model::element::{BondDeformation, StiffnessFactors};
use ligament_model::failure::{
    AfterLimit, Criteria, CriteriaInState, Criterion, Softened, StateVariables, Weakened,
};
use ligament_model::parallel::{self, CHUNK};

use crate::bond_numbers::BondNumbers;
use crate::checkpoint::CheckpointError;
use crate::serial::{Serial, Sink};

/// Relative difference from its extreme below which a bond counts as at its extreme.
const SAME: f64 = 1e-9;

/// Relative increase of a deformation over which the slope of a law of softening is taken.
const NEXT: f64 = 1e-6;

/// State of bonds beyond their limits; empty where no bond softens.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Softening {
    /// Largest e/e_0 in equilibrium states, shape (n_bonds) for each criterion; empty for criteria that do not soften.
    pub largest: Vec<Vec<f64>>,
    /// Largest e/e_0 including the present iterate, shape (n_bonds) for each criterion.
    trial: Vec<Vec<f64>>,
    /// Remaining stiffness at the deformations of the iterate, shape (n_bonds).
    pub remaining: Vec<StiffnessFactors>,
    /// Deformations at which bonds began to soften by the stress around them, infinite for bonds that did not, shape (n_bonds) for each
    /// criterion; empty for criteria without stress.
    begun: Vec<Vec<f64>>,
    /// Limits and laws of the criteria that follow from where bonds began; empty where no criterion lets bonds begin.
    variables: Vec<StateVariables>,
}

impl Softening {
    /// Whether all arrays have the shapes for these criteria and this number of bonds.
    pub(crate) fn fits(&self, criteria: &Criteria, n_bonds: usize) -> bool {
        let lengths = |it: &Self| {
            let of = |lists: &[Vec<f64>]| lists.iter().map(Vec::len).collect::<Vec<usize>>();
            let (largest, trial, begun) = (of(&it.largest), of(&it.trial), of(&it.begun));
            (largest, trial, begun, it.remaining.len())
        };
        lengths(self) == lengths(&Self::of_sound_bonds(criteria, n_bonds))
    }

    /// Appends the softening of all bonds of the body, see [`BondNumbers::write`].
    pub(crate) fn write(&self, numbers: &BondNumbers, out: &mut dyn Sink) {
        for lists in [&self.largest, &self.trial] {
            lists.len().write(out);
            lists.iter().for_each(|list| numbers.write(list, 0.0, out));
        }
        numbers.write(&self.remaining, StiffnessFactors::WHOLE, out);
        self.begun.len().write(out);
        (self.begun.iter()).for_each(|list| numbers.write(list, f64::INFINITY, out));
    }

    /// Reads the softening of all bonds, and keeps the softening of the local bonds.
    ///
    /// # Errors
    ///
    /// If the bytes are damaged or belong to another body.
    pub(crate) fn read(
        numbers: &BondNumbers,
        criteria: &Criteria,
        from: &mut dyn Read,
    ) -> Result<Self, CheckpointError> {
        let lists = |usual: f64, from: &mut dyn Read| -> Result<Vec<Vec<f64>>, CheckpointError> {
            let count = usize::read(from)?;
            (0..count).map(|_| numbers.read(usual, from)).collect()
        };
        let mut softening = Self {
            largest: lists(0.0, from)?,
            trial: lists(0.0, from)?,
            remaining: numbers.read(StiffnessFactors::WHOLE, from)?,
            begun: lists(f64::INFINITY, from)?,
            variables: Vec::new(),
        };
        let lengths = |of: &[Vec<f64>]| of.iter().map(Vec::len).collect::<Vec<usize>>();
        if !softening.begun.is_empty() {
            if lengths(&softening.begun) != lengths(&criteria.none_begun()) {
                return Err(CheckpointError::OtherModel);
            }
            softening.variables = criteria.begun(&softening.begun);
        }
        Ok(softening)
    }

    /// State of bonds without softening.
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
            variables: criteria.begun(&criteria.none_begun()),
            begun: criteria.none_begun(),
        }
    }

    /// Deformations at which bonds began to soften by the stress around them, infinite for bonds that did not, shape (n_bonds) for each
    /// criterion; empty for criteria without stress.
    pub fn begun(&self) -> &[Vec<f64>] {
        &self.begun
    }

    /// Lets bonds begin to soften at deformations, in the shape of [`begun`](Self::begun).
    pub(crate) fn begin(&mut self, criteria: &Criteria, begun: Vec<Vec<f64>>) {
        self.variables = criteria.begun(&begun);
        self.begun = begun;
    }

    /// The criteria with the limits of the bonds that began to soften.
    pub fn criteria<'a>(&self, criteria: &'a Criteria) -> CriteriaInState<'a> {
        criteria.with_variables(&self.variables)
    }

    /// Updates the trial extremes and the remaining stiffness of the bonds to the deformations of an iterate (n_bonds).
    ///
    /// A bond within its largest deformation keeps its stiffness; beyond, it follows its law, and past the end of its law it keeps
    /// a small remainder until it breaks ([`AfterLimit::extreme`](ligament_model::failure::AfterLimit::extreme)). With `is_one_way`
    /// the extremes of the iterates count as well, as in a body that loses its bonds faster than it is loaded.
    pub fn follow(
        &mut self,
        criteria: &Criteria,
        intact: &[bool],
        deformations: &[BondDeformation],
        is_one_way: bool,
    ) {
        let criteria = &self.criteria(criteria);
        for (place, (largest, trial)) in self.largest.iter().zip(&mut self.trial).enumerate() {
            if largest.is_empty() {
                continue;
            }
            let after = criteria.after(place);
            parallel::for_each(trial.chunks_mut(CHUNK).enumerate(), |(chunk, trial)| {
                for (bond, trial) in (chunk * CHUNK..).zip(trial) {
                    let utilisation = criteria.utilisation_by(place, bond, &deformations[bond]);
                    let floor = if is_one_way { *trial } else { largest[bond] };
                    if intact[bond] {
                        let extreme = after.extreme(bond, utilisation);
                        *trial = extreme.map_or(floor, |it| floor.max(it));
                    }
                }
            });
        }
        let trial = &self.trial;
        let chunks = self.remaining.chunks_mut(CHUNK).enumerate();
        parallel::for_each(chunks, |(chunk, remaining)| {
            for (bond, remaining) in (chunk * CHUNK..).zip(remaining) {
                if intact[bond] {
                    let is_open = deformations[bond].stretch() >= 0.0;
                    *remaining = remaining_of(criteria, trial, bond, is_open);
                }
            }
        });
    }

    /// The bonds that are neither broken nor have begun to soften: only these show the strain of the body.
    pub fn sound<'a>(&self, intact: &'a [bool]) -> Cow<'a, [bool]> {
        if self.largest.iter().all(Vec::is_empty) {
            return Cow::Borrowed(intact);
        }
        let begun = |bond: usize| {
            let began = self
                .begun
                .iter()
                .any(|it| it.get(bond).is_some_and(|it| it.is_finite()));
            let mut largest = self.largest.iter();
            began || largest.any(|it| it.get(bond).is_some_and(|it| *it > 1.0))
        };
        let numbered = intact.iter().enumerate();
        numbered
            .map(|(bond, intact)| *intact && !begun(bond))
            .collect()
    }

    /// Accepts the extremes of an iterate that is in equilibrium.
    pub fn settle(&mut self) {
        for (largest, trial) in self.largest.iter_mut().zip(&self.trial) {
            largest.copy_from_slice(trial);
        }
    }

    /// Energy that softening would have dissipated in an unbroken bond at a deformation, J.
    pub(crate) fn dissipated_at(
        &self,
        system: &dyn Bonds,
        criteria: &CriteriaInState<'_>,
        bond: usize,
        deformation: &BondDeformation,
    ) -> f64 {
        let of = |(place, largest): (usize, &Vec<f64>)| {
            let largest = *largest.get(bond)?;
            let after = criteria.after(place);
            let now = after.extreme(bond, criteria.utilisation_by(place, bond, deformation));
            let kappa = now.map_or(largest, |it| largest.max(it));
            let dissipated = after.at(bond, kappa).dissipated;
            (dissipated != 0.0).then(|| dissipated * energy_at_limit(system, criteria, place, bond))
        };
        self.largest.iter().enumerate().filter_map(of).sum()
    }

    /// Whether an unbroken bond is at its extreme at a deformation, so that it softens further at any larger one of its kind.
    pub(crate) fn goes_on(
        &self,
        criteria: &CriteriaInState<'_>,
        bond: usize,
        deformation: &BondDeformation,
    ) -> bool {
        let mut largest = self.largest.iter().enumerate();
        largest.any(|(place, largest)| {
            let Some(&largest) = largest.get(bond) else {
                return false;
            };
            let utilisation = criteria.utilisation_by(place, bond, deformation);
            let extreme = criteria.after(place).extreme(bond, utilisation);
            extreme.is_some_and(|it| it > 1.0 && it >= largest * (1.0 - SAME))
        })
    }

    /// Law after the limit of a criterion.
    fn after<'a>(&'a self, criteria: &'a Criteria, place: usize) -> &'a AfterLimit {
        let own = &criteria.list[place];
        let variables = self.variables.get(place);
        variables.map_or(&own.after, |it| it.after(own))
    }

    /// Criterion that weakens a bond most, and the change of its secant with ln(e) in further loading; None for a bond that is within its
    /// largest deformation.
    pub(crate) fn fall(
        &self,
        criteria: &CriteriaInState<'_>,
        bond: usize,
        deformation: &BondDeformation,
    ) -> Option<(usize, f64)> {
        let trial = self.trial.iter().enumerate();
        let beyond = trial.filter_map(|(place, trial)| {
            let largest = trial.get(bond).filter(|it| **it > 1.0)?;
            Some((
                place,
                *largest,
                criteria.after(place).at(bond, *largest).secant,
            ))
        });
        let (place, largest, secant) = beyond.min_by(|one, other| one.2.total_cmp(&other.2))?;
        let after = criteria.after(place);
        let now = criteria.utilisation_by(place, bond, deformation);
        let is_loaded = after.extreme(bond, now)? >= largest * (1.0 - SAME);
        let next = after.extreme(bond, largest * (1.0 + NEXT))?;
        is_loaded.then(|| (place, (after.at(bond, next).secant - secant) / NEXT))
    }

    /// Softening of a bond under a criterion, by its extreme in equilibrium; undamaged for a criterion that does not soften.
    pub fn bond(&self, criteria: &Criteria, criterion: usize, bond: usize) -> Softened {
        match self.largest.get(criterion).and_then(|it| it.get(bond)) {
            None => Softened::SOUND,
            Some(&largest) => self.after(criteria, criterion).at(bond, largest),
        }
    }
}

/// Energy of a bond at its limit by a criterion, J; 0 where it never fails.
pub(crate) fn energy_at_limit(
    system: &dyn Bonds,
    criteria: &CriteriaInState<'_>,
    place: usize,
    bond: usize,
) -> f64 {
    let criterion = &criteria.criteria().list[place];
    let limit = criteria.limits(place)[bond];
    criterion.energy_at(limit, system.rigidities(), bond)
}

/// Remaining stiffness of a bond for the largest utilisations, the smallest of all criteria.
fn remaining_of(
    criteria: &CriteriaInState<'_>,
    largest: &[Vec<f64>],
    bond: usize,
    is_open: bool,
) -> StiffnessFactors {
    let [mut opening, mut crushing, mut sliding] = [1.0_f64; 3];
    for (place, largest) in largest.iter().enumerate() {
        let Some(&largest) = largest.get(bond) else {
            continue;
        };
        if largest <= 1.0 {
            continue;
        }
        let secant = criteria.after(place).at(bond, largest).secant;
        let weakened: &mut [&mut f64] = match criteria.criteria().list[place].measure.weakens() {
            Weakened::Opening => &mut [&mut opening],
            Weakened::Crushing => &mut [&mut crushing],
            Weakened::Sliding => &mut [&mut sliding],
            Weakened::Whole => &mut [&mut opening, &mut crushing],
        };
        for weakest in weakened {
            **weakest = weakest.min(secant);
        }
    }
    StiffnessFactors {
        axial: if is_open { opening } else { crushing },
        shear: opening.min(crushing).min(sliding),
        rotational: opening.min(crushing),
    }
}
