//! File that the case of a run came from: the first line of the resolved case names it, with the identity of its content, so that `resume` can
//! tell that it has changed since.

use std::path::{Path, PathBuf};

use ligament_case::case::CaseFile;
use ligament_case::input_file;
use ligament_output::folder::RESOLVED_CASE;
use ligament_output::summary::Identity;

use crate::inputs::recorded_case;

/// Beginning of the line.
const BEGINNING: &str = "# from ";

/// Text of the case as a result folder records it.
///
/// # Errors
///
/// If the case cannot be written as TOML.
pub(crate) fn recorded_text(case: &CaseFile, folder: &Path) -> anyhow::Result<String> {
    let kept = is_of(case, folder).then(|| first_line_of_origin(&case.source.text));
    let line = kept.unwrap_or_else(|| line_of(case)).unwrap_or_default();
    Ok(line + &recorded_case(case, folder).resolved_toml()?)
}

/// Message where the file that the case of earlier results came from has changed since; none where it is gone.
pub(crate) fn change(case: &CaseFile, folder: &Path) -> Option<String> {
    let line = first_line_of_origin(&case.source.text)?;
    let (path, then) = line.trim_end().strip_prefix(BEGINNING)?.rsplit_once(" (")?;
    let path = PathBuf::from(path);
    let now = Identity::new(input_file::read_text(&path).ok()?.as_bytes());
    // A run that began anew while it was resumed came from the resolved case that it replaces.
    let is_other = path.parent() != Some(folder) && format!("{now})") != then;
    let (path, folder) = (path.display(), folder.display());
    is_other
        .then(|| format!("{path} has changed since; the run goes on with {folder}/{RESOLVED_CASE}"))
}

/// Whether a case is the resolved one of a result folder.
fn is_of(case: &CaseFile, folder: &Path) -> bool {
    case.source.path == folder.join(RESOLVED_CASE)
}

/// The line of a resolved case, if it has one.
fn first_line_of_origin(text: &str) -> Option<String> {
    let line = text.lines().next()?;
    line.starts_with(BEGINNING).then(|| format!("{line}\n"))
}

/// The line of a case that comes from a file.
fn line_of(case: &CaseFile) -> Option<String> {
    let (path, text) = (&case.source.path, &case.source.text);
    let path = std::path::absolute(path).ok()?;
    // A comment of TOML has no control characters.
    let path = path.to_str().filter(|it| !it.contains(char::is_control))?;
    let content = Identity::new(text.as_bytes());
    (!text.is_empty()).then(|| format!("{BEGINNING}{path} ({content})\n"))
}
