//! `[[fracture.criterion]]`: when a bond fails, and what it does after.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::{Fault, KeyFault};
use super::fracture::Control;
use super::key_path::KeyPath;
use super::model::Law;
use super::values::{require, require_positive};

/// A failure criterion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Criterion {
    /// What fails, and where its limit comes from.
    #[serde(flatten)]
    pub kind: CriterionKind,
    /// What a bond does after its limit.
    #[serde(flatten)]
    pub after: After,
}

/// What fails, and where its limit comes from.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum CriterionKind {
    /// Stretch, from the energy at the tensile strength (NHPD).
    Strength,
    /// Stretch, from the tensile strength, or this one.
    Tension {
        /// Limit stretch.
        #[serde(skip_serializing_if = "Option::is_none")]
        limit: Option<f64>,
    },
    /// Shortening, from the compressive strength, or this one.
    Compression {
        /// Limit shortening, positive.
        #[serde(skip_serializing_if = "Option::is_none")]
        limit: Option<f64>,
    },
    /// Sliding, from the tensile strength, or this one.
    Sliding {
        /// Limit sliding.
        #[serde(skip_serializing_if = "Option::is_none")]
        limit: Option<f64>,
    },
    /// Sliding that compression makes harder, from both strengths.
    Frictional {
        /// How it comes from them.
        calibration: FrictionCalibration,
    },
    /// Stretch, from the fracture energy.
    CriticalStretch,
    /// Energy of stretch and sliding, from the fracture energy, or this limit.
    BondEnergy {
        /// Stretch that stores the limit energy.
        #[serde(skip_serializing_if = "Option::is_none")]
        limit: Option<f64>,
    },
    /// Opening and shear of bonds with strains of their own, from the fracture energies, or these limits.
    MixedMode {
        /// The limits, both or none.
        #[serde(flatten)]
        limits: Option<MixedModeLimits>,
    },
}

/// Limits of opening and of shear.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MixedModeLimits {
    /// Stretch at which a bond without shear breaks.
    pub critical_stretch: f64,
    /// Shear at which a bond that does not open breaks, rad.
    pub critical_angle: f64,
}

/// How cohesion and friction come from the strengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FrictionCalibration {
    /// As printed: exact without lateral strain alone.
    #[default]
    Printed,
    /// From the strains of a bar under both strengths.
    TwoPoint,
}

/// What a bond does after its limit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "after", rename_all = "kebab-case")]
pub enum After {
    /// It breaks.
    Brittle,
    /// Its force falls in a straight line to zero.
    Bilinear {
        /// Deformation there over that at the limit; none: so that the fracture energy of the material comes out.
        #[serde(skip_serializing_if = "Option::is_none")]
        end: Option<f64>,
    },
    /// Its force falls exponentially.
    Exponential {
        /// Scale of the fall over the deformation at the limit; none: so that the fracture energy of the material comes out.
        #[serde(skip_serializing_if = "Option::is_none")]
        scale: Option<f64>,
    },
    /// Its force stays.
    Plastic,
}

impl Criterion {
    /// That of a case that names none: the strength of NHPD, or the one criterion that the law takes.
    pub fn default_of(law: Law) -> Self {
        let kind = match law {
            Law::MbbPd => CriterionKind::MixedMode { limits: None },
            _ => CriterionKind::Strength,
        };
        Self {
            kind,
            after: After::Brittle,
        }
    }

