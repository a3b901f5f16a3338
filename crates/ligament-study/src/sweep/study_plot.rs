//! The section `[[plot]]` of a study: the runs and quantities of a plot.

use serde::Deserialize;
use serde::de::IgnoredAny;

use super::axis::{Axis, axis_of_key, names, require_axis};
use super::toml_text;
use ligament_case::case::Fault;
use ligament_case::case::document::{Node, Value};
use ligament_case::case::fault::KeyFault;
use ligament_case::case::key_path::KeyPath;
use ligament_case::case::values::require;

/// A plot over the runs of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct StudyPlot {
    /// Content of the plot.
    pub content: PlotContent,
    /// Keys of axes: each value of the last one has a curve, each combination of the others a panel.
    pub by: Vec<String>,
    /// Keys of axes over whose values the plot has a mean.
    pub mean: Vec<String>,
    /// Filters of the drawn runs; all runs without any.
    pub(crate) filters: Vec<AxisFilter>,
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

/// Content of a plot over runs.
#[derive(Debug, Clone, PartialEq)]
pub enum PlotContent {
    /// One column of the table over another: keys of axes, derived columns or results.
    Columns {
        /// The column along x.
        x: String,
        /// The column along y.
        y: String,
    },
    /// The curves of the runs, as `ligament plot --curve` draws them.
    Curves {
        /// Column of the history along x; by default the displacement, of a motion the time.
        x: Option<String>,
        /// Column of the history along y; by default the reaction.
        y: Option<String>,
    },
    /// The crack paths of the runs at their end, over one another.
    CrackPaths,
}

/// Values of an axis that a plot draws.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AxisFilter {
    /// Index of the axis.
    pub(crate) axis: usize,
    /// Indices of the values, ascending.
    pub(crate) values: Vec<usize>,
}

