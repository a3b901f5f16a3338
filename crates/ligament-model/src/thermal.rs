//! Strains that a temperature gives without stress.

/// Strains of points without stress, in the plane or in space.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FreeStrains {
    in_plane: Vec<[f64; 3]>,
    in_space: Vec<[f64; 6]>,
}

impl FreeStrains {
    /// Strains (eps_xx, eps_yy, gamma_xy), shape (n_points).
    pub fn in_plane(strains: Vec<[f64; 3]>) -> Self {
        Self {
            in_plane: strains,
            in_space: Vec::new(),
        }
    }

    /// Strains (eps_xx, eps_yy, eps_zz, gamma_xy, gamma_xz, gamma_yz), shape (n_points).
    pub fn in_space(strains: Vec<[f64; 6]>) -> Self {
        Self {
            in_plane: Vec::new(),
            in_space: strains,
        }
    }

    /// Whether there is none anywhere.
    pub fn is_empty(&self) -> bool {
        self.in_plane.is_empty() && self.in_space.is_empty()
    }

    /// Strains (eps_xx, eps_yy, gamma_xy), shape (n_points); empty where there are none, and in space.
    pub fn of_plane(&self) -> &[[f64; 3]] {
        &self.in_plane
    }

    /// Strains (eps_xx, eps_yy, eps_zz, gamma_xy, gamma_xz, gamma_yz), shape (n_points); empty where there are none, and in the plane.
    pub fn of_space(&self) -> &[[f64; 6]] {
        &self.in_space
    }

    /// The strains times a load factor.
    pub fn times(&self, load_factor: f64) -> ThermalStrain<'_> {
        ThermalStrain {
            strain: &self.in_plane,
            in_space: &self.in_space,
            load_factor,
        }
    }
}

/// Strains that the temperature would give the points without stress, at some load factor.
#[derive(Debug, Clone, Copy)]
pub struct ThermalStrain<'a> {
    strain: &'a [[f64; 3]],
    in_space: &'a [[f64; 6]],
    load_factor: f64,
}

impl<'a> ThermalStrain<'a> {
    /// No strain anywhere.
    pub const NONE: Self = ThermalStrain {
        strain: &[],
        in_space: &[],
        load_factor: 0.0,
    };

    /// Strains (eps_xx, eps_yy, gamma_xy) at load factor 1, shape (n_points), times a load factor; empty where there are none.
    pub fn proportional(strain: &'a [[f64; 3]], load_factor: f64) -> Self {
        Self {
            strain,
            load_factor,
            ..Self::NONE
        }
    }

    /// Strains (eps_xx, eps_yy, eps_zz, gamma_xy, gamma_xz, gamma_yz) at load factor 1, shape (n_points), times a load factor; empty
    /// where there are none.
    pub fn proportional_in_space(strain: &'a [[f64; 6]], load_factor: f64) -> Self {
        Self {
            in_space: strain,
            load_factor,
            ..Self::NONE
        }
    }

    /// Whether there is none anywhere.
    pub fn is_none(&self) -> bool {
        self.strain.is_empty() && self.in_space.is_empty()
    }

    /// The strains at load factor 1.
    pub fn at_full_load(&self) -> Self {
        Self {
            load_factor: 1.0,
            ..*self
        }
    }

    /// The strain of a point in the plane: (eps_xx, eps_yy, gamma_xy).
    pub fn of_point(&self, point: usize) -> [f64; 3] {
        self.strain[point].map(|strain| self.load_factor * strain)
    }

    /// The strain of a point in space: (eps_xx, eps_yy, eps_zz, gamma_xy, gamma_xz, gamma_yz).
    pub fn of_point_in_space(&self, point: usize) -> [f64; 6] {
        self.in_space[point].map(|strain| self.load_factor * strain)
    }

    /// The components of the strain of a point: three in the plane, six in space.
    pub fn at_point(&self, point: usize) -> Vec<f64> {
        if self.in_space.is_empty() {
            self.of_point(point).to_vec()
        } else {
            self.of_point_in_space(point).to_vec()
        }
    }

    /// The mean of the ends of a bond in the plane: (eps_xx, eps_yy, gamma_xy).
    #[inline]
    pub fn of_bond(&self, ends: [u32; 2]) -> [f64; 3] {
        let [a, b] = ends.map(|end| self.strain[end as usize]);
        [0, 1, 2].map(|k| self.load_factor * (0.5 * (a[k] + b[k])))
    }

    /// The mean of the ends of a bond in space: (eps_xx, eps_yy, eps_zz, gamma_xy, gamma_xz, gamma_yz).
    #[inline]
    pub fn of_bond_in_space(&self, ends: [u32; 2]) -> [f64; 6] {
        let [a, b] = ends.map(|end| self.in_space[end as usize]);
        std::array::from_fn(|k| self.load_factor * (0.5 * (a[k] + b[k])))
    }
}
