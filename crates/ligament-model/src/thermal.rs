//! Strains that a temperature gives without stress.

/// Strains that the temperature would give the points without stress, at some load factor.
#[derive(Debug, Clone, Copy)]
pub struct ThermalStrain<'a> {
    strain: &'a [[f64; 3]],
    load_factor: f64,
}

impl<'a> ThermalStrain<'a> {
    /// No strain anywhere.
    pub const NONE: Self = ThermalStrain {
        strain: &[],
        load_factor: 0.0,
    };

    /// Strains (eps_xx, eps_yy, gamma_xy) at load factor 1, shape (n_points), times a load factor; empty where there are none.
    pub fn proportional(strain: &'a [[f64; 3]], load_factor: f64) -> Self {
        Self {
            strain,
            load_factor,
        }
    }

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

    /// The strain of a point: (eps_xx, eps_yy, gamma_xy).
    pub fn of_point(&self, point: usize) -> [f64; 3] {
        self.strain[point].map(|strain| self.load_factor * strain)
    }

    /// The mean of the ends of a bond: (eps_xx, eps_yy, gamma_xy).
    #[inline]
    pub fn of_bond(&self, ends: [u32; 2]) -> [f64; 3] {
        let [a, b] = ends.map(|end| self.strain[end as usize]);
        [0, 1, 2].map(|k| self.load_factor * (0.5 * (a[k] + b[k])))
    }
}
