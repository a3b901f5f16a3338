//! The runs of a study: all combinations of the values of its axes, each with a name and a checked case.

use std::path::{Path, PathBuf};

use super::axis::{Axis, AxisPoint, Setting, short_words};
use super::error::StudyError;
use super::meshes::MeshPlan;
use super::study::Study;
use super::toml_text::quoted;
use ligament_case::case::key_path::KeyPath;
use ligament_case::case::{CaseError, CaseFile, Location};
use ligament_case::input_file;
use ligament_run::inputs::{FileIdentities, Inputs};

/// Subfolder of the meshes that are made for a study.
pub(crate) const MESHES: &str = "meshes";

/// Largest number of runs of a study.
const MOST_RUNS: usize = 100_000;

/// Longest name of a run, bytes: file systems allow 255, and derived names are longer.
const LONGEST_NAME: usize = 200;

/// Longest part for a value in the name of a run, bytes.
const LONGEST_LABEL: usize = 48;

/// A run of a study.
#[derive(Debug, Clone)]
pub struct Run {
    /// Name of the run and of its folder, which depends only on the values of the run.
    pub name: String,
    /// Index of the run's value on each axis.
    pub place: Vec<usize>,
    /// Settings of the run on the base case, `key=value` each.
    pub overrides: Vec<String>,
    /// Case of the run, checked.
    pub case: CaseFile,
    /// Mesh to be made for the run, if any.
    pub mesh: Option<MeshPlan>,
    /// Inputs that determine the results.
    pub inputs: Inputs,
}

impl Run {
    /// The value of the run on each axis.
    pub fn points<'a>(
        &'a self,
        study: &'a Study,
    ) -> impl Iterator<Item = (&'a Axis, &'a AxisPoint)> {
        points(study, &self.place)
    }

    /// Description of the run's values: "horizon_factor = 2.5, file = 4 mm".
    pub fn words(&self, study: &Study) -> String {
        let keys = short_keys(&study.axes);
        let parts = self.points(study).zip(&keys);
        let parts = parts.flat_map(|((axis, point), keys)| parts_of(axis, point, keys));
        let words = parts.map(|(key, label)| format!("{key} = {label}"));
        words.collect::<Vec<_>>().join(", ")
    }
}

/// Keys and texts that identify a value of an axis: each key with its value, or the first key with the label.
fn parts_of<'a>(
    axis: &'a Axis,
    point: &'a AxisPoint,
    keys: &'a [String],
) -> impl Iterator<Item = (&'a str, String)> {
    let shown = if axis.is_labelled { 1 } else { keys.len() };
    let label = |cell| match axis.is_labelled {
        true => point.label.clone(),
        false => short_words(cell),
    };
    let cells = keys.iter().zip(&point.cells).take(shown);
    cells.map(move |(key, cell)| (key.as_str(), label(cell)))
}

/// Lists the runs of a study, with the last axis varying fastest, and checks the case of each; `folder` is the folder of the study.
///
/// # Errors
///
/// If there are too many runs, or the case of one is wrong, with the responsible position in the study.
pub fn runs(study: &Study, folder: &Path) -> Result<Vec<Run>, StudyError> {
    let sizes = study.axes.iter().map(|axis| axis.points.len());
    let total = sizes.fold(1, usize::saturating_mul);
    if total > MOST_RUNS {
        return Err(StudyError::TooMany {
            path: study.source.path.clone(),
            runs: total,
            most: MOST_RUNS,
        });
    }
    let text = input_file::read_text(&study.case).map_err(|source| CaseError::Read {
        path: study.case.clone(),
        source,
    })?;
    let mut planning = Planning {
        study,
        text,
        names: names(&study.axes),
        meshes: folder.join(MESHES),
        contents: FileIdentities::default(),
    };
    let run = |number| planning.run(place(&study.axes, number));
    (0..total).map(run).collect()
}

/// Index of the value on each axis for a run's index.
fn place(axes: &[Axis], number: usize) -> Vec<usize> {
    let mut rest = number;
    let mut place: Vec<usize> = (axes.iter().rev())
        .map(|axis| {
            let index = rest % axis.points.len();
            rest /= axis.points.len();
            index
        })
        .collect();
    place.reverse();
    place
}

/// Data common to all runs of a study, for their plan.
struct Planning<'a> {
    study: &'a Study,
    /// Text of the base case.
    text: String,
    /// Part of each value of each axis in the names of runs, shape (n_axes, n_values).
    names: Vec<Vec<String>>,
    /// Folder of the meshes to be made.
    meshes: PathBuf,
    contents: FileIdentities,
}

