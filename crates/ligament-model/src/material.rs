//! Isotropic linear elastic materials with a tensile strength.

/// State of the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Plane {
    /// Plane stress: no stress out of the plane.
    Stress,
    /// Plane strain: no strain out of the plane.
    Strain,
}

/// An isotropic, linear elastic, brittle material.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name in the case file.
    pub name: String,
    /// Young's modulus E, Pa.
    pub young: f64,
    /// Poisson's ratio nu.
    pub poisson: f64,
    /// Tensile strength F_t, Pa; needed where bonds may break.
    pub tensile_strength: Option<f64>,
    /// Mass density, kg/m^3; used for the mass that `check` reports.
    pub density: Option<f64>,
}

impl Material {
    /// Strain energy density of a uniaxial strain of size one (the transverse strain held at zero), J/m^3.
    ///
    /// NHPD eq. 11 with eps = 1: E / (2 (1 - nu^2)) in plane stress, E (1 - nu) / (2 (1 + nu)(1 - 2 nu)) in plane strain.
    pub fn uniaxial_strain_energy(&self, plane: Plane) -> f64 {
        let (young, poisson) = (self.young, self.poisson);
        match plane {
            Plane::Stress => young / (2.0 * (1.0 - poisson * poisson)),
            Plane::Strain => {
                young * (1.0 - poisson) / (2.0 * (1.0 + poisson) * (1.0 - 2.0 * poisson))
            }
        }
    }

    /// Strain energy density of equal strains of size one along x and y, J/m^3: E / (1 - nu) or E / ((1 + nu)(1 - 2 nu)).
    pub fn biaxial_strain_energy(&self, plane: Plane) -> f64 {
        let (young, poisson) = (self.young, self.poisson);
        match plane {
            Plane::Stress => young / (1.0 - poisson),
            Plane::Strain => young / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
        }
    }

    /// Strain energy density of a pure shear strain gamma_xy of size one, J/m^3: G / 2 = E / (4 (1 + nu)).
    pub fn shear_strain_energy(&self) -> f64 {
        self.young / (4.0 * (1.0 + self.poisson))
    }

    /// Poisson's ratio at which the bonds' shear stiffness vanishes: 1/3 in plane stress, 1/4 in plane strain.
    pub fn central_force_poisson(plane: Plane) -> f64 {
        match plane {
            Plane::Stress => 1.0 / 3.0,
            Plane::Strain => 0.25,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Energies against 1/2 sigma : eps with sigma from the inverse of the compliance, in both planes.
    #[test]
    fn strain_energies_agree_with_hookes_law() {
        let material = Material {
            name: String::new(),
            young: 7.0,
            poisson: 0.3,
            tensile_strength: None,
            density: None,
        };
        let (young, poisson) = (material.young, material.poisson);
        for plane in [Plane::Stress, Plane::Strain] {
            // Plane strain is plane stress with E/(1 - nu^2) and nu/(1 - nu).
            let (e, n) = match plane {
                Plane::Stress => (young, poisson),
                Plane::Strain => (young / (1.0 - poisson * poisson), poisson / (1.0 - poisson)),
            };
            let energy = |ex: f64, ey: f64| {
                let c = e / (1.0 - n * n);
                0.5 * (c * (ex + n * ey) * ex + c * (ey + n * ex) * ey)
            };
            assert!(
                (material.uniaxial_strain_energy(plane) / energy(1.0, 0.0) - 1.0).abs() < 1e-14
            );
            assert!((material.biaxial_strain_energy(plane) / energy(1.0, 1.0) - 1.0).abs() < 1e-14);
        }
        // Pure shear is tension and compression of half the size along the diagonals.
        let c = young / (1.0 - poisson * poisson);
        let energy = c * (1.0 - poisson) * 0.25;
        assert!((material.shear_strain_energy() / energy - 1.0).abs() < 1e-14);
    }
}
