//! The runs of an entry, and the cache of their results.

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};

use anyhow::{Context, bail};

use super::document::{Choice, ExperimentFile, FileTable, LabelExpansion, Run};
use super::expression::{Expression, RunRow};
use super::quantity::{CURVE, RunResults, ensure_known};
use crate::case_run::CaseRun;
use crate::places::repository;
use crate::published::known_table;
use crate::table::{Labels, number};
use crate::uniform_stress::loads;

/// Placeholder for doubled braces while the others are filled: a character that no setting has.
const OPENING: &str = "\u{1}";
const CLOSING: &str = "\u{2}";

/// The runs of an entry or of a point of a plot, with the expression that combines their results.
pub(super) struct EntryRuns<'a> {
    file: &'a ExperimentFile,
    /// The run of the table, added to the run of the file.
    run: &'a Run,
    value: Expression,
    /// Labels of each run, by the beginning of their keys up to a comma.
    runs: Vec<BTreeMap<String, String>>,
    /// Command of each run, computed at first use.
    commands: Vec<OnceCell<String>>,
}

/// Meaning of a name in an expression for a run.
enum Meaning<'a> {
    Number(f64),
    Expression(Expression),
    Reference(EntryRuns<'a>),
    Quantity,
}

impl<'a> EntryRuns<'a> {
    /// The runs of an entry of a table.
    pub(super) fn for_entry(
        file: &'a ExperimentFile,
        table: &'a FileTable,
        labels: Labels<'_>,
    ) -> anyhow::Result<Self> {
        let of_entry: BTreeMap<String, String> = (labels.pairs())
            .map(|(key, label)| (name_of(key).to_owned(), label.to_owned()))
            .collect();
        let mut runs = vec![of_entry.clone()];
        for over in &table.over {
            let LabelExpansion {
                key,
                label,
                members,
            } = over;
            if of_entry.get(key).map_or("", String::as_str) != label {
                continue;
            }
            runs = combined_with_labels(&runs, key, members);
        }
        Self::new(file, &table.run, &table.value, runs)
    }

    /// Several runs by their labels; the labels of the first run select the expression of the value.
    pub(super) fn new(
        file: &'a ExperimentFile,
        run: &'a Run,
        value: &Choice,
        runs: Vec<BTreeMap<String, String>>,
    ) -> anyhow::Result<Self> {
        let text = value.for_labels(|key| label(&runs[0], key))?;
        let value = Expression::parse(&with_labels(text, &runs[0]))?;
        Ok(Self {
            file,
            run,
            value,
            commands: vec![OnceCell::new(); runs.len()],
            runs,
        })
    }

    /// The command of a run.
    fn command(&self, run: usize) -> anyhow::Result<&str> {
        if self.commands[run].get().is_none() {
            let command = self.case_run(run)?.command();
            return Ok(self.commands[run].get_or_init(|| command));
        }
        self.commands[run]
            .get()
            .map(String::as_str)
            .context("no command")
    }

    /// The case run of a run of the entry.
    pub(super) fn case_run(&self, run: usize) -> anyhow::Result<CaseRun> {
        let labels = &self.runs[run];
        let choice = |own: &'a Option<Choice>, of_file: &'a Option<Choice>| {
            let choice = own.as_ref().or(of_file.as_ref());
            let text = choice.map(|it| it.for_labels(|key| label(labels, key)));
            anyhow::Ok(text.transpose()?.map(|it| with_labels(it, labels)))
        };
        let case = choice(&self.run.case, &self.file.run.case)?.context("no `case` is named")?;
        let mut case_run = CaseRun::from_file(&case)?;
        let mesh = choice(&self.run.mesh, &self.file.run.mesh)?;
        if let Some(mesh) = mesh.filter(|it| !it.is_empty()) {
            case_run = case_run.on_mesh_file(repository().join("meshes").join(mesh));
        }
        let mut settings: Vec<&String> = Vec::new();
        for run in [&self.file.run, self.run] {
            settings.extend(&run.set);
            if let Some(by_label) = &run.set_by {
                settings.extend(by_label.for_labels(|key| label(labels, key))?);
            }
        }
        for setting in settings {
            let (key, value) = setting
                .split_once('=')
                .context("a setting is `key=value`")?;
            case_run = case_run.set_toml(key, &self.filled_setting(value, run, None)?);
        }
        for of in [&self.file.run, self.run] {
            if let Some(list) = &of.list {
                let items =
                    (0..list.count).map(|it| self.filled_setting(&list.item, run, Some(it)));
                let items = items.collect::<anyhow::Result<Vec<_>>>()?;
                case_run = case_run.set_toml(&list.key, &format!("[{}]", items.join(",")));
            }
            if let Some(stress) = &of.stress {
                let number = |text: &str| self.constant(text, run, None);
                let principal = stress.principal.for_labels(|key| label(labels, key))?;
                let principal = principal.split(';').map(number);
                let principal = principal.collect::<anyhow::Result<Vec<_>>>()?;
                case_run = case_run.set_toml("load", &loads(&principal, number(&stress.angle)?)?);
            }
        }
        Ok(case_run)
    }

