//! Copies of results.

use std::fs;
use std::path::Path;

use super::entries::{names, refuse_links};
use super::kind::{Kind, is_own_trace};
use super::lock::Lock;
use super::{ResultFolder, recover};
use crate::Error;

/// Copies the files of a folder with the results of a run into another one, where earlier results are replaced if `replace` is set.
///
/// # Errors
///
/// If a process writes to either folder, the other one may not be used, or a file cannot be copied.
pub fn copy_results(from: &Path, to: &Path, replace: bool) -> Result<(), Error> {
    recover(from, Kind::RUN)?;
    Lock::check(from)?;
    refuse_links(from, Kind::RUN)?;
    let into = ResultFolder::create(to, replace)?;
    let mut names = names(from)?;
    // First the file by which a folder is recognised.
    names.sort_by_key(|name| name.to_str() != Some(Kind::RUN.marker));
    for name in names {
        let (source, target) = (from.join(&name), into.path().join(&name));
        let is_trace = name.to_str().is_some_and(is_own_trace);
        if !is_trace && source.is_file() {
            fs::copy(&source, &target).map_err(Error::system("copy", &source))?;
        }
    }
    into.finish()
}
