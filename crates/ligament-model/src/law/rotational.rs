//! The rotational stiffness of a bond beside a shear stiffness. Uniform strains do not see it, so the continuum does not say
//! what it is: the papers choose.

/// A choice of k_theta for a given k_t.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RotationalStiffness {
    /// k_t l (1 - l/H)/2 (OMPPD after eq. 57): short bonds resist bending most, and one as long as the horizon not at all.
    Decaying,
    /// k_t l/4: the moment at an end does not depend on the rotation of the other.
    Quarter,
    /// Rotational stiffness k_t l/12 of a beam (Gerstle 2007; OMPPD eq. 22).
    Beam,
    /// No rotational stiffness: relative rotations cost nothing.
    Zero,
}

impl RotationalStiffness {
    /// k_theta (N/m^5) for the shear stiffness k_t (N/m^6) of a bond of length l (m) with the bond horizon H (m).
    pub fn density(self, shear: f64, length: f64, horizon: f64) -> f64 {
        match self {
            Self::Decaying => 0.5 * shear * length * (1.0 - length / horizon).max(0.0),
            Self::Quarter => 0.25 * shear * length,
            Self::Beam => shear * length / 12.0,
            Self::Zero => 0.0,
        }
    }
}