    /// The value of an expression of labels and numbers of the file, which may contain the counter `item`.
    fn constant(&self, text: &str, run: usize, item: Option<usize>) -> anyhow::Result<f64> {
        let place = RunRow { run, row: None };
        Expression::parse(text)?.at(place, &mut |place, name| match item {
            Some(item) if name == "item" => Ok(item as f64),
            _ => self.number(place.run, name),
        })
    }

    /// A setting with braces replaced: in a text by labels, elsewhere by numbers. Doubled braces become single ones.
    fn filled_setting(
        &self,
        setting: &str,
        run: usize,
        item: Option<usize>,
    ) -> anyhow::Result<String> {
        let setting = setting.replace("{{", OPENING).replace("}}", CLOSING);
        let mut filled = String::new();
        let mut left = &*setting;
        while let Some((before, rest)) = left.split_once('{') {
            let (inner, after) = rest.split_once('}').context("a `}` is missing")?;
            filled.push_str(before);
            let is_in_text = filled.matches('"').count() % 2 == 1;
            if is_in_text {
                filled.push_str(&label(&self.runs[run], inner)?);
            } else {
                filled.push_str(&number_text(self.constant(inner, run, item)?));
            }
            left = after;
        }
        filled.push_str(left);
        Ok(filled.replace(OPENING, "{").replace(CLOSING, "}"))
    }

    /// The value of a name, which is a label or a number of the file.
    pub(super) fn number(&self, run: usize, name: &str) -> anyhow::Result<f64> {
        match self.meaning(run, name)? {
            Meaning::Number(number) => Ok(number),
            Meaning::Expression(expression) => {
                let place = RunRow { run, row: None };
                expression.at(place, &mut |place, name| self.number(place.run, name))
            }
            _ => bail!("no label and no number is called `{name}`"),
        }
    }

    fn meaning(&self, run: usize, name: &str) -> anyhow::Result<Meaning<'a>> {
        let labels = &self.runs[run];
        if let Some(choice) = self.file.numbers.get(name) {
            let text = with_labels(choice.for_labels(|key| label(labels, key))?, labels);
            let expression = Expression::parse(&text).with_context(|| format!("number `{name}`"));
            return Ok(Meaning::Expression(expression?));
        }
        if let Some(label) = labels.get(name) {
            return Ok(Meaning::Number(number(name, label)?));
        }
        if let Some(reference) = self.file.reference.get(name) {
            let mut labels = labels.clone();
            labels.extend(reference.labels.clone());
            if let Some(table) = &reference.known {
                return known_value(&with_labels(table, &labels), &labels).map(Meaning::Number);
            }
            let value = reference.value.as_ref();
            let value = value.with_context(|| format!("reference `{name}` has no `value`"))?;
            let run = reference.run.as_ref().unwrap_or(self.run);
            let runs = Self::new(self.file, run, value, vec![labels]);
            return Ok(Meaning::Reference(runs?));
        }
        Ok(match name {
            "pi" => Meaning::Number(std::f64::consts::PI),
            _ => Meaning::Quantity,
        })
    }
}

/// Labels of runs, each combined with all labels of one or several keys.
pub(super) fn combined_with_labels(
    runs: &[BTreeMap<String, String>],
    key: &str,
    labels: &[String],
) -> Vec<BTreeMap<String, String>> {
    let with = |run: &BTreeMap<String, String>, label: &String| {
        let labels = label.splitn(key.split(", ").count(), ", ");
        let pairs = key.split(", ").zip(labels);
        let pairs = pairs.map(|(key, label)| (key.to_owned(), label.to_owned()));
        run.clone().into_iter().chain(pairs).collect()
    };
    let all = runs.iter();
    all.flat_map(|run| labels.iter().map(move |label| with(run, label)))
        .collect()
}

/// Name of a key in expressions: the part before a comma and its unit.
fn name_of(key: &str) -> &str {
    key.split(',').next().unwrap_or(key)
}

