//! When a run ends before its loading does.

/// Rules that end a run early.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StopRules {
    /// The load at rest fell to this fraction of the largest so far, after bonds broke; not where the load was taken back.
    pub load_fraction: Option<f64>,
    /// The displacement of the control load reached this, m.
    pub displacement: Option<f64>,
    /// So many bonds broke.
    pub bonds: Option<usize>,
    /// So many seconds passed.
    pub wall_time: Option<f64>,
    /// The stored energy became negative: the body has lost its stability.
    pub negative_energy: bool,
}

impl StopRules {
    /// The whole loading, as long as the body is stable.
    pub const NONE: Self = Self {
        load_fraction: None,
        displacement: None,
        bonds: None,
        wall_time: None,
        negative_energy: true,
    };
}
