//! The file that a picture is written to.

use std::path::{Path, PathBuf};

use ligament_output::{check_file, write_file};

use super::PictureError;
use crate::drawing::Drawing;

/// Size and file of a picture.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Target {
    /// File to write; `None`: a file beside the results.
    pub out: Option<PathBuf>,
    /// Whether an existing file may be replaced; the program's own picture in a folder of results always is.
    pub force: bool,
    /// Kind of the file; `None`: by the ending of the file, PNG where no file is given.
    pub format: Option<Format>,
    /// Width, mm; `None`: the width of a column or of a page.
    pub width: Option<f64>,
    /// Dots per inch of a PNG or an animation; `None`: 300 for a picture, 150 for an animation.
    pub dpi: Option<f64>,
}

/// The kinds of files that pictures are written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Dots, for all programs that show pictures.
    Png,
    /// Paths and text, which can be edited.
    Svg,
    /// A page of its size with paths and text, for LaTeX and printers.
    Pdf,
}

/// Dots per inch of a picture.
const DPI: f64 = 300.0;

impl Format {
    /// All formats of pictures.
    pub const ALL: [Self; 3] = [Self::Png, Self::Svg, Self::Pdf];

    /// The ending of the files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Svg => "svg",
            Self::Pdf => "pdf",
        }
    }

    /// The kind of a file by its ending.
    fn named_by(path: &Path) -> Result<Self, PictureError> {
        let extension = path.extension().and_then(|it| it.to_str());
        let extension = extension.map(str::to_lowercase);
        let mut all = Self::ALL.into_iter();
        let format = all.find(|format| extension.as_deref() == Some(format.word()));
        format.ok_or_else(|| PictureError::Ending(path.to_path_buf()))
    }
}

impl Target {
    /// The file; `default` with the ending of its kind where none is given.
    pub(super) fn file(&self, default: impl FnOnce() -> PathBuf) -> Result<PathBuf, PictureError> {
        let Some(path) = self.out.clone() else {
            let format = self.format.unwrap_or(Format::Png);
            return Ok(default().with_extension(format.word()));
        };
        let named = self.format_of(&path)?;
        match self.format {
            Some(format) if format != named => Err(PictureError::OtherEnding {
                path,
                format: format.word(),
            }),
            _ => Ok(path),
        }
    }

    /// The kind of a file by the ending of its name; for a name without ending, such as a pipe, the requested kind.
    fn format_of(&self, path: &Path) -> Result<Format, PictureError> {
        match self.format {
            Some(format) if path.extension().is_none() => Ok(format),
            _ => Format::named_by(path),
        }
    }

    /// Whether an existing file may be replaced.
    fn may_replace(&self) -> bool {
        self.force || self.out.is_none()
    }

    /// Fails where a picture could not be written, before it is drawn.
    pub(super) fn check(&self, path: &Path) -> Result<(), PictureError> {
        Ok(check_file(path, self.may_replace())?)
    }

    /// Writes the picture with a title as the kind of file that its name ends in.
    pub(super) fn write(
        &self,
        path: PathBuf,
        drawing: &Drawing,
        title: &str,
    ) -> Result<PathBuf, PictureError> {
        let bytes = match self.format_of(&path)? {
            Format::Png => drawing.to_png(self.dpi.unwrap_or(DPI))?,
            Format::Svg => drawing.to_svg(title).into_bytes(),
            Format::Pdf => drawing.to_pdf(title),
        };
        write_file(&path, &bytes, self.may_replace())?;
        Ok(path)
    }
}
