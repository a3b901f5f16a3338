//! `[mesh]`: the meshed body.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::values::{metre, require};
use super::word::Word;
use ligament_model::Plane;

/// The meshed body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshSection {
    /// The mesh, a Gmsh file (2.2 or 4.1), from the folder of the case file.
    #[schemars(length(min = 1))]
    pub file: PathBuf,
    /// Thickness of the body, m.
    #[serde(default = "metre")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub thickness: f64,
    /// Plane stress or plane strain.
    #[serde(default)]
    pub plane: Word<Plane>,
}

/// Makes the path at a key an absolute one; without `..` where the file exists. Whether it does is for its reader to say.
pub(super) fn complete_path(
    key: &KeyPath,
    file: &mut PathBuf,
    folder: &Path,
) -> Result<(), KeyFault> {
    require(
        !file.as_os_str().is_empty(),
        || key.clone(),
        "a path",
        &file,
    )?;
    let path = folder.join(&*file);
    let absolute = path.canonicalize().or_else(|_| std::path::absolute(&path));
    *file = absolute.unwrap_or(path);
    Ok(())
}
