//! `ligament plot`: pictures of the results of runs, as SVG or PNG.
//!
//! Outputs are chosen ([`select`]), read (`body`, `field`, `crack`), moved by the displacement, cut into bands of colour
//! (`levels`, `contour`, `joined`) and arranged (`strip`) in one SVG document (`svg`), from which a PNG is made
//! ([`plots::png`](crate::plots::png)). Force-displacement curves are plots ([`curve`]). [`maps`] draws bodies that are in
//! memory.

mod body;
mod colour_bar;
pub mod colour_map;
mod contour;
mod crack;
pub mod curve;
mod field;
mod fields;
mod joined;
mod levels;
pub mod maps;
mod panel;
pub mod profile;
mod request;
pub mod select;
mod series;
mod source;
mod strip;
mod style;
mod svg;
mod units;

use std::path::{Path, PathBuf};

use ligament_output::replace_file;
use ligament_output::results::steps::{StepError, listed};
use thiserror::Error;

pub use fields::draw_fields;
pub use request::{FieldRequest, Magnification};
pub use series::draw_each;

use crate::plots::PlotError;
use crate::plots::png::{PngError, to_png};

/// Size and file of a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    /// File to write, `.png` or `.svg`; None: one beside the results.
    pub out: Option<PathBuf>,
    /// Width, mm; None: that of a column or of a page.
    pub width: Option<f64>,
    /// Dots per inch of a PNG.
    pub dpi: f64,
}

/// Why there is no picture.
#[derive(Debug, Error)]
pub enum PictureError {
    /// Results cannot be read, or the picture cannot be written.
    #[error(transparent)]
    Results(#[from] ligament_output::Error),
    /// No field has the name.
    #[error(
        "there is no field `{name}`;{} there are {}",
        suggestion.as_ref().map(|it| format!(" did you mean `{it}`?")).unwrap_or_default(),
        known.join(", ")
    )]
    UnknownField {
        /// The name.
        name: String,
        /// The nearest name.
        suggestion: Option<String>,
        /// All names.
        known: Vec<String>,
    },
    /// A field of several numbers without the one to draw.
    #[error("`{field}` has several components; name one of {}", choices.join(", "))]
    NoComponent {
        /// The field.
        field: String,
        /// Names that can be drawn.
        choices: Vec<String>,
    },
    /// A step that was asked for is not there.
    #[error(transparent)]
    Step(#[from] StepError),
    /// There is no mode of this number.
    #[error("{path} has no output of mode {number}; there are {}", listed(known))]
    NoSuchMode {
        /// The folder.
        path: PathBuf,
        /// The number.
        number: usize,
        /// Numbers that there are.
        known: Vec<usize>,
    },
    /// A picture for each step is one of each result alone.
    #[error("{option} draws one result at a time, and there are {n_results}; name one of them")]
    SeveralResults {
        /// The option that asked for it.
        option: &'static str,
        /// Results given.
        n_results: usize,
    },
    /// There is no history to choose or to draw from in the folder.
    #[error("{0} has no history.csv with the outputs, so none can be chosen by the displacement")]
    NoHistory(PathBuf),
    /// Modes have no curves and no cracks.
    #[error("{path} has natural modes, and so no {what}; leave out {option}")]
    Modes {
        /// The folder.
        path: PathBuf,
        /// What was asked for.
        what: &'static str,
        /// The option that asked for it.
        option: &'static str,
    },
    /// There are as many labels as results, or none.
    #[error("{n_labels} labels for {n_results} results; give one for each, in their order")]
    Labels {
        /// Labels given.
        n_labels: usize,
        /// Results given.
        n_results: usize,
    },
    /// The field has no value to draw.
    #[error("`{0}` has no finite value in these outputs")]
    NoValues(String),
    /// No column has the name.
    #[error("{path} has no column `{name}`{hint}")]
    UnknownColumn {
        /// The table.
        path: PathBuf,
        /// The name.
        name: String,
        /// The nearest name, and all.
        hint: String,
    },
    /// Curves in different units.
    #[error("the results have {axis} in different units ({first} and {other}); draw them apart")]
    Units {
        /// The column.
        axis: String,
        /// Unit of the first.
        first: String,
        /// Unit of another.
        other: String,
    },
    /// The file is neither PNG nor SVG.
    #[error("{0}: a picture ends in .png or .svg")]
    Format(PathBuf),
    /// A plot cannot be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// A PNG could not be made of the picture.
    #[error(transparent)]
    Png(#[from] PngError),
}

/// Whether a file is to be a PNG, and not an SVG.
fn is_png(path: &Path) -> Result<bool, PictureError> {
    let extension = path.extension().and_then(|it| it.to_str());
    match extension.map(str::to_lowercase).as_deref() {
        Some("png") => Ok(true),
        Some("svg") => Ok(false),
        _ => Err(PictureError::Format(path.to_path_buf())),
    }
}

impl Target {
    /// The file; `default` where none is given.
    fn file(&self, default: impl FnOnce() -> PathBuf) -> Result<PathBuf, PictureError> {
        let path = self.out.clone().unwrap_or_else(default);
        is_png(&path)?;
        Ok(path)
    }

    fn write(&self, path: PathBuf, svg: &str) -> Result<PathBuf, PictureError> {
        if is_png(&path)? {
            replace_file(&path, &to_png(svg, self.dpi)?)?;
        } else {
            replace_file(&path, svg.as_bytes())?;
        }
        Ok(path)
    }
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
