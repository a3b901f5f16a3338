//! The study file: a base case, axes, derived results and plots, in TOML.

use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde::de::IgnoredAny;

use super::axis::{Axis, RawAxis, Setting};
use super::derived::{self, RawDerived, Surroundings};
use super::error::StudyError;
use super::study_plot::RawPlot;
use super::toml_text;
use ligament_case::case::decode::decode;
use ligament_case::case::document::{Node, Value};
use ligament_case::case::fault::KeyFault;
use ligament_case::case::key_path::KeyPath;
use ligament_case::case::source::Source;
use ligament_case::case::values::{require, require_unique};
use ligament_case::case::{CaseError, Fault, Location};
use ligament_case::input_file;

pub use super::derived::{DerivedColumn, Reference, ReferenceTable};
pub use super::study_plot::{FitRange, KnownLine, PlotContent, StudyPlot};

/// A study: its cases, derived results and plots.
#[derive(Debug, Clone)]
pub struct Study {
    /// Parsed text of the study, with its file.
    pub source: Source,
    /// Title of the study.
    pub title: String,
    /// The file of the base case.
    pub case: PathBuf,
    /// The geometry whose numbers are axes, if there is one.
    pub geometry: Option<PathBuf>,
    /// Settings of all runs.
    pub(crate) settings: Vec<Setting>,
    /// The axes; the first one varies slowest.
    pub axes: Vec<Axis>,
    /// Columns derived from results.
    pub derived: Vec<DerivedColumn>,
    /// Plots over the runs.
    pub plots: Vec<StudyPlot>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawStudy {
    #[serde(default)]
    title: String,
    case: String,
    geometry: Option<String>,
    #[serde(rename = "set")]
    _set: Option<IgnoredAny>,
    #[serde(default)]
    axis: Vec<RawAxis>,
    #[serde(default)]
    result: Vec<RawDerived>,
    #[serde(default)]
    plot: Vec<RawPlot>,
}

impl Study {
    /// Reads a study file and checks it as far as possible without its case.
    ///
    /// # Errors
    ///
    /// If the file cannot be read, is not TOML, or has a wrong key or value.
    pub fn load(path: &Path) -> Result<Self, StudyError> {
        let text = input_file::read_text(path).map_err(|source| StudyError::Read {
            path: path.to_owned(),
            source,
        })?;
        let source = Source::parse(path, text, &[])?;
        let study = Self::from_source(&source).map_err(|fault| source.error(fault))?;
        Ok(study)
    }

    /// Checks the parts of a study.
    fn from_source(source: &Source) -> Result<Self, KeyFault> {
        let (document, root) = (&source.document, KeyPath::default());
        let raw: RawStudy = decode(document, &root).map_err(in_study)?;
        require(
            !raw.case.is_empty(),
            || root.child("case"),
            "a path",
            &raw.case,
        )?;
        let axes = raw.axis.into_iter().enumerate();
        let axes = axes.map(|(index, axis)| axis.check(document, &root.child("axis").child(index)));
        let axes: Vec<Axis> = axes.collect::<Result<_, _>>()?;
        check_axes(&axes, raw.geometry.is_some(), &root.child("axis"))?;
        let folder = source.path.parent().unwrap_or(Path::new(""));
        let surroundings = Surroundings {
            document,
            axes: &axes,
            folder,
        };
        let derived = derived::check_columns(raw.result, surroundings, &root)?;
        let plots = raw.plot.into_iter().enumerate();
        let plot = |(index, plot): (usize, RawPlot)| {
            plot.check(document, &axes, &root.child("plot").child(index))
        };
        let plots: Vec<StudyPlot> = plots.map(plot).collect::<Result<_, _>>()?;
        Ok(Self {
            source: source.clone(),
            title: raw.title,
            case: folder.join(raw.case),
            geometry: raw.geometry.map(|geometry| folder.join(geometry)),
            settings: settings(document)?,
            derived,
            plots,
            axes,
        })
    }