/// The known value of the entry of a table with given labels.
fn known_value(table: &str, labels: &BTreeMap<String, String>) -> anyhow::Result<f64> {
    let known = known_table(table)?;
    let keys = known
        .heading
        .keys
        .iter()
        .map(|key| labels.get(name_of(key)));
    let wanted: Option<Vec<&String>> = keys.collect();
    let wanted = wanted.with_context(|| format!("{table}: no labels for all of its keys"))?;
    let mut entries = known.entries.iter();
    let entry = entries.find(|it| it.labels.iter().eq(wanted.iter().copied()));
    Ok(entry
        .with_context(|| format!("{table} has no {wanted:?}"))?
        .known
        .value())
}

/// The label of a key.
fn label(labels: &BTreeMap<String, String>, key: &str) -> anyhow::Result<String> {
    let known = || labels.keys().cloned().collect::<Vec<_>>().join(", ");
    let found = labels.get(key).cloned();
    found.with_context(|| format!("no label `{key}`; labels: {}", known()))
}

/// A text with the names in braces replaced by labels.
pub(super) fn with_labels(text: &str, labels: &BTreeMap<String, String>) -> String {
    labels.iter().fold(text.to_owned(), |filled, (key, label)| {
        filled.replace(&format!("{{{key}}}"), label)
    })
}

/// A number as TOML has it; a whole one without a point, as lattices count their cells.
fn number_text(number: f64) -> String {
    let whole = number.round();
    if (number - whole).abs() < 1e-9 * whole.abs().max(1.0) && whole.abs() < 1e9 {
        format!("{whole}")
    } else {
        format!("{number:?}")
    }
}

/// Results of all runs of an experiment, by their commands: equal commands give equal results.
#[derive(Default)]
pub(super) struct RunCache {
    /// Quantities to read from each run.
    wanted: BTreeMap<String, BTreeSet<String>>,
    found: BTreeMap<String, RunResults>,
}

impl RunCache {
    /// Notes the quantities that the value of some runs needs, so that each run is read only once.
    pub(super) fn plan(&mut self, runs: &EntryRuns<'_>) -> anyhow::Result<()> {
        (0..runs.runs.len()).try_for_each(|run| self.plan_names(runs, run, &runs.value))
    }

    fn plan_names(
        &mut self,
        runs: &EntryRuns<'_>,
        run: usize,
        expression: &Expression,
    ) -> anyhow::Result<()> {
        for name in expression.names() {
            match runs.meaning(run, name)? {
                Meaning::Number(_) => {}
                Meaning::Expression(expression) => self.plan_names(runs, run, &expression)?,
                Meaning::Reference(other) => self.plan(&other)?,
                Meaning::Quantity => {
                    ensure_known(name)?;
                    self.request_quantity(runs, run, name)?;
                }
            }
        }
        Ok(())
    }

    /// Notes that the curve of a run is needed.
    pub(super) fn plan_curve(&mut self, runs: &EntryRuns<'_>) -> anyhow::Result<()> {
        self.request_quantity(runs, 0, CURVE)
    }

    fn request_quantity(
        &mut self,
        runs: &EntryRuns<'_>,
        run: usize,
        name: &str,
    ) -> anyhow::Result<()> {
        let wanted = self.wanted.entry(runs.command(run)?.to_owned());
        wanted.or_default().insert(name.to_owned());
        Ok(())
    }

    /// The combined value of some runs.
    pub(super) fn value(&mut self, runs: &EntryRuns<'_>) -> anyhow::Result<f64> {
        let all = 0..runs.runs.len();
        (runs.value).value(all, &mut |place, name| {
            self.value_of_name(runs, place, name)
        })
    }

    fn value_of_name(
        &mut self,
        runs: &EntryRuns<'_>,
        place: RunRow,
        name: &str,
    ) -> anyhow::Result<f64> {
        match runs.meaning(place.run, name)? {
            Meaning::Number(number) => Ok(number),
            Meaning::Expression(expression) => expression.at(place, &mut |place, name| {
                self.value_of_name(runs, place, name)
            }),
            Meaning::Reference(other) => self.value(&other),
            Meaning::Quantity => self.results(runs, place.run)?.value(name, place.row),
        }
    }

    /// The curve of displacement and load of a run, m and N.
    pub(super) fn curve(&mut self, runs: &EntryRuns<'_>) -> anyhow::Result<Vec<[f64; 2]>> {
        Ok(self.results(runs, 0)?.curve.clone())
    }

    fn results(&mut self, runs: &EntryRuns<'_>, run: usize) -> anyhow::Result<&RunResults> {
        let command = runs.command(run)?;
        if !self.found.contains_key(command) {
            let wanted = self.wanted.get(command).cloned().unwrap_or_default();
            let number = |name: &str| runs.number(run, name);
            let case_run = runs.case_run(run)?;
            let results = RunResults::from_case_run(&case_run, &wanted, &number)?;
            self.found.insert(command.to_owned(), results);
        }
        self.found.get(command).context("the run has no results")
    }
}
