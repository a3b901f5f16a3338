//! Rules for the end of a run before the end of its loading.

/// Rules that end a run early.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StopRules {
    /// Fraction of the largest load so far to which the load at rest falls after breakage, except by unloading.
    pub load_fraction: Option<f64>,
    /// Largest displacement of the control load, m.
    pub displacement: Option<f64>,
    /// Largest number of broken bonds.
    pub bonds: Option<usize>,
    /// Largest wall time, s.
    pub wall_time: Option<f64>,
    /// Whether the run ends at a negative stored energy, where the body has lost its stability.
    pub negative_energy: bool,
}

impl StopRules {
    /// Rules for the whole loading, as long as the body is stable.
    pub const NONE: Self = Self {
        load_fraction: None,
        displacement: None,
        bonds: None,
        wall_time: None,
        negative_energy: true,
    };
}
