//! Pictures of fields, cracks and modes on deformed bodies.

use std::path::PathBuf;

use super::PictureError;
use super::body::common_scale;
use super::field::Field;
use super::panel::Panel;
use super::request::{FieldRequest, Magnification, WIDTHS};
use super::source::{Output, Subject, outputs};
use super::style::{Style, crack_legend};
use crate::drawing::Drawing;

/// Draws the picture and returns where it is.
///
/// # Errors
///
/// If there are no such results, outputs or fields, or the picture cannot be written.
pub fn draw_fields(request: &FieldRequest) -> Result<PathBuf, PictureError> {
    let subject = Subject::open(request)?;
    let file = request.target.file(|| subject.default_file(request))?;
    request.target.check(&file)?;
    let (drawing, title) = drawing_with_title(request, &subject)?;
    request.target.write(file, &drawing, &title)
}

/// The picture with its title; no file is written.
///
/// # Errors
///
/// If there are no such results, outputs or fields.
pub fn picture_of_fields(request: &FieldRequest) -> Result<(Drawing, String), PictureError> {
    drawing_with_title(request, &Subject::open(request)?)
}

fn drawing_with_title(
    request: &FieldRequest,
    subject: &Subject,
) -> Result<(Drawing, String), PictureError> {
    let outputs = outputs(&subject.sources, &request.choice)?;
    let mut panels = Vec::new();
    for output in &outputs {
        panels.push(output.panel(&subject.field)?);
    }
    let magnification = match request.magnification {
        Magnification::Times(factor) => Some(factor),
        Magnification::Auto if request.has_lines() => Some(0.0),
        Magnification::Auto if subject.has_modes => None,
        Magnification::Auto => Some(common_scale(panels.iter().map(|it| &it.body))),
    };
    let deformed = outputs.iter().zip(panels);
    let panels: Vec<Panel> = deformed
        .map(|(output, panel)| output.deformed(panel, magnification))
        .collect();

    let fields = panels.iter().filter_map(|panel| panel.field.as_ref());
    let unit = panels[0].field.as_ref().map_or("-", |field| field.unit);
    let ranges = fields.filter_map(Field::range);
    let style = Style::new(request, subject, magnification, (ranges, unit))?;
    let mut legend = crack_legend(&subject.sources, &panels, panels.len() == 1);
    legend.extend(Output::warning(&outputs));
    let width = WIDTHS[usize::from(panels.len() > 1)];
    let drawing = style.drawing(&panels, legend, None, width);
    Ok((drawing, style.title))
}
