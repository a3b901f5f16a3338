//! `analysis` and `[modal]`: what is computed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::word::Word;
use ligament_analysis::modal::Rotations;

/// Modes at most: each keeps three vectors of the search in memory.
pub const MOST_MODES: u32 = 1000;

/// What is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Analysis {
    /// One linear elastic solution at load factor 1.
    Static,
    /// The breaking of bonds under rising loads.
    Fracture,
    /// Natural frequencies and modes.
    Modal,
}

/// Settings of a modal analysis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Modal {
    /// Number of modes, rigid ones included, lowest first.
    pub modes: u32,
    /// Inertia of the rotations of the points.
    pub rotations: Word<Option<Rotations>>,
    /// Residual of the iteration below which a mode is found.
    pub tolerance: f64,
}

#[derive(Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawModal {
    /// Number of modes, rigid ones included, lowest first.
    #[schemars(range(min = 1, max = MOST_MODES), extend("default" = 10))]
    modes: Option<u32>,
    /// Inertia of the rotations of the points.
    rotations: Word<Option<Rotations>>,
    /// Residual of the search, relative to 1/omega^2.
    #[schemars(extend("default" = 1e-10, "exclusiveMinimum" = 0))]
    tolerance: Option<f64>,
}

impl RawModal {
    pub(super) fn complete(self) -> Modal {
        Modal {
            modes: self.modes.unwrap_or(10),
            rotations: self.rotations,
            tolerance: self.tolerance.unwrap_or(1e-10),
        }
    }
}

/// Sections and keys that not every analysis has: whether they are given.
pub(super) struct Given {
    pub(super) fracture: bool,
    pub(super) modal: bool,
    pub(super) loads: bool,
    pub(super) temperature: bool,
    pub(super) probes: bool,
    pub(super) output: bool,
}

impl Analysis {
    /// The analysis that a case names, or that its sections mean; all sections must go with it.
    pub(super) fn named_or_meant(named: Option<Self>, given: &Given) -> Result<Self, KeyFault> {
        let meant = if given.fracture {
            Self::Fracture
        } else {
            Self::Static
        };
        let analysis = named.unwrap_or(meant);
        if analysis == Self::Fracture && !given.fracture {
            let reason = "\"fracture\" needs a [fracture] section, which says how the loads rise";
            return Err(KeyFault::new(KeyPath::default().child("analysis"), reason));
        }
        let why_no_modes =
            "it says which modes are wanted, and only analysis = \"modal\" finds any";
        let misfit = match analysis {
            Self::Static if given.fracture => Some((
                "fracture",
                "analysis = \"static\"",
                "no bond breaks in an elastic solution",
            )),
            Self::Static if given.modal => Some(("modal", "analysis = \"static\"", why_no_modes)),
            Self::Fracture if given.modal => {
                Some(("modal", "analysis = \"fracture\"", why_no_modes))
            }
            Self::Static | Self::Fracture => None,
            Self::Modal => given.unfit_for_modes(),
        };
        match misfit {
            None => Ok(analysis),
            Some((key, setting, reason)) => Err(KeyFault::new(
                KeyPath::default().child(key),
                Fault::NotWith {
                    key,
                    setting: setting.to_owned(),
                    reason,
                },
            )),
        }
    }
}

impl Given {
    fn unfit_for_modes(&self) -> Option<(&'static str, &'static str, &'static str)> {
        let sections = [
            ("fracture", self.fracture, "no bond breaks in a mode"),
            (
                "load",
                self.loads,
                "modes are free vibrations without loads; supports hold",
            ),
            (
                "temperature",
                self.temperature,
                "modes are free vibrations without loads",
            ),
            ("probe", self.probes, "modes have no history to read"),
            (
                "output",
                self.output,
                "every mode is written, to a file of its own",
            ),
        ];
        let found = sections.into_iter().find(|(_, given, _)| *given);
        found.map(|(key, _, reason)| (key, "analysis = \"modal\"", reason))
    }
}
