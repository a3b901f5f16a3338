//! Linear elastic materials, isotropic, orthotropic or anisotropic, with their strengths.

mod anisotropic;
mod contrast;
mod elasticity;
mod expansion;
mod waves;

pub use anisotropic::Anisotropic;
pub use contrast::with_reduced_contrast;
pub use elasticity::{Elasticity, Isotropic, Orthotropic, OutOfPlane, Plane, Space, Stiffness};
pub(crate) use elasticity::{stress, stress_component};
pub use expansion::Expansion;
pub use waves::PlaneWaves;

/// A linear elastic, brittle material.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name of the material in the case file.
    pub name: String,
    /// Elastic constants of the material.
    pub elasticity: Elasticity,
    /// Tensile strength F_t, Pa.
    pub tensile_strength: Option<f64>,
    /// Compressive strength F_c, Pa, positive.
    pub compressive_strength: Option<f64>,
    /// Fracture energy G_c, J/m^2; where opening and sliding differ, the fracture energy of opening, G_Ic.
    pub fracture_energy: Option<f64>,
    /// Fracture energy of sliding, mode II, G_IIc, J/m^2; `None` where it equals that of opening.
    pub fracture_energy_sliding: Option<f64>,
    /// Exponent eta of the interpolation between both fracture energies (Benzeggagh and Kenane 1996).
    pub mixed_mode_exponent: Option<f64>,
    /// Mass density, kg/m^3.
    pub density: Option<f64>,
    /// Thermal expansion.
    pub expansion: Option<Expansion>,
}

impl Material {
    /// An isotropic material with Young's modulus (Pa) and Poisson's ratio, without a name, strengths or any other property.
    pub fn isotropic(young: f64, poisson: f64) -> Self {
        Self {
            name: String::new(),
            elasticity: Elasticity::Isotropic(Isotropic { young, poisson }),
            tensile_strength: None,
            compressive_strength: None,
            fracture_energy: None,
            fracture_energy_sliding: None,
            mixed_mode_exponent: None,
            density: None,
            expansion: None,
        }
    }
}
