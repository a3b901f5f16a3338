//! Elastic constants of a material, and which keys tell them.

use serde::Serialize;

use super::super::fault::{Fault, KeyFault};
use super::super::key_path::KeyPath;
use super::super::values::require;

/// Elastic constants.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Elasticity {
    /// Constants that are the same in all directions.
    Isotropic {
        /// Young's modulus, Pa.
        young: f64,
        /// Poisson's ratio.
        poisson: f64,
    },
    /// With axes.
    Orthotropic(Orthotropic),
    /// Without any symmetry in the plane.
    Anisotropic(Anisotropic),
}

/// Constants of an orthotropic material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Orthotropic {
    /// Young's modulus along the axis 1, Pa.
    pub young_1: f64,
    /// Young's modulus along the axis 2, Pa.
    pub young_2: f64,
    /// Poisson's ratio: contraction along 2 under stress along 1.
    pub poisson_12: f64,
    /// Shear modulus in the plane, Pa.
    pub shear_modulus: f64,
    /// Angle from the x axis to the axis 1, rad.
    pub angle: f64,
    /// Constants across the plane, for plane strain: Young's modulus, Pa.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub young_3: Option<f64>,
    /// Contraction across under stress along 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poisson_13: Option<f64>,
    /// Contraction across under stress along 2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poisson_23: Option<f64>,
}

/// Constants of a material without any symmetry in the plane: (sigma_xx, sigma_yy, sigma_xy) = c (eps_xx, eps_yy, gamma_xy), Pa.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Anisotropic {
    /// Of sigma_xx by eps_xx.
    pub c11: f64,
    /// Of sigma_xx by eps_yy.
    pub c12: f64,
    /// Of sigma_xx by gamma_xy.
    pub c16: f64,
    /// Of sigma_yy by eps_yy.
    pub c22: f64,
    /// Of sigma_yy by gamma_xy.
    pub c26: f64,
    /// Of sigma_xy by gamma_xy.
    pub c66: f64,
}

/// Keys that only an orthotropic material has: one of them tells it.
pub(super) const ORTHOTROPIC_KEYS: [&str; 8] = [
    "young_1",
    "young_2",
    "poisson_12",
    "shear_modulus",
    "angle",
    "young_3",
    "poisson_13",
    "poisson_23",
];

/// Keys that only a material without symmetry has.
pub(super) const ANISOTROPIC_KEYS: [&str; 6] = ["c11", "c12", "c16", "c22", "c26", "c66"];

impl Orthotropic {
    pub(super) fn check(&self, key: &KeyPath) -> Result<(), KeyFault> {
        let across = [self.young_3, self.poisson_13, self.poisson_23];
        if across.iter().any(Option::is_some) {
            self.require_across(
                key,
                "because the other constants across the plane are given",
            )?;
        }
        let stable = ligament_model::Orthotropic::from(*self).is_stable();
        require(
            stable,
            || key.child("poisson_12"),
            "so small that every strain costs energy (nu_12^2 < E_1/E_2, and the like across the plane)",
            self.poisson_12,
        )
    }

    pub(super) fn require_across(
        &self,
        key: &KeyPath,
        reason: &'static str,
    ) -> Result<(), KeyFault> {
        let across = [
            ("young_3", self.young_3),
            ("poisson_13", self.poisson_13),
            ("poisson_23", self.poisson_23),
        ];
        match across.into_iter().find(|(_, value)| value.is_none()) {
            None => Ok(()),
            Some((name, _)) => {
                let fault = Fault::Required {
                    key: name,
                    reason: reason.to_owned(),
                };
                Err(KeyFault::new(key.child(name), fault))
            }
        }
    }
}

impl From<Elasticity> for ligament_model::Elasticity {
    fn from(elasticity: Elasticity) -> Self {
        match elasticity {
            Elasticity::Isotropic { young, poisson } => {
                Self::Isotropic(ligament_model::Isotropic { young, poisson })
            }
            Elasticity::Orthotropic(constants) => Self::Orthotropic(constants.into()),
            Elasticity::Anisotropic(constants) => Self::Anisotropic(constants.into()),
        }
    }
}

impl From<Orthotropic> for ligament_model::Orthotropic {
    fn from(constants: Orthotropic) -> Self {
        let across = constants.young_3.zip(constants.poisson_13);
        let across = across.zip(constants.poisson_23);
        Self {
            young: [constants.young_1, constants.young_2],
            poisson: constants.poisson_12,
            shear_modulus: constants.shear_modulus,
            out_of_plane: across.map(|((young, along_1), along_2)| {
                ligament_model::material::OutOfPlane {
                    young,
                    poisson: [along_1, along_2],
                }
            }),
            angle: constants.angle,
        }
    }
}

impl Anisotropic {
    pub(super) fn check(&self, key: &KeyPath) -> Result<(), KeyFault> {
        let (c11, c22, c66) = (self.c11, self.c22, self.c66);
        for (name, coupling, both, words) in [
            ("c12", self.c12, c11 * c22, "c12^2 < c11 c22"),
            ("c16", self.c16, c11 * c66, "c16^2 < c11 c66"),
            ("c26", self.c26, c22 * c66, "c26^2 < c22 c66"),
        ] {
            let expected = format!("so small that every strain costs energy ({words})");
            let holds = coupling * coupling < both;
            require(holds, || key.child(name), &expected, coupling)?;
        }
        if ligament_model::Anisotropic::from(*self).is_stable() {
            return Ok(());
        }
        let reason = "the stiffness c11 to c66 is not positive definite: some strain would cost no energy, or give some back; \
                      c12, c16 and c26 are too large together";
        Err(KeyFault::new(key.clone(), reason))
    }
}

impl From<Anisotropic> for ligament_model::Anisotropic {
    fn from(constants: Anisotropic) -> Self {
        let Anisotropic {
            c11,
            c12,
            c16,
            c22,
            c26,
            c66,
        } = constants;
        Self::new([c11, c12, c16, c22, c26, c66])
    }
}
