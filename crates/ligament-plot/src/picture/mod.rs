//! `ligament plot`: pictures of the results of runs, as SVG or PNG.
//!
//! Outputs are chosen ([`select`]), read (`body`, `field`, `crack`), moved by the displacement, cut into bands of colour
//! (`levels`, `contour`, `joined`) and arranged (`strip`) in one SVG document (`svg`), from which a PNG is made
//! ([`plots::png`](crate::plots::png)). Force-displacement curves are plots ([`curve`]).

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
mod panel;
pub mod select;
mod strip;
mod svg;
mod units;

use std::path::{Path, PathBuf};

use ligament_output::replace_file;
use ligament_output::results::outputs::OutputKind;
use thiserror::Error;

pub use fields::{FieldRequest, Magnification, draw_fields};

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
    /// There is no output of this number.
    #[error(
        "{} has no output of {} {number}; there are {}{}",
        path.display(),
        match kind { OutputKind::Steps => "step", OutputKind::Modes => "mode" },
        list(known),
        match kind {
            OutputKind::Steps => " (run it again with --set output.fields_every=1 for all)",
            OutputKind::Modes => "",
        }
    )]
    NoSuchOutput {
        /// The folder.
        path: PathBuf,
        /// Kind of the outputs in the folder.
        kind: OutputKind,
        /// The number.
        number: usize,
        /// Numbers that there are.
        known: Vec<usize>,
    },
    /// There is no history to choose or to draw from.
    #[error("{} has no history.csv with the outputs, so none can be chosen by the displacement", path.display())]
    NoHistory {
        /// The folder.
        path: PathBuf,
    },
    /// Modes have no curves and no cracks.
    #[error("{} has natural modes, and so no {what}; leave out {option}", path.display())]
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
    /// No value to draw.
    #[error("`{name}` has no finite value in these outputs")]
    NoValues {
        /// The field.
        name: String,
    },
    /// No column has the name.
    #[error("{} has no column `{name}`{hint}", path.display())]
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
    /// A file that is neither PNG nor SVG.
    #[error("{}: a picture ends in .png or .svg", path.display())]
    Format {
        /// The file.
        path: PathBuf,
    },
    /// A plot cannot be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// A PNG could not be made of the picture.
    #[error(transparent)]
    Png(#[from] PngError),
}

fn list(numbers: &[usize]) -> String {
    const MOST: usize = 24;
    let words: Vec<String> = numbers.iter().map(usize::to_string).collect();
    match words.as_slice() {
        [first @ .., last] if words.len() > MOST => {
            format!("{}, ..., {last}", first[..MOST - 2].join(", "))
        }
        all => all.join(", "),
    }
}

/// The formats of pictures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Png,
    Svg,
}

impl Format {
    fn from_path(path: &Path) -> Result<Self, PictureError> {
        let extension = path
            .extension()
            .and_then(|it| it.to_str())
            .map(str::to_lowercase);
        match extension.as_deref() {
            Some("png") => Ok(Self::Png),
            Some("svg") => Ok(Self::Svg),
            _ => Err(PictureError::Format {
                path: path.to_path_buf(),
            }),
        }
    }
}

impl Target {
    /// The file and its format; `default` where none is given.
    fn file(&self, default: impl FnOnce() -> PathBuf) -> Result<(PathBuf, Format), PictureError> {
        let path = self.out.clone().unwrap_or_else(default);
        let format = Format::from_path(&path)?;
        Ok((path, format))
    }

    fn write(&self, (path, format): (PathBuf, Format), svg: &str) -> Result<PathBuf, PictureError> {
        match format {
            Format::Svg => replace_file(&path, svg.as_bytes())?,
            Format::Png => replace_file(&path, &to_png(svg, self.dpi)?)?,
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
