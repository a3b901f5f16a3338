//! Restraint of a bond by stiffer materials, and its exchange of k_t for k_n.

/// Restraint of the rotations of the ends of a bond by stiffer materials.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Restraint {
    /// Fraction beta of the rotation of its material that an end does not follow, for each end.
    pub ends: [f64; 2],
    /// Ratio kappa of the shear density k_t of the bond to the k_t of a bond in the stiffest material of the body.
    pub softness: f64,
}

/// Loss and gain of stiffness of a restrained bond.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exchange {
    /// Fraction d of k_t and k_theta that the bond loses.
    pub lost: f64,
    /// Part g of k_t that k_n gains.
    pub gained: f64,
}

impl Restraint {
    /// No restraint.
    pub const NONE: Self = Self {
        ends: [0.0; 2],
        softness: 1.0,
    };

    /// Mean beta over both ends.
    pub(super) fn mean(&self) -> f64 {
        0.5 * (self.ends[0] + self.ends[1])
    }

    /// Loss d of a bond in all directions, 3 beta/(1 + 3 beta).
    pub(super) fn usual_loss(&self) -> f64 {
        let tripled = 3.0 * self.mean();
        tripled / (1.0 + tripled)
    }

    /// Share of an end in the sum of both restraints.
    pub(super) fn share(&self, end: usize) -> f64 {
        0.5 * self.ends[end] / self.mean()
    }
}
