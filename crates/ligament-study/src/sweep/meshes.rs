//! Meshes of a study's geometry, one for each combination of its numbers.

use std::collections::BTreeMap;
use std::path::Path;

use crate::meshing::gmsh_program::{MeshRequest, make_mesh};
use crate::meshing::{Coordinates, MeshingError};

/// Plan of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshPlan {
    /// Request to gmsh.
    pub request: MeshRequest,
    /// Text of the geometry and the numbers of the mesh.
    pub content: String,
}

impl MeshPlan {
    /// The mesh of a geometry with some numbers. The file's name depends on the content of the geometry, so that an existing mesh is up to
    /// date.
    pub(crate) fn new(
        geometry: &Path,
        numbers: Vec<(String, f64)>,
        folder: &Path,
        name: &str,
        content: &str,
    ) -> Self {
        let values = numbers
            .iter()
            .map(|(name, value)| format!(", {name} = {value:?}"));
        let content = format!("meshed from {content}{}", values.collect::<String>());
        let digest = twox_hash::XxHash64::oneshot(0, content.as_bytes());
        let file = format!("{name}~{:08x}.msh", digest as u32);
        let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
        Self {
            request: MeshRequest {
                geometry: geometry.to_owned(),
                out: folder.join(file),
                force: true,
                gmsh: "gmsh".into(),
                numbers,
                size: None,
                coordinates: Coordinates::default(),
            },
            content,
        }
    }
}

/// Makes the missing meshes of plans by the program `gmsh`, and reports each to `print`. Returns the reasons for meshes that could not be made,
/// by their files.
///
/// # Errors
///
/// If all meshes are affected: no geometry, no program, or a number that the geometry does not have.
pub(crate) fn make<'a>(
    plans: impl Iterator<Item = &'a MeshPlan>,
    gmsh: &Path,
    print: &mut dyn FnMut(&str),
) -> Result<BTreeMap<&'a Path, String>, MeshingError> {
    let mut failed = BTreeMap::new();
    for plan in plans {
        let out = plan.request.out.as_path();
        if !out.is_file()
            && !failed.contains_key(out)
            && let Some(reason) = make_one(plan, gmsh, print)?
        {
            failed.insert(out, reason);
        }
    }
    Ok(failed)
}

/// Makes a mesh; returns the reason if gmsh fails.
fn make_one(
    plan: &MeshPlan,
    gmsh: &Path,
    print: &mut dyn FnMut(&str),
) -> Result<Option<String>, MeshingError> {
    let request = MeshRequest {
        gmsh: gmsh.to_owned(),
        ..plan.request.clone()
    };
    match make_mesh(&request) {
        Ok(mesh) => {
            let name = request.out.display();
            print(&format!("meshed {name}: {} nodes", mesh.n_nodes()));
            Ok(None)
        }
        Err(error @ (MeshingError::Refused { .. } | MeshingError::Unusable { .. })) => {
            let lines: Vec<String> = error
                .to_string()
                .lines()
                .map(|line| line.trim().to_owned())
                .collect();
            Ok(Some(lines.join("; ")))
        }
        Err(error) => Err(error),
    }
}