    /// What it takes from each material: the key, and the key of the criterion that would spare it.
    pub(super) fn needs(&self) -> Vec<(&'static str, Option<&'static str>)> {
        let mut needs = match self.kind {
            CriterionKind::Tension { limit: Some(_) }
            | CriterionKind::Compression { limit: Some(_) }
            | CriterionKind::Sliding { limit: Some(_) }
            | CriterionKind::BondEnergy { limit: Some(_) }
            | CriterionKind::MixedMode { limits: Some(_) } => Vec::new(),
            CriterionKind::Strength => vec![("tensile_strength", None)],
            CriterionKind::Tension { limit: None } | CriterionKind::Sliding { limit: None } => {
                vec![("tensile_strength", Some("limit"))]
            }
            CriterionKind::Compression { limit: None } => {
                vec![("compressive_strength", Some("limit"))]
            }
            CriterionKind::Frictional { .. } => {
                vec![("tensile_strength", None), ("compressive_strength", None)]
            }
            CriterionKind::CriticalStretch => vec![("fracture_energy", None)],
            CriterionKind::BondEnergy { limit: None } => {
                vec![("fracture_energy", Some("limit"))]
            }
            CriterionKind::MixedMode { limits: None } => {
                vec![("fracture_energy", Some("critical_stretch"))]
            }
        };
        match self.after {
            After::Bilinear { end: None } => needs.push(("fracture_energy", Some("end"))),
            After::Exponential { scale: None } => needs.push(("fracture_energy", Some("scale"))),
            After::Bilinear { .. }
            | After::Exponential { .. }
            | After::Brittle
            | After::Plastic => {}
        }
        needs
    }
}

impl CriterionKind {
    /// The word for it in a case file, and in results.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Strength => "strength",
            Self::Tension { .. } => "tension",
            Self::Compression { .. } => "compression",
            Self::Sliding { .. } => "sliding",
            Self::Frictional { .. } => "frictional",
            Self::CriticalStretch => "critical-stretch",
            Self::BondEnergy { .. } => "bond-energy",
            Self::MixedMode { .. } => "mixed-mode",
        }
    }

    /// Number of criteria of the model that it stands for: one for opening along each axis, or one.
    pub fn parts(&self) -> usize {
        match self {
            Self::MixedMode { .. } => 2,
            _ => 1,
        }
    }

    /// Whether its limits come from constants of isotropic materials alone.
    pub(super) fn is_isotropic(&self) -> bool {
        !matches!(self, Self::MixedMode { .. })
    }
}

impl After {
    /// The word for it in a case file.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Brittle => "brittle",
            Self::Bilinear { .. } => "bilinear",
            Self::Exponential { .. } => "exponential",
            Self::Plastic => "plastic",
        }
    }
}

#[derive(Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
enum KindName {
    /// Stretch, from the energy at the `tensile_strength` (NHPD).
    Strength,
    /// Stretch, from the `tensile_strength` or a `limit`.
    Tension,
    /// Shortening, from the `compressive_strength` or a `limit`.
    Compression,
    /// Sliding, from the `tensile_strength` or a `limit`.
    Sliding,
    /// Sliding that compression makes harder, from both strengths.
    Frictional,
    /// Stretch, from the `fracture_energy`.
    CriticalStretch,
    /// Energy of stretch and sliding, from the `fracture_energy` or a `limit`.
    BondEnergy,
    /// Opening and shear of the bonds of `mbb-pd`, from the fracture energies or limits of both.
    MixedMode,
}

