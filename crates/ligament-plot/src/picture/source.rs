//! The results in a folder, as pictures need them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ligament_output::FieldLocation;
use ligament_output::csv::read::CsvTable;
use ligament_output::quantity::four_digits;
use ligament_output::remedy::Remedy;
use ligament_output::results::cracks::StoredCracks;
use ligament_output::results::fields::{DISPLACEMENT, OPENING};
use ligament_output::results::outputs::{OutputKind, Outputs};
use ligament_output::results::solid_body::is_solid;
use ligament_output::results::solid_cracks::{SolidCracks, has_solid};
use ligament_output::results::{StoredState, first_field_of, stored_rigid_bodies};
use ligament_output::vtu::read::VtuFile;

use super::body::{Body, MODE_SHARE};
use super::crack::{self, Crack};
use super::field::{Field, NONE, normalise_by_quantile};
use super::lines::Lines;
use super::panel::{Panel, SolidView};
use super::request::{CrackDrawing, FieldRequest, Magnification, SolidRequest};
use super::select::{Choice, HistoryRow, SelectedOutput, history_rows, selected_outputs};
use super::strip::LegendEntry;
use super::units::AxisUnit;
use super::{PictureError, labels_of, solid};
use crate::stored_loading::stored_loading;

/// Text in titles and legends for a step in which bonds were still failing.
const NOT_CONVERGED: &str = "not converged";

/// The results in a folder.
pub(super) struct Source {
    pub(super) outputs: Outputs,
    pub(super) label: String,
    rows: BTreeMap<usize, HistoryRow>,
    /// Units in which displacement and force are shown.
    units: Option<[AxisUnit; 2]>,
    /// Unit in which the time of a motion is shown; none in statics.
    time: Option<AxisUnit>,
    pub(super) crack: Option<Crack>,
    /// Lines that are drawn over the body in all steps.
    lines: Vec<Lines>,
    /// Cracks of a body in the plane under loads.
    cracks: Option<StoredCracks>,
    /// Cracks of a solid that are drawn.
    solid_cracks: Option<SolidCracks>,
    /// Style of cracks.
    drawing: Option<CrackDrawing>,
    /// Settings of solids.
    solid: SolidRequest,
    /// Frequencies of modes by number, Hz.
    frequencies: BTreeMap<usize, f64>,
}

/// Results, and the field to draw.
pub(super) struct Subject {
    pub(super) sources: Vec<Source>,
    /// Name of the field, or `none`.
    pub(super) field: String,
    /// Whether these are natural modes.
    pub(super) has_modes: bool,
}

/// An output that is drawn.
pub(super) struct Output<'a> {
    source: &'a Source,
    selected: SelectedOutput,
    is_labelled: bool,
}

/// The chosen outputs of all results, which are labelled where there are several.
pub(super) fn outputs<'a>(
    sources: &'a [Source],
    choice: &Choice,
) -> Result<Vec<Output<'a>>, PictureError> {
    let mut outputs = Vec::new();
    for source in sources {
        let all = selected_outputs(&source.outputs, choice, &source.rows)?;
        outputs.extend(all.into_iter().map(|selected| Output {
            source,
            selected,
            is_labelled: sources.len() > 1,
        }));
    }
    Ok(outputs)
}

/// The results in the folders, with a colour for each criterion that broke bonds in them.
fn sources(request: &FieldRequest) -> Result<Vec<Source>, PictureError> {
    let labels = labels_of(&request.folders, &request.labels)?;
    let mut sources = Vec::new();
    for (folder, label) in request.folders.iter().zip(labels) {
        sources.push(Source::open(folder, label, request)?);
    }
    let over_field = request.field.as_deref() != Some(NONE);
    let cracks = sources.iter_mut().filter_map(|it| it.crack.as_mut());
    crack::paint(cracks.collect(), over_field);
    Ok(sources)
}

impl Subject {
    pub(super) fn open(request: &FieldRequest) -> Result<Self, PictureError> {
        let sources = sources(request)?;
        let given = request.field.clone();
        if let (true, Magnification::Times(factor)) = (request.has_lines(), request.magnification)
            && factor != 0.0
        {
            return Err(PictureError::MovedLines(
                factor,
                Remedy::OmitOption("scale"),
            ));
        }
        let has_surface = sources.iter().any(|it| it.solid_cracks.is_some());
        let default = match request.crack {
            Some(CrackDrawing::Lines) if has_surface => OPENING.name,
            Some(CrackDrawing::Lines) => NONE,
            _ => default_field(&sources)?,
        };
        Ok(Self {
            field: given.unwrap_or_else(|| default.to_owned()),
            has_modes: (sources.iter()).any(|it| it.outputs.kind == OutputKind::Modes),
            sources,
        })
    }

    /// The default file of a picture. Runs write no file with this name.
    pub(super) fn default_file(&self, request: &FieldRequest) -> PathBuf {
        let name = match self.field.as_str() {
            _ if self.has_modes => "picture-modes.png".to_owned(),
            NONE => "picture-crack.png".to_owned(),
            field => format!("picture-{field}.png"),
        };
        request.folders[0].join(name)
    }
}

