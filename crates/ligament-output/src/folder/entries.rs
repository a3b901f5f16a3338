//! Files of a result folder. A folder may be of unknown origin: links in the place of result files are refused, so that no other file is
//! touched.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::kind::{Kind, REPORT, final_name};
use crate::Error;
use crate::atomic::remove_file;
use crate::remedy::{PathKind, Remedy};

/// Names of the entries of a folder.
///
/// # Errors
///
/// If the folder cannot be listed.
pub(super) fn names(folder: &Path) -> Result<Vec<OsString>, Error> {
    let entries = fs::read_dir(folder).map_err(Error::system("list", folder))?;
    let names: io::Result<Vec<OsString>> = entries.map(|it| it.map(|it| it.file_name())).collect();
    names.map_err(Error::system("list", folder))
}

/// Removes the files of a folder whose names satisfy a condition.
///
/// # Errors
///
/// If the folder cannot be listed, or a file cannot be removed.
pub(super) fn remove_files(folder: &Path, is_one: impl Fn(&str) -> bool) -> Result<(), Error> {
    let names = names(folder)?;
    let mut ones = names.iter().filter(|it| it.to_str().is_some_and(&is_one));
    ones.try_for_each(|name| remove_file(&folder.join(name)))
}

/// Removes unfinished report pages of killed processes from a result folder.
///
/// # Errors
///
/// If the folder cannot be listed, or a page cannot be removed.
pub fn remove_unfinished_pages(folder: &Path) -> Result<(), Error> {
    remove_files(folder, |name| final_name(name) == Some(REPORT))
}

/// The folder of a path, with links resolved and without a separator at the end.
pub(super) fn resolve_links(path: &Path) -> PathBuf {
    let plain: PathBuf = path.components().collect();
    let is_link = fs::symlink_metadata(&plain).is_ok_and(|it| it.is_symlink());
    match fs::canonicalize(&plain) {
        Ok(target) if is_link => target,
        _ => plain,
    }
}

/// Refuses a path that is a link, or neither file nor folder.
///
/// # Errors
///
/// If the path is a link, or neither file nor folder; the error names the path.
pub fn refuse_link(path: &Path) -> Result<(), Error> {
    match fs::symlink_metadata(path) {
        Ok(found) if found.is_symlink() => Err(Error::Link(path.to_path_buf())),
        // A pipe would block until it is opened at its other end.
        Ok(found) if !found.is_file() && !found.is_dir() => {
            let remedy = Remedy::OtherPath(PathKind::File, None);
            Err(Error::NoPlaceForFile(path.to_path_buf(), remedy))
        }
        _ => Ok(()),
    }
}

/// Refuses a result folder with a link in the place of a result file; a folder that does not exist passes.
///
/// # Errors
///
/// If there is such a link, with its path, or if the folder cannot be listed.
pub fn refuse_links(folder: &Path, kind: Kind) -> Result<(), Error> {
    if !folder.is_dir() {
        return Ok(());
    }
    for name in names(folder)? {
        let text = name.to_string_lossy();
        if kind.may_remove(&text) || (kind.holds_run)(&text) {
            refuse_link(&folder.join(&name))?;
        }
    }
    Ok(())
}