impl Planning<'_> {
    /// The run with the values of these indices on the axes.
    fn run(&mut self, place: Vec<usize>) -> Result<Run, StudyError> {
        let study = self.study;
        let name = shortened_name(self.name(&place, |_| true), LONGEST_NAME);
        let mut settings = study.settings.clone();
        let of_case = points(study, &place).filter(|(axis, _)| !axis.of_geometry);
        settings.extend(of_case.flat_map(|(axis, point)| axis.settings(point)));
        let mesh = match &study.geometry {
            None => None,
            Some(geometry) => {
                let plan = self.mesh(geometry, &place)?;
                settings.push(Setting {
                    given: format!("mesh.file={}", quoted(&plan.request.out.to_string_lossy())),
                    place: key("geometry"),
                });
                Some(plan)
            }
        };
        let overrides: Vec<String> = settings.iter().map(|it| it.given.clone()).collect();
        let case = CaseFile::parse(&study.case, self.text.clone(), &overrides)
            .map_err(|error| error_at_study_value(study, &name, &settings, error))?;
        let content = mesh.as_ref().map(|plan| plan.content.as_str());
        let inputs = Inputs::from_case(&case, content, &mut self.contents);
        let inputs = inputs.map_err(|(path, source)| {
            let file = path.file_name().unwrap_or_default().to_string_lossy();
            StudyError::Input {
                location: last(study, &settings, |it| it.given.contains(&*file)),
                run: name.clone(),
                path: path.clone(),
                source,
            }
        })?;
        Ok(Run {
            name,
            place,
            overrides,
            case,
            mesh,
            inputs,
        })
    }

    /// Name of the values of these indices on some of the axes.
    fn name(&self, place: &[usize], is_named: impl Fn(&Axis) -> bool) -> String {
        let axes = self.study.axes.iter().zip(&self.names).zip(place);
        let named = axes.filter(|((axis, _), _)| is_named(axis));
        let parts: Vec<&str> = named.map(|((_, names), &k)| names[k].as_str()).collect();
        parts.join(",")
    }

    /// The mesh of a geometry with the numbers of a run.
    fn mesh(&mut self, geometry: &Path, place: &[usize]) -> Result<MeshPlan, StudyError> {
        let study = self.study;
        let of_geometry = points(study, place).filter(|(axis, _)| axis.of_geometry);
        let numbers = of_geometry.filter_map(|(axis, point)| {
            let key = axis.keys.first()?.clone();
            Some((key, point.cells.first()?.as_f64()?))
        });
        let name = self.name(place, |axis| axis.of_geometry);
        let content = self.contents.identity(geometry);
        let content = content.map_err(|source| StudyError::Input {
            location: study.location(&key("geometry")),
            run: shortened_name(name.clone(), LONGEST_NAME),
            path: geometry.to_owned(),
            source,
        })?;
        let content = content.to_string();
        Ok(MeshPlan::new(
            geometry,
            numbers.collect(),
            &self.meshes,
            &name,
            &content,
        ))
    }
}

/// The values of these indices on the axes of a study.
fn points<'a>(
    study: &'a Study,
    place: &'a [usize],
) -> impl Iterator<Item = (&'a Axis, &'a AxisPoint)> {
    let axes = study.axes.iter().zip(place);
    axes.map(|(axis, &index)| (axis, &axis.points[index]))
}

fn key(name: &str) -> KeyPath {
    KeyPath(vec![name.to_owned()])
}

/// Location in the study of the last setting that satisfies a condition, or else of the case.
fn last(study: &Study, settings: &[Setting], is_it: impl Fn(&Setting) -> bool) -> Location {
    let found = settings.iter().rfind(|it| is_it(it));
    study.location(&found.map_or_else(|| key("case"), |it| it.place.clone()))
}

/// The error of a case, at the responsible value of the study, or unchanged where the case file itself is wrong.
fn error_at_study_value(
    study: &Study,
    run: &str,
    settings: &[Setting],
    source: CaseError,
) -> StudyError {
    let given = match &source {
        CaseError::Override { given, .. }
        | CaseError::Key {
            location: Location::Override { given },
            ..
        } => given,
        _ => return source.into(),
    };
    StudyError::Run {
        location: last(study, settings, |it| it.given == *given),
        run: run.to_owned(),
        source: Box::new(source),
    }
}

/// Part of each value of each axis in the names of runs, `horizon_factor=2.5`; shape (n_axes, n_values).
fn names(axes: &[Axis]) -> Vec<Vec<String>> {
    let keys = short_keys(axes);
    let of_axis = |(axis, keys): (&Axis, &Vec<String>)| {
        let name = |point| {
            let parts = parts_of(axis, point, keys);
            let parts = parts.map(|(key, label)| {
                safe_file_name(key) + "=" + &shortened_name(safe_file_name(&label), LONGEST_LABEL)
            });
            parts.collect::<Vec<_>>().join(",")
        };
        let names: Vec<String> = axis.points.iter().map(name).collect();
        let clashes = |name: &String| {
            names
                .iter()
                .filter(|it| it.eq_ignore_ascii_case(name))
                .count()
                > 1
        };
        let unique = |(point, name): (&AxisPoint, &String)| match clashes(name) {
            // Labels that differ only in letters without a distinction in file names get a digest.
            true => format!("{name}~{:08x}", digest(&point.label) as u32),
            false => name.clone(),
        };
        axis.points.iter().zip(&names).map(unique).collect()
    };
    axes.iter().zip(&keys).map(of_axis).collect()
}

