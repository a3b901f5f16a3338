//! Criteria in a state of the body: with the limits and stresses that the bonds have then.

use std::borrow::Cow;
use std::sync::Arc;

use super::criterion::{Criteria, Criterion, Stresses};
use super::hooke::{Moduli, StressAcross};
use super::measure::Measure;
use super::softening::AfterLimit;
use super::surroundings::Surroundings;
use crate::element::BondDeformation;
use crate::interface::Bonds;
use crate::stress::point_strain::Motion;

/// Relative difference below which a stress is as far beyond two surfaces: a bar under tension is on both of Mohr and Coulomb.
const SAME: f64 = 1e-9;

impl Criteria {
    /// Stresses across the bonds in a motion of a body of which some bonds are left, with the deformations (n_bonds) in it, for each
    /// criterion; empty for those that take none.
    pub fn stresses(
        &self,
        system: &dyn Bonds,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
    ) -> Vec<Stresses> {
        let of = |criterion: &Criterion| match criterion.follows_stress() {
            true => {
                let moduli = |bond| Moduli::from_coefficients(criterion.coefficients(bond));
                Stresses::new(system.stresses_across(motion, deformations, &moduli))
            }
            false => Stresses::default(),
        };
        self.list.iter().map(of).collect()
    }

    /// The criteria with the limits and the stresses that they have in a state of the body, in which some bonds are intact, of the
    /// deformations (n_bonds) and with the [`stresses`](Self::stresses).
    pub fn in_state(
        &self,
        stresses: &[Stresses],
        intact: &[bool],
        deformations: &[BondDeformation],
    ) -> Cow<'_, Self> {
        if self.list.iter().all(|it| it.surroundings.is_none()) {
            return Cow::Borrowed(self);
        }
        let mut criteria = self.clone();
        for (criterion, stresses) in criteria.list.iter_mut().zip(stresses) {
            match criterion.surroundings.as_deref() {
                None | Some(Surroundings::Starting(_)) => {}
                Some(Surroundings::CrackAtPoints(crack)) => {
                    let limits = crack.limits(&criterion.limit, intact, deformations);
                    criterion.limit = limits.into();
                }
                Some(Surroundings::Stress) => criterion.stress = stresses.clone(),
            }
        }
        Cow::Owned(criteria)
    }

    /// The deformations at which bonds began to soften, those that begin in a motion among them, from those that had begun: shape (n_bonds)
    /// for each criterion by which bonds begin, and infinite for bonds that did not; None where none begins now. `motion` has the bonds
    /// intact that are neither broken nor soften, and no other begins.
    pub fn beginning(
        &self,
        begun: &[Vec<f64>],
        system: &dyn Bonds,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
    ) -> Option<Vec<Vec<f64>>> {
        let of_criteria = self.utilisations_at_start(system, motion, deformations);
        let mut begun = begun.to_vec();
        let mut some = false;
        for bond in (0..deformations.len()).filter(|bond| motion.intact[*bond]) {
            let mut farthest = None;
            for (place, of_bonds) in of_criteria.iter().enumerate() {
                let utilisation = of_bonds.as_ref().map_or(0.0, |it| it[bond]);
                // Of surfaces that the stress is as far beyond the first one decides, tension before shear.
                if utilisation >= farthest.map_or(1.0, |(_, it)| it * (1.0 + SAME)) {
                    farthest = Some((place, utilisation));
                }
            }
            if let Some((place, utilisation)) = farthest
                && let Some(starting) = self.list[place].starting()
            {
                let deformation = self.list[place].measure(bond, &deformations[bond]);
                let least = self.list[place].after.law().parameter;
                let least = least.map_or(1.0, |it| it.least_energy);
                begun[place][bond] = starting.began_at(bond, deformation, utilisation, least);
                some = true;
            }
        }
        some.then_some(begun)
    }

    /// Stress around each bond over the strength at which it begins to soften, for each criterion by which bonds begin.
    fn utilisations_at_start(
        &self,
        system: &dyn Bonds,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
    ) -> Vec<Option<Vec<f64>>> {
        let of = |criterion: &Criterion| {
            let starting = criterion.starting()?;
            Some(system.utilisations(motion, deformations, starting))
        };
        self.list.iter().map(of).collect()
    }

    /// The criteria of a body of which no bond began to soften, in a motion: those by which bonds begin see the stress around each bond over the
    /// strength, with the limit 1. In proportion to the load that is proportional too.
    pub fn at_start(
        &self,
        system: &dyn Bonds,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
    ) -> Cow<'_, Self> {
        let of_criteria = self.utilisations_at_start(system, motion, deformations);
        if of_criteria.iter().all(Option::is_none) {
            return Cow::Borrowed(self);
        }
        let mut criteria = self.clone();
        for (criterion, utilisations) in criteria.list.iter_mut().zip(of_criteria) {
            let Some(utilisations) = utilisations else {
                continue;
            };
            let stress = |&normal: &f64| StressAcross {
                normal,
                ..Default::default()
            };
            let limit = vec![1.0; utilisations.len()];
            *criterion = Criterion {
                stress: Stresses::new(utilisations.iter().map(stress).collect()),
                surroundings: Some(Arc::new(Surroundings::Stress)),
                choice: criterion.choice,
                ..Criterion::brittle(criterion.name, Measure::NormalStress, limit)
            };
        }
        Cow::Owned(criteria)
    }

    /// The criteria of bonds that began to soften at these deformations, as [`beginning`](Self::beginning) gives them.
    pub fn begun_at(&self, begun: &[Vec<f64>]) -> Self {
        let mut criteria = self.clone();
        for (place, begun) in begun.iter().enumerate() {
            let Some(starting) = self.list[place].starting() else {
                continue;
            };
            let law = *self.list[place].after.law();
            let of_energy = law.parameter.map(|it| it.for_energy);
            let parameter = begun
                .iter()
                .zip(&starting.critical)
                .map(|(began, critical)| {
                    let energy = (critical / began).powi(2);
                    match began.is_finite() {
                        true => of_energy.map_or(f64::NAN, |parameter| parameter(energy)),
                        false => f64::INFINITY,
                    }
                });
            criteria.list[place].after = AfterLimit::new(law, parameter.collect());
            criteria.list[place].limit = begun.clone().into();
            for back in starting.never_began {
                let never_began = Arc::make_mut(&mut criteria.list[place - back].limit);
                let never_began = never_began.iter_mut().zip(begun);
                for (limit, _) in never_began.filter(|(_, began)| began.is_finite()) {
                    *limit = f64::INFINITY;
                }
            }
        }
        criteria
    }

    /// Stresses across bonds that never begin to soften at which these break, over the strength, of those bonds for which that is less than one;
    /// their horizon is several times E G_c/F_t^2.
    pub fn below_strength(&self) -> Vec<f64> {
        let of = |(place, criterion): (usize, &Criterion)| {
            let starting = criterion.starting()?;
            let of_stress = &self.list[place - starting.never_began[0]];
            let both = of_stress.limit.iter().zip(&starting.strength);
            let shares = both.map(|(limit, strength)| limit / strength);
            Some(shares.filter(|it| *it < 1.0).collect())
        };
        let first: Option<Vec<f64>> = self.list.iter().enumerate().find_map(of);
        first.unwrap_or_default()
    }

    /// Deformations at which bonds began to soften where none did yet, shape (n_bonds) for each criterion by which they begin.
    pub fn none_begun(&self) -> Vec<Vec<f64>> {
        let of = |it: &Criterion| match it.starting() {
            Some(_) => vec![f64::INFINITY; it.limit.len()],
            None => Vec::new(),
        };
        self.list.iter().map(of).collect()
    }
}
