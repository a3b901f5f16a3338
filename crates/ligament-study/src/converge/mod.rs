//! `ligament converge`: between which values the results of a case lie as its points become finer.
//!
//! The case is run on [bodies](self) at the sizes h and 2h (`bodies`, `lattices`, `displaced_nodes`), as a sweep over them whose study file is
//! written into the folder. Its results have [intervals](interval) of convergence (`evaluation`, `crack_paths`) but where they have no limit
//! (`no_limit`), which a
//! `report` tells.

mod bodies;
mod crack_paths;
mod displaced_nodes;
mod evaluation;
pub mod interval;
mod lattices;
mod no_limit;
mod report;

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use ligament_case::case::{Analysis, CaseFile};
use ligament_output::replace_file;
use ligament_run::progress::ProgressMode;

pub use bodies::MeshSource;
pub use evaluation::Evaluated;

use crate::sweep::plan;
use crate::sweep::study::Study;
use crate::sweep::toml_text::quoted;
use crate::sweep::{self, Task};
use bodies::{SizedBodies, SizedBody};
use evaluation::{Runs, SizedRun};
use no_limit::{NoLimit, no_limit};

/// Name of the study file in the folder.
const STUDY: &str = "study.toml";
const CASE: &str = "case.toml";

/// Factor on the horizon factor of runs with larger families: from the usual 3 to 4.
const MORE_BONDS: f64 = 4.0 / 3.0;

/// Smallest horizon factor at 2h for a fixed horizon.
const FEWEST_BONDS: f64 = 2.0;

/// Request for intervals of convergence.
#[derive(Debug, Clone)]
pub struct Request<'a> {
    /// The case.
    pub case: &'a CaseFile,
    /// Folder of the results; `results/NAME-converge` without it.
    pub out: Option<PathBuf>,
    /// Source of the meshes.
    pub source: MeshSource,
    /// Names of results; the usual ones without any.
    pub results: Vec<String>,
    /// Whether runs with larger families show the change with the number of bonds at the same horizon.
    pub families: bool,
    /// Whether both sizes have the same horizon.
    pub fixed_horizon: bool,
    /// Task for the planned runs.
    pub task: Task,
}

/// A body with the settings of a run, and whether its families are larger.
#[derive(Debug, Clone)]
struct PlannedRun<'a> {
    body: &'a SizedBody,
    label: String,
    settings: Vec<(String, String)>,
    has_more_bonds: bool,
}

/// Executes the request, with its output on `out`; returns the results with their intervals, but of a list or a shard.
///
/// # Errors
///
/// If the case is wrong or of a kind without intervals, a mesh cannot be made, or a run failed.
pub fn converge(
    request: &Request<'_>,
    out: &mut dyn Write,
) -> anyhow::Result<Option<Vec<Evaluated>>> {
    let case = request.case;
    require_limits(case)?;
    let path = match &request.out {
        Some(path) => path.clone(),
        None => Path::new("results").join(format!("{}-converge", case.name())),
    };
    let source = std::path::absolute(path.join(STUDY))?;
    let title = format!("Convergence of: {}", case.case.title);
    // A lattice is refused before anything is written.
    let lattices = match case.case.mesh {
        None => Some(lattices::lattices(case)?),
        Some(_) => None,
    };
    let folder = sweep::create_folder(&path, &source, &title)?;
    let bodies = match lattices {
        Some(bodies) => bodies,
        None => bodies::meshes(case, &request.source, &path, &mut request.print())?,
    };
    let bodies = bodies.with_note(request.fixed_horizon);
    let planned = planned_runs(case, &bodies, request)?;
    for (name, text) in [
        (CASE, case.resolved_toml()?),
        (STUDY, study_text(&title, breaks_in_plane(case), &planned)),
    ] {
        replace_file(&path.join(name), text.as_bytes())?;
    }
    let study = Study::load(&source)?;
    let no_limit = no_limits(&study, &path, request)?;
    let from = match &request.task {
        Task::Run(settings) => {
            sweep::run(&study, &path, settings, &mut io::sink())?;
            if settings.shard.is_some() {
                let collect = "their intervals: ligament converge --collect";
                writeln!(out, "  runs in {}; {collect}", path.display())?;
                return Ok(None);
            }
            &[][..]
        }
        Task::List => {
            let list = sweep::Request {
                study: source,
                out: Some(path),
                task: Task::List,
            };
            return sweep::sweep(&list, out).map(|()| None);
        }
        Task::Collect(from) => from,
    };
    let done = sweep::done_runs(&study, &path, from)?;
    let runs = runs_to_evaluate(case, &bodies, &planned, (done, no_limit));
    let results = runs.evaluate(&request.results)?;
    report::write(case, &runs, &results, folder.path(), out)?;
    Ok(Some(results))
}

impl Request<'_> {
    /// Display of the meshes that are made.
    fn print(&self) -> impl FnMut(&str) {
        let is_quiet =
            matches!(&self.task, Task::Run(settings) if settings.progress == ProgressMode::Quiet);
        move |line| {
            if !is_quiet {
                // A closed pipe must not end the study.
                let _ = writeln!(io::stderr(), "{line}");
            }
        }
    }
}

/// The results without a limit for the first body; prints them before any run.
fn no_limits(study: &Study, path: &Path, request: &Request<'_>) -> anyhow::Result<NoLimit> {
    let first = plan::runs(study, path)?.into_iter().next();
    let case = first.map_or_else(|| request.case.clone(), |run| run.case);
    let found = no_limit(&case, &case.setup(&mut ())?);
    found.show(&request.results, &mut request.print())?;
    Ok(found)
}

