//! The folder of a run while its results are made.

use anyhow::Context;
use ligament_case::case::CaseFile;
use ligament_output::folder::{RESOLVED_CASE, ResultFolder};

/// Makes the results of a case in a folder, which takes the place of earlier results if all are there: what is made says so.
///
/// # Errors
///
/// If the folder cannot be opened, or the results cannot be made; earlier results are then as they were.
pub(crate) fn make_results<T>(
    case: &CaseFile,
    open: impl FnOnce() -> Result<ResultFolder, ligament_output::Error>,
    make: impl FnOnce(&ResultFolder) -> anyhow::Result<(T, bool)>,
) -> anyhow::Result<T> {
    let resolved = case.resolved_toml()?;
    let folder = open()?;
    let written = folder.write_text(RESOLVED_CASE, &resolved);
    let made = written
        .map_err(anyhow::Error::from)
        .and_then(|()| make(&folder));
    let (made, is_complete) = match folder.replaces() {
        None => made?,
        Some(earlier) => made.with_context(|| {
            let unfinished = folder.path().display();
            let earlier = earlier.display();
            format!("the results in {earlier} are the earlier ones; those of this run are unfinished, in {unfinished}")
        })?,
    };
    if is_complete {
        folder.finish()?;
    }
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
