//! Criteria in a state of the body, and the variables of this state.

use std::sync::Arc;

use super::criterion::Surroundings;
use super::criterion::{Criteria, Criterion, Verdict};
use super::hooke::{Moduli, StressAcross};
use super::measure::Measure;
use super::softening::{AfterLimit, brittle};
use crate::element::BondDeformation;
use crate::interface::Bonds;
use crate::parallel;
use crate::stress::point_strain::Motion;

/// Relative difference of two utilisations that count as equal: a bar under tension meets both conditions of Mohr and Coulomb.
const SAME: f64 = 1e-9;

/// Stresses across the bonds of a body: the stresses at one load factor, times a number.
#[derive(Debug, Clone, PartialEq)]
pub struct Stresses {
    /// Stress across each bond, shape (n_bonds); empty where no measure takes it.
    of_bonds: Arc<Vec<StressAcross>>,
    /// Factor of all stresses.
    times: f64,
}

impl Stresses {
    /// Stresses across the bonds (n_bonds).
    fn new(of_bonds: Vec<StressAcross>) -> Self {
        Self {
            of_bonds: of_bonds.into(),
            times: 1.0,
        }
    }

    /// Stress across a bond over E'; zero where no measure takes it.
    #[inline]
    fn of_bond(&self, bond: usize) -> StressAcross {
        let of_bond = self.of_bonds.get(bond);
        of_bond.map_or_else(StressAcross::default, |it| it.scaled(self.times))
    }

    /// All stresses times a factor.
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            of_bonds: self.of_bonds.clone(),
            times: factor * self.times,
        }
    }

    /// The sum of the stresses and `factor` times others.
    fn plus(&self, other: &Self, factor: f64) -> Self {
        let factor = factor * other.times;
        let sum = |bond: usize| {
            let scaled = self.of_bonds[bond].scaled(self.times);
            scaled.plus(&other.of_bonds[bond], factor)
        };
        let n_bonds = self.of_bonds.len();
        Self::new(parallel::values(n_bonds, StressAcross::default(), sum))
    }
}

/// State variables of a criterion: what its measure and limits depend on beside the deformation of a bond.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StateVariables {
    /// Stresses across the bonds; None where the measure takes none.
    stress: Option<Stresses>,
    /// Limit of each bond in the state, shape (n_bonds); None for the limit of the criterion.
    limit: Option<Arc<Vec<f64>>>,
    /// Law after the limit in the state; None for the law of the criterion.
    after: Option<Arc<AfterLimit>>,
    /// Measure before any bond begins to soften; None for the measure of the criterion.
    before_softening: Option<Measure>,
}

/// Empty state variables, of a criterion that depends on the deformation alone.
static NO_VARIABLES: StateVariables = StateVariables {
    stress: None,
    limit: None,
    after: None,
    before_softening: None,
};

/// Criteria in a state of the body.
#[derive(Debug, Clone)]
pub struct CriteriaInState<'a> {
    criteria: &'a Criteria,
    /// State variables of each criterion; empty where no criterion has any.
    variables: Vec<StateVariables>,
}

