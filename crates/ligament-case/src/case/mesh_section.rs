//! `[mesh]`: the meshed body.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::values::require;
use super::word::Word;
use ligament_model::Plane;

/// The meshed body.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeshSection {
    /// The Gmsh file, as an absolute path.
    pub file: PathBuf,
    /// Thickness of the body, m.
    pub thickness: f64,
    /// Plane stress or plane strain.
    pub plane: Word<Plane>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RawMesh {
    /// The mesh, a Gmsh file (2.2 or 4.1), from the folder of the case file.
    #[schemars(length(min = 1))]
    file: String,
    /// Thickness of the body, m.
    #[schemars(extend("default" = 1.0, "exclusiveMinimum" = 0))]
    thickness: Option<f64>,
    /// Plane stress or plane strain.
    #[schemars(extend("default" = "stress"))]
    plane: Option<Word<Plane>>,
}

impl RawMesh {
    /// Checks the section; `folder` is that of the case file.
    pub(super) fn check(self, key: &KeyPath, folder: &Path) -> Result<MeshSection, KeyFault> {
        require(
            !self.file.is_empty(),
            || key.child("file"),
            "a path",
            &self.file,
        )?;
        let file = absolute(&folder.join(self.file));
        Ok(MeshSection {
            file,
            thickness: self.thickness.unwrap_or(1.0),
            plane: self.plane.unwrap_or_default(),
        })
    }
}

/// An absolute path, without `..` where the file exists; whether it does is for its reader to say.
pub(super) fn absolute(path: &Path) -> PathBuf {
    path.canonicalize()
        .or_else(|_| std::path::absolute(path))
        .unwrap_or_else(|_| path.to_owned())
}
