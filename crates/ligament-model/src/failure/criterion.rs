//! Criteria with the limits of their bonds.

use std::borrow::Cow;
use std::sync::Arc;

use super::measure::{Measure, Weakened};
use super::softening::{AfterLimit, brittle};
use super::starting::Starting;
use super::surroundings::Surroundings;
use crate::element::{BondDeformation, Rigidities};

/// A failure criterion with its limits.
#[derive(Debug, Clone, PartialEq)]
pub struct Criterion {
    /// Name of the criterion in results.
    pub name: &'static str,
    /// Measure of the deformation that has the limit.
    pub measure: Measure,
    /// Limit of each bond; infinite where it never fails, shape (n_bonds).
    pub limit: Vec<f64>,
    /// Coefficients of the measure for each bond; empty where the measure has none, shape (n_bonds, n).
    pub coefficient: Vec<f64>,
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
            measure,
            limit,
            coefficient: Vec::new(),
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
            Weakened::Opening | Weakened::Crushing => rigidities.axial[bond],
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
        self.measure.value(deformation, self.coefficients(bond))
    }

    /// The coefficients of the measure for a bond, shape (n).
    #[inline]
    pub fn coefficients(&self, bond: usize) -> &[f64] {
        let count = match self.coefficient.len() {
            0 => return &[],
            len if len == self.limit.len() => 1,
            len => len / self.limit.len(),
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
        self.with_stresses(|criterion, at, there| {
            let begin = from.map_or(0.0, |it| it.list[criterion].coefficient[at]);
            begin + share * (there - begin)
        })
    }

    /// The criteria of a motion + t another one, of the same body with the same bonds, from those of both.
    pub fn ahead(&self, rates: &Self, t: f64) -> Cow<'_, Self> {
        self.with_stresses(|criterion, at, here| here + t * rates.list[criterion].coefficient[at])
    }

    /// The criteria with other stresses around the bonds, which a function makes of the number of a criterion, the place of a coefficient
    /// and its value.
    fn with_stresses(&self, stress: impl Fn(usize, usize, f64) -> f64) -> Cow<'_, Self> {
        if !self.list.iter().any(Criterion::follows_stress) {
            return Cow::Borrowed(self);
        }
        let mut criteria = self.clone();
        let of_stress = criteria.list.iter_mut().enumerate();
        for (place, criterion) in of_stress.filter(|(_, it)| it.follows_stress()) {
            let count = criterion.measure.coefficient_names().len();
            for bond in 0..criterion.limit.len() {
                for at in count * bond..count * bond + criterion.measure.n_of_stress() {
                    let value = &mut criterion.coefficient[at];
                    *value = stress(place, at, *value);
                }
            }
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
