//! The pictures of a run at its end.

use std::path::{Path, PathBuf};

use ligament_output::results::outputs::{OutputKind, kind_of};

use super::PictureError;
use super::curve::{CurveRequest, draw_curves};
use super::fields::draw_fields;
use super::request::FieldRequest;
use super::target::Target;
use crate::stored_loading::resolved_case;

/// Whether the case of a run has `output.picture = true`, for pictures at its end.
pub fn asks_for_pictures(folder: &Path) -> bool {
    let case = resolved_case(folder).ok();
    let requested = |case: toml::Table| case.get("output")?.get("picture")?.as_bool();
    case.and_then(requested).unwrap_or(false)
}

/// Draws the last state of a run, or its first modes, as PNG into its folder; if the mesh was refined, also the horizons; if the run breaks bonds, also the curve of force over
/// displacement, in a motion over time. Returns the paths of the pictures.
///
/// # Errors
///
/// If there are no such results, or a picture cannot be written.
pub fn draw_run(folder: &Path) -> Result<Vec<PathBuf>, PictureError> {
    let mut drawn = vec![draw_fields(&FieldRequest::default_for(
        folder.to_path_buf(),
    ))?];
    let case = resolved_case(folder)?;
    if case.contains_key("refine") {
        drawn.push(draw_fields(&FieldRequest {
            field: Some("horizon".to_owned()),
            ..FieldRequest::default_for(folder.to_path_buf())
        })?);
    }
    let has_curve = case.contains_key("fracture") || case.contains_key("motion");
    if has_curve && kind_of(folder) == OutputKind::Steps {
        drawn.push(draw_curves(&CurveRequest {
            folders: vec![folder.to_path_buf()],
            labels: Vec::new(),
            x: None,
            y: vec!["reaction".to_owned()],
            target: Target::default(),
        })?);
    }
    Ok(drawn)
}
