//! Criteria with the limits of their bonds.

use std::borrow::Cow;
use std::sync::Arc;

use rayon::prelude::*;

use super::hooke::{Moduli, StressAcross};
use super::measure::Measure;
use super::softening::{AfterLimit, brittle};
use super::starting::Starting;
use super::surroundings::Surroundings;
use super::weakened::Weakened;
use crate::element::{BondDeformation, Rigidities};
use crate::stress::point_strain::StrainAround;

/// A failure criterion with its limits.
#[derive(Debug, Clone, PartialEq)]
pub struct Criterion {
    /// Name of the criterion in results, which begins with the word of its kind.
    pub name: &'static str,
    /// Place of its choice among those of the criteria.
    pub choice: usize,
    /// Measure of the deformation that has the limit.
    pub measure: Measure,
    /// Limit of each bond; infinite where it never fails, shape (n_bonds).
    pub limit: Arc<Vec<f64>>,
    /// Coefficients of the measure for each bond; empty where the measure has none, shape (n_bonds, n).
    pub coefficient: Arc<Vec<f64>>,
    /// Stresses across the bonds in the state of the criterion; none but where the measure takes them.
    pub stress: Stresses,
    /// What happens after the limit.
    pub after: AfterLimit,
    /// What its limits or its measure follow while the body deforms and bonds break; None where both depend on the bond alone.
    pub surroundings: Option<Arc<Surroundings>>,
}

impl Criterion {
    /// A criterion of a measure without a coefficient, by which bonds break at their limit (n_bonds).
    pub fn brittle(name: &'static str, measure: Measure, limit: Vec<f64>) -> Self {
        Self {
            name,
            choice: 0,
            measure,
            limit: limit.into(),
            coefficient: Arc::default(),
            stress: Stresses::default(),
            after: AfterLimit::new(brittle::LAW, Vec::new()),
            surroundings: None,
        }
    }

    /// Whether the measure follows the stress around the bonds.
    pub fn follows_stress(&self) -> bool {
        matches!(self.surroundings.as_deref(), Some(Surroundings::Stress))
    }

    /// Where bonds begin to soften, if the stress around them says so.
    pub fn starting(&self) -> Option<&Starting> {
        match self.surroundings.as_deref()? {
            Surroundings::Starting(starting) => Some(starting),
            Surroundings::Stress | Surroundings::CrackAtPoints(_) => None,
        }
    }

    /// Whether the limits follow the bonds that are left.
    pub fn limits_follow_bonds(&self) -> bool {
        matches!(
            self.surroundings.as_deref(),
            Some(Surroundings::CrackAtPoints(_))
        )
    }

    /// Energy of a bond at its limit, J; zero without a limit.
    pub(crate) fn energy_at_limit(&self, rigidities: &Rigidities, bond: usize) -> f64 {
        let rigidity = match self.measure.weakens() {
            Weakened::Opening | Weakened::Crushing | Weakened::Whole => rigidities.axial[bond],
            Weakened::Sliding => rigidities.shear[bond],
        };
        let limit = self.limit[bond];
        if limit.is_finite() {
            0.5 * rigidity * limit * limit
        } else {
            0.0
        }
    }

    /// The measure of a deformation of a bond.
    #[inline]
    pub fn measure(&self, bond: usize, deformation: &BondDeformation) -> f64 {
        let coefficients = self.coefficients(bond);
        self.measure
            .value(deformation, coefficients, || self.stress(bond))
    }

    /// Largest value of a measure of stress over both signs of a bond's stretch and of the lateral strain around it; None for a bar.
    pub fn largest_of_stress(
        &self,
        bond: usize,
        stretch: f64,
        around: Option<StrainAround>,
    ) -> f64 {
        let coefficients = self.coefficients(bond);
        let moduli = Moduli::from_coefficients(coefficients);
        let of_signs = [1.0, -1.0].map(|sign| {
            let around = around.map(|it| StrainAround {
                lateral: sign * it.lateral,
                ..it
            });
            let stress = moduli.stress_across(sign * stretch, around);
            let unused = BondDeformation::default();
            self.measure.value(&unused, coefficients, || stress)
        });
        of_signs[0].max(of_signs[1])
    }

    /// Stress across a bond over E'; zero where the measure takes none.
    #[inline]
    pub(super) fn stress(&self, bond: usize) -> StressAcross {
        let of_bond = self.stress.of_bonds.get(bond);
        of_bond.map_or_else(StressAcross::default, |it| it.scaled(self.stress.times))
    }

    /// The coefficients of the measure for a bond, shape (n).
    #[inline]
    pub fn coefficients(&self, bond: usize) -> &[f64] {
        let count = match self.coefficient.len() {
            0 => return &[],
            len if len == self.limit.len() => 1,
            _ => self.measure.coefficient_names().len(),
        };
        &self.coefficient[count * bond..count * (bond + 1)]
    }

    /// Measure at which a bond breaks.
    #[inline]
    pub fn break_limit(&self, bond: usize) -> f64 {
        self.limit[bond] * self.after.end(bond)
    }