/// The default field: the field of the first results in which bonds failed, else the displacement.
fn default_field(sources: &[Source]) -> Result<&'static str, PictureError> {
    for source in sources {
        let field = first_field_of(&source.outputs)?;
        if field.name != DISPLACEMENT.name {
            return Ok(field.name);
        }
    }
    Ok(DISPLACEMENT.name)
}

/// The largest size of a value of the rows of a history.
fn largest(rows: &BTreeMap<usize, HistoryRow>, of: fn(&HistoryRow) -> f64) -> f64 {
    let sizes = rows.values().map(|it| of(it).abs());
    sizes.fold(0.0, f64::max)
}

impl Source {
    fn open(folder: &Path, label: String, request: &FieldRequest) -> Result<Self, PictureError> {
        let mut source = Self {
            outputs: Outputs::list(folder)?,
            label,
            rows: BTreeMap::new(),
            units: None,
            time: None,
            crack: None,
            lines: Vec::new(),
            cracks: None,
            solid_cracks: None,
            drawing: request.crack,
            solid: request.solid,
            frequencies: BTreeMap::new(),
        };
        if source.outputs.kind == OutputKind::Modes {
            if request.crack.is_some() {
                return Err(PictureError::Modes {
                    path: folder.to_path_buf(),
                    what: "cracks",
                    remedy: Remedy::OmitOption("crack"),
                });
            }
            let table = CsvTable::read(folder.join("modes.csv"))?;
            let numbers = table.values::<usize>("mode")?.into_iter();
            source.frequencies = numbers.zip(table.values("frequency_hz")?).collect();
            return Ok(source);
        }
        source.rows = history_rows(folder)?;
        let loading = stored_loading(folder).ok();
        let largest = |of: fn(&HistoryRow) -> f64| largest(&source.rows, of);
        source.units = loading.as_ref().map(|it| {
            [
                AxisUnit::new(it.units.displacement, largest(|it| it.displacement)),
                AxisUnit::new(it.units.force, largest(|it| it.reaction)),
            ]
        });
        let moving = loading.as_ref().filter(|it| it.in_time);
        source.time = moving.map(|_| AxisUnit::new("s", largest(|it| it.load_factor)));
        if request.crack.is_some() && has_solid(folder)? {
            source.solid_cracks = Some(SolidCracks::open(folder)?);
            return Ok(source);
        }
        let follows_path = loading.is_some_and(|it| it.follows_path);
        match request.crack {
            Some(CrackDrawing::Lines) => source.lines.push(Lines::from_precracks(folder)?),
            Some(CrackDrawing::Bonds) => source.crack = Some(Crack::read(folder, follows_path)?),
            None => {}
        }
        // A run that was cut short has no history before its first step.
        if !has_solid(folder)? && folder.join("history.csv").is_file() {
            source.cracks = Some(StoredCracks::open(folder)?);
        }
        for (place, table) in request.lines.iter().enumerate() {
            source.lines.push(Lines::from_table(table, place)?);
        }
        Ok(source)
    }
}

