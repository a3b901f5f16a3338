//! Structure of the file of an experiment.

use std::collections::BTreeMap;

use anyhow::Context;
use serde::Deserialize;

/// An experiment as written in its file.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExperimentFile {
    /// Name on the command line.
    pub name: String,
    /// Title of the experiment.
    pub title: String,
    /// Paper, tables and figures, or closed form.
    pub source: String,
    /// Description of the computation.
    pub setup: String,
    /// Numbers by name: a number, an expression, or one of these by labels. Only numbers that no setting needs may contain quantities of
    /// the run.
    #[serde(default)]
    pub(super) numbers: BTreeMap<String, Choice>,
    /// Values of other runs by name.
    #[serde(default)]
    pub(super) reference: BTreeMap<String, Reference>,
    /// The case of all tables.
    #[serde(default)]
    pub(super) run: Run,
    pub(super) table: Vec<FileTable>,
    #[serde(default)]
    pub(super) plot: Vec<Figure>,
}

/// The case of a run with its settings.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Run {
    /// Case file, from the root of the repository.
    pub(super) case: Option<Choice>,
    /// Mesh, from the folder of meshes; without one, or where its name is empty, the body of the case.
    pub(super) mesh: Option<Choice>,
    /// Settings over the case (`key=value`, as with `--set`). In braces, `{label}` in a text is the label of the entry, and an expression
    /// elsewhere its number. Doubled braces are braces of the setting.
    #[serde(default)]
    pub(super) set: Vec<String>,
    /// Settings by labels.
    pub(super) set_by: Option<SettingsByLabels>,
    /// Loads of a uniform stress.
    pub(super) stress: Option<UniformStress>,
    /// A list of settings.
    pub(super) list: Option<SettingsList>,
}

/// A uniform stress, whose tractions load the sides of a rectangle or a box.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct UniformStress {
    /// Expressions of the principal stresses with semicolons between them, Pa.
    pub(super) principal: Choice,
    /// Expression of the angle by which the axes are turned about z and then, in space, about x, degrees.
    pub(super) angle: String,
}

/// A setting whose value is a list; `item` counts its items from 0.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SettingsList {
    pub(super) key: String,
    pub(super) count: usize,
    pub(super) item: String,
}

/// The value of a run, or a known value of a table, with some labels of the entry replaced.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Reference {
    /// Expression of the value.
    pub(super) value: Option<Choice>,
    /// Name of the table, with labels in braces.
    pub(super) known: Option<String>,
    /// The run, as in a table; by default the run of the entry.
    pub(super) run: Option<Run>,
    #[serde(default)]
    pub(super) labels: BTreeMap<String, String>,
}

/// Settings by the label of a key; `else` for all labels that are not listed.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(super) struct SettingsByLabels {
    pub(super) by: String,
    #[serde(flatten)]
    pub(super) settings: BTreeMap<String, Vec<String>>,
}

/// A table of known values, and the value that is compared with them.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileTable {
    /// Name of its file in `published`, without `.csv`.
    pub(super) file: String,
    /// Expression of the computed value.
    pub(super) value: Choice,
    /// The run, where it differs from the run of all tables; its settings are added.
    #[serde(default)]
    pub(super) run: Run,
    /// Labels that stand for several runs each. The first key is the outermost.
    #[serde(default)]
    pub(super) over: Vec<LabelExpansion>,
}

/// A label with the labels for which it stands.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LabelExpansion {
    /// Key, or several with a comma and a space between them, as between the labels of a member.
    pub(super) key: String,
    /// The label; empty where the table has no such key.
    #[serde(default)]
    pub(super) label: String,
    pub(super) members: Vec<String>,
}

/// A text, or texts by labels of an entry.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "toml::Value")]
pub(super) enum Choice {
    Always(String),
    ByLabels {
        /// Keys of the labels.
        by: Vec<String>,
        /// Texts by the labels, with a comma and a space between them; `else` for all others.
        texts: BTreeMap<String, String>,
    },
}

impl TryFrom<toml::Value> for Choice {
    type Error = String;

