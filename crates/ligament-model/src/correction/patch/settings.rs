//! Settings of the patch correction.

use crate::case_type::Range;

crate::case_type! {
    /// Reference factors, from which the patch correction departs as little as it can: alpha times one number for the body, which for `Families` is
    /// multiplied by a factor of each bond.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Reference {
        /// alpha times one number for the body.
        Body,
        /// alpha times factors with which a dilation has one stress at all points, also where the mesh is graded.
        Families,
    }
}

/// Settings of the patch correction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Smallest ratio lo of a factor to the uncorrected one.
    pub lowest: f64,
    /// Largest ratio hi of a factor to the uncorrected one.
    pub highest: f64,
    /// Weight of the equations of moments against those of forces.
    pub moment_weight: f64,
    /// Reference factors.
    pub reference: Reference,
    /// Regularisation r of the last outer step, where the equations can be satisfied; elsewhere it is up to ten times as large.
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
        reference: Reference::Families,
        regularisation: 1e-6,
    };
}

impl Default for Settings {
    fn default() -> Self {
        Self::DEFAULT
    }
}