impl Output<'_> {
    /// The state, or number of the mode.
    pub(super) fn state(&self) -> StoredState {
        self.selected.state
    }

    /// The load of the state.
    fn history_row(&self) -> Option<&HistoryRow> {
        self.selected.load.as_ref()
    }

    /// Long and short words of the title.
    pub(super) fn title(&self) -> Vec<[String; 2]> {
        let (source, state) = (self.source, self.selected.state);
        let same = |text: String| [text.clone(), text];
        let mut words = Vec::new();
        if self.is_labelled {
            words.push(same(source.label.clone()));
        }
        if source.outputs.kind == OutputKind::Modes {
            let frequency = source.frequencies.get(&state.step);
            let frequency =
                frequency.map_or(String::new(), |it| format!(": {} Hz", four_digits(*it)));
            words.push(same(format!("mode {state}{frequency}")));
            return words;
        }
        if let (Some(row), Some(units)) = (self.history_row(), &source.time) {
            words.push(same(format!("t = {}", units.value(row.load_factor))));
            words.extend(self.selected.happened.clone());
            return words;
        }
        let step = state.step;
        words.push(match state.breakages() {
            Some(count) => [
                format!("step {step} after {count} breakages"),
                format!("step {state}"),
            ],
            None => same(format!("step {step}")),
        });
        words.extend(self.selected.happened.clone());
        if let (Some(row), Some([displacement, force])) = (self.history_row(), &source.units) {
            // A change of temperature loads a body that nothing moves.
            let is_heated = displacement.unit.ends_with('K');
            let moved = displacement.value(row.displacement);
            let moves = if is_heated {
                "temperature change"
            } else {
                "displacement"
            };
            words.push([format!("{moves} {moved}"), moved]);
            if !row.at_rest {
                words.push(same(NOT_CONVERGED.to_owned()));
            }
            if !is_heated {
                let held = force.value(row.reaction);
                words.push([format!("reaction {held}"), held]);
            }
        }
        words
    }

    /// The entry of the legend for steps that are not in equilibrium with their load; none without such steps.
    pub(super) fn warning(outputs: &[Self]) -> Option<LegendEntry> {
        let unsettled = |it: &Self| it.history_row().is_some_and(|row| !row.at_rest);
        let words = match outputs {
            [_] => format!("{NOT_CONVERGED}: bonds were still breaking at this load"),
            _ => {
                format!("steps {NOT_CONVERGED}: bonds were still breaking at their load")
            }
        };
        outputs.iter().any(unsettled).then_some(LegendEntry {
            colour: None,
            words,
        })
    }

    /// The undeformed body with a field.
    pub(super) fn panel(&self, field: &str) -> Result<Panel, PictureError> {
        let file = VtuFile::open(&self.selected.path)?;
        if is_solid(&file)? {
            return self.solid_panel(&file, field);
        }
        if let Some(option) = self.source.solid.option_for_solids() {
            let folder = self.source.outputs.folder.clone();
            return Err(PictureError::Plane(folder, Remedy::OmitOption(option)));
        }
        let is_drawn = field != NONE;
        let mut field = is_drawn.then(|| Field::read(&file, field)).transpose()?;
        if self.source.outputs.kind == OutputKind::Modes {
            field.iter_mut().for_each(normalise_by_quantile);
        }
        let mut body = Body::read(&file)?;
        let on_cells = |it: &Field| it.location == FieldLocation::Cell;
        let opens = !self.draws_lines() && !field.as_ref().is_some_and(on_cells);
        if let Some(cracks) = self.source.cracks.as_ref().filter(|_| opens) {
            let values = field.as_mut().map(|it| &mut it.values);
            body.open(cracks, self.selected.state, values);
        }
        Ok(Panel {
            title: self.title(),
            positions: Vec::new(),
            body,
            field,
            broken: Vec::new(),
            interfaces: Vec::new(),
            lines: self.lines(),
            rigid: stored_rigid_bodies(&self.selected.path)?,
            solid: None,
        })
    }

    /// The undeformed solid with a field, as seen.
    fn solid_panel(&self, file: &VtuFile, field: &str) -> Result<Panel, PictureError> {
        let source = self.source;
        if !source.lines.is_empty() {
            return Err(PictureError::LinesOfSolid(Remedy::OmitOption("with-lines")));
        }
        let cracks = source.solid_cracks.as_ref();
        let cracks = cracks.map(|it| (it, self.selected.state));
        let drawn = (&source.solid, source.drawing);
        let (scene, mut field) = solid::read(file, field, drawn, cracks)?;
        if source.outputs.kind == OutputKind::Modes {
            field.iter_mut().for_each(normalise_by_quantile);
        }
        let view = source.solid.view();
        let [reference, displacement] = scene.projected_places(view);
        Ok(Panel {
            title: self.title(),
            positions: Vec::new(),
            body: Body::new(reference, displacement, Vec::new(), FieldLocation::Cell),
            field,
            broken: Vec::new(),
            interfaces: Vec::new(),
            lines: Vec::new(),
            rigid: None,
            solid: Some(SolidView {
                scene,
                view,
                factor: 0.0,
            }),
        })
    }

    /// Whether cracks are drawn as lines.
    fn draws_lines(&self) -> bool {
        self.source.drawing == Some(CrackDrawing::Lines)
    }

    /// Lines over the body, its cracks above all others.
    fn lines(&self) -> Vec<Lines> {
        let cracks = self.source.cracks.as_ref().filter(|_| self.draws_lines());
        let cracks = cracks.map(|it| Lines::from_cracks(it, self.selected.state));
        self.source.lines.iter().cloned().chain(cracks).collect()
    }

    /// The panel with its body deformed and its broken bonds between the deformed ends.
    pub(super) fn deformed(&self, mut panel: Panel, magnification: Option<f64>) -> Panel {
        let factor = magnification.unwrap_or_else(|| panel.body.scale_for_share(MODE_SHARE));
        let positions = panel.body.deformed(factor);
        if let Some(solid) = &mut panel.solid {
            solid.factor = factor;
        }
        let line = |ends: [i64; 2]| {
            let [a, b] = ends.map(|tag| panel.body.place(tag, &positions));
            Some([a?, b?])
        };
        let source = self.source;
        let kinds = source
            .crack
            .iter()
            .flat_map(|crack| crack.kinds.iter().map(move |it| (crack, it)));
        // In a mesh a pre-crack is a line, along which the body opens.
        let kinds = kinds.filter(|(_, kind)| !(kind.is_cut() && panel.body.is_mesh()));
        panel.broken = kinds
            .map(|(crack, kind)| {
                let bonds = crack.broken_until(kind, self.selected.state).into_iter();
                (kind.colour, bonds.filter_map(line).collect())
            })
            .collect();
        panel.interfaces = panel.body.interfaces(factor);
        panel.positions = positions;
        panel.rigid = panel.rigid.map(|it| it.moved(factor));
        panel
    }
}