/// A line from another source, for comparison.
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

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Kind {
    #[default]
    Columns,
    Curves,
    CrackPaths,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawPlot {
    #[serde(default)]
    kind: Kind,
    x: Option<String>,
    y: Option<String>,
    #[serde(rename = "by")]
    _by: Option<IgnoredAny>,
    #[serde(rename = "mean")]
    _mean: Option<IgnoredAny>,
    #[serde(rename = "where")]
    _filters: Option<IgnoredAny>,
    title: Option<String>,
    x_label: Option<String>,
    y_label: Option<String>,
    line: Option<KnownLine>,
    fit: Option<FitRange>,
}

impl RawPlot {
    /// Checks the plot at a place of the study.
    pub(super) fn check(
        self,
        document: &Node,
        axes: &[Axis],
        place: &KeyPath,
    ) -> Result<StudyPlot, KeyFault> {
        self.check_kind(document, place)?;
        let [by, mean] = ["by", "mean"].map(|key| axis_keys(document, axes, &place.child(key)));
        let (by, mean) = (by?, mean?);
        let is_drawn = |key: &&String| {
            let axis = axis_of_key(axes, key);
            by.iter().any(|it| axis_of_key(axes, it) == axis)
        };
        if let Some(key) = mean.iter().find(is_drawn) {
            let fault = format!("`{key}` is in `by` too, which draws its values one by one");
            return Err(KeyFault::new(place.child("mean"), fault));
        }
        if let Some(FitRange {
            from: Some(from),
            to: Some(to),
        }) = self.fit
        {
            let range = || place.child("fit");
            require(from < to, range, "a range with from < to", (from, to))?;
        }
        let filters = filters(document, axes, &place.child("where"))?;
        Ok(StudyPlot {
            content: self.content(place)?,
            by,
            mean,
            filters,
            title: self.title,
            x_label: self.x_label,
            y_label: self.y_label,
            line: self.line,
            fit: self.fit,
        })
    }

    /// Fails at a key that does not apply to the kind.
    fn check_kind(&self, document: &Node, place: &KeyPath) -> Result<(), KeyFault> {
        let of_table = ["line", "fit", "mean", "x_label", "y_label"];
        let keys: &[&str] = match self.kind {
            Kind::Columns => &[],
            Kind::Curves => &of_table,
            Kind::CrackPaths => &["x", "y", "line", "fit", "mean", "x_label", "y_label"],
        };
        let given = |key: &&&'static str| document.at(&place.child(key)).is_some();
        match keys.iter().find(given) {
            Some(key) => {
                let fault = Fault::NotWith {
                    key,
                    setting: "this `kind`".to_owned(),
                    reason: "it belongs to plots of columns of the table, or of the history",
                };
                Err(KeyFault::new(place.child(key), fault))
            }
            None => Ok(()),
        }
    }

    fn content(&self, place: &KeyPath) -> Result<PlotContent, KeyFault> {
        let required = |key: &str, given: &Option<String>| {
            given.clone().ok_or_else(|| {
                let fault = Fault::MissingKey {
                    key: key.to_owned(),
                    table: place.table_title(),
                    unit: None,
                };
                KeyFault::new(place.child(key), fault)
            })
        };
        Ok(match self.kind {
            Kind::Columns => PlotContent::Columns {
                x: required("x", &self.x)?,
                y: required("y", &self.y)?,
            },
            Kind::Curves => PlotContent::Curves {
                x: self.x.clone(),
                y: self.y.clone(),
            },
            Kind::CrackPaths => PlotContent::CrackPaths,
        })
    }
}

/// The keys of different axes at a place of the study; none where nothing is given.
fn axis_keys(document: &Node, axes: &[Axis], place: &KeyPath) -> Result<Vec<String>, KeyFault> {
    let keys = names(document, place)?;
    for (index, key) in keys.iter().enumerate() {
        let axis = require_axis(axes, key, || place.clone())?;
        let earlier = keys[..index].iter();
        let mut same = earlier.filter(|it| axis_of_key(axes, it) == Some(axis));
        if let Some(other) = same.next() {
            let fault = format!("`{key}` and `{other}` are one axis: name it once");
            return Err(KeyFault::new(place.clone(), fault));
        }
    }
    Ok(keys)
}

/// The filters of a table of keys of axes, quoted or nested, with values or labels.
fn filters(document: &Node, axes: &[Axis], place: &KeyPath) -> Result<Vec<AxisFilter>, KeyFault> {
    let mut filters = Vec::new();
    if let Some(node) = document.at(place) {
        if !matches!(node.value, Value::Table(_)) {
            let fault =
                "expected a table of keys of axes, such as { \"model.horizon_factor\" = 3.0 }";
            return Err(KeyFault::new(place.clone(), fault));
        }
        collect(node, axes, (place, &KeyPath::default()), &mut filters)?;
    }
    Ok(filters)
}

fn collect(
    table: &Node,
    axes: &[Axis],
    (place, above): (&KeyPath, &KeyPath),
    out: &mut Vec<AxisFilter>,
) -> Result<(), KeyFault> {
    for entry in table.entries() {
        let place = place.child(&entry.key);
        let path = KeyPath::parse(&entry.key).unwrap_or_else(|| KeyPath(vec![entry.key.clone()]));
        let key = KeyPath(above.0.iter().cloned().chain(path.0).collect());
        let name = key.to_string();
        let is_above = axes.iter().flat_map(|axis| &axis.keys).any(|it| {
            let begins = it.strip_prefix(name.as_str());
            begins.is_some_and(|rest| rest.starts_with('.'))
        });
        if is_above && matches!(entry.node.value, Value::Table(_)) {
            collect(&entry.node, axes, (&place, &key), out)?;
            continue;
        }
        let axis = require_axis(axes, &name, || place.clone())?;
        let values = values(&axes[axis], &name, &entry.node, &place)?;
        out.push(AxisFilter { axis, values });
    }
    Ok(())
}

/// Indices of the axis values in a node: a value or a label, or a list of these.
fn values(axis: &Axis, key: &str, node: &Node, place: &KeyPath) -> Result<Vec<usize>, KeyFault> {
    let found = meant(axis, key, node, place)?;
    let mut found = match (&node.value, found.is_empty()) {
        (Value::List(nodes), true) if !nodes.is_empty() => {
            let mut all = Vec::new();
            for (index, node) in nodes.iter().enumerate() {
                let place = place.child(index);
                let found = meant(axis, key, node, &place)?;
                all.extend(required(found, axis, key, node, &place)?);
            }
            all
        }
        _ => required(found, axis, key, node, place)?,
    };
    found.sort_unstable();
    found.dedup();
    Ok(found)
}

fn meant(axis: &Axis, key: &str, node: &Node, place: &KeyPath) -> Result<Vec<usize>, KeyFault> {
    let text = toml_text::toml(node, place)?;
    let words = toml_text::words(&toml_text::cell(node, &text));
    let points = axis.points.iter().enumerate();
    let found = points.filter(|(_, point)| axis.is_value(point, key, &words));
    Ok(found.map(|(index, _)| index).collect())
}

fn required(
    found: Vec<usize>,
    axis: &Axis,
    key: &str,
    node: &Node,
    place: &KeyPath,
) -> Result<Vec<usize>, KeyFault> {
    if !found.is_empty() {
        return Ok(found);
    }
    let text = toml_text::toml(node, place)?;
    let words = toml_text::words(&toml_text::cell(node, &text));
    let known = axis.points.iter().map(|point| axis.value_words(point, key));
    let fault = Fault::unknown_name("value of the axis", words, known);
    Err(KeyFault::new(place.clone(), fault))
}
