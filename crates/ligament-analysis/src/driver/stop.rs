//! Rules for the end of a run before the end of its loading.

ligament_model::case_type! {
    /// When to stop before the end of the loading; whichever comes first.
    #[derive(Debug, Clone, Copy, PartialEq)]
    #[case(serde(default))]
    pub struct StopRules {
        /// When the load has fallen to this share of its largest value; not where the load factor is below an earlier one.
        #[range("exclusiveMinimum" = 0, "exclusiveMaximum" = 1)]
        pub load_fraction: Option<f64>,
        /// When the displacement of the first load reaches this, m; in rad, m^3 or K where that is its unit.
        #[range("exclusiveMinimum" = 0)]
        #[unit("m")]
        pub displacement: Option<f64>,
        /// When so many bonds are broken.
        #[range("minimum" = 1)]
        pub bonds: Option<usize>,
        /// After so much time, s.
        #[range("exclusiveMinimum" = 0)]
        #[unit("s")]
        pub wall_time: Option<f64>,
        /// When the stored energy becomes negative, as it may where Poisson's ratio makes the bonds' shear stiffness negative.
        pub negative_energy: bool,
    }
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

impl Default for StopRules {
    fn default() -> Self {
        Self::NONE
    }
}
