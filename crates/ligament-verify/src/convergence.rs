//! Coverage of the intervals of convergence: how many contain the limit of their result.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use anyhow::Context;
use ligament_case::case::CaseFile;
use ligament_run::progress::ProgressMode;
use ligament_study::converge::{Evaluated, MeshSource, Request, converge};
use ligament_study::sweep::{Settings, Task};
use serde::Deserialize;

use super::experiment::{Compute, Experiment, Findings};
use super::places::repository;
use super::published::{folder, known_table};
use super::table::{Extent, Labels};

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "converge",
    title: "Intervals of convergence and the limits of their results",
    source: "closed forms, finite elements with a cohesive crack, else the mean of both meshers at a size 2 or 4 times finer",
    setup: "`ligament converge` at several sizes h on problems of its geometries: two meshers at h and 2h each. Place is the target less the \
            middle of the interval over its half-width, between -1 and 1 inside; width is the half-width over the target, %. Share is the \
            percentage of the intervals that contain their target.",
    cases: &[],
    compute: Compute::Code(compute),
};

/// Label that stands for all problems.
const ALL: &str = "all";

/// A problem of the table.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Problem {
    /// Case file, from the root of the repository.
    case: PathBuf,
    /// Geometry, from the folder of meshes; without one the cells of the mesh are split, or the body is a lattice.
    geometry: Option<String>,
    /// Numbers of the geometry for sizes, m, at the relative size 1.
    #[serde(default)]
    sizes: BTreeMap<String, f64>,
    /// Other numbers of the geometry.
    #[serde(default)]
    numbers: BTreeMap<String, f64>,
    /// Settings that replace values of the case.
    #[serde(default)]
    set: Vec<String>,
}

/// The results of problems at their sizes.
#[derive(Default)]
struct Intervals {
    problems: BTreeMap<String, Problem>,
    /// Results by problem and size.
    known: BTreeMap<(String, String), Vec<Evaluated>>,
    /// Relative positions of the targets in all intervals so far.
    places: Vec<f64>,
}

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let file = folder().join("../../experiments/convergence.toml");
    let text = std::fs::read_to_string(&file).with_context(|| file.display().to_string())?;
    let mut intervals = Intervals {
        problems: toml::from_str(&text).with_context(|| file.display().to_string())?,
        ..Intervals::default()
    };
    let table = known_table("converge")?.judge(extent, |labels| intervals.value(labels))?;
    Ok(Findings {
        tables: vec![table],
        ..Findings::default()
    })
}

impl Intervals {
    /// The value of an entry.
    fn value(&mut self, labels: Labels<'_>) -> anyhow::Result<f64> {
        let [problem, result, size, of] =
            ["problem", "result", "size", "of"].map(|key| labels.text(key));
        let (problem, result, size, of) = (problem?, result?, size?, of?);
        if problem == ALL {
            let inside = self.places.iter().filter(|place| place.abs() <= 1.0);
            return Ok(100.0 * inside.count() as f64 / self.places.len() as f64);
        }
        let target = labels.number("target")?;
        let key = (problem.to_owned(), size.to_owned());
        if !self.known.contains_key(&key) {
            let problem = self.problems.get(problem);
            let problem = problem.context("experiments/convergence.toml has no such problem")?;
            let found = problem.intervals(labels.number("size")?)?;
            self.known.insert(key.clone(), found);
        }
        let results = self.known[&key].iter();
        let mut named = results.filter(|it| it.name == result);
        let found = named.next().context("no such result")?;
        let interval = found.interval.with_context(|| {
            format!("refused: {}", found.refused.as_deref().unwrap_or_default())
        })?;
        let half = 0.5 * (interval.upper - interval.lower);
        let place = (target - 0.5 * (interval.upper + interval.lower)) / half;
        if of == "half-width, %" {
            return Ok(100.0 * half / target.abs());
        }
        self.places.push(place);
        Ok(place)
    }
}

impl Problem {
    /// The results at a size, relative to the sizes of the problem.
    fn intervals(&self, size: f64) -> anyhow::Result<Vec<Evaluated>> {
        let mut settings = self.set.clone();
        settings.push("solver.threads=1".to_owned());
        let case = CaseFile::load(&repository().join(&self.case), &settings)?;
        let place = tempfile::tempdir().context("no folder for temporary results")?;
        let geometry = self.geometry.as_ref();
        let sizes = self
            .sizes
            .iter()
            .map(|(name, it)| (name.clone(), size * it));
        let others = self.numbers.iter().map(|(name, it)| (name.clone(), *it));
        let request = Request {
            case: &case,
            out: Some(place.path().join("converge")),
            source: MeshSource {
                geometry: geometry.map(|it| repository().join(Path::new("meshes")).join(it)),
                numbers: sizes.chain(others).collect(),
                size: None,
                split: geometry.is_none(),
                gmsh: "gmsh".into(),
            },
            results: Vec::new(),
            families: false,
            fixed_horizon: false,
            task: Task::Run(Settings {
                shard: None,
                jobs: Some(1),
                memory: None,
                force: false,
                gmsh: "gmsh".into(),
                progress: ProgressMode::Quiet,
                program: Vec::new(),
            }),
        };
        converge(&request, &mut io::sink())?.context("no results")
    }
}