/// Refuses cases whose results have no interval of this kind.
fn require_limits(case: &CaseFile) -> anyhow::Result<()> {
    let sections = &case.case;
    let has_scatter = sections
        .fracture
        .as_ref()
        .is_some_and(|it| it.scatter.is_some());
    let (key, reason) = if sections.analysis == Some(Analysis::Motion) {
        (
            "analysis",
            "the rule of the intervals was tested on bodies at rest and their modes, not on motions: compare sizes by `ligament sweep`",
        )
    } else if has_scatter {
        (
            "fracture.scatter",
            "the result of one sample has no limit: `ligament ensemble` gives the statistics of many, and `--unset fracture.scatter` the body without",
        )
    } else if (sections.refine.as_ref()).is_some_and(|it| it.size.is_some()) {
        (
            "refine.size",
            "the meshes of both sizes would be equally fine at the crack: give `levels`, the number of times that the edges of each are halved there",
        )
    } else {
        return Ok(());
    };
    Err(case.error(key, reason).into())
}

/// The runs of the bodies, followed by those with larger families.
fn planned_runs<'a>(
    case: &CaseFile,
    bodies: &'a SizedBodies,
    request: &Request<'_>,
) -> anyhow::Result<Vec<PlannedRun<'a>>> {
    let model = &case.case.model;
    let (key, at_h) = match (model.horizon, model.horizon_factor) {
        (Some(length), _) => ("model.horizon", length),
        (None, factor) => ("model.horizon_factor", factor.unwrap_or(3.0)),
    };
    // A horizon factor scales the horizon with the spacing, a length does not.
    let at_2h = match (key, request.fixed_horizon) {
        ("model.horizon", false) => 2.0 * at_h,
        ("model.horizon_factor", true) => 0.5 * at_h,
        _ => at_h,
    };
    if key == "model.horizon_factor" && at_2h < FEWEST_BONDS {
        let reason = format!(
            "with the horizon of h the bodies of 2h have half of the factor, {at_2h}, and families are too small below {FEWEST_BONDS}: use \
             `--set model.horizon_factor={}`",
            2.0 * FEWEST_BONDS
        );
        return Err(case.error(key, reason).into());
    }
    let run = |body: &'a SizedBody, factor: f64, has_more_bonds: bool| {
        let horizon = factor * if body.is_fine { at_h } else { at_2h };
        let mut settings = body.settings.clone();
        settings.push((key.to_owned(), format!("{horizon:?}")));
        let label = if has_more_bonds {
            format!("{} more bonds", body.label)
        } else {
            body.label.clone()
        };
        PlannedRun {
            body,
            label,
            settings,
            has_more_bonds,
        }
    };
    let mut planned: Vec<PlannedRun<'_>> = bodies
        .bodies
        .iter()
        .map(|body| run(body, 1.0, false))
        .collect();
    if request.families {
        let fine = bodies.bodies.iter().filter(|body| body.is_fine);
        planned.extend(fine.map(|body| run(body, MORE_BONDS, true)));
    }
    Ok(planned)
}

/// Whether bonds of a body in the plane break in the case.
fn breaks_in_plane(case: &CaseFile) -> bool {
    case.case.fracture.is_some() && !case.case.is_solid()
}

/// Text of the study over the planned runs; `has_lines` says whether cracks are lines that can be drawn.
fn study_text(title: &str, has_lines: bool, planned: &[PlannedRun<'_>]) -> String {
    let list = |items: &mut dyn Iterator<Item = String>| {
        format!("[{}]", items.collect::<Vec<_>>().join(", "))
    };
    let mut text = format!("title = {}\ncase = {}\n", quoted(title), quoted(CASE));
    let keys = planned
        .first()
        .map(|run| list(&mut run.settings.iter().map(|(key, _)| quoted(key))));
    text += &format!(
        "\n[[axis]]\nkeys = {}\nvalues = [\n",
        keys.unwrap_or_default()
    );
    for run in planned {
        text += &format!(
            "  {},\n",
            list(&mut run.settings.iter().map(|(_, value)| value.clone()))
        );
    }
    let labels = list(&mut planned.iter().map(|run| quoted(&run.label)));
    text += &format!("]\nlabels = {labels}\n");
    if has_lines {
        text += "\n[[plot]]\nkind = \"crack-paths\"\n\n[[plot]]\nkind = \"curves\"\n";
    }
    text
}

/// The runs with the data for their intervals.
fn runs_to_evaluate<'a>(
    case: &CaseFile,
    bodies: &'a SizedBodies,
    planned: &[PlannedRun<'a>],
    (done, no_limit): (Vec<sweep::DoneRun>, NoLimit),
) -> Runs<'a> {
    let mut runs = Vec::new();
    let mut more_bonds = Vec::new();
    for (plan, done) in planned.iter().zip(done) {
        match plan.has_more_bonds {
            true => more_bonds.push(done.results),
            false => runs.push(SizedRun {
                body: plan.body,
                results: done.results,
                folder: done.folder,
            }),
        }
    }
    Runs {
        bodies,
        runs,
        more_bonds,
        no_limit,
        dimensions: if case.case.is_solid() { 3 } else { 2 },
        thickness: case.case.thickness().unwrap_or(1.0),
    }
}
