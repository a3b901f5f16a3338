//! `ligament calibrate`: the value of a key with which a result equals a target.
//!
//! The strength of bonds in a case is not a constant of the material: with the same value the peak load grows with the horizon factor
//! lambda (NHPD eq. 22: by (3 lambda - 1)/8 on the mesh of the paper). The peak load of a specimen of known strength calibrates it for a
//! horizon and a mesh.

mod known_result;
pub mod line;
mod record;
mod request;
pub mod search;

use std::io::Write;

use anyhow::Context;

use crate::quantities::Quantities;
use ligament_case::case::{Analysis, CaseError, CaseFile, Fault};
use ligament_run::inputs::{FileIdentities, Inputs, unreadable_file};
use ligament_run::progress::ProgressMode;
use ligament_run::run;
use record::{Record, Run};
use request::setting;
pub use request::{CalibrationError, Request};
use search::{Next, Search, Trial, Verdict};

/// Relative width of a bracket at which a remaining difference of the result is a jump.
pub const RESOLUTION: f64 = 1e-3;

/// Runs a case with successive values of the key until the result meets the target or the search ends; reports each run on `progress` and
/// the end on `out`.
///
/// # Errors
///
/// If the case or the request is wrong, a run fails, the result does not exist, or the target cannot be met. The record always has all
/// runs.
pub fn calibrate(
    request: &Request,
    progress: &mut dyn Write,
    out: &mut dyn Write,
) -> anyhow::Result<()> {
    let search = search_of(request)?;
    // Errors of the case and of the key are found before anything is written.
    let case = case_with(request, search.start)?;
    if case.case.refine.is_some() {
        let reason = "each run of a calibration would have meshes of its own, whose scatter the search would follow: remove it, and take the `mesh.msh` of \
                      a refined run";
        return Err(case.error("refine", reason).into());
    }
    known_result::check(&request.of, case.case.analysis == Some(Analysis::Modal))
        .map_err(|source| CalibrationError::UnknownResult(request.of.clone(), source))?;
    let inputs =
        Inputs::from_case(&case, None, &mut FileIdentities::default()).map_err(unreadable_file)?;
    let mut record = Record::open(request, &inputs)?;
    writeln!(progress, "{}", record.heading())?;
    for run in record.runs() {
        writeln!(
            progress,
            "{} (from an earlier calibration)",
            record.line(run)
        )?;
    }
    let verdict = loop {
        let trials: Vec<Trial> = record.runs().iter().map(|run| run.trial).collect();
        match search.next(&trials) {
            Next::Stop(verdict) => break verdict,
            Next::Try(key) => {
                let run = one_run(request, &record, key)?;
                writeln!(progress, "{}", record.line(&run))?;
                record.append(run)?;
            }
        }
    };
    let answer = match &verdict {
        Verdict::Met(trial) => Ok(record.answer(trial)),
        unmet => Err(CalibrationError::NotMet(record.failure_message(unmet))),
    };
    record.close(&verdict)?;
    Ok(out.write_all(answer?.as_bytes())?)
}

fn search_of(request: &Request) -> anyhow::Result<Search> {
    let Request {
        target, from, to, ..
    } = *request;
    if !target.is_finite() || target == 0.0 {
        return Err(CalibrationError::NoTarget(target).into());
    }
    if let (Some(low), Some(high)) = (from, to)
        && low >= high
    {
        return Err(CalibrationError::EmptyRange(low, high).into());
    }
    let case = CaseFile::load(&request.case, &request.overrides)?;
    let start = match (case.number(&request.key)?, from, to) {
        (Some(start), ..) if start != 0.0 => start,
        (_, Some(low), Some(high)) => 0.5 * (low + high),
        _ => return Err(missing_start_error(request)),
    };
    Ok(Search {
        start,
        limits: [
            from.unwrap_or(f64::NEG_INFINITY),
            to.unwrap_or(f64::INFINITY),
        ],
        target,
        tolerance: request.within * target.abs(),
        resolution: RESOLUTION,
        most_trials: request.most_runs,
    })
}

/// The error of a missing start value; a key that no case has gets an error of its own.
fn missing_start_error(request: &Request) -> anyhow::Error {
    let is_about_key = |error: &CaseError| match error {
        CaseError::Key { fault, .. } => matches!(**fault, Fault::UnknownKey { .. }),
        CaseError::Override { .. } => true,
        _ => false,
    };
    match case_with(request, 1.0) {
        Err(error) if is_about_key(&error) => error.into(),
        _ => CalibrationError::NoStart {
            key: request.key.clone(),
        }
        .into(),
    }
}

/// The case with a value of the key.
fn case_with(request: &Request, value: f64) -> Result<CaseFile, CaseError> {
    let mut overrides = request.overrides.clone();
    overrides.push(setting(&request.key, value));
    let mut case = CaseFile::load(&request.case, &overrides)?;
    let threads = &mut case.case.solver.threads;
    *threads = request.threads.or(*threads);
    Ok(case)
}

fn one_run(request: &Request, record: &Record, key: f64) -> anyhow::Result<Run> {
    let case = case_with(request, key)?;
    let number = record.runs().len() + 1;
    let folder = record.run_folder(number);
    let setting = setting(&request.key, key);
    // The folder of a killed run may still exist.
    let one = run::Request {
        force: true,
        ..run::Request::new(&case, &folder, request.build.clone())
    };
    one.run(ProgressMode::Quiet)
        .with_context(|| format!("run {number} ({setting}) failed"))?;
    let results = Quantities::read(&folder)?;
    if let Some(reason) = results.without_equilibrium() {
        return Err(CalibrationError::NoEquilibrium {
            run: number,
            setting,
            folder,
            reason,
        }
        .into());
    }
    let result = results.number(&request.of);
    let result = result.with_context(|| {
        let folder = folder.display();
        format!("run {number} ({setting}), results in {folder}")
    })?;
    Ok(Run::new(number, Trial { key, result }, &results)?)
}
