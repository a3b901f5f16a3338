//! Bond laws: from materials and bond horizons to the stiffness densities of the bonds.

pub mod nhpd;

/// Stiffness densities of the bonds.
#[derive(Debug, Clone, PartialEq)]
pub struct BondStiffness {
    /// Axial k_n, shape (n_bonds), N/m^6.
    pub axial: Vec<f64>,
    /// Shear k_t, shape (n_bonds), N/m^6; negative above the central-force Poisson's ratio.
    pub shear: Vec<f64>,
    /// Rotational k_theta, shape (n_bonds), N/m^5; of the sign of k_t.
    pub rotational: Vec<f64>,
}

impl BondStiffness {
    /// The bonds for which `keep` (n_bonds) is true.
    pub fn retained(self, keep: &[bool]) -> Self {
        use crate::bonds::retained;
        Self {
            axial: retained(self.axial, keep),
            shear: retained(self.shear, keep),
            rotational: retained(self.rotational, keep),
        }
    }
}
