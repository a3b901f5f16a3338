//! Style that all bodies of a picture share: factor on the displacement, colours, legend.

use ligament_output::results::fields::STRESS_VIRIAL;

use super::PictureError;
use super::body::MODE_SHARE;
use super::colour_bar::ColourBar;
use super::colour_map::ColourMap;
use super::field::NONE;

use super::panel::{Panel, Scale};
use super::request::FieldRequest;
use super::source::{Source, Subject};
use super::strip::{LegendEntry, SeriesExtent, Strip};
use crate::drawing::{Drawing, PIXELS_PER_MM};

/// Style of all bodies of a picture, or of a series of pictures.
pub(super) struct Style<'a> {
    request: &'a FieldRequest,
    /// Factor on the displacement; `None`: the factor of a mode.
    pub(super) magnification: Option<f64>,
    /// Colours of the field, and the range of its values; None where no field is drawn.
    colours: Option<(Scale, [f64; 2])>,
    quantity: String,
    unit: &'static str,
    /// Title of the file.
    pub(super) title: String,
}

impl<'a> Style<'a> {
    /// The style of a subject for a magnification of displacements, the ranges of the field in its outputs, and the SI unit of the field.
    pub(super) fn new(
        request: &'a FieldRequest,
        subject: &Subject,
        magnification: Option<f64>,
        (ranges, unit): (impl Iterator<Item = [f64; 2]>, &'static str),
    ) -> Result<Self, PictureError> {
        let name = &subject.field;
        let quantity = if subject.has_modes {
            format!("{name} / its 99.5 % quantile")
        } else {
            name.clone()
        };
        let range = ranges.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        let colours = |range: [f64; 2]| {
            // Modes are relative to their largest values.
            let of_modes = subject
                .has_modes
                .then_some([range[0].signum().min(0.0), 1.0]);
            let requested = request.range.or(of_modes);
            let map = request.map.or_else(|| ColourMap::default_for(name));
            (Scale::new(range, requested, request.bands, map), range)
        };
        if name != NONE && range.is_none() {
            return Err(PictureError::NoValues(name.clone()));
        }
        Ok(Self {
            request,
            magnification,
            colours: range.map(colours),
            quantity,
            unit,
            title: format!("{name} of {}", subject.sources[0].label),
        })
    }

    /// The picture of bodies with a legend, beside each other; `width` (mm) is its default width.
    pub(super) fn drawing(
        &self,
        panels: &[Panel],
        legend: Vec<LegendEntry>,
        room: Option<&SeriesExtent>,
        width: f64,
    ) -> Drawing {
        let magnification = LegendEntry {
            colour: None,
            words: magnification_words(self.magnification),
        };
        let colours = self.colours.as_ref();
        let quantity = caption(&self.quantity);
        let bar = colours.map(|(scale, range)| ColourBar::new(scale, &quantity, self.unit, *range));
        let strip = Strip {
            scale: self.colours.as_ref().map(|it| &it.0),
            bar,
            legend: [vec![magnification], legend].concat(),
            window: self.request.window,
            columns: self.request.columns,
            room,
            has_axes: self.request.has_lines() && panels.iter().all(|it| it.solid.is_none()),
            panels,
        };
        strip.draw(self.request.target.width.unwrap_or(width) * PIXELS_PER_MM)
    }
}

/// The name of a field below its colour bar. Virial stresses at single points of a mesh are not the stresses of the continuum: the name says
/// that only means are right.
fn caption(quantity: &str) -> String {
    match quantity.starts_with(STRESS_VIRIAL.name) {
        true => format!("{quantity}, right in the mean"),
        false => quantity.to_owned(),
    }
}

pub(super) fn magnification_words(magnification: Option<f64>) -> String {
    match magnification {
        Some(0.0) => "undeformed".to_owned(),
        Some(factor) => format!("deformation × {factor}"),
        None => format!("largest displacement drawn as {MODE_SHARE} of the body"),
    }
}

/// Legend entries for the failure criteria of broken bonds and for the lines over the bodies, each once, with numbers of bonds and lengths if
/// requested.
pub(super) fn crack_legend(
    sources: &[Source],
    panels: &[Panel],
    is_numbered: bool,
) -> Vec<LegendEntry> {
    let mut entries: Vec<LegendEntry> = Vec::new();
    let kinds = sources
        .iter()
        .flat_map(|it| &it.crack)
        .flat_map(|it| &it.kinds);
    for kind in kinds {
        let is_drawn = panels.iter().flat_map(|it| &it.broken);
        let count: usize = is_drawn
            .filter(|it| it.0 == kind.colour)
            .map(|it| it.1.len())
            .sum();
        let words = match is_numbered {
            true => format!("{} ({count})", kind.name),
            false => kind.name.clone(),
        };
        if count > 0 && !entries.iter().any(|it| it.words == words) {
            entries.push(LegendEntry {
                colour: Some(kind.colour),
                words,
            });
        }
    }
    for lines in panels.iter().flat_map(|panel| &panel.lines) {
        let detail = if is_numbered { &lines.detail } else { "" };
        let words = format!("{}{detail}", lines.name);
        if !lines.polylines.is_empty() && !entries.iter().any(|it| it.words == words) {
            entries.push(LegendEntry {
                colour: Some(lines.colour),
                words,
            });
        }
    }
    entries
}
