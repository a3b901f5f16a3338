//! Pictures of fields, cracks and modes on deformed bodies.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ligament_output::csv::read::Sheet;
use ligament_output::results::outputs::{OutputKind, Outputs};
use ligament_output::vtu::read::VtuFile;

use super::body::{Body, common_scale};
use super::colour_bar::ColourBar;
use super::colour_map::ColourMap;
use super::crack::{self, Crack};
use super::field::{Field, NONE};
use super::panel::{Panel, Scale};
use super::select::{Choice, Moment, chosen, moments};
use super::strip::{Entry, Strip};
use super::svg::PIXELS_PER_MM;
use super::units::{Shown, four_digits};
use super::{PictureError, Target, labels_of};
use crate::stored_loading::stored_loading;

/// Width of a column and of a page of a paper, mm.
const WIDTHS: [f64; 2] = [90.0, 180.0];

/// Share of the body's size that the largest displacement of a mode is drawn with.
pub(super) const MODE_SHARE: f64 = 0.1;

/// Quantile of a mode's field that is drawn as its largest value: the corners of a clamp outshine all else.
const MODE_QUANTILE: f64 = 0.995;

/// How much larger displacements are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Magnification {
    /// So that the largest is about a twentieth of the body; of a mode a tenth.
    Auto,
    /// By this factor.
    Times(f64),
}

/// A picture of a field, or of a crack.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldRequest {
    /// Folders with results.
    pub folders: Vec<PathBuf>,
    /// Labels of the results; where empty, the names of their folders.
    pub labels: Vec<String>,
    /// Field with its component, or `none`; None: damage where bonds broke, else the displacement; of modes the strain energy
    /// density.
    pub field: Option<String>,
    /// Outputs of each folder.
    pub choice: Choice,
    /// Factor on the displacement.
    pub magnification: Magnification,
    /// Whether broken bonds are drawn.
    pub crack: bool,
    /// Part of the plane, lower left and upper right corner, m.
    pub window: Option<[[f64; 2]; 2]>,
    /// Number of bands of colour.
    pub bands: Option<usize>,
    /// First and last level, SI units.
    pub range: Option<[f64; 2]>,
    /// Colours; None: as the signs of the field ask for.
    pub map: Option<ColourMap>,
    /// Bodies in a row.
    pub columns: Option<usize>,
    /// Size and file.
    pub target: Target,
}

/// The results in a folder.
struct Source {
    outputs: Outputs,
    label: String,
    moments: BTreeMap<usize, Moment>,
    /// Units to show displacement and force in.
    shown: Option<[Shown; 2]>,
    crack: Option<Crack>,
    /// Whether broken bonds are drawn. A pre-crack in a mesh, whose cells hide it, is drawn in any case.
    shows_broken: bool,
    /// Frequencies of modes by number, Hz.
    frequencies: BTreeMap<usize, f64>,
}

/// Draws the picture and returns where it is.
///
/// # Errors
///
/// If there are no such results, outputs or fields, or the picture cannot be written.
pub fn draw_fields(request: &FieldRequest) -> Result<PathBuf, PictureError> {
    let first = &request.folders[0];
    let labels = labels_of(&request.folders, &request.labels)?;
    let sources = sources(request, labels)?;
    let has_modes = (sources.iter()).any(|it| it.outputs.kind == OutputKind::Modes);
    let given = request.field.clone();
    let name = given.unwrap_or_else(|| default_field(&sources).to_owned());
    let file = request
        .target
        .file(|| first.join(default_name(&name, has_modes)))?;

    let mut panels = Vec::new();
    for source in &sources {
        for (number, path) in chosen(&source.outputs, &request.choice, &source.moments)? {
            let title = source.title(number, sources.len() > 1);
            panels.push((source, number, source.panel(&path, &name, title)?));
        }
    }
    let magnification = match request.magnification {
        Magnification::Times(factor) => Some(factor),
        Magnification::Auto if has_modes => None,
        Magnification::Auto => Some(common_scale(panels.iter().map(|it| &it.2.body))),
    };
    let panels: Vec<Panel> = panels
        .into_iter()
        .map(|(source, number, panel)| source.deformed(panel, number, magnification))
        .collect();

    let drawn = scale(&panels, &name, has_modes, request)?;
    let mut legend = vec![Entry {
        colour: None,
        words: magnification_words(magnification),
    }];
    legend.extend(crack_legend(&sources, &panels));
    let quantity = if has_modes {
        format!("{name} / its 99.5 % quantile")
    } else {
        name.clone()
    };
    let unit = panels[0].field.as_ref().map_or("-", |field| field.unit);
    let bar = |(scale, range)| ColourBar::new(scale, &quantity, unit, range);
    let strip = Strip {
        scale: drawn.as_ref().map(|it| &it.0),
        bar: drawn.as_ref().map(|(scale, range)| bar((scale, *range))),
        legend,
        window: request.window,
        columns: request.columns,
        title: format!("{name} of {}", sources[0].label),
        panels: &panels,
    };
    let width = request
        .target
        .width
        .unwrap_or(WIDTHS[usize::from(panels.len() > 1)]);
    request
        .target
        .write(file, &strip.to_svg(width * PIXELS_PER_MM))
}