/// Shortest unique and meaningful ending of each key of each axis; shape (n_axes, n_keys).
pub(super) fn short_keys(axes: &[Axis]) -> Vec<Vec<String>> {
    let path = |key: &String| KeyPath::parse(key).unwrap_or_default().0;
    let paths: Vec<Vec<String>> = axes.iter().flat_map(|axis| &axis.keys).map(path).collect();
    let end = |path: &[String], parts: usize| path[path.len().saturating_sub(parts)..].join(".");
    // A number or a single letter is not meaningful: `displacement.y` instead of `y`.
    let least = |path: &[String]| {
        let says = |part: &&String| part.chars().count() > 1 && part.parse::<usize>().is_err();
        let silent = path.iter().rev().take_while(|part| !says(part)).count();
        (silent + 1).min(path.len())
    };
    let name = |path: Vec<String>| {
        let others = || paths.iter().filter(|other| **other != path);
        let differs =
            |parts: &usize| others().all(|other| end(other, *parts) != end(&path, *parts));
        let parts = (least(&path)..=path.len()).find(differs);
        end(&path, parts.unwrap_or(path.len()))
    };
    let of_axis = |axis: &Axis| axis.keys.iter().map(|key| name(path(key))).collect();
    axes.iter().map(of_axis).collect()
}

/// A text with unsafe characters of file names replaced by underscores.
pub(super) fn safe_file_name(text: &str) -> String {
    let letter = |letter: char| match letter {
        'a'..='z' | 'A'..='Z' | '0'..='9' | '.' | '-' | '_' | '+' => letter,
        _ => '_',
    };
    text.trim().chars().map(letter).collect()
}

/// A name (of safe letters) of at most `longest` bytes; a longer name is truncated and ends in a digest.
fn shortened_name(name: String, longest: usize) -> String {
    if name.len() <= longest {
        return name;
    }
    let mark = format!("~{:016x}", digest(&name));
    let keep = longest - mark.len();
    name.chars().take(keep).collect::<String>() + &mark
}

/// Hash of a text.
fn digest(text: &str) -> u64 {
    twox_hash::XxHash64::oneshot(0, text.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    use serde_json::json;

    fn axis(key: &str, labels: &[&str]) -> Axis {
        let point = |label: &&str| AxisPoint {
            cells: vec![json!(label)],
            texts: vec![quoted(label)],
            label: (*label).to_owned(),
            place: KeyPath::default(),
        };
        Axis {
            keys: vec![key.to_owned()],
            of_geometry: false,
            is_labelled: true,
            points: labels.iter().map(point).collect(),
        }
    }

    #[test]
    fn the_last_axis_varies_fastest() {
        let axes = [axis("a", &["1", "2"]), axis("b", &["1", "2", "3"])];
        let places: Vec<Vec<usize>> = (0..6).map(|number| place(&axes, number)).collect();
        assert_eq!(places, [[0, 0], [0, 1], [0, 2], [1, 0], [1, 1], [1, 2]]);
    }

    #[test]
    fn names_are_short_and_say_what_varies() {
        let axes = [
            axis("model.horizon_factor", &["2.5"]),
            axis("mesh.file", &["4 mm"]),
            axis("load.0.displacement.y", &["-1e-4"]),
            axis("support.1.displacement.y", &["0.0"]),
            axis("precrack.0.points.1.0", &["3"]),
        ];
        let keys = short_keys(&axes).concat();
        assert_eq!(keys[0], "horizon_factor");
        assert_eq!(keys[1], "file");
        assert_eq!(keys[2], "0.displacement.y");
        assert_eq!(keys[3], "1.displacement.y");
        assert_eq!(keys[4], "points.1.0");
        assert_eq!(names(&axes)[1], ["file=4_mm"]);
    }

    #[test]
    fn labels_that_file_systems_confuse_are_told_apart() {
        let long = "x".repeat(300);
        let axes = [axis("a", &["p/q", "p_q", "P_q", "é", "ü", "r", &long])];
        let names = &names(&axes)[0];
        let lower: BTreeSet<String> = names.iter().map(|name| name.to_lowercase()).collect();
        assert_eq!(lower.len(), names.len(), "{names:?}");
        assert_eq!(names[5], "a=r");
        assert!(
            names.iter().all(|name| name.len() <= LONGEST_LABEL + 2),
            "{names:?}"
        );
        assert!(
            names
                .iter()
                .all(|name| name.is_ascii() && !name.contains('/'))
        );
        // Without its neighbours a label keeps its name, unless a digest distinguished it from one of them.
        assert_eq!(super::names(&[axis("a", &["r"])])[0], ["a=r"]);
    }
}
