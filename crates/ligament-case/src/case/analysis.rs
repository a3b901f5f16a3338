//! `analysis` and `[modal]`: what is computed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::sections::Case;
use super::values::refuse;
use super::word::Word;
use ligament::setup;
use ligament_analysis::modal::{ModalSettings, Rotations};

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

/// Natural modes that are wanted.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Modal {
    /// Number of modes, rigid ones included, lowest first.
    #[schemars(range(min = 1, max = MOST_MODES))]
    pub modes: u32,
    /// Inertia of the rotations of the points.
    pub rotations: Word<Option<Rotations>>,
    /// Residual of the search, relative to 1/omega^2.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub tolerance: f64,
}

impl Default for Modal {
    fn default() -> Self {
        let ModalSettings {
            modes,
            rotations,
            tolerance,
        } = setup::modal();
        Self {
            modes: modes as u32,
            rotations: Word(rotations),
            tolerance,
        }
    }
}

impl Modal {
    pub(super) fn setup(&self) -> ModalSettings {
        ModalSettings {
            modes: self.modes as usize,
            rotations: self.rotations.0,
            tolerance: self.tolerance,
        }
    }
}

impl Case {
    /// Names the analysis: the one that the case says, or that its sections mean; all sections must go with it.
    pub(super) fn complete_analysis(&mut self, has_output: bool) -> Result<(), KeyFault> {
        let (is_breaking, is_modal) = (self.fracture.is_some(), self.modal.is_some());
        let meant = match is_breaking {
            true => Analysis::Fracture,
            false => Analysis::Static,
        };
        let analysis = *self.analysis.get_or_insert(meant);
        let refuse = |key, is_given, reason| {
            let setting = format!("analysis = \"{}\"", analysis.word());
            refuse(&KeyPath::default(), [(key, is_given)], &setting, reason)
        };
        if analysis != Analysis::Modal {
            let reason = "it says which modes are wanted, and only analysis = \"modal\" finds any";
            refuse("modal", is_modal, reason)?;
        }
        match analysis {
            Analysis::Fracture if !is_breaking => {
                let reason =
                    "\"fracture\" needs a [fracture] section, which says how the loads rise";
                Err(KeyFault::new(KeyPath::default().child("analysis"), reason))
            }
            Analysis::Fracture => Ok(()),
            Analysis::Static => {
                let reason = "no bond breaks in an elastic solution";
                refuse("fracture", is_breaking, reason)
            }
            Analysis::Modal => {
                self.modal.get_or_insert_default();
                let (loads, free) = (&self.loads, "modes are free vibrations without loads");
                refuse("fracture", is_breaking, "no bond breaks in a mode")?;
                let held = "modes are free vibrations without loads; supports hold";
                refuse("load", !loads.is_empty(), held)?;
                refuse("temperature", !self.temperatures.is_empty(), free)?;
                let reason = "modes have no history to read";
                refuse("probe", !self.probes.is_empty(), reason)?;
                let reason = "every mode is written, to a file of its own";
                refuse("output", has_output, reason)
            }
        }
    }
}

impl Analysis {
    fn word(self) -> &'static str {
        match self {
            Self::Static => "static",
            Self::Fracture => "fracture",
            Self::Modal => "modal",
        }
    }
}
