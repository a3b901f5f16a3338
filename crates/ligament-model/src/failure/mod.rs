//! Failure criteria: when a bond fails, and what it does after.
//!
//! A criterion compares a [`Measure`] of the bond's deformation with a limit, and says what is [`AfterLimit`]. Its utilisation
//! is measure over limit; the bond fails where that reaches one. Of several criteria the first that is met decides.
//!
//! | criterion | measure | limit |
//! |---|---|---|
//! | [`strength`] | tension | from the energy at the tensile strength (NHPD eqs 14 to 16) |
//! | [`stretch`] | tension, compression | F/E (MPPD eqs 44 to 46) |
//! | [`sliding`] | sliding | s_0t (1 + nu)/2 (MPPD eq. 49) |
//! | [`frictional`] | friction | a, tan(beta) (MPPD eqs 52 to 58) |
//! | [`fracture_energy`] | tension, energy | from G_c, the elastic moduli and the mean length of the bonds (Silling and Askari 2005) |
//! | [`mixed_mode`] | mixed mode, along x or y | from G_Ic, G_IIc and the bonds that a crack cuts (MBB-PD appendix C) |

pub mod fracture_energy;
pub mod frictional;
mod measure;
pub mod mixed_mode;
pub mod sliding;
pub mod softening;
pub mod strength;
pub mod stretch;

pub use measure::{Measure, Weakened};
pub use softening::{AfterLimit, Softened};

use crate::element::BondDeformation;
use crate::system::BondSystem;

/// A failure criterion with its limits.
#[derive(Debug, Clone, PartialEq)]
pub struct Criterion {
    /// What results call it.
    pub name: &'static str,
    /// What it looks at.
    pub measure: Measure,
    /// Limit of each bond; infinite where it never fails, shape (n_bonds).
    pub limit: Vec<f64>,
    /// Coefficients of the measure for each bond; empty where the measure has none, shape (n_bonds, n).
    pub coefficient: Vec<f64>,
    /// What happens after the limit.
    pub after: AfterLimit,
}

impl Criterion {
    /// A criterion of a measure without a coefficient, by which bonds break at their limit (n_bonds).
    pub fn brittle(name: &'static str, measure: Measure, limit: Vec<f64>) -> Self {
        Self {
            name,
            measure,
            limit,
            coefficient: Vec::new(),
            after: AfterLimit::Brittle,
        }
    }

    /// The measure of a deformation of a bond.
    #[inline]
    pub fn measure(&self, bond: usize, deformation: &BondDeformation) -> f64 {
        self.measure.of(deformation, self.coefficients(bond))
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

/// How near a bond is to its breakage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verdict {
    /// Number of the criterion that decides.
    pub criterion: usize,
    /// Its measure.
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
    /// They, in the order of the case.
    pub list: Vec<Criterion>,
}

impl Criteria {
    /// Whether bonds may do anything but break at once.
    pub fn soften(&self) -> bool {
        self.list.iter().any(|it| !it.after.is_brittle())
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
            let verdict = Verdict {
                criterion,
                measure: it.measure(bond, deformation),
                limit: it.break_limit(bond),
            };
            if verdict.measure > 0.0 && worst.is_none_or(|worst| verdict.ratio() > worst.ratio()) {
                worst = Some(verdict);
            }
        }
        worst
    }
}

/// The smallest of the values of the materials (n_materials) that have a share in an end of each bond, and infinity where an end
/// is marked in `no_fail` (n_points), shape (n_bonds).
pub fn weakest(system: &BondSystem, no_fail: &[bool], of_materials: &[f64]) -> Vec<f64> {
    let materials = weakest_materials(system, of_materials);
    let of_bond = |(ends, material): (&[u32; 2], usize)| {
        if ends.iter().any(|end| no_fail[*end as usize]) {
            f64::INFINITY
        } else {
            of_materials[material]
        }
    };
    system
        .bonds
        .ends
        .iter()
        .zip(materials)
        .map(of_bond)
        .collect()
}

/// The material with the smallest of the values (n_materials) among those that have a share in an end of each bond, the first of
/// equals, shape (n_bonds).
pub fn weakest_materials(system: &BondSystem, of_materials: &[f64]) -> Vec<usize> {
    let smaller = |one: usize, other: usize| {
        let is_smaller = of_materials[other] < of_materials[one];
        let is_equal = of_materials[other] == of_materials[one];
        if is_smaller || (is_equal && other < one) {
            other
        } else {
            one
        }
    };
    let at_point = |point: usize| {
        let shares = system.cloud.shares(point).iter().enumerate();
        let present = shares
            .filter(|(_, share)| **share > 0.0)
            .map(|(material, _)| material);
        present.reduce(smaller).unwrap_or_default()
    };
    let at_points: Vec<usize> = (0..system.cloud.len()).map(at_point).collect();
    let of_bond = |ends: &[u32; 2]| {
        let [a, b] = ends.map(|end| at_points[end as usize]);
        smaller(a, b)
    };
    system.bonds.ends.iter().map(of_bond).collect()
}
