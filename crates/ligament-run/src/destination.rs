//! The folder of a run while its results are made.

use std::path::Path;

use anyhow::Context;
use ligament_case::case::CaseFile;
use ligament_output::folder::{RESOLVED_CASE, ResultFolder};

/// Makes the results of a case in a new folder, which takes the place of earlier results once all are there.
///
/// # Errors
///
/// If the folder cannot be used, or the results cannot be made; earlier results are then as they were.
pub(crate) fn make_results<T>(
    case: &CaseFile,
    out: &Path,
    force: bool,
    make: impl FnOnce(&ResultFolder) -> anyhow::Result<T>,
) -> anyhow::Result<T> {
    let resolved = case.resolved_toml()?;
    let folder = ResultFolder::create(out, force)?;
    let written = folder.write_text(RESOLVED_CASE, &resolved);
    let made = written
        .map_err(anyhow::Error::from)
        .and_then(|()| make(&folder));
    let made = match folder.replaces() {
        None => made?,
        Some(_) => made.with_context(|| {
            let unfinished = folder.path().display();
            let out = out.display();
            format!("the results in {out} are the earlier ones; those of this run are unfinished, in {unfinished}")
        })?,
    };
    folder.finish()?;
    Ok(made)
}

/// Words for the user where earlier results are replaced.
pub(crate) fn words(folder: &ResultFolder) -> Option<String> {
    let earlier = folder.replaces()?.display();
    let place = folder.path().display();
    Some(format!(
        "results are made in {place}; they take the place of {earlier} when they are complete"
    ))
}