    fn try_from(value: toml::Value) -> Result<Self, String> {
        let text = |value: toml::Value| match value {
            toml::Value::String(text) => Ok(text),
            toml::Value::Integer(number) => Ok(number.to_string()),
            toml::Value::Float(number) => Ok(format!("{number:?}")),
            other => Err(format!("`{other}` is neither a text nor a number")),
        };
        let toml::Value::Table(mut table) = value else {
            return Ok(Self::Always(text(value)?));
        };
        let by = match table
            .remove("by")
            .ok_or("`by` names the keys of the labels")?
        {
            toml::Value::Array(keys) => keys.into_iter().map(text).collect::<Result<_, _>>()?,
            key => vec![text(key)?],
        };
        let texts = table
            .into_iter()
            .map(|(labels, it)| Ok((labels, text(it)?)));
        Ok(Self::ByLabels {
            by,
            texts: texts.collect::<Result<_, String>>()?,
        })
    }
}

/// Key of the text for all labels that are not listed.
pub(super) const ELSE: &str = "else";

impl Choice {
    /// The text for given labels.
    pub(super) fn for_labels(
        &self,
        label: impl Fn(&str) -> anyhow::Result<String>,
    ) -> anyhow::Result<&str> {
        match self {
            Self::Always(text) => Ok(text),
            Self::ByLabels { by, texts } => {
                let labels = by.iter().map(|key| label(key));
                let labels = labels.collect::<anyhow::Result<Vec<_>>>()?.join(", ");
                let found = texts.get(&labels).or_else(|| texts.get(ELSE));
                let found = found.map(String::as_str);
                found.with_context(|| format!("nothing is given for {} {labels}", by.join(", ")))
            }
        }
    }

    /// All texts of the choice.
    pub(super) fn texts(&self) -> Vec<&str> {
        match self {
            Self::Always(text) => vec![text],
            Self::ByLabels { texts, .. } => texts.values().map(String::as_str).collect(),
        }
    }
}

/// A plot, or one for each of several labels.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Figure {
    /// Name of its file, without spaces, and title; with labels in braces.
    pub(super) name: String,
    pub(super) title: String,
    pub(super) axes: [String; 2],
    /// Labels by key. Each of them has a plot of its own.
    #[serde(default)]
    pub(super) each: BTreeMap<String, Vec<String>>,
    /// Texts for the title, by labels.
    #[serde(default)]
    pub(super) words: BTreeMap<String, Choice>,
    /// Labels of all runs of the plot.
    #[serde(default)]
    pub(super) labels: BTreeMap<String, String>,
    /// Lines whose points are expressions.
    #[serde(default)]
    pub(super) fixed: Vec<FixedLine>,
    /// Series of a table.
    #[serde(default)]
    pub(super) table: Vec<TableSeries>,
    /// Series of runs.
    pub(super) runs: Option<RunSeries>,
}

/// A dashed line.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FixedLine {
    pub(super) name: String,
    pub(super) points: Vec<[String; 2]>,
}

/// A series of the values of a table over the numbers of a key.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TableSeries {
    pub(super) name: String,
    /// File of the table.
    pub(super) file: String,
    /// Key of the numbers along x.
    pub(super) x: String,
    /// Labels of the rows, such as `law=pds, of=lattice`, with labels of the plot in braces.
    #[serde(default)]
    pub(super) of: String,
    pub(super) colour: String,
    #[serde(default)]
    pub(super) mark: FileMark,
    /// Whether the values are the known ones.
    #[serde(default)]
    pub(super) known: bool,
    /// Whether the numbers along x are subtracted from the values.
    #[serde(default)]
    pub(super) less_x: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum FileMark {
    #[default]
    Line,
    Curve,
    Circles,
    Dashes,
}

/// Series with a line for each label of a key.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RunSeries {
    /// Key of the lines, or several as in [`LabelExpansion`], its labels, and their name with the label in braces.
    pub(super) line: String,
    pub(super) lines: Vec<String>,
    pub(super) name: String,
    pub(super) colours: Vec<String>,
    /// Key of the numbers along x and its labels, with the value as an expression.
    pub(super) x: Option<String>,
    #[serde(default)]
    pub(super) xs: Vec<String>,
    pub(super) y: Option<String>,
    /// Label along x. The value there divides all values of its line.
    pub(super) over: Option<String>,
    /// The curve of a run: expressions of `displacement` and `reaction`.
    pub(super) curve: Option<[String; 2]>,
}

impl SettingsByLabels {
    /// The settings for given labels.
    pub(super) fn for_labels(
        &self,
        label: impl Fn(&str) -> anyhow::Result<String>,
    ) -> anyhow::Result<&Vec<String>> {
        let label = label(&self.by)?;
        let found = self
            .settings
            .get(&label)
            .or_else(|| self.settings.get(ELSE));
        found.with_context(|| format!("no settings are given for {} {label}", self.by))
    }
}
