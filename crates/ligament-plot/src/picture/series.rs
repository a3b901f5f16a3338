//! Series of pictures: one for each output, with the same colours, scale of the displacement and place of the body.

use std::path::{Path, PathBuf};

use ligament_output::results::StoredState;
use ligament_output::{check_file, is_stream, write_file};

use super::PictureError;
use super::body::common_scale_from;
use super::panel::Panel;
use super::request::{FieldRequest, Magnification, WIDTHS};
use super::select::Choice;
use super::source::{Output, Subject, outputs};
use super::strip::{LegendEntry, SeriesExtent};
use super::style::{Style, crack_legend};
use crate::drawing::Drawing;
use crate::drawing::frame::bounds;
use crate::drawing::gif::to_gif;

/// Largest number of pictures of an animation for which no steps are chosen.
const MOST_FRAMES: usize = 120;

/// Dots per inch of an animation.
const DPI: f64 = 150.0;

/// The pictures of a series. The bodies are read when they are drawn, so that memory holds one at a time.
pub(super) struct Series<'a> {
    subject: &'a Subject,
    outputs: Vec<Output<'a>>,
    style: Style<'a>,
    room: SeriesExtent,
    legend: Vec<LegendEntry>,
}

/// Draws a picture of each chosen output, and returns where they are: in files with the number of the step or the mode.
///
/// # Errors
///
/// If there are several results, no such outputs or fields, or a picture cannot be written.
pub fn draw_each(request: &FieldRequest) -> Result<Vec<PathBuf>, PictureError> {
    let subject = one_subject(request, "--step all")?;
    let file = request.target.file(|| subject.default_file(request))?;
    let series = Series::new(request, &subject)?;
    let mut written = Vec::new();
    let files = |output: &Output<'_>| numbered_file(&file, output.state());
    for output in &series.outputs {
        request.target.check(&files(output))?;
    }
    for output in &series.outputs {
        let numbered = files(output);
        let drawing = series.draw(output)?;
        let target = &request.target;
        written.push(target.write(numbered, &drawing, &series.style.title)?);
    }
    Ok(written)
}

/// An animation over the chosen outputs, or evenly spread ones of all.
///
/// Each is shown for `1 / per_second` s, the last for two seconds at least. Returns where the animation is.
///
/// # Errors
///
/// If there are several results, no such outputs or fields, the file does not end in `.gif` or cannot be written.
pub fn animate(
    request: &FieldRequest,
    file: &Path,
    per_second: f64,
) -> Result<PathBuf, PictureError> {
    let is_gif = (file.extension()).is_some_and(|it| it.eq_ignore_ascii_case("gif"));
    if !is_gif && !is_stream(file) {
        return Err(PictureError::Ending(file.to_path_buf()));
    }
    check_file(file, request.target.force)?;
    let subject = one_subject(request, "--animate")?;
    let evenly_spread = FieldRequest {
        choice: match &request.choice {
            Choice::Default => Choice::Strip(MOST_FRAMES),
            choice => choice.clone(),
        },
        ..request.clone()
    };
    let series = Series::new(&evenly_spread, &subject)?;
    let mut pictures = Vec::new();
    for output in &series.outputs {
        let dpi = request.target.dpi.unwrap_or(DPI);
        pictures.push(series.draw(output)?.pixels(dpi)?);
    }
    let hundredths = (100.0 / per_second).round().clamp(2.0, 6000.0);
    let bytes = to_gif(&pictures, hundredths as u16)?;
    write_file(file, &bytes, request.target.force)?;
    Ok(file.to_path_buf())
}

/// The results in the one folder of a series.
fn one_subject(request: &FieldRequest, option: &'static str) -> Result<Subject, PictureError> {
    match request.folders.as_slice() {
        [_] => Subject::open(request),
        folders => Err(PictureError::SeveralResults {
            option,
            n_results: folders.len(),
        }),
    }
}

/// The file with a number before its ending, with as many digits as in the names of outputs.
fn numbered_file(file: &Path, state: StoredState) -> PathBuf {
    let part =
        |part: Option<&std::ffi::OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    let (stem, ending) = (part(file.file_stem()), part(file.extension()));
    file.with_file_name(format!("{stem}-{}.{ending}", state.in_file_name()))
}

impl<'a> Series<'a> {
    /// The series of the chosen outputs.
    fn new(request: &'a FieldRequest, subject: &'a Subject) -> Result<Self, PictureError> {
        let outputs = outputs(&subject.sources, &request.choice)?;
        let (mut ranges, mut scales, mut unit) = (Vec::new(), Vec::new(), "-");
        for output in &outputs {
            let panel = output.panel(&subject.field)?;
            if let Some(field) = &panel.field {
                ranges.extend(field.range());
                unit = field.unit;
            }
            scales.extend(panel.body.drawn_scale());
        }
        let magnification = match request.magnification {
            Magnification::Times(factor) => Some(factor),
            Magnification::Auto if request.has_lines() => Some(0.0),
            Magnification::Auto if subject.has_modes => None,
            Magnification::Auto => Some(common_scale_from(scales.into_iter())),
        };
        let mut extents = Vec::new();
        let mut last: Option<Panel> = None;
        for output in &outputs {
            let panel = output.deformed(output.panel(&subject.field)?, magnification);
            extents.extend(panel.bounds().into_iter().flatten());
            last = Some(panel);
        }
        let shown = last.as_slice();
        let mut legend = crack_legend(&subject.sources, shown, false);
        legend.extend(Output::warning(&outputs));
        Ok(Self {
            style: Style::new(request, subject, magnification, (ranges.into_iter(), unit))?,
            room: SeriesExtent {
                extent: bounds(&extents),
                titles: outputs.iter().map(Output::title).collect(),
            },
            legend,
            subject,
            outputs,
        })
    }

    /// The picture of an output.
    fn draw(&self, output: &Output<'_>) -> Result<Drawing, PictureError> {
        let panel = output.panel(&self.subject.field)?;
        let panel = output.deformed(panel, self.style.magnification);
        let (legend, room) = (self.legend.clone(), Some(&self.room));
        Ok(self.style.drawing(&[panel], legend, room, WIDTHS[0]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_a_series_sort_by_their_numbers() {
        let of = |file: &str, step: usize| numbered_file(Path::new(file), step.into());
        assert_eq!(of("out/a.b.png", 7), Path::new("out/a.b-0007.png"));
        assert_eq!(of("crack.svg", 12345), Path::new("crack-12345.svg"));
    }
}