    /// Measure over limit, 0 where the measure is not positive.
    #[inline]
    pub fn utilisation(&self, bond: usize, deformation: &BondDeformation) -> f64 {
        let measure = self.measure(bond, deformation);
        // An infinite limit is never reached: nor is infinity times zero, which is no number.
        if measure > 0.0 {
            measure / self.limit[bond]
        } else {
            0.0
        }
    }
}

/// Stresses across the bonds of a body, as they are at one load factor times another one.
#[derive(Debug, Clone, PartialEq)]
pub struct Stresses {
    /// Stress across each bond, shape (n_bonds); empty where no measure takes it.
    pub(super) of_bonds: Arc<Vec<StressAcross>>,
    /// Factor on all of them.
    pub(super) times: f64,
}

impl Default for Stresses {
    fn default() -> Self {
        Self {
            of_bonds: Arc::default(),
            times: 1.0,
        }
    }
}

impl Stresses {
    /// Stresses across the bonds (n_bonds).
    pub(super) fn new(of_bonds: Vec<StressAcross>) -> Self {
        Self {
            of_bonds: of_bonds.into(),
            times: 1.0,
        }
    }

    /// Replaces the stresses across some bonds.
    pub fn replace(&mut self, bonds: &[u32], stresses: &[StressAcross]) {
        let of_bonds = Arc::make_mut(&mut self.of_bonds);
        for (&bond, stress) in bonds.iter().zip(stresses) {
            of_bonds[bond as usize] = stress.scaled(self.times.recip());
        }
    }

    /// All stresses times a factor.
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            of_bonds: self.of_bonds.clone(),
            times: factor * self.times,
        }
    }

    /// The stresses and others times a factor.
    fn plus(&self, other: &Self, factor: f64) -> Self {
        let both = self.of_bonds.par_iter().zip(&*other.of_bonds);
        let factor = factor * other.times;
        let sum = |(one, other): (&StressAcross, &StressAcross)| {
            one.scaled(self.times).plus(other, factor)
        };
        Self {
            of_bonds: Arc::new(both.map(sum).collect()),
            times: 1.0,
        }
    }
}

/// Distance of a bond from its breakage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verdict {
    /// Number of the criterion that decides.
    pub criterion: usize,
    /// Measure of the bond's deformation.
    pub measure: f64,
    /// The measure at which the bond breaks.
    pub limit: f64,
}

impl Verdict {
    /// Measure over limit.
    #[inline]
    pub fn ratio(&self) -> f64 {
        self.measure / self.limit
    }
}

/// The criteria of a model: a bond fails by the first that is met.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Criteria {
    /// The criteria, in the order in which they were chosen.
    pub list: Vec<Criterion>,
}

impl Criteria {
    /// Whether bonds may do anything but break at once.
    pub fn soften(&self) -> bool {
        self.list.iter().any(|it| !it.after.is_brittle())
    }

    /// The criteria on the straight line between two motions, of the same body with the same bonds: from that of some criteria, or none
    /// from the unloaded body, to that of these, at a share of it. Limits are those of these.
    pub fn on_line(&self, from: Option<&Self>, share: f64) -> Cow<'_, Self> {
        self.with_stresses(|place, there| {
            let there = there.scaled(share);
            match from {
                Some(from) => there.plus(&from.list[place].stress, 1.0 - share),
                None => there,
            }
        })
    }

    /// The criteria of a motion + t another one, of the same body with the same bonds, from those of both.
    pub fn ahead(&self, rates: &Self, t: f64) -> Cow<'_, Self> {
        self.with_stresses(|place, here| here.plus(&rates.list[place].stress, t))
    }

    /// The criteria with other stresses across the bonds, which a function makes of the number of a criterion and its stresses.
    fn with_stresses(&self, stress: impl Fn(usize, &Stresses) -> Stresses) -> Cow<'_, Self> {
        if !self.list.iter().any(Criterion::follows_stress) {
            return Cow::Borrowed(self);
        }
        let mut criteria = self.clone();
        let of_stress = criteria.list.iter_mut().enumerate();
        for (place, criterion) in of_stress.filter(|(_, it)| it.follows_stress()) {
            criterion.stress = stress(place, &criterion.stress);
        }
        Cow::Owned(criteria)
    }

    /// Largest utilisation of a bond over the criteria; 0 without any.
    #[inline]
    pub fn utilisation(&self, bond: usize, deformation: &BondDeformation) -> f64 {
        let of = |it: &Criterion| it.utilisation(bond, deformation);
        self.list.iter().map(of).fold(0.0, f64::max)
    }

    /// The criterion with the largest measure over the limit at which the bond *breaks*, the first of them where several are;
    /// None where no measure is positive.
    #[inline]
    pub fn breaking(&self, bond: usize, deformation: &BondDeformation) -> Option<Verdict> {
        let mut worst: Option<Verdict> = None;
        for (criterion, it) in self.list.iter().enumerate() {
            let measure = it.measure(bond, deformation);
            if measure > 0.0 {
                let verdict = Verdict {
                    criterion,
                    measure,
                    limit: it.break_limit(bond),
                };
                if worst.is_none_or(|worst| verdict.ratio() > worst.ratio()) {
                    worst = Some(verdict);
                }
            }
        }
        worst
    }
}
