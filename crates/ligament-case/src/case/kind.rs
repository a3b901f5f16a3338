//! Check of a case against the kind of its body, in the plane or a solid, before the body is built.

use super::fault::{CaseError, Fault, KeyFault};
use super::key_path::KeyPath;
use super::keys::check_dimensions;
use super::mesh_section::MeshSection;
use super::sections::Case;
use super::source::Source;
use crate::mesh_file::{MeshFileError, read_any_mesh};
use crate::point_table::Tables;

impl Case {
    /// Checks the case on a substitute for its body. For a case that would fit a body of the other kind, the error states the kind of the
    /// mesh, or that it cannot be read.
    pub(super) fn check_kind(&self, source: &Source) -> Result<(), CaseError> {
        let is_solid = self.is_solid();
        let Err(error) = self.check_as(source, is_solid) else {
            return Ok(());
        };
        let Some(mesh) = &self.mesh else {
            return Err(error);
        };
        if source.body.is_some() || self.check_as(source, !is_solid).is_err() {
            return Err(error);
        }
        let read = read_any_mesh(&mesh.file, mesh.coordinate_plane());
        Err(match (&mesh.unread, read) {
            (Some(reason), _) => {
                let reason = format!("{reason}; paths are relative to the folder of the case file");
                unreadable_mesh(source, "read", mesh, &reason)
            }
            (None, Err(MeshFileError::Parse { source: reason, .. })) => {
                unreadable_mesh(source, "use", mesh, &reason.to_string())
            }
            (None, _) => other_kind_error(error, mesh),
        })
    }

    /// Checks the case for a solid or for a body in the plane.
    fn check_as(&self, source: &Source, is_solid: bool) -> Result<(), CaseError> {
        let body = self.substitute_body(is_solid);
        let setup = body.and_then(|it| self.setup_on(it, Tables::Unread));
        let setup = setup.and_then(|it| check_dimensions(&source.document, it));
        let setup = setup.map_err(|fault| source.error(fault))?;
        (setup.check()).map_err(|error| self.error_at_key(source, error))
    }
}

/// The error of an unreadable mesh that would determine the kind of the case.
fn unreadable_mesh(source: &Source, what: &str, mesh: &MeshSection, reason: &str) -> CaseError {
    let file = mesh.file.display();
    let reason = format!("cannot {what} the mesh {file}: {reason}");
    let key = KeyPath::default().child("mesh").child("file");
    source.error(KeyFault::new(key, reason))
}

/// The error of a case that fits the other kind of body, with the kind of its mesh.
fn other_kind_error(error: CaseError, mesh: &MeshSection) -> CaseError {
    let CaseError::Key {
        location,
        key,
        fault,
    } = error
    else {
        return error;
    };
    let file = mesh.file.file_name().unwrap_or(mesh.file.as_os_str());
    let file = file.to_string_lossy();
    let advice = match mesh.is_solid {
        true => format!(
            "{file} has solid cells, and all else fits a body in the plane: if that is meant, mesh its surface alone (`gmsh -2`)"
        ),
        false => format!(
            "{file} has no solid cells, and all else fits a solid: if that is meant, mesh its volume (`gmsh -3`) and let a physical \
             volume hold it"
        ),
    };
    CaseError::Key {
        location,
        key,
        fault: Box::new(Fault::Other(format!("{fault}; {advice}"))),
    }
}
