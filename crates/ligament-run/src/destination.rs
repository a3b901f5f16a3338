//! Result folder of a run while results are written.

use std::io;

use ligament_case::case::CaseFile;
use ligament_output::folder::{RESOLVED_CASE, ResultFolder};

use crate::inputs::copy_files;
use crate::origin::recorded_text;

/// Writes the results of a case into a folder, which replaces earlier results if `make` returns that the results are complete. With
/// `keeps_inputs` the folder gets copies of the files that the case reads, and `make` the case with them.
///
/// # Errors
///
/// If the folder cannot be opened, or the results cannot be written; earlier results are then unchanged.
pub(crate) fn make_results<T>(
    (case, keeps_inputs): (&CaseFile, bool),
    open: impl FnOnce() -> Result<ResultFolder, ligament_output::Error>,
    make: impl FnOnce(&ResultFolder, &CaseFile) -> anyhow::Result<(T, bool)>,
) -> anyhow::Result<T> {
    case.resolved_toml()?;
    let folder = open()?;
    let made = write_case(case, keeps_inputs, &folder).and_then(|case| make(&folder, &case));
    let (made, is_complete) = made.map_err(|error| match failed_run_message(&folder, &error) {
        Some(words) => error.context(words),
        None => error,
    })?;
    if is_complete {
        folder.finish()?;
    }
    Ok(made)
}

/// Writes the case, and copies of its files if they are kept; returns the case with the copies.
fn write_case(
    case: &CaseFile,
    keeps_inputs: bool,
    folder: &ResultFolder,
) -> anyhow::Result<CaseFile> {
    // First the file by which the folder is recognised.
    folder.write(RESOLVED_CASE, &case.resolved_toml()?)?;
    let case = copy_files(case, folder, keeps_inputs)?;
    folder.write(RESOLVED_CASE, &recorded_text(&case, folder.path())?)?;
    Ok(case)
}

/// Message about the files of a failed run and their use, where needed.
fn failed_run_message(folder: &ResultFolder, error: &anyhow::Error) -> Option<String> {
    let place = folder.path().display();
    let was_not_written = error.chain().any(|it| it.is::<io::Error>());
    // A run cannot be resumed without its case.
    let can_go_on = was_not_written && folder.file(RESOLVED_CASE).is_file();
    let onward = can_go_on.then(|| {
        format!(
            "once the cause is fixed, `ligament resume {place}` continues from the last checkpoint"
        )
    });
    let earlier = folder.replaces().map(|earlier| {
        let earlier = earlier.display();
        format!(
            "{earlier} has the earlier results; the unfinished results of this run are in {place}"
        )
    });
    match (earlier, onward) {
        (Some(earlier), Some(onward)) => Some(format!("{earlier}: {onward}")),
        (None, Some(onward)) => Some(format!("the results in {place} are unfinished: {onward}")),
        (earlier, None) => earlier,
    }
}

/// Message to the user where earlier results are replaced.
pub(crate) fn replacement_message(folder: &ResultFolder) -> Option<String> {
    let earlier = folder.replaces()?.display();
    let place = folder.path().display();
    Some(format!(
        "results are written to {place} and replace {earlier} when they are complete"
    ))
}
