//! `[mesh]`: the meshed body.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::values::{refuse, require};
use super::word::Word;
use crate::mesh_file::holds_solid;
use crate::point_table::is_table;
use ligament_mesh::AnyMesh;
use ligament_mesh::gmsh::CoordinatePlane;
use ligament_model::Plane;

/// A body in the plane, or a solid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodyKind {
    /// Body in the plane of x and y.
    Plane,
    /// Solid in space.
    Solid,
}

/// The meshed body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshSection {
    /// The mesh, a Gmsh file (2.2 or 4.1), or a table of points (`.csv`), from the folder of the case file.
    #[schemars(length(min = 1))]
    pub file: PathBuf,
    /// Factor on the coordinates of the mesh, such as 1e-3 for a mesh in mm; lengths elsewhere in the case stay in m.
    #[schemars(extend("exclusiveMinimum" = 0, "default" = 1.0))]
    pub scale: Option<f64>,
    /// Plane in which a mesh without solid cells lies; from another one than that of x and y it is turned, and the case has the turned x and y.
    #[schemars(extend("default" = "xy"))]
    pub coordinates: Option<Word<CoordinatePlane>>,
    /// Thickness of a body in the plane, m; a mesh of solid cells has none.
    #[schemars(extend("exclusiveMinimum" = 0, "default" = 1.0))]
    pub thickness: Option<f64>,
    /// Plane stress or plane strain of a body in the plane; a mesh of solid cells has none.
    #[schemars(extend("default" = "stress"))]
    pub plane: Option<Plane>,
    /// Whether the cells of the mesh are solid; not if it cannot be read.
    #[serde(skip)]
    pub is_solid: bool,
    /// Why the mesh cannot be read, if so.
    #[serde(skip)]
    pub(crate) unread: Option<String>,
}

impl MeshSection {
    /// The mesh with the factor on its coordinates.
    pub(crate) fn scaled(&self, mesh: AnyMesh) -> AnyMesh {
        match self.scale {
            Some(factor) => mesh.scaled(factor),
            None => mesh,
        }
    }

    /// Plane in which a mesh without solid cells lies.
    pub fn coordinate_plane(&self) -> CoordinatePlane {
        self.coordinates.unwrap_or_default().0
    }

    /// Fills in missing keys; `folder` is the folder of the case file, `body` the kind of a body in memory.
    pub(super) fn complete(
        &mut self,
        key: &KeyPath,
        folder: &Path,
        body: Option<BodyKind>,
    ) -> Result<(), KeyFault> {
        complete_path(&key.child("file"), &mut self.file, folder)?;
        self.scale = self.scale.filter(|it| *it != 1.0);
        self.coordinates = (self.coordinates).filter(|it| it.0 != CoordinatePlane::Xy);
        if is_table(&self.file) {
            let reason = "give positions and areas or volumes in m";
            refuse(
                key,
                self,
                &["scale", "coordinates"],
                "a table of points",
                reason,
            )?;
        }
        match (body, holds_solid(&self.file)) {
            (Some(kind), _) => self.is_solid = kind == BodyKind::Solid,
            (None, Ok(is_solid)) => self.is_solid = is_solid,
            (None, Err(error)) => self.unread = Some(error.to_string()),
        }
        if self.is_solid {
            let reason = "only bodies in the plane have it";
            return refuse(
                key,
                self,
                &["thickness", "plane", "coordinates"],
                "a mesh of solid cells",
                reason,
            );
        }
        self.plane.get_or_insert_default();
        Ok(())
    }
}

/// Makes the path at a key absolute, and without `..` if the file exists, which is not checked here.
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
