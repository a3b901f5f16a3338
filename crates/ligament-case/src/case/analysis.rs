//! `analysis` and `[modal]`: the kind of analysis.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::word::Word;
use ligament::setup;
use ligament_analysis::modal::{ModalSettings, Rotations};

/// Largest number of modes: each needs three vectors of the search in memory.
pub const MOST_MODES: usize = 1000;

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
    /// A motion in time, in which bonds break where `[fracture]` has criteria.
    Motion,
}

/// Natural modes that are wanted.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Modal {
    /// Number of modes, rigid ones included, lowest first.
    #[schemars(range(min = 1, max = MOST_MODES))]
    pub modes: usize,
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
            modes,
            rotations: Word(rotations),
            tolerance,
        }
    }
}

impl Modal {
    pub(super) fn setup(&self) -> ModalSettings {
        ModalSettings {
            modes: self.modes,
            rotations: self.rotations.0,
            tolerance: self.tolerance,
        }
    }
}