    /// The study's name: the name of its folder if the file is called `study.toml`, else the name of the file without its extension.
    pub fn name(&self) -> String {
        self.source.name(&["study"])
    }

    /// The title, or the name of a study without one.
    pub(crate) fn heading(&self) -> String {
        match self.title.as_str() {
            "" => self.name(),
            title => title.to_owned(),
        }
    }

    /// Location of a key in the study file, or of the table that would have it.
    pub(crate) fn location(&self, key: &KeyPath) -> Location {
        self.source.location_of(key)
    }

    /// The error for a fault that is found later, with the location of its key.
    pub(crate) fn error(&self, key: KeyPath, fault: impl Into<Fault>) -> CaseError {
        self.source.error(KeyFault::new(key, fault))
    }
}

/// The fault with the name of the study file, if its key is the root.
fn in_study(mut fault: KeyFault) -> KeyFault {
    if let Fault::UnknownKey { table, .. } | Fault::MissingKey { table, .. } = &mut fault.fault
        && fault.key.0.len() == 1
    {
        *table = "the study file".to_owned();
    }
    fault
}

fn check_axes(axes: &[Axis], has_geometry: bool, place: &KeyPath) -> Result<(), KeyFault> {
    if axes.is_empty() {
        let fault = Fault::MissingSection {
            section: "[[axis]]".to_owned(),
            purpose: "one or more, each with a `key` of the case and its `values`",
        };
        return Err(KeyFault::new(place.clone(), fault));
    }
    let is_mesh = |axis: &Axis| !axis.of_geometry && axis.keys.iter().any(|key| key == "mesh.file");
    let number = axes.iter().position(|axis| axis.of_geometry);
    let mesh = axes.iter().position(is_mesh);
    match (number, mesh, has_geometry) {
        (Some(index), _, false) => {
            let fault = Fault::Required {
                key: "geometry",
                reason: "by an axis with a `number`: the Gmsh file of which it is one, relative to the folder of the study"
                    .to_owned(),
            };
            return Err(KeyFault::new(place.child(index), fault));
        }
        (None, _, true) => {
            let fault = "no axis has a `number` of the geometry, so nothing would be meshed: add one, or name meshes by \
                         the key mesh.file";
            return Err(KeyFault::new(KeyPath::default().child("geometry"), fault));
        }
        (Some(_), Some(index), true) => {
            let fault = "the meshes are made from `geometry`: an axis cannot name others";
            return Err(KeyFault::new(place.child(index), fault));
        }
        _ => {}
    }
    let keys = axes.iter().enumerate().flat_map(|(index, axis)| {
        let keys = axis.keys.iter();
        keys.map(move |key| (place.child(index), key.as_str()))
    });
    require_unique(
        keys,
        ": a key belongs to one axis; keys that vary together are `keys` of one",
    )
}

/// The settings of `[set]`, by quoted key paths or by nested tables.
fn settings(document: &Node) -> Result<Vec<Setting>, KeyFault> {
    let mut settings = Vec::new();
    let place = KeyPath::default().child("set");
    if let Some(node) = document.get("set") {
        if !matches!(node.value, Value::Table(_)) {
            return Err(KeyFault::new(
                place,
                "expected a table of keys of the case file",
            ));
        }
        collect(node, &place, &KeyPath::default(), &mut settings)?;
    }
    Ok(settings)
}

fn collect(
    table: &Node,
    place: &KeyPath,
    above: &KeyPath,
    out: &mut Vec<Setting>,
) -> Result<(), KeyFault> {
    for entry in table.entries() {
        let place = place.child(&entry.key);
        let Some(path) = KeyPath::parse(&entry.key) else {
            let fault = "is not a key path such as load.0.displacement.y";
            return Err(KeyFault::new(place, fault));
        };
        let key = KeyPath(above.0.iter().cloned().chain(path.0).collect());
        if let Value::Table(_) = entry.node.value {
            collect(&entry.node, &place, &key, out)?;
        } else {
            out.push(Setting {
                given: format!("{key}={}", toml_text::toml(&entry.node, &place)?),
                place,
            });
        }
    }
    Ok(())
}
