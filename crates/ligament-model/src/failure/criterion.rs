//! Criteria with the limits of their bonds.

use std::sync::Arc;

use super::crack_at_points::CrackAtPoints;
use super::hooke::{Moduli, StressAcross};
use super::measure::Measure;
use super::measure::Weakened;
use super::softening::{AfterLimit, brittle};
use super::starting::Starting;
use crate::element::{BondDeformation, Rigidities};
use crate::stress::point_strain::StrainAround;

/// A failure criterion with its limits, which stay as they are during a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Criterion {
    /// Name of the criterion in results, which begins with the word of its kind.
    pub name: &'static str,
    /// Index of its choice in the list of choices.
    pub choice: usize,
    /// Measure of the deformation that has the limit.
    pub measure: Measure,
    /// Limit of each bond; infinite where it never fails, shape (n_bonds).
    pub limit: Arc<Vec<f64>>,
    /// Coefficients of the measure for each bond; empty where the measure has none, shape (n_bonds, n).
    pub coefficient: Arc<Vec<f64>>,
    /// Law after the limit.
    pub after: AfterLimit,
    /// Surroundings of the bonds on which the limits or the measure depend; None where both depend on the bond alone.
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
            after: AfterLimit::new(brittle::LAW, Vec::new()),
            surroundings: None,
        }
    }

    /// Whether the measure depends on the stress around the bonds.
    pub fn follows_stress(&self) -> bool {
        matches!(self.surroundings.as_deref(), Some(Surroundings::Stress))
    }

    /// Condition on the stress around bonds at which they begin to soften, if there is one.
    pub fn starting(&self) -> Option<&Starting> {
        match self.surroundings.as_deref()? {
            Surroundings::Starting(starting) => Some(starting),
            Surroundings::Stress | Surroundings::CrackAtPoints(_) => None,
        }
    }

    /// Whether the limits depend on the unbroken bonds.
    pub fn limits_follow_bonds(&self) -> bool {
        matches!(
            self.surroundings.as_deref(),
            Some(Surroundings::CrackAtPoints(_))
        )
    }

    /// Energy of a bond at a limit of the measure, J; zero without a limit.
    pub fn energy_at(&self, limit: f64, rigidities: &Rigidities, bond: usize) -> f64 {
        let rigidity = match self.measure.weakens() {
            Weakened::Opening | Weakened::Crushing | Weakened::Whole => rigidities.axial[bond],
            Weakened::Sliding => rigidities.shear[bond],
        };
        if limit.is_finite() {
            0.5 * rigidity * limit * limit
        } else {
            0.0
        }
    }

    /// Value of the measure for the deformation of a bond, with zero stress around the bond.
    #[inline]
    pub fn measure(&self, bond: usize, deformation: &BondDeformation) -> f64 {
        let coefficients = self.coefficients(bond);
        self.measure
            .value(deformation, coefficients, StressAcross::default)
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

    /// Measure at which a bond breaks by its own limit.
    #[inline]
    pub fn break_limit(&self, bond: usize) -> f64 {
        self.limit[bond] * self.after.end(bond)
    }
}

/// Distance of a bond from its breakage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verdict {
    /// Number of the decisive criterion.
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
    /// Whether some bonds may soften instead of breaking at once.
    pub fn soften(&self) -> bool {
        self.list.iter().any(|it| !it.after.is_brittle())
    }
}

/// Surroundings of bonds on which limits and measures depend while the body deforms and bonds break.
#[derive(Debug, Clone, PartialEq)]
pub enum Surroundings {
    /// The limits depend on the unbroken bonds of the points.
    CrackAtPoints(CrackAtPoints),
    /// The measures depend on the stress around the bonds ([`Moduli`](super::hooke::Moduli)).
    Stress,
    /// Bonds begin to soften by the stress around them.
    Starting(Starting),
}