/// The results in the folders, with a colour for each criterion that broke bonds in them.
fn sources(request: &FieldRequest, labels: Vec<String>) -> Result<Vec<Source>, PictureError> {
    let mut sources = Vec::new();
    for (folder, label) in request.folders.iter().zip(labels) {
        sources.push(Source::open(folder, label, request)?);
    }
    let over_field = request.field.as_deref() != Some(NONE);
    let cracks = sources.iter_mut().filter_map(|it| it.crack.as_mut());
    crack::paint(cracks.collect(), over_field);
    Ok(sources)
}

impl Source {
    fn open(folder: &Path, label: String, request: &FieldRequest) -> Result<Self, PictureError> {
        let mut source = Self {
            outputs: Outputs::list(folder)?,
            label,
            moments: BTreeMap::new(),
            shown: None,
            crack: None,
            shows_broken: request.crack,
            frequencies: BTreeMap::new(),
        };
        if source.outputs.kind == OutputKind::Modes {
            if request.crack {
                return Err(PictureError::Modes {
                    path: folder.to_path_buf(),
                    what: "broken bonds",
                    option: "--crack",
                });
            }
            let table = Sheet::read(folder.join("modes.csv"))?;
            let numbers = table.values::<usize>("mode")?.into_iter();
            source.frequencies = numbers.zip(table.values("frequency_hz")?).collect();
            return Ok(source);
        }
        source.moments = moments(folder)?;
        let loading = stored_loading(folder).ok();
        let largest = |of: fn(&Moment) -> f64| {
            let sizes = source.moments.values().map(|it| of(it).abs());
            sizes.fold(0.0, f64::max)
        };
        source.shown = loading.map(|it| {
            [
                Shown::new(it.units.displacement, largest(|it| it.displacement)),
                Shown::new(it.units.force, largest(|it| it.reaction)),
            ]
        });
        let follows_path = loading.is_some_and(|it| it.follows_path);
        source.crack = Some(Crack::read(folder, follows_path, request.crack)?);
        Ok(source)
    }

    fn title(&self, number: usize, is_labelled: bool) -> Vec<[String; 2]> {
        let same = |text: String| [text.clone(), text];
        let mut words = Vec::new();
        if is_labelled {
            words.push(same(self.label.clone()));
        }
        if self.outputs.kind == OutputKind::Modes {
            let frequency = self.frequencies.get(&number);
            let frequency =
                frequency.map_or(String::new(), |it| format!(": {} Hz", four_digits(*it)));
            words.push(same(format!("mode {number}{frequency}")));
            return words;
        }
        words.push(same(format!("step {number}")));
        if let (Some(moment), Some([displacement, force])) =
            (self.moments.get(&number), &self.shown)
        {
            // A change of temperature loads a body that nothing moves.
            let is_heated = displacement.unit.ends_with('K');
            let moved = displacement.value(moment.displacement);
            let moves = if is_heated {
                "temperature change"
            } else {
                "displacement"
            };
            words.push([format!("{moves} {moved}"), moved]);
            if !moment.at_rest {
                words.push(same("not at rest".to_owned()));
            }
            if !is_heated {
                let held = force.value(moment.reaction);
                words.push([format!("reaction {held}"), held]);
            }
        }
        words
    }

    fn panel(
        &self,
        path: &Path,
        name: &str,
        title: Vec<[String; 2]>,
    ) -> Result<Panel, PictureError> {
        let file = VtuFile::open(path)?;
        let is_drawn = name != NONE;
        let mut field = is_drawn.then(|| Field::read(&file, name)).transpose()?;
        if self.outputs.kind == OutputKind::Modes {
            field.iter_mut().for_each(relate_to_largest);
        }
        Ok(Panel {
            title,
            positions: Vec::new(),
            body: Body::read(&file)?,
            field,
            broken: Vec::new(),
        })
    }

