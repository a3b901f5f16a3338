//! `ligament ensemble`: samples of a case whose strength or fracture energy varies at random.
//!
//! All samples share the body, its corrections and its intact factor ([`ligament::ensemble`]). A folder has an identity (`identity`): the case,
//! the seed and the displacements at which curves are compared (`grid`). Samples are stored in parts (`part`), one of each shard, as rows (`row`)
//! and counts at the points of the body, whose size does not grow with the samples; locks, shards and progress work as in every
//! [table of runs](crate::run_table). The samples of all parts (`collected`) become tables, fields and plots (`report`).

mod collected;
mod grid;
mod identity;
mod part;
mod plots;
mod report;
mod request;
mod row;

use std::collections::BTreeSet;
use std::fs;
use std::io::Write;
use std::slice;

use anyhow::bail;
use ligament::ensemble::{Ensemble, Sample};
use ligament::run::on_threads;
use ligament_output::{remove_if_there, replace_file};
use ligament_run::end::End;
use ligament_run::model::build_model;
use ligament_run::progress::{Progress, ProgressMode};
use ligament_run::stability;
use ligament_run::stages::Stages;

use crate::run_table::folder::{Shard, StudyFolder};
use crate::run_table::progress::ProgressDisplay;
use collected::CollectedSamples;
use identity::{Identity, MARKER};
use part::{PARTS, Part};
pub use request::{Request, Settings, Task};

/// Executes the request, with its output on `out`; returns whether it was done or stopped.
///
/// # Errors
///
/// If the case is wrong or has nothing that varies at random, the folder is of another ensemble or in use, or a sample cannot be followed.
pub fn ensemble(request: &Request<'_>, out: &mut dyn Write) -> anyhow::Result<End> {
    match &request.task {
        Task::Run(settings) => run(request, settings, out),
        Task::Collect(from) => {
            let folders = StudyFolder::folders_to_collect(MARKER, request.out, from)?;
            for folder in &folders {
                Identity::for_request(folder, request)?;
            }
            let marker = Identity::from_folder(&folders[0])?.text()?;
            let to =
                StudyFolder::with_marker(MARKER, request.out).create_or_open(&marker, &[PARTS])?;
            report(request, &folders, &to, out)?;
            Ok(End::Done)
        }
    }
}

/// Computes the missing samples, and writes the tables and plots unless the samples are a shard.
fn run(request: &Request<'_>, settings: &Settings, out: &mut dyn Write) -> anyhow::Result<End> {
    let threads = request.case.threads();
    let ensemble = on_threads(threads, || prepare_ensemble(request))??;
    let found = StudyFolder::with_marker(MARKER, request.out);
    let identity = match found.is_marked() && !settings.force {
        true => Identity::for_request(&found, request)?,
        false => on_threads(threads, || Identity::new(request, &ensemble))??,
    };
    // Nothing is written before the case is checked.
    let folder = found.create_or_open(&identity.text()?, &[PARTS])?;
    let _claim = folder.claim(settings.shard)?;
    if settings.force {
        begin_anew(&folder, &identity)?;
    }
    // Another shard may have begun the folder meanwhile.
    let identity = Identity::for_request(&folder, request)?;
    let parts = part::stored(&folder, identity.grid)?;
    let rows = parts.iter().flat_map(|part| &part.rows);
    let done: BTreeSet<u64> = rows.map(|row| row.sample).collect();
    let todo = (0..request.samples).filter(|it| Shard::contains(settings.shard, *it as usize));
    let todo: Vec<u64> = todo.filter(|it| !done.contains(it)).collect();
    let end = match todo.as_slice() {
        [] => End::Done,
        todo => {
            let name = Shard::file_name(settings.shard, "whole");
            let part = Part::open(&folder, &name, identity.grid, &ensemble)?;
            compute(request, settings, &ensemble, part, todo)?
        }
    };
    match (end, settings.shard) {
        (End::Stopped, _) => writeln!(out, "stopped; the same command goes on")?,
        (_, None) => report(request, slice::from_ref(&folder), &folder, out)?,
        (_, Some(Shard { number, count })) => writeln!(
            out,
            "shard {number} of {count} is done; tables and plots of all: ligament ensemble --collect"
        )?,
    }
    Ok(end)
}

/// The ensemble of the case, ready for samples.
fn prepare_ensemble(request: &Request<'_>) -> anyhow::Result<Ensemble> {
    let case = request.case;
    let quiet = Progress::new(ProgressMode::Quiet);
    let model = build_model(case, &mut Stages::default(), &quiet)?;
    let ensemble =
        Ensemble::new(model, request.seed).map_err(|error| case.error_in_case_terms(error))?;
    match ensemble.refused() {
        Some(end) => bail!(
            "no sample has a result: {}",
            stability::end_text(&end, ensemble.model())
        ),
        None => Ok(ensemble),
    }
}

/// Removes stored samples and writes the new identity of the folder.
fn begin_anew(folder: &StudyFolder, identity: &Identity) -> anyhow::Result<()> {
    for entry in fs::read_dir(folder.path().join(PARTS))? {
        remove_if_there(&entry?.path())?;
    }
    let text = identity.text()?;
    Ok(replace_file(&folder.path().join(MARKER), text.as_bytes())?)
}

/// Computes samples and stores them in the part of this process.
fn compute(
    request: &Request<'_>,
    settings: &Settings,
    ensemble: &Ensemble,
    mut part: Part<'_>,
    todo: &[u64],
) -> anyhow::Result<End> {
    let template = "{pos}/{len} samples [{bar:24}] {elapsed} so far, {eta} to go";
    let mut progress = ProgressDisplay::new(settings.progress, todo.len(), template);
    let threads = request.threads();
    let workers = settings.jobs.unwrap_or(threads).min(todo.len());
    let at_once = [workers, (threads / workers).max(1)];
    let added = ensemble.for_each(todo, at_once, |sample: Sample| {
        part.add(&sample).map_err(SampleFault::Stored)?;
        progress.count();
        progress.print_tenth("samples");
        match (request.is_stopped)() {
            true => Err(SampleFault::Stopped),
            false => Ok(()),
        }
    });
    progress.finish();
    // Samples computed before a fault are kept.
    part.store()?;
    match added {
        Ok(()) => Ok(End::Done),
        Err(SampleFault::Stopped) => Ok(End::Stopped),
        Err(SampleFault::Sample(error)) => Err(request.case.error_in_case_terms(error)),
        Err(SampleFault::Stored(error)) => Err(error),
    }
}

/// Reason why no further sample is computed.
enum SampleFault {
    /// Error of a sample.
    Sample(ligament::Error),
    /// Error of the folder.
    Stored(anyhow::Error),
    /// The user wants to stop.
    Stopped,
}

impl From<ligament::Error> for SampleFault {
    fn from(error: ligament::Error) -> Self {
        Self::Sample(error)
    }
}

/// Writes the tables and plots of the samples of several folders into one folder.
fn report(
    request: &Request<'_>,
    folders: &[StudyFolder],
    to: &StudyFolder,
    out: &mut dyn Write,
) -> anyhow::Result<()> {
    let identity = Identity::from_folder(to)?;
    let mut parts = Vec::new();
    for folder in folders {
        anyhow::ensure!(
            Identity::from_folder(folder)?.has_same_samples(&identity),
            "the samples in {} are of another ensemble than those in {}",
            folder.path().display(),
            to.path().display()
        );
        parts.extend(part::stored(folder, identity.grid)?);
    }
    let collected = CollectedSamples::from_parts(parts, &identity)?;
    report::write(request, &identity, &collected, to.path(), out)
}
