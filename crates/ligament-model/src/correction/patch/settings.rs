//! Settings of the patch correction.

use super::reference::Reference;
use crate::case_type::Range;

/// Settings of the patch correction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Smallest ratio lo of a factor to the uncorrected one.
    pub lowest: f64,
    /// Largest ratio hi of a factor to the uncorrected one.
    pub highest: f64,
    /// Weight of the equations of moments against those of forces.
    pub moment_weight: f64,
    /// Reference factors; `None` stands for [`Reference::Body`] in the plane and [`Reference::Families`] in space.
    pub reference: Option<Reference>,
    /// Regularisation r of the last outer step. The first step has 1e-2, and each has three hundredths of the one before.
    pub regularisation: f64,
}

impl Settings {
    /// Range of the smallest ratio.
    pub const LOWEST: Range<'static> = Range::SHARE;

    /// Range of the largest ratio.
    pub const HIGHEST: Range<'static> = Range::new(&[("exclusiveMinimum", 1.0)]);

    /// Range of the weight of the moments.
    pub const MOMENT_WEIGHT: Range<'static> = Range::POSITIVE;

    /// Range of the regularisation.
    pub const REGULARISATION: Range<'static> = Range::SHARE;

    /// Settings that satisfy the equations best on meshes of all kinds.
    pub const DEFAULT: Self = Self {
        lowest: 0.02,
        highest: 20.0,
        moment_weight: 0.04,
        reference: None,
        regularisation: 1e-5,
    };
}

impl Default for Settings {
    fn default() -> Self {
        Self::DEFAULT
    }
}
