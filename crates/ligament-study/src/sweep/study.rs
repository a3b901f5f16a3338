//! The study file: a base case, axes, derived results and plots, in TOML.

use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde::de::IgnoredAny;

use super::axis::{Axis, RawAxis, Setting};
use super::error::StudyError;
use super::toml_text;
use ligament_case::case::decode::decode;
use ligament_case::case::document::{Node, Value};
use ligament_case::case::fault::KeyFault;
use ligament_case::case::key_path::KeyPath;
use ligament_case::case::source::Source;
use ligament_case::case::values::{require, require_column_name, require_unique};
use ligament_case::case::{CaseError, Fault, Location};
use ligament_case::input_file;

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

/// A column derived from a result.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DerivedColumn {
    /// Name of the column.
    pub name: String,
    /// The result by its name (see `crate::quantities`).
    pub of: String,
    /// Divisor of the result.
    #[serde(default = "one")]
    pub over: f64,
}

fn one() -> f64 {
    1.0
}

/// A plot over the runs of a study.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudyPlot {
    /// The column along x: a key of an axis, a derived column or a result.
    pub x: String,
    /// The column along y: a key of an axis, a derived column or a result.
    pub y: String,
    /// A key of an axis; each of its values has a curve.
    pub by: Option<String>,
    /// Title; by default the title of the study.
    pub title: Option<String>,
    /// Label along x, with the unit; by default the name of the column.
    pub x_label: Option<String>,
    /// Label along y, with the unit; by default the name of the column.
    pub y_label: Option<String>,
    /// A known line beside the curves.
    pub line: Option<KnownLine>,
    /// Range of x of a line fitted to each curve.
    pub fit: Option<FitRange>,
}

/// A line that is known from elsewhere.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KnownLine {
    /// Slope of the line.
    pub slope: f64,
    /// Value of y at x = 0.
    pub intercept: f64,
    /// Label of the line.
    #[serde(default)]
    pub label: String,
}

impl KnownLine {
    /// Name of the line: the label, or "known".
    pub fn name(&self) -> &str {
        match self.label.as_str() {
            "" => "known",
            label => label,
        }
    }

    /// The line's y at x.
    pub fn at(&self, x: f64) -> f64 {
        self.slope * x + self.intercept
    }
}

/// Range of x of a fit; unbounded where no end is given.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FitRange {
    /// Smallest x.
    pub from: Option<f64>,
    /// Largest x.
    pub to: Option<f64>,
}

impl FitRange {
    /// Whether the range contains x; its ends belong to it.
    pub fn contains(&self, x: f64) -> bool {
        self.from.is_none_or(|from| x >= from) && self.to.is_none_or(|to| x <= to)
    }
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
    result: Vec<DerivedColumn>,
    #[serde(default)]
    plot: Vec<StudyPlot>,
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
        check_derived(&raw.result, &root)?;
        for (index, plot) in raw.plot.iter().enumerate() {
            check_plot(plot, &axes, &root.child("plot").child(index))?;
        }
        let folder = source.path.parent().unwrap_or(Path::new(""));
        Ok(Self {
            source: source.clone(),
            title: raw.title,
            case: folder.join(raw.case),
            geometry: raw.geometry.map(|geometry| folder.join(geometry)),
            settings: settings(document)?,
            axes,
            derived: raw.result,
            plots: raw.plot,
        })
    }

    /// The study's name: the name of its folder if the file is called `study.toml`, else the name of the file without its extension.
    pub fn name(&self) -> String {
        self.source.name(&["study"])
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

/// The fault with the name of the study file, where it is about the root.
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

fn check_derived(derived: &[DerivedColumn], root: &KeyPath) -> Result<(), KeyFault> {
    let place = |index: usize| root.child("result").child(index);
    for (index, DerivedColumn { name, over, .. }) in derived.iter().enumerate() {
        require_column_name(|| place(index).child("name"), name)?;
        require(
            *over != 0.0,
            || place(index).child("over"),
            "other than 0",
            *over,
        )?;
    }
    let names = derived.iter().enumerate();
    require_unique(
        names.map(|(index, it)| (place(index).child("name"), it.name.as_str())),
        "",
    )
}

fn check_plot(plot: &StudyPlot, axes: &[Axis], place: &KeyPath) -> Result<(), KeyFault> {
    let keys: Vec<&String> = axes.iter().flat_map(|axis| &axis.keys).collect();
    if let Some(by) = &plot.by
        && !keys.contains(&by)
    {
        let fault = Fault::unknown_name("key of an axis", by, keys.into_iter().cloned());
        return Err(KeyFault::new(place.child("by"), fault));
    }
    if let Some(FitRange {
        from: Some(from),
        to: Some(to),
    }) = plot.fit
    {
        require(
            from < to,
            || place.child("fit"),
            "a range with from < to",
            (from, to),
        )?;
    }
    Ok(())
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
