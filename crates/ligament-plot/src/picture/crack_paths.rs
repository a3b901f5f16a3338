//! The crack paths of several runs over one another, on the body of the first.

use std::path::PathBuf;

use ligament_output::FieldLocation;
use ligament_output::remedy::Remedy;
use ligament_output::results::cracks::StoredCracks;
use ligament_output::results::outputs::{OutputKind, Outputs};
use ligament_output::results::solid_body::is_solid;
use ligament_output::vtu::read::VtuFile;

use super::body::Body;
use super::colour_map::ColourMap;
use super::lines::Lines;
use super::panel::Panel;
use super::request::WIDTHS;
use super::strip::{LegendEntry, Strip};
use super::style::crack_legend;
use super::{PictureError, Target, labels_of};
use crate::drawing::{Drawing, PIXELS_PER_MM, Rgb};
use crate::plots::Colour;

/// Crack paths of runs on one body.
#[derive(Debug, Clone, PartialEq)]
pub struct PathPanel {
    /// Title above the body.
    pub title: String,
    /// Labels of the runs with the folders of their results; one or more.
    pub runs: Vec<(String, PathBuf)>,
}

/// The drawing of one or several panels, of a width in mm, with a title in the legend. Runs with the same label have the same colour.
///
/// # Errors
///
/// If results cannot be read, or a body is a solid.
pub fn drawing_of_crack_paths(
    title: &str,
    panels: &[PathPanel],
    width: f64,
) -> Result<Drawing, PictureError> {
    let runs = panels.iter().flat_map(|panel| &panel.runs);
    let mut labels: Vec<&str> = Vec::new();
    for (label, _) in runs {
        if !labels.contains(&label.as_str()) {
            labels.push(label);
        }
    }
    let colours = colours(labels.len());
    let colour = |label: &str| {
        let place = labels.iter().position(|it| *it == label);
        colours[place.unwrap_or(0)]
    };
    let drawn = panels.iter().map(|panel| drawn_panel(panel, &colour));
    let drawn: Vec<Panel> = drawn.collect::<Result<_, _>>()?;
    let heading = LegendEntry {
        colour: None,
        words: format!("{title}: crack paths at the end"),
    };
    let strip = Strip {
        scale: None,
        bar: None,
        legend: [vec![heading], crack_legend(&[], &drawn, false)].concat(),
        window: None,
        columns: None,
        room: None,
        has_axes: true,
        panels: &drawn,
    };
    Ok(strip.draw(width * PIXELS_PER_MM))
}

/// Draws the crack paths of results in one panel and returns where the picture is.
///
/// # Errors
///
/// If results cannot be read, a body is a solid, or the picture cannot be written.
pub fn draw_crack_paths(
    folders: &[PathBuf],
    labels: &[String],
    target: &Target,
) -> Result<PathBuf, PictureError> {
    let labels = labels_of(folders, labels)?;
    let file = target.file(|| PathBuf::from("crack-paths.png"))?;
    target.check(&file)?;
    let panel = PathPanel {
        title: String::new(),
        runs: labels.into_iter().zip(folders.iter().cloned()).collect(),
    };
    let title = format!("{} runs", panel.runs.len());
    let width = target.width.unwrap_or(WIDTHS[1]);
    let drawing = drawing_of_crack_paths(&title, &[panel], width)?;
    target.write(file, &drawing, &title)
}

/// Colours that can be told apart, or more of them in order from dark to bright.
fn colours(count: usize) -> Vec<Rgb> {
    match count {
        0..=6 => Colour::CYCLE.map(Colour::rgb).to_vec(),
        _ => ColourMap::Viridis.bands(count),
    }
}

/// The body of the first run with the pre-cracks of its case and the cracks of all.
fn drawn_panel(panel: &PathPanel, colour: &dyn Fn(&str) -> Rgb) -> Result<Panel, PictureError> {
    let mut body = None;
    let mut lines = Vec::new();
    for (label, folder) in &panel.runs {
        let outputs = Outputs::list(folder)?;
        if outputs.kind == OutputKind::Modes {
            return Err(PictureError::Modes {
                path: folder.clone(),
                what: "crack paths",
                remedy: Remedy::OmitOption("crack"),
            });
        }
        if let (None, Some((_, path))) = (&body, outputs.files.first_key_value()) {
            let file = VtuFile::open(path)?;
            if is_solid(&file)? {
                return Err(PictureError::Solid("a picture of crack paths"));
            }
            body = Some(Body::read(&file)?);
            lines.push(Lines::from_precracks(folder)?);
        }
        let cracks = StoredCracks::open(folder)?;
        lines.push(Lines::from_run(&cracks, label, colour(label)));
    }
    let body =
        body.unwrap_or_else(|| Body::new(Vec::new(), Vec::new(), Vec::new(), FieldLocation::Point));
    let title = Some(panel.title.clone()).filter(|it| !it.is_empty());
    Ok(Panel {
        title: title.into_iter().map(|it| [it.clone(), it]).collect(),
        positions: body.deformed(0.0),
        body,
        field: None,
        broken: Vec::new(),
        interfaces: Vec::new(),
        rigid: None,
        lines,
        solid: None,
    })
}
