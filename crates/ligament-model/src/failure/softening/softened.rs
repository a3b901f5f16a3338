//! State of a bond between its limit and its breakage.

/// A bond past its limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Softened {
    /// Force over force at the limit: the printed mu of the damage variables (MPPD eqs 45, 46, 50).
    pub force: f64,
    /// Secant stiffness over elastic stiffness.
    pub secant: f64,
    /// Dissipated energy over the energy stored at the limit.
    pub dissipated: f64,
}

impl Softened {
    /// A bond that never passed its limit.
    pub const SOUND: Self = Self {
        force: 1.0,
        secant: 1.0,
        dissipated: 0.0,
    };
}
