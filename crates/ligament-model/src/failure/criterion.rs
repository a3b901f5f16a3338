//! Criteria with the limits of their bonds.

use std::borrow::Cow;
use std::sync::Arc;

use super::crack_at_points::CrackAtPoints;
use super::measure::{Measure, Weakened};
use super::softening::{AfterLimit, brittle};
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
    /// What the limits follow while bonds break; None where they stay.
    pub crack_at_points: Option<Arc<CrackAtPoints>>,
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
            crack_at_points: None,
        }
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

    /// The criteria with the limits that they have while the bonds marked in `intact` (n_bonds) are left, at deformations (n_bonds).
    pub fn in_state(&self, intact: &[bool], deformations: &[BondDeformation]) -> Cow<'_, Self> {
        if self.list.iter().all(|it| it.crack_at_points.is_none()) {
            return Cow::Borrowed(self);
        }
        let mut criteria = self.clone();
        for criterion in &mut criteria.list {
            if let Some(crack) = &criterion.crack_at_points {
                criterion.limit = crack.limits(&criterion.limit, intact, deformations);
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
