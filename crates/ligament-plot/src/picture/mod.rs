//! `ligament plot`: pictures of the results of runs, as SVG, PNG or PDF, and animations.
//!
//! Outputs are chosen ([`select`]), read (`body`, `field`, `crack`), moved by the displacement, cut into bands of colour
//! (`levels`, `contour`, `merged_corners`) and arranged (`strip`) in one [`drawing`](crate::drawing), several of them over the steps (`series`).
//! Force-displacement curves are plots ([`curve`]), crack paths of several runs lie over one another (`crack_paths`). [`maps`] draws bodies
//! that are in memory.

mod body;
mod colour_bar;
pub mod colour_map;
mod columns;
mod contour;
mod crack;
mod crack_paths;
pub mod curve;
mod field;
mod fields;
mod isosurface;
mod levels;
mod lines;
pub mod maps;
mod merged_corners;
mod panel;
pub mod profile;
mod request;
mod run_pictures;
pub mod select;
mod series;
mod solid;
mod source;
mod strip;
mod style;
mod target;
pub mod units;

use std::path::PathBuf;

use ligament_output::remedy::Remedy;
use ligament_output::results::StoredState;
use ligament_output::results::steps::{StepError, listed};
use thiserror::Error;

pub use crack_paths::{PathPanel, draw_crack_paths, drawing_of_crack_paths};
pub use fields::{draw_fields, picture_of_fields};
pub use isosurface::{Isosurface, IsosurfaceRequest, write_isosurfaces};
pub use lines::stored_precracks;
pub use request::{CrackDrawing, FieldRequest, Magnification, SolidRequest};
pub use run_pictures::{asks_for_pictures, draw_run};
pub use series::{animate, draw_each};
pub use solid::{Section, Upward, View, draw_groups};
pub use target::{Format, Target};

use crate::drawing::gif::GifError;
use crate::drawing::png::PngError;
use crate::plots::PlotError;

/// Reason why there is no picture.
#[derive(Debug, Error)]
pub enum PictureError {
    /// Results cannot be read, or the picture cannot be written.
    #[error(transparent)]
    Results(#[from] ligament_output::Error),
    /// No field has the name.
    #[error(
        "there is no field `{name}`;{}{} there are {}",
        requested_by.map(|it| format!(" write stress = [\"{it}\"] under [output] in the case and run it anew;")).unwrap_or_default(),
        suggestion.as_ref().map(|it| format!(" did you mean `{it}`?")).unwrap_or_default(),
        known.join(", ")
    )]
    UnknownField {
        /// Name of a field that does not exist.
        name: String,
        /// Word of `output.stress` with which results have the field.
        requested_by: Option<&'static str>,
        /// The nearest name.
        suggestion: Option<String>,
        /// Names of all fields.
        known: Vec<String>,
    },
    /// A field with several components was requested without a component.
    #[error("`{field}` has several components; name one of {}", choices.join(", "))]
    NoComponent {
        /// Field that needs a component.
        field: String,
        /// Names that can be drawn.
        choices: Vec<String>,
    },
    /// A requested step does not exist.
    #[error(transparent)]
    Step(#[from] StepError),
    /// There is no mode of this number.
    #[error("{path} has no output of mode {mode}; there are {}", listed(known))]
    NoSuchMode {
        /// Folder of the modes.
        path: PathBuf,
        /// Number of a mode that does not exist.
        mode: StoredState,
        /// Numbers of the existing modes.
        known: Vec<StoredState>,
    },
    /// Lines are drawn on the body without its displacement.
    #[error(
        "{0} times the displacement moves the body away from its lines, which are drawn where it is without load"
    )]
    MovedLines(f64, #[source] Remedy),
    /// A picture for each step was requested for several results.
    #[error("{option} draws one result at a time, and there are {n_results}; name one of them")]
    SeveralResults {
        /// The option that requests it.
        option: &'static str,
        /// Number of given results.
        n_results: usize,
    },
    /// The body is a solid, and the kind of picture shows bodies in the plane.
    #[error(
        "{0} shows bodies in the plane, and this one is a solid; draw it, or a section of it, by `ligament plot`"
    )]
    Solid(&'static str),
    /// A view, section or level is requested for a body in the plane.
    #[error(
        "{0} has a body in the plane, and only a solid has views, sections and surfaces of a level"
    )]
    Plane(PathBuf, #[source] Remedy),
    /// A level is requested without a field.
    #[error("the surface of a level needs a field of the points")]
    NoLevel(#[source] Remedy),
    /// Lines are requested over a solid.
    #[error("lines and boxes are drawn over bodies in the plane, and this one is a solid")]
    LinesOfSolid(#[source] Remedy),
    /// There is no history to choose or to draw from in the folder.
    #[error("{0} has no history.csv with the outputs, so none can be chosen by the displacement")]
    NoHistory(PathBuf),
    /// Modes have no curves and no cracks.
    #[error("{path} has natural modes, and so no {what}")]
    Modes {
        /// Folder of the modes.
        path: PathBuf,
        /// The requested drawing.
        what: &'static str,
        /// Advice: the request without it.
        #[source]
        remedy: Remedy,
    },
    /// The number of labels differs from the number of results.
    #[error(
        "{n_labels} labels for {n_results} results; give one label for each result, in the same order"
    )]
    Labels {
        /// Number of given labels.
        n_labels: usize,
        /// Number of given results.
        n_results: usize,
    },
    /// The field has no value to draw.
    #[error("`{0}` has no finite value in these outputs")]
    NoValues(String),
    /// No column has the name.
    #[error("{path} has no column `{name}`{hint}")]
    UnknownColumn {
        /// Table without the column.
        path: PathBuf,
        /// Name of a column that does not exist.
        name: String,
        /// The nearest name, and all.
        hint: String,
    },
    /// Curves in different units.
    #[error(
        "there are values of {axis} in different units ({first} and {other}); draw them separately"
    )]
    Units {
        /// Column along the axis.
        axis: String,
        /// Unit of the first curve.
        first: String,
        /// Unit of another curve.
        other: String,
    },
    /// The file name has no ending of a format of pictures.
    #[error(
        "{0}: a picture ends in .png, .svg or .pdf, and an animation, which --animate makes, in .gif"
    )]
    Ending(PathBuf),
    /// The file name ends like another format than the requested one.
    #[error("{path} does not end in .{format}; leave out --format, or name another file")]
    OtherEnding {
        /// File of the picture.
        path: PathBuf,
        /// Ending of the requested format.
        format: &'static str,
    },
    /// A plot cannot be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// A PNG could not be made of the picture.
    #[error(transparent)]
    Png(#[from] PngError),
    /// An animation could not be made of the pictures.
    #[error(transparent)]
    Gif(#[from] GifError),
}

/// Labels of results in a picture: the labels given, or the names of the folders.
fn labels_of(folders: &[PathBuf], labels: &[String]) -> Result<Vec<String>, PictureError> {
    let name = |folder: &PathBuf| {
        let whole = folder.canonicalize().unwrap_or_else(|_| folder.clone());
        let name = whole.file_name().unwrap_or(whole.as_os_str());
        name.to_string_lossy().into_owned()
    };
    match labels.len() {
        0 => Ok(folders.iter().map(name).collect()),
        count if count == folders.len() => Ok(labels.to_vec()),
        n_labels => Err(PictureError::Labels {
            n_labels,
            n_results: folders.len(),
        }),
    }
}