    /// The panel with its body deformed and its broken bonds between the deformed ends.
    fn deformed(&self, mut panel: Panel, number: usize, magnification: Option<f64>) -> Panel {
        let factor = magnification.unwrap_or_else(|| panel.body.scale_for_share(MODE_SHARE));
        let positions = panel.body.deformed(factor);
        let line = |ends: [i64; 2]| {
            let [a, b] = ends.map(|tag| panel.body.place(tag, &positions));
            Some([a?, b?])
        };
        let kinds = self
            .crack
            .iter()
            .flat_map(|crack| crack.kinds.iter().map(move |it| (crack, it)));
        let shows_cut = self.shows_broken || panel.body.is_mesh();
        let kinds = kinds.filter(|(_, kind)| shows_cut || !kind.is_cut());
        panel.broken = kinds
            .map(|(crack, kind)| {
                let bonds = crack.until(kind, number).into_iter();
                (kind.colour.clone(), bonds.filter_map(line).collect())
            })
            .collect();
        panel.positions = positions;
        panel
    }

    fn has_broken(&self) -> bool {
        let breaks = Sheet::read(self.outputs.folder.join("breaks.csv"));
        let steps = breaks.and_then(|sheet| sheet.values::<usize>("step"));
        steps.is_ok_and(|steps| !steps.is_empty())
    }
}

fn default_field(sources: &[Source]) -> &'static str {
    if sources[0].outputs.kind == OutputKind::Modes {
        "strain_energy_density"
    } else if sources.iter().any(Source::has_broken) {
        "damage"
    } else {
        "displacement"
    }
}

/// Runs write no file of such a name.
fn default_name(field: &str, has_modes: bool) -> String {
    match field {
        _ if has_modes => "picture-modes.png".to_owned(),
        NONE => "picture-crack.png".to_owned(),
        field => format!("picture-{field}.png"),
    }
}

pub(super) fn magnification_words(magnification: Option<f64>) -> String {
    match magnification {
        Some(0.0) => "undeformed".to_owned(),
        Some(factor) => format!("deformation × {factor}"),
        None => format!("largest displacement drawn as {MODE_SHARE} of the body"),
    }
}

/// The quantile of the absolute values becomes 1: a mode has no size of its own.
pub(super) fn relate_to_largest(field: &mut Field) {
    let mut sizes: Vec<f64> = field
        .values
        .iter()
        .map(|it| it.abs())
        .filter(|it| it.is_finite())
        .collect();
    sizes.sort_by(f64::total_cmp);
    let place = (MODE_QUANTILE * sizes.len().saturating_sub(1) as f64).round() as usize;
    let largest = sizes
        .get(place)
        .copied()
        .filter(|it| *it > 0.0)
        .unwrap_or(1.0);
    for value in &mut field.values {
        *value /= largest;
    }
    field.unit = "-";
}

/// Colours for the field of all panels, and the range of its values; None where no field is drawn.
fn scale(
    panels: &[Panel],
    name: &str,
    has_modes: bool,
    request: &FieldRequest,
) -> Result<Option<(Scale, [f64; 2])>, PictureError> {
    if name == NONE {
        return Ok(None);
    }
    let fields = panels.iter().filter_map(|panel| panel.field.as_ref());
    let ranges = fields.filter_map(Field::range);
    let range = ranges.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    let range = range.ok_or_else(|| PictureError::NoValues(name.to_owned()))?;
    // Modes are relative to their largest values.
    let of_modes = has_modes.then_some([range[0].signum().min(0.0), 1.0]);
    let asked = request.range.or(of_modes);
    let scale = Scale::new(range, asked, request.bands, request.map);
    Ok(Some((scale, range)))
}

/// The criteria by which bonds of any panel broke, each once, with the number in the last panel.
fn crack_legend(sources: &[Source], panels: &[Panel]) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
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
        let words = match panels {
            [_] => format!("{} ({count})", kind.name),
            _ => kind.name.clone(),
        };
        if count > 0 && !entries.iter().any(|it| it.words == words) {
            entries.push(Entry {
                colour: Some(kind.colour.clone()),
                words,
            });
        }
    }
    entries
}
