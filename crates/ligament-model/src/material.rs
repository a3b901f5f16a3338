//! Linear elastic materials, isotropic, orthotropic or anisotropic, with their strengths.

mod anisotropic;
mod contrast;
mod elasticity;
mod expansion;
mod volumetric_split;
mod waves;

pub use anisotropic::Anisotropic;
pub use contrast::with_reduced_contrast;
pub use elasticity::{Elasticity, Isotropic, Orthotropic, OutOfPlane, Plane, Space, Stiffness};
pub(crate) use elasticity::{add_volumetric, stress, stress_component};
pub use expansion::Expansion;
pub use volumetric_split::{PoissonForm, VolumetricSplit};
pub use waves::PlaneWaves;

crate::case_type! {
    /// A linear elastic, brittle material. A case file gives its constants and its expansion by keys of their own.
    #[derive(Debug, Clone, PartialEq)]
    pub struct Material {
        /// Name of the material in the case file.
        #[case(serde(skip))]
        pub name: String,
        /// Elastic constants of the material.
        #[case(serde(skip, default = "no_elasticity"))]
        pub elasticity: Elasticity,
        /// Tensile strength, Pa.
        #[range("exclusiveMinimum" = 0)]
        pub tensile_strength: Option<f64>,
        /// Compressive strength, Pa, positive.
        #[range("exclusiveMinimum" = 0)]
        pub compressive_strength: Option<f64>,
        /// Fracture energy of opening, J/m^2.
        #[range("exclusiveMinimum" = 0)]
        pub fracture_energy: Option<f64>,
        /// Fracture energy of sliding where it is another, J/m^2; for `mixed-mode`.
        #[range("exclusiveMinimum" = 0)]
        pub fracture_energy_sliding: Option<f64>,
        // The exponent of Benzeggagh and Kenane 1996.
        /// Exponent eta between the two fracture energies; for `mixed-mode`.
        #[range("exclusiveMinimum" = 0)]
        pub mixed_mode_exponent: Option<f64>,
        /// Mass density, kg/m^3; for natural modes.
        #[range("exclusiveMinimum" = 0)]
        pub density: Option<f64>,
        /// Thermal expansion.
        #[case(serde(skip))]
        pub expansion: Option<Expansion>,
    }
}

/// Placeholder for constants that a case file gives by separate keys.
#[cfg(feature = "case")]
fn no_elasticity() -> Elasticity {
    Elasticity::Isotropic(Isotropic {
        young: 0.0,
        poisson: 0.0,
    })
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
