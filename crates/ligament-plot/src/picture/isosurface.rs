//! Surfaces in solids on which a field equals a level, as files beside the results.

use std::path::PathBuf;

use ligament_output::pvd::Collection;
use ligament_output::remedy::Remedy;
use ligament_output::results::outputs::Outputs;
use ligament_output::results::solid_body::{SolidBody, is_solid};
use ligament_output::results::steps::StepChoice;
use ligament_output::results::{StoredState, write_level_set};
use ligament_output::vtu::read::VtuFile;

use super::PictureError;
use super::field::Field;

/// Request for surfaces of a field.
#[derive(Debug, Clone, PartialEq)]
pub struct IsosurfaceRequest {
    /// The folder of the results.
    pub folder: PathBuf,
    /// Field with its component, named as in pictures.
    pub field: String,
    /// Value of the field on the surface, SI units.
    pub level: f64,
    /// The steps, or modes: one is written as `iso.vtu`, several or all as `iso_NNNN.vtu` and `iso.pvd`.
    pub step: StepChoice,
}

/// A surface that was written.
#[derive(Debug, Clone, PartialEq)]
pub struct Isosurface {
    /// State, or mode, of the surface.
    pub state: StoredState,
    /// Area in the body without load, m^2.
    pub area: f64,
    /// Number of triangles; without any there is no file.
    pub triangles: usize,
    /// File of the surface.
    pub path: PathBuf,
}

/// Writes the surfaces of the steps.
///
/// # Errors
///
/// If there is no such step or field, the body is not a solid, or a file cannot be used.
pub fn write_isosurfaces(request: &IsosurfaceRequest) -> Result<Vec<Isosurface>, PictureError> {
    let folder = &request.folder;
    let outputs = Outputs::list(folder)?;
    let steps = request.step.steps(folder, &outputs.states())?;
    let is_series = request.step == StepChoice::All || steps.len() > 1;
    let mut collection = match is_series {
        true => Some(Collection::new(folder.join("iso.pvd"))),
        false => None,
    };
    let mut written = Vec::new();
    for state in steps.iter().map(|it| it.state) {
        let name = match is_series {
            true => format!("iso_{}.vtu", state.in_file_name()),
            false => "iso.vtu".to_owned(),
        };
        let Some(fields) = outputs.files.get(&state) else {
            continue;
        };
        let file = VtuFile::open(fields)?;
        let surface = write(request, (state, &file), folder.join(&name))?;
        if let Some(collection) = collection.as_mut().filter(|_| surface.triangles > 0) {
            collection.append(file.time()?.unwrap_or(state.step as f64), name)?;
        }
        written.push(surface);
    }
    Ok(written)
}

fn write(
    request: &IsosurfaceRequest,
    (state, file): (StoredState, &VtuFile),
    path: PathBuf,
) -> Result<Isosurface, PictureError> {
    if !is_solid(file)? {
        return Err(PictureError::Plane(
            request.folder.clone(),
            Remedy::OmitOption("iso"),
        ));
    }
    let body = SolidBody::read(file)?;
    let field = Field::read(file, &request.field)?;
    if field.values.len() != body.grid.positions.len() {
        return Err(PictureError::NoLevel(Remedy::Give {
            option: "field",
            value: "NAME",
        }));
    }
    let of = (file, &body);
    let (area, triangles) = write_level_set(&path, of, &field.values, request.level)?;
    Ok(Isosurface {
        state,
        area,
        triangles,
        path,
    })
}