#[derive(Clone, Copy, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
enum AfterName {
    /// It breaks.
    #[default]
    Brittle,
    /// Its force falls in a straight line to zero.
    Bilinear,
    /// Its force falls exponentially.
    Exponential,
    /// Its force stays; of `sliding` alone.
    Plastic,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RawCriterion {
    /// What fails, and where its limit comes from.
    kind: KindName,
    /// Stretch, shortening or sliding at which a bond fails, in the place of the strength or the energy of the material.
    #[schemars(extend("exclusiveMinimum" = 0))]
    limit: Option<f64>,
    /// Stretch at which a bond without shear fails; of `mixed-mode`, with `critical_angle`.
    #[schemars(extend("exclusiveMinimum" = 0))]
    critical_stretch: Option<f64>,
    /// Shear at which a bond that does not open fails, rad; of `mixed-mode`, with `critical_stretch`.
    #[schemars(extend("exclusiveMinimum" = 0))]
    critical_angle: Option<f64>,
    /// How the limit of `frictional` comes from the strengths.
    #[schemars(extend("default" = "printed"))]
    calibration: Option<FrictionCalibration>,
    /// What a bond does after its limit.
    #[serde(default)]
    after: AfterName,
    /// Deformation at which the force of `bilinear` is gone, over that at the limit; without it so that the `fracture_energy` comes out.
    #[schemars(extend("exclusiveMinimum" = 1))]
    end: Option<f64>,
    /// Scale of the fall of `exponential` over the deformation at the limit; without it so that the `fracture_energy` comes out.
    #[schemars(extend("exclusiveMinimum" = 0))]
    scale: Option<f64>,
}

impl RawCriterion {
    pub(super) fn check(self, key: &KeyPath, control: &Control) -> Result<Criterion, KeyFault> {
        let criterion = Criterion {
            kind: self.kind(key)?,
            after: self.after(),
        };
        self.refuse_other_kinds(key, &criterion)?;
        self.refuse_after(key, &criterion, control)?;
        for (name, limit) in [
            ("limit", self.limit),
            ("critical_stretch", self.critical_stretch),
            ("critical_angle", self.critical_angle),
        ] {
            if let Some(limit) = limit {
                require_positive(key, name, limit)?;
            }
        }
        if let Some(end) = self.end {
            require(end > 1.0, || key.child("end"), "greater than 1", end)?;
        }
        if let Some(scale) = self.scale {
            require_positive(key, "scale", scale)?;
        }
        Ok(criterion)
    }

    fn kind(&self, key: &KeyPath) -> Result<CriterionKind, KeyFault> {
        let limit = self.limit;
        Ok(match self.kind {
            KindName::Strength => CriterionKind::Strength,
            KindName::Tension => CriterionKind::Tension { limit },
            KindName::Compression => CriterionKind::Compression { limit },
            KindName::Sliding => CriterionKind::Sliding { limit },
            KindName::Frictional => CriterionKind::Frictional {
                calibration: self.calibration.unwrap_or_default(),
            },
            KindName::CriticalStretch => CriterionKind::CriticalStretch,
            KindName::BondEnergy => CriterionKind::BondEnergy { limit },
            KindName::MixedMode => CriterionKind::MixedMode {
                limits: self.mixed_mode_limits(key)?,
            },
        })
    }

    fn mixed_mode_limits(&self, key: &KeyPath) -> Result<Option<MixedModeLimits>, KeyFault> {
        let missing = |name: &'static str, given: &str| {
            let reason = format!(
                "beside `{given}`: the limits of opening and of shear are given together, or both come from the fracture energies"
            );
            KeyFault::new(key.child(name), Fault::Required { key: name, reason })
        };
        match (self.critical_stretch, self.critical_angle) {
            (None, None) => Ok(None),
            (Some(critical_stretch), Some(critical_angle)) => Ok(Some(MixedModeLimits {
                critical_stretch,
                critical_angle,
            })),
            (Some(_), None) => Err(missing("critical_angle", "critical_stretch")),
            (None, Some(_)) => Err(missing("critical_stretch", "critical_angle")),
        }
    }

    fn after(&self) -> After {
        match self.after {
            AfterName::Brittle => After::Brittle,
            AfterName::Bilinear => After::Bilinear { end: self.end },
            AfterName::Exponential => After::Exponential { scale: self.scale },
            AfterName::Plastic => After::Plastic,
        }
    }