impl Criteria {
    /// The criteria with their own limits and without stresses across the bonds.
    pub fn without_state(&self) -> CriteriaInState<'_> {
        self.with_variables(&[])
    }

    /// The criteria with the state variables of bonds that [began](Self::begun) to soften.
    pub fn with_variables(&self, begun: &[StateVariables]) -> CriteriaInState<'_> {
        CriteriaInState {
            criteria: self,
            variables: begun.to_vec(),
        }
    }

    /// Stresses across the bonds for each criterion, in a motion of the unbroken bonds with deformations (n_bonds); None for a criterion without
    /// stress.
    pub fn stresses(
        &self,
        system: &dyn Bonds,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
    ) -> Vec<Option<Stresses>> {
        let of = |criterion: &Criterion| {
            let moduli = |bond| Moduli::from_coefficients(criterion.coefficients(bond));
            let stresses = || system.stresses_across(motion, deformations, &moduli);
            (criterion.follows_stress()).then(|| Stresses::new(stresses()))
        };
        self.list.iter().map(of).collect()
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
                // Of equally exceeded conditions the first one decides, tension before shear.
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

    /// Stress around each bond over the strength at which it begins to soften, for each criterion with such a start.
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

    /// State variables of bonds that began to soften at these deformations, as [`beginning`](Self::beginning) gives them; empty where no
    /// criterion lets bonds begin.
    pub fn begun(&self, begun: &[Vec<f64>]) -> Vec<StateVariables> {
        if begun.iter().all(Vec::is_empty) {
            return Vec::new();
        }
        let mut variables = vec![StateVariables::default(); self.list.len()];
        for (place, begun) in begun.iter().enumerate() {
            let Some(starting) = self.list[place].starting() else {
                continue;
            };
            let law = self.list[place].after.law().clone();
            let of_bonds = begun.iter().zip(&starting.critical);
            let parameter = of_bonds.map(|(began, critical)| {
                let energy = (critical / began).powi(2);
                match began.is_finite() {
                    true => law.parameter_for(energy),
                    false => f64::INFINITY,
                }
            });
            let parameter = parameter.collect();
            let after = AfterLimit::new(law, parameter);
            variables[place].after = Some(Arc::new(after));
            variables[place].limit = Some(Arc::new(begun.clone()));
            for back in starting.never_began {
                let never_began = place - back;
                let own = &self.list[never_began].limit;
                let limits = variables[never_began].limit.get_or_insert(own.clone());
                let limits = Arc::make_mut(limits).iter_mut().zip(begun);
                for (limit, _) in limits.filter(|(_, began)| began.is_finite()) {
                    *limit = f64::INFINITY;
                }
            }
        }
        variables
    }

    /// Deformations at which bonds began to soften where none did yet, shape (n_bonds) for each criterion by which they begin.
    pub fn none_begun(&self) -> Vec<Vec<f64>> {
        let of = |it: &Criterion| match it.starting() {
            Some(_) => vec![f64::INFINITY; it.limit.len()],
            None => Vec::new(),
        };
        self.list.iter().map(of).collect()
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
}

impl StateVariables {
    /// Law after the limit of a criterion with these state variables.
    #[inline]
    pub fn after<'a>(&'a self, criterion: &'a Criterion) -> &'a AfterLimit {
        self.after.as_deref().unwrap_or(&criterion.after)
    }
}

impl<'a> CriteriaInState<'a> {
    /// The criteria without their state variables.
    pub fn criteria(&self) -> &'a Criteria {
        self.criteria
    }

    /// The criteria with the limits and stresses of a state, from its intact bonds, its deformations (n_bonds) and the
    /// [`stresses`](Criteria::stresses) across the bonds.
    pub fn in_state(
        mut self,
        stresses: &[Option<Stresses>],
        intact: &[bool],
        deformations: &[BondDeformation],
    ) -> Self {
        let list = &self.criteria.list;
        if list.iter().all(|it| it.surroundings.is_none()) {
            return self;
        }
        self.variables.resize_with(list.len(), Default::default);
        for ((criterion, stress), variables) in list.iter().zip(stresses).zip(&mut self.variables) {
            variables.stress.clone_from(stress);
            if let Some(Surroundings::CrackAtPoints(crack)) = criterion.surroundings.as_deref() {
                let limits = crack.limits(&criterion.limit, intact, deformations);
                variables.limit = Some(limits.into());
            }
        }
        self
    }

    /// The criteria in a motion of a body in which no bond has begun to soften: a criterion by which bonds begin measures the stress around each
    /// bond over the strength, with the limit 1. That measure grows in proportion to the load.
    pub fn before_softening(
        mut self,
        system: &dyn Bonds,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
    ) -> Self {
        let criteria = self.criteria;
        let of_criteria = criteria.utilisations_at_start(system, motion, deformations);
        for (place, utilisations) in of_criteria.into_iter().enumerate() {
            let Some(utilisations) = utilisations else {
                continue;
            };
            let stress = |&normal: &f64| StressAcross {
                normal,
                ..Default::default()
            };
            self.variables
                .resize_with(criteria.list.len(), Default::default);
            self.variables[place] = StateVariables {
                stress: Some(Stresses::new(utilisations.iter().map(stress).collect())),
                limit: Some(Arc::new(vec![1.0; utilisations.len()])),
                after: Some(Arc::new(AfterLimit::new(brittle::LAW, Vec::new()))),
                before_softening: Some(Measure::NormalStress),
            };
        }
        self
    }

    /// A criterion with its state variables.
    #[inline]
    fn criterion(&self, place: usize) -> (&'a Criterion, &StateVariables) {
        let variables = self.variables.get(place).unwrap_or(&NO_VARIABLES);
        (&self.criteria.list[place], variables)
    }

    /// Stress across a bond over E' that a criterion takes; zero where it takes none.
    #[inline]
    pub(super) fn stress(&self, place: usize, bond: usize) -> StressAcross {
        let stress = self.criterion(place).1.stress.as_ref();
        stress.map_or_else(StressAcross::default, |it| it.of_bond(bond))
    }

    /// Limit of each bond by a criterion, shape (n_bonds); infinite where it never fails.
    #[inline]
    pub fn limits(&self, place: usize) -> &[f64] {
        let (criterion, variables) = self.criterion(place);
        variables.limit.as_ref().unwrap_or(&criterion.limit)
    }

    /// Law after the limit of a criterion.
    #[inline]
    pub fn after(&self, place: usize) -> &AfterLimit {
        let (criterion, variables) = self.criterion(place);
        variables.after(criterion)
    }

    /// The measure of a deformation of a bond by a criterion.
    #[inline]
    pub fn measure(&self, place: usize, bond: usize, deformation: &BondDeformation) -> f64 {
        let (criterion, variables) = self.criterion(place);
        let measure = variables.before_softening.unwrap_or(criterion.measure);
        measure.value(deformation, criterion.coefficients(bond), || {
            self.stress(place, bond)
        })
    }

    /// Measure at which a bond breaks by a criterion.
    #[inline]
    pub fn break_limit(&self, place: usize, bond: usize) -> f64 {
        self.limits(place)[bond] * self.after(place).end(bond)
    }

    /// Utilisation (measure over limit) by a criterion, 0 where the measure is not positive.
    #[inline]
    pub fn utilisation_by(&self, place: usize, bond: usize, deformation: &BondDeformation) -> f64 {
        let measure = self.measure(place, bond, deformation);
        // An infinite limit is never reached: nor is infinity times zero, which is no number.
        if measure > 0.0 {
            measure / self.limits(place)[bond]
        } else {
            0.0
        }
    }

    /// Largest utilisation of a bond over the criteria; 0 without any.
    #[inline]
    pub fn utilisation(&self, bond: usize, deformation: &BondDeformation) -> f64 {
        let of = |place| self.utilisation_by(place, bond, deformation);
        (0..self.criteria.list.len()).map(of).fold(0.0, f64::max)
    }

    /// The criterion with the largest ratio of the measure to the limit at which the bond *breaks*, the first of equals; None where no measure is
    /// positive.
    #[inline]
    pub fn breaking(&self, bond: usize, deformation: &BondDeformation) -> Option<Verdict> {
        let mut worst: Option<Verdict> = None;
        for criterion in 0..self.criteria.list.len() {
            let measure = self.measure(criterion, bond, deformation);
            if measure > 0.0 {
                let verdict = Verdict {
                    criterion,
                    measure,
                    limit: self.break_limit(criterion, bond),
                };
                if worst.is_none_or(|worst| verdict.ratio() > worst.ratio()) {
                    worst = Some(verdict);
                }
            }
        }
        worst
    }

    /// The criteria at a fraction of the straight line to this motion, from another motion of the same bonds or from the unloaded body, with the
    /// limits of this state.
    pub fn on_line(&self, from: Option<&Self>, share: f64) -> Self {
        self.with_stresses(|place, there| {
            let there = there.scaled(share);
            match from.and_then(|it| it.criterion(place).1.stress.as_ref()) {
                Some(from) => there.plus(from, 1.0 - share),
                None => there,
            }
        })
    }

    /// The criteria in the sum of this motion and t times another motion of the same bonds, `rates`.
    pub fn ahead(&self, rates: &Self, t: f64) -> Self {
        self.with_stresses(|place, stress| match &rates.criterion(place).1.stress {
            Some(rate) => stress.plus(rate, t),
            None => stress.clone(),
        })
    }

    /// The criteria with other stresses across the bonds: a function of the number of a criterion and its stresses.
    fn with_stresses(&self, stress: impl Fn(usize, &Stresses) -> Stresses) -> Self {
        let of = |(place, it): (usize, &StateVariables)| StateVariables {
            stress: it.stress.as_ref().map(|it| stress(place, it)),
            ..it.clone()
        };
        Self {
            criteria: self.criteria,
            variables: self.variables.iter().enumerate().map(of).collect(),
        }
    }

    /// Replaces the stresses across some bonds by the values of a function of the bond and its moduli.
    pub fn replace_stresses(
        &mut self,
        bonds: &[u32],
        stress: impl Fn(u32, &Moduli) -> StressAcross + Sync,
    ) {
        let both = self.criteria.list.iter().zip(&mut self.variables);
        for (criterion, stresses) in both.filter_map(|(it, its)| Some((it, its.stress.as_mut()?))) {
            let found = parallel::values(bonds.len(), StressAcross::default(), |place| {
                let coefficients = criterion.coefficients(bonds[place] as usize);
                stress(bonds[place], &Moduli::from_coefficients(coefficients))
            });
            let times = stresses.times.recip();
            let of_bonds = Arc::make_mut(&mut stresses.of_bonds);
            for (&bond, stress) in bonds.iter().zip(&found) {
                of_bonds[bond as usize] = stress.scaled(times);
            }
        }
    }
}
