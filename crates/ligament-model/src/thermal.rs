//! Strains that the temperature would give the points without stress.

/// Strains that the temperature would give the points without stress, at load factor 1.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ThermalStrains {
    /// Strain (eps_xx, eps_yy, gamma_xy) of each point, shape (n_points); empty where no temperature changes.
    pub at_points: Vec<[f64; 3]>,
}

impl ThermalStrains {
    /// Whether no temperature changes.
    pub fn is_empty(&self) -> bool {
        self.at_points.is_empty()
    }

    /// The strains at a load factor.
    pub fn at(&self, load_factor: f64) -> ThermalStrain<'_> {
        ThermalStrain {
            strain: &self.at_points,
            load_factor,
        }
    }
}

/// Strains that the temperature would give the points without stress, at some load factor.
#[derive(Debug, Clone, Copy)]
pub struct ThermalStrain<'a> {
    strain: &'a [[f64; 3]],
    load_factor: f64,
}

impl ThermalStrain<'_> {
    /// No strain anywhere.
    pub const NONE: Self = ThermalStrain {
        strain: &[],
        load_factor: 0.0,
    };

    /// Whether there is none anywhere.
    pub fn is_none(&self) -> bool {
        self.strain.is_empty()
    }

    /// The strains at load factor 1.
    pub fn at_full_load(&self) -> Self {
        Self {
            load_factor: 1.0,
            ..*self
        }
    }

    /// The mean of the ends of a bond: (eps_xx, eps_yy, gamma_xy).
    #[inline]
    pub fn of_bond(&self, ends: [u32; 2]) -> [f64; 3] {
        let [a, b] = ends.map(|end| self.strain[end as usize]);
        [0, 1, 2].map(|k| self.load_factor * (0.5 * (a[k] + b[k])))
    }
}