    /// Keys that mean nothing with the others: a user who gives one expects what will not happen.
    fn refuse_other_kinds(&self, key: &KeyPath, criterion: &Criterion) -> Result<(), KeyFault> {
        let kind = format!("kind = \"{}\"", criterion.kind.word());
        let takes_limit = matches!(
            self.kind,
            KindName::Tension | KindName::Compression | KindName::Sliding | KindName::BondEnergy
        );
        let is_mixed = self.kind == KindName::MixedMode;
        for (name, given) in [
            ("critical_stretch", self.critical_stretch),
            ("critical_angle", self.critical_angle),
        ] {
            if given.is_some() && !is_mixed {
                let reason = "only \"mixed-mode\" has a limit for opening and one for shear";
                return Err(not_with(key, name, name, kind, reason));
            }
        }
        if self.limit.is_some() && is_mixed {
            let reason =
                "it has two limits: `critical_stretch` of opening and `critical_angle` of shear";
            return Err(not_with(key, "limit", "limit", kind, reason));
        }
        if self.limit.is_some() && !takes_limit {
            let reason = "its limits come from the material; \"tension\", \"compression\", \"sliding\" and \"bond-energy\" take one";
            return Err(not_with(key, "limit", "limit", kind, reason));
        }
        if self.calibration.is_some() && self.kind != KindName::Frictional {
            let reason = "only the limit of \"frictional\" can come from the strengths in two ways";
            return Err(not_with(key, "calibration", "calibration", kind, reason));
        }
        let after = format!("after = \"{}\"", criterion.after.word());
        if self.end.is_some() && !matches!(criterion.after, After::Bilinear { .. }) {
            let reason =
                "only a force that falls in a straight line, after = \"bilinear\", has an end";
            return Err(not_with(key, "end", "end", after, reason));
        }
        if self.scale.is_some() && !matches!(criterion.after, After::Exponential { .. }) {
            let reason =
                "only a force that falls exponentially, after = \"exponential\", has a scale";
            return Err(not_with(key, "scale", "scale", after, reason));
        }
        Ok(())
    }

    /// What bonds may do after their limit depends on the criterion and on what drives the load.
    fn refuse_after(
        &self,
        key: &KeyPath,
        criterion: &Criterion,
        control: &Control,
    ) -> Result<(), KeyFault> {
        let kind = format!("kind = \"{}\"", criterion.kind.word());
        let named = match criterion.after {
            After::Brittle => return Ok(()),
            After::Bilinear { .. } => "after = \"bilinear\"",
            After::Exponential { .. } => "after = \"exponential\"",
            After::Plastic => "after = \"plastic\"",
        };
        if self.kind == KindName::Frictional {
            let reason = "its limit moves with the stretch, so that there is no one deformation at which softening begins";
            return Err(not_with(key, "after", named, kind, reason));
        }
        if self.kind == KindName::MixedMode {
            let reason = "which bonds a strain is taken from changes when their neighbours break, so that it says nothing of \
                          what a bond went through";
            return Err(not_with(key, "after", named, kind, reason));
        }
        if criterion.after == After::Plastic && self.kind != KindName::Sliding {
            let reason = "only bonds that slide, kind = \"sliding\", keep their force";
            return Err(not_with(key, "after", named, kind, reason));
        }
        if *control == Control::Event {
            let (control, reason) = (
                "control = \"event\"".to_owned(),
                "the exact path is straight between breakages, and softening bends it: take load steps (`steps`)",
            );
            return Err(not_with(key, "after", named, control, reason));
        }
        let spends_all = self.kind == KindName::CriticalStretch
            || (self.kind == KindName::BondEnergy && self.limit.is_none());
        let wanted = match criterion.after {
            After::Bilinear { end: None } => "end",
            After::Exponential { scale: None } => "scale",
            _ => return Ok(()),
        };
        if spends_all {
            let reason =
                format!("with {kind}: up to the limit a bond takes all of the fracture energy");
            let fault = Fault::Required {
                key: wanted,
                reason,
            };
            return Err(KeyFault::new(key.child(wanted), fault));
        }
        Ok(())
    }
}

/// A key, or a setting of it, that does not go with another.
fn not_with(
    table: &KeyPath,
    key: &str,
    named: &'static str,
    setting: String,
    reason: &'static str,
) -> KeyFault {
    let fault = Fault::NotWith {
        key: named,
        setting,
        reason,
    };
    KeyFault::new(table.child(key), fault)
}
